#include "sdf/check_lipschitz.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "sdf/evaluate.h"
#include "sdf/machine.h"

namespace edgewise::sdf {
namespace {

/// The instructions of a node and all below it, and where it is asked and answers.
struct NodeSpan {
    std::uint32_t node = 0;
    std::size_t first = SIZE_MAX, last = 0;
    double bound = 1.0;  ///< in the node's frame
};

/// Children before their parents, in the order of their last instructions, so that one run of the tape passes
/// them all.
class Spans {
  public:
    Spans(const Tree& tree, const Tape& tape) : tree_(tree), tape_(tape), spans_(tree.nodes.size()) {
        for (std::size_t i = 0; i < tape.size(); ++i) cover(tape.instructions[i].node, i, i);
        collect(tree.root);
        setBounds();
    }
    std::vector<NodeSpan> take() { return std::move(ordered_); }

  private:
    void cover(std::uint32_t node, std::size_t first, std::size_t last) {
        NodeSpan& span = spans_[node];
        span.first = std::min(span.first, first);
        span.last = std::max(span.last, last);
    }
    void collect(std::uint32_t node) {
        for (const std::uint32_t child : tree_.nodes[node].children) {
            collect(child);
            cover(node, spans_[child].first, spans_[child].last);
        }
        spans_[node].node = node;
        ordered_.push_back(spans_[node]);
    }
    void setBounds() {
        std::vector<double> slope(kMostSlots, 1.0);
        std::vector<double> at_first(tape_.size(), 1.0);
        for (std::size_t i = 0; i < tape_.size(); ++i) {
            const Instruction& instruction = tape_.instructions[i];
            const CodeForm form = codeInfo(instruction.code).form;
            if (form == CodeForm::kShape || form == CodeForm::kMove) at_first[i] = slope[instruction.a];
            if (form == CodeForm::kMove) slope[instruction.to] = instruction.lipschitz;
        }
        for (NodeSpan& span : ordered_)
            span.bound = tape_.instructions[span.last].lipschitz / at_first[span.first];
    }

    const Tree& tree_;
    const Tape& tape_;
    std::vector<NodeSpan> spans_, ordered_;
};

struct Asked {
    glm::dvec3 position;
    RunningError value;
};

class PairSampler {
  public:
    PairSampler(const FieldScene& scene, const Tape& tape, std::uint64_t seed) : tape_(tape), random_(seed) {
        findRegion(scene);
    }

    std::pair<glm::vec3, glm::vec3> next(std::size_t index) {
        glm::dvec3 p = inRegion();
        if (index % 2 == 1) p = nearSurface(p);
        if (index % 4 >= 2) return {glm::vec3(p), glm::vec3(inRegion())};
        // Distances by their logarithm: from a thousandth of the region to all of it.
        const double distance = glm::length(half_) * std::exp2(-10.0 * unit_(random_));
        return {glm::vec3(p), glm::vec3(p + distance * direction())};
    }

  private:
    void findRegion(const FieldScene& scene) {
        glm::dvec3 low(1.0), high(-1.0);
        const auto hold = [&](const glm::dvec3& a, const glm::dvec3& b) {
            const bool first = low.x > high.x;
            low = first ? a : glm::min(low, a), high = first ? b : glm::max(high, b);
        };
        const Box& b = scene.bounds;
        const glm::dvec3 b_low(b.low[0], b.low[1], b.low[2]), b_high(b.high[0], b.high[1], b.high[2]);
        if (glm::distance(b_low, b_high) > 0.0) hold(b_low, b_high);
        for (const SurfaceCamera& camera : scene.cameras) {
            const glm::dvec3 reach(0.5 * glm::distance(camera.eye_world, camera.target_world));
            hold(camera.target_world - reach, camera.target_world + reach);
        }
        if (low.x > high.x) hold(glm::dvec3(-1.0), glm::dvec3(1.0));
        middle_ = 0.5 * (low + high);
        half_ = 0.75 * (high - low) + 0.01 * glm::length(high - low);
    }
    glm::dvec3 inRegion() {
        const double x = unit_(random_), y = unit_(random_), z = unit_(random_);
        return middle_ + half_ * (2.0 * glm::dvec3(x, y, z) - 1.0);
    }
    glm::dvec3 direction() {
        for (;;) {
            const double x = unit_(random_), y = unit_(random_), z = unit_(random_);
            const glm::dvec3 d = 2.0 * glm::dvec3(x, y, z) - 1.0;
            const double size = glm::length(d);
            if (size > 0.01 && size <= 1.0) return d / size;
        }
    }
    /// Newton's steps along the gradient, held within the region's size.
    glm::dvec3 nearSurface(glm::dvec3 p) const {
        const double most = glm::length(half_);
        for (int i = 0; i < 4; ++i) {
            const ValueAndGradient at = gradientAt(tape_, p);
            const double slope2 = glm::dot(at.gradient, at.gradient);
            if (!(slope2 > 1e-12)) break;
            glm::dvec3 step = -at.value / slope2 * at.gradient;
            if (glm::length(step) > most) step *= most / glm::length(step);
            p += step;
        }
        return p;
    }

