#include "tests/fuzz/check_visibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "analytic/pixel_weights.h"
#include "analytic/row_owners.h"
#include "analytic/visibility.h"
#include "tests/fuzz/scene_from_bytes.h"
#include "tests/witness/map_scan.h"
#include "tests/witness/wide.h"

namespace edgewise::fuzz {
namespace {

constexpr int kReachPx = 3;
constexpr int kRandomLines = 6;
/// The weights' target, on each px2 that is judged along either axis: what two roundings of one depth may
/// differ in.
constexpr double kWrongPx2 = 1e-12 * 2 * (2 * kReachPx) * (2 * kReachPx);

bool finite(const FinePoint& p) {
    return std::isfinite(p.grid.x) && std::isfinite(p.grid.y) && std::abs(p.rest.x) <= kGridPx &&
           std::abs(p.rest.y) <= kGridPx;
}

std::string checkSegments(const VisibleMap& map) {
    for (const VisibleSegment& s : map.segments) {
        if (!finite(s.a) || !finite(s.b) || !std::isfinite(s.length)) return "a segment is not finite";
        if (s.left == s.right) return fmt::format("a segment has owner {} on both sides", s.left);
        if (s.line >= map.lines.size()) return "a segment lies on no line";
        const glm::dvec2 run = (s.b.grid - s.a.grid) + (s.b.rest - s.a.rest);
        const glm::dvec2 direction = map.lines[s.line].direction;
        if (run.x * direction.x + run.y * direction.y < 0) return "a segment runs against its line";
    }
    return {};
}

/// That an owner's boundary enters or leaves a point.
struct Passage {
    witness::Quad x, y;
    Owner owner;
    int by;
    auto place() const { return std::tie(x, y, owner); }
};

/// Owners are left as often as they are entered at every point of a leaf, bit for bit, but on its border.
std::string checkClosed(const VisibleMap& map, const Window& cells) {
    std::vector<Passage> passages;
    const auto note = [&](const FinePoint& p, Owner owner, int by) {
        const witness::Quad x = witness::Quad(p.grid.x) + p.rest.x, y = witness::Quad(p.grid.y) + p.rest.y;
        const bool inside = x > cells.x0 + kBorderRestPx && x < cells.x1 + kBorderRestPx &&
                            y > cells.y0 + kBorderRestPx && y < cells.y1 + kBorderRestPx;
        if (inside) passages.push_back({x, y, owner, by});
    };
    for (const VisibleSegment& s : map.segments) {
        note(s.a, s.left, 1), note(s.b, s.left, -1);
        note(s.a, s.right, -1), note(s.b, s.right, 1);
    }
    std::sort(passages.begin(), passages.end(),
              [](const Passage& p, const Passage& q) { return p.place() < q.place(); });
    for (std::size_t first = 0; first < passages.size();) {
        int sum = 0;
        std::size_t last = first;
        for (; last < passages.size() && passages[last].place() == passages[first].place(); ++last)
            sum += passages[last].by;
        if (sum != 0)
            return fmt::format("the boundary of owner {} is open at ({:.17g}, {:.17g})",
                               passages[first].owner, double(passages[first].x), double(passages[first].y));
        first = last;
    }
    return {};
}

struct FilterWeights {
    const char* name;
    Prefilter filter;
    PixelWeights weights;

    explicit FilterWeights(const char* n) : name(n), filter(makePrefilter(n, {}, {})), weights(filter) {}
};

/// An open boundary shows in the weights of positive kernels: an owner below 0, or labels that are not left
/// as often as entered.
std::string checkSample(FilterWeights& f, const VisibleMap& map, glm::ivec2 pixel) {
    constexpr double kRoundings = 0x1p-40;  // of up to a thousand terms and border shares, with room
    const std::uint64_t conflicts = f.weights.label_conflicts();
    const glm::dvec2 sample = glm::dvec2(pixel) + 0.5;
    f.weights.begin(sample, 1);
    for (const VisibleSegment& s : map.segments) f.weights.add(s, map.lines[s.line], s.left, s.right);
    const Owner base = ownerOnRow(map, pixel.y, sample.x + f.filter.radius);
    std::vector<OwnerWeight> weights;
    std::size_t offset[2] = {0, 0};
    f.weights.finish(&base, weights, offset);
    FixedWeight sum = 0;
    for (const OwnerWeight& entry : weights) {
        sum += entry.weight;
        const double weight = std::ldexp(double(entry.weight), -kWeightBits);
        if (weight < -kRoundings || weight > 1 + kRoundings)
            return fmt::format("{}: owner {} has weight {}", f.name, entry.owner, weight);
    }
    if (sum != FixedWeight{1} << kWeightBits) return fmt::format("{}: weights do not sum to 1", f.name);
    if (f.weights.label_conflicts() != conflicts)
        return fmt::format("{}: border labels do not chain", f.name);
    return {};
}

/// The kernels take both ways to the closed form, strips and fans, and supports within the judged window.
std::string checkWeights(const VisibleMap& map) {
    static FilterWeights filters[] = {FilterWeights("box"), FilterWeights("disk"), FilterWeights("cone"),
                                      FilterWeights("gaussian")};
    for (FilterWeights& f : filters)
        for (const glm::ivec2 by : {glm::ivec2(0, 0), glm::ivec2(1, 0), glm::ivec2(-1, 1)})
            if (std::string wrong = checkSample(f, map, glm::ivec2(int(std::floor(kSamplePx))) + by);
                !wrong.empty())
                return wrong;
    return {};
}

Window judgedWindow() {
    const int centre = int(std::floor(kSamplePx)), reach = kReachPx + 1;
    return {centre - reach, centre - reach, centre + reach + 1, centre + reach + 1};
}

std::string checkPartition(const VisibleMap& map, const VisibilityOptions& options) {
    const bool one_leaf = options.max_triangles >= int(kMostTriangles);
    if (std::string wrong = checkSegments(map); !wrong.empty()) return wrong;
    if (std::string wrong = one_leaf ? checkClosed(map, cellWindow(judgedWindow())) : ""; !wrong.empty())
        return wrong;
    return checkWeights(map);
}

std::string checkMap(const ScreenScene& scene, const VisibilityOptions& options) {
    const VisibleMap map = visibleMap(scene, judgedWindow(), options);
    if (std::string wrong = checkPartition(map, options); !wrong.empty()) return wrong;
    const auto verdict = witness::compareMap(scene, map, {kSamplePx, kSamplePx}, kReachPx, 1, kRandomLines);
    if (verdict.wrong_px2 <= kWrongPx2) return {};
    return fmt::format("{:.3g} px2 wrong, {} places without a single owner; first: {}",
                       double(verdict.wrong_px2), verdict.broken, verdict.first);
}

/// The judge knows no stacks, but they are a partition too.
std::string checkStacks(ScreenScene scene) {
    scene.see_through.assign(kMostTriangles, 0);
    for (std::size_t k = 0; k < scene.see_through.size(); k += 2) scene.see_through[k] = 1;
    return checkPartition(visibleMap(scene, judgedWindow(), {}), {});
}

std::string named(const char* where, const std::string& wrong) {
    return wrong.empty() ? wrong : where + wrong;
}

}  // namespace

std::string checkVisibility(const ScreenScene& scene) {
    VisibilityOptions split;  // so few triangles fit one cell otherwise
    split.max_triangles = 2;
    if (std::string wrong = checkMap(scene, {}); !wrong.empty()) return wrong;
    if (std::string wrong = checkMap(scene, split); !wrong.empty()) return named("in small cells: ", wrong);
    return named("see-through: ", checkStacks(scene));
}

}  // namespace edgewise::fuzz
