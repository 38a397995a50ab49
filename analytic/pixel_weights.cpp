#include "analytic/pixel_weights.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "analytic/base_point.h"
#include "analytic/border.h"
#include "analytic/edge_input.h"
#include "analytic/edge_integral.h"
#include "analytic/sample_owners.h"
#include "analytic/segment_tiles.h"

namespace edgewise {
namespace {

/// A segment farther than this from a support cannot be rounded into it: 2^-40 is far more than its few
/// roundings of 2^-53.
constexpr double kSlack = 1.0 + 0x1p-40;
/// ... nor moved by its points' rests, nor come near to the base point of one.
constexpr double kMargin = 4 * kGridPx;

}  // namespace

struct PixelWeights::State {
    State(const Prefilter& filter, Precision precision)
        : kernel(filter, precision), edge_terms(chooseEdgeTerms(precision)) {}

    LaneRange reach(const VisibleSegment& segment) const;
    bool radial() const { return kernel.lanes.form != kStripTerm; }
    void queue(const EdgeInput& edge, Owner left, Owner right, LaneRange lanes);
    void evaluate();
    void addBorder(int slot);
    void addBases(const EdgeInput& input, Owner left, Owner right);

    EdgeKernel kernel;
    EdgeTermsFunction edge_terms;
    glm::dvec2 first{0.0};
    int count = 0;

    // pairs that wait for a call of edge_terms
    struct Side {
        int lane;
        Owner left, right;
    };
    std::array<EdgePair, kMostPairs> pairs;
    std::array<Side, kMostPairs> sides;
    int pair_count = 0;
    /// Of those given as segments, in turn: each has a pair at least, so one in use is among the last
    /// kMostPairs.
    std::array<EdgeInput, kMostPairs + 1> own_edges;
    std::size_t own_next = 0;
    EdgeTerms terms{};

    std::array<SampleOwners, kLanes> sums;
    std::array<std::vector<BorderCrossing>, kLanes> crossings;
    std::array<f64::BasePoint, kLanes> bases;
    std::vector<BorderShare> shares;
    std::uint64_t term_count = 0, conflicts = 0;
};

/// Lanes whose support's box the segment's box meets.
LaneRange PixelWeights::State::reach(const VisibleSegment& segment) const {
    const double reach = kernel.lanes.radius * kSlack + kMargin;
    const glm::dvec2 a = segment.a.grid - first, b = segment.b.grid - first;
    if (std::min(a.y, b.y) > reach || std::max(a.y, b.y) < -reach) return {0, -1};
    return LaneRange::within(std::min(a.x, b.x) - reach, std::max(a.x, b.x) + reach, count);
}

void PixelWeights::State::queue(const EdgeInput& edge, Owner left, Owner right, LaneRange lanes) {
    for (int lane = lanes.first; lane <= lanes.last; ++lane) {
        if (pair_count == kMostPairs) evaluate();
        const auto at = static_cast<std::size_t>(pair_count++);
        pairs[at] = {&edge, first.x + lane, first.y};
        sides[at] = {lane, left, right};
    }
}

void PixelWeights::State::evaluate() {
    if (pair_count == 0) return;
    edge_terms(kernel.lanes, pairs.data(), pair_count, terms);
    term_count += static_cast<std::uint64_t>(std::popcount(terms.touched));
    for (PairSet set = terms.touched; set != 0; set &= set - 1) {
        const auto at = static_cast<std::size_t>(std::countr_zero(set));
        SampleOwners& sum = sums[static_cast<std::size_t>(sides[at].lane)];
        sum.add(sides[at].left, terms.value[at]);
        sum.add(sides[at].right, -terms.value[at]);
    }
    addBorder(0), addBorder(1);
    pair_count = 0;
}

void PixelWeights::State::addBorder(int slot) {
    for (PairSet set = terms.crossed[slot]; set != 0; set &= set - 1) {
        const auto at = static_cast<std::size_t>(std::countr_zero(set));
        const Side& side = sides[at];
        crossings[static_cast<std::size_t>(side.lane)].push_back(
            {terms.order[slot][at], terms.position[slot][at], terms.doubt[slot][at], terms.spread[slot][at],
             slot == 0 ? side.left : side.right, slot == 0 ? side.right : side.left});
    }
}

/// Lanes whose point (sample.x + R, sample.y) the segment comes near to, seldom any: a margin twice as wide
/// as considerBase() looks covers all roundings, here of the ordinates that a flat segment's abscissae hang
/// on.
void PixelWeights::State::addBases(const EdgeInput& in, Owner left, Owner right) {
    const double R = kernel.lanes.radius, margin = kMargin;
    const double a_y = in.a_y - first.y, b_y = in.b_y - first.y;
    if (std::min(a_y, b_y) > margin || std::max(a_y, b_y) < -margin) return;
    const double a_x = in.a_x - first.x, b_x = in.b_x - first.x;
    const f64::Span met = a_y <= b_y ? f64::spanWithin(a_x, a_y, b_x, b_y, -margin, margin)
                                     : f64::spanWithin(b_x, b_y, a_x, a_y, -margin, margin);
    const LaneRange near = LaneRange::within(met.low - R - margin, met.high - R + margin, count);
    for (int i = near.first; i <= near.last; ++i)
        f64::considerBase(bases[static_cast<std::size_t>(i)], radial(), R, in, first.x + i, first.y, left,
                          right);
}

PixelWeights::PixelWeights(const Prefilter& filter, Precision precision)
    : state_(std::make_unique<State>(filter, precision)) {}
PixelWeights::~PixelWeights() = default;

void PixelWeights::begin(glm::dvec2 first_sample_px, int count) {
    State& s = *state_;
    s.first = first_sample_px;
    s.count = count;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        s.sums[i].clear();
        s.crossings[i].clear();
        s.bases[i] = f64::noBasePoint();
    }
}

void PixelWeights::add(const VisibleSegment& segment, const CarrierLine& line, Owner left, Owner right) {
    State& s = *state_;
    const LaneRange lanes = s.reach(segment);
    if (left == right || lanes.last < lanes.first) return;
    EdgeInput& edge = s.own_edges[s.own_next];
    s.own_next = (s.own_next + 1) % s.own_edges.size();
    edge = edgeInput(segment, line);
    add(edge, left, right, lanes);
}

void PixelWeights::add(const EdgeInput& edge, Owner left, Owner right, LaneRange lanes) {
    if (left == right) return;
    state_->addBases(edge, left, right);
    state_->queue(edge, left, right, lanes);
}

void PixelWeights::finish(const Owner* base_owner, std::vector<OwnerWeight>& out, std::size_t* offset) {
    State& s = *state_;
    s.evaluate();
    for (std::size_t i = 0; i < static_cast<std::size_t>(s.count); ++i) {
        offset[i] = out.size();
        const Owner base = f64::isKnown(s.bases[i]) ? s.bases[i].owner : base_owner[i];
        if (s.crossings[i].empty() && s.sums[i].empty()) {
            out.push_back({base, FixedWeight{1} << kWeightBits});
            continue;
        }
        s.conflicts += static_cast<unsigned>(shareBorder(s.crossings[i], s.radial(), base, s.shares));
        for (const BorderShare& share : s.shares) s.sums[i].add(share.owner, share.share);
        s.sums[i].appendTo(out);
    }
    offset[s.count] = out.size();
}

std::uint64_t PixelWeights::terms() const {
    return state_->term_count;
}
std::uint64_t PixelWeights::label_conflicts() const {
    return state_->conflicts;
}

}  // namespace edgewise