    const Tape& tape_;
    std::mt19937_64 random_;
    std::uniform_real_distribution<double> unit_{0.0, 1.0};
    glm::dvec3 middle_{0.0}, half_{1.0};
};

/// What every node is asked and answers at a point.
void askAll(const Tape& tape, const std::vector<NodeSpan>& spans, const glm::vec3& p,
            Slots<RunningError>& slots, std::vector<Vec3<RunningError>>& before,
            std::vector<Asked>& answers) {
    slots.position[0] = {RunningError(p.x, 0.0), RunningError(p.y, 0.0), RunningError(p.z, 0.0)};
    std::size_t next = 0;
    for (std::size_t i = 0; i < tape.size(); ++i) {
        const Instruction& instruction = tape.instructions[i];
        before[i] = slots.position[instruction.a];
        step(instruction, tape.numbers.data() + instruction.numbers, slots);
        for (; next < spans.size() && spans[next].last == i; ++next) {
            const Vec3<RunningError>& at = before[spans[next].first];
            answers[next] = {{at.x.value, at.y.value, at.z.value}, slots.value[instruction.to]};
        }
    }
}

std::size_t pairCount(const Tape& tape) {
    constexpr std::size_t kMost = 4096, kLeast = 256, kSteps = std::size_t(1) << 21;
    return std::clamp(kSteps / tape.size(), kLeast, kMost);
}

}  // namespace

std::vector<LipschitzViolation> checkLipschitz(const FieldScene& scene, const LipschitzSamples& samples) {
    if (scene.tree.empty()) return {};
    const Tape tape = lower(scene.tree);
    const std::vector<NodeSpan> spans = Spans(scene.tree, tape).take();
    PairSampler sampler(scene, tape, samples.seed);
    Slots<RunningError> slots;
    std::vector<Vec3<RunningError>> before(tape.size());
    std::vector<Asked> at_p(spans.size()), at_q(spans.size());
    std::vector<LipschitzViolation> found(spans.size());
    const std::size_t pairs = samples.pairs > 0 ? samples.pairs : pairCount(tape);
    for (std::size_t pair = 0; pair < pairs; ++pair) {
        const auto [p, q] = sampler.next(pair);
        askAll(tape, spans, p, slots, before, at_p);
        askAll(tape, spans, q, slots, before, at_q);
        for (std::size_t s = 0; s < spans.size(); ++s) {
            const double distance = glm::distance(at_p[s].position, at_q[s].position);
            const double rounding = at_p[s].value.error + at_q[s].value.error;
            const double change = std::abs(at_p[s].value.value - at_q[s].value.value) - rounding;
            LipschitzViolation& worst = found[s];
            ++worst.of;
            if (!(change > spans[s].bound * distance)) continue;  // without a bound on rounding, too
            ++worst.pairs;
            worst.measured = std::max(worst.measured, distance > 0.0 ? change / distance : INFINITY);
        }
    }
    // Children come before their parents.
    std::vector<bool> told_below(scene.tree.nodes.size(), false);
    std::vector<LipschitzViolation> told;
    for (std::size_t s = 0; s < spans.size(); ++s) {
        const Node& node = scene.tree.nodes[spans[s].node];
        bool below = false;
        for (const std::uint32_t child : node.children) below = below || told_below[child];
        const bool tell = found[s].pairs > 0 && (!below || node.declared_lipschitz.has_value());
        told_below[spans[s].node] = below || tell;
        if (!tell) continue;
        found[s].node = spans[s].node, found[s].path = node.path, found[s].bound = spans[s].bound;
        told.push_back(found[s]);
    }
    return told;
}

std::string wordsOf(const LipschitzViolation& v) {
    return fmt::format(
        "{}: changes {:.4g} as fast as position does, more than its bound {:.4g}, in {} of {} pairs; "
        "relaxation, pruning and the prepass are off, steps are by the bound all the same",
        v.path, v.measured, v.bound, v.pairs, v.of);
}

}  // namespace edgewise::sdf
