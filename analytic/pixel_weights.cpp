#include "analytic/pixel_weights.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "analytic/base_point.h"
#include "analytic/border.h"
#include "analytic/edge_integral.h"
#include "analytic/owner_table.h"

namespace edgewise {
namespace {

using Lanes = std::array<std::int64_t, PixelWeights::kLanes>;

/// A segment farther than this from a support cannot be rounded into it: 2^-40 is far more than its few
/// roundings of 2^-53.
constexpr double kSlack = 1.0 + 0x1p-40;
/// ... nor moved by its points' rests, nor come near to the base point of one.
constexpr double kMargin = 4 * kGridPx;

/// Sums may leave the range on the way: they come back, modulo 2^64.
void wrappingAdd(FixedWeight& sum, FixedWeight term) {
    sum = static_cast<FixedWeight>(static_cast<std::uint64_t>(sum) + static_cast<std::uint64_t>(term));
}

void addLanes(OwnerTable& table, Owner owner, const std::int64_t* value, std::int64_t sign) {
    Lanes& weight = table.row(owner).weight;
    for (int i = 0; i < PixelWeights::kLanes; ++i) wrappingAdd(weight[i], sign * value[i]);
}

EdgeInput inputOf(glm::dvec2 sample, const VisibleSegment& s, const CarrierLine& l) {
    return {sample.x,   sample.y,   s.a.grid.x,    s.a.grid.y,   s.a.rest.x, s.a.rest.y,
            s.b.grid.x, s.b.grid.y, s.b.rest.x,    s.b.rest.y,   s.length,   l.origin.x,
            l.origin.y, l.nx_hi,    l.nx_lo,       l.ny_hi,      l.ny_lo,    l.c_hi,
            l.c_lo,     l.length,   l.direction.x, l.direction.y};
}

}  // namespace

struct PixelWeights::State {
    State(const Prefilter& filter, Precision precision)
        : kernel(filter, precision), edge_terms(chooseEdgeTerms(precision)) {}

    bool reaches(const VisibleSegment& segment) const;
    bool radial() const { return kernel.lanes.form != kStripTerm; }
    void addBorder(Owner left, Owner right);
    void addBases(const EdgeInput& input, Owner left, Owner right);

    EdgeKernel kernel;
    EdgeTermsFunction edge_terms;
    glm::dvec2 first{0.0};
    int count = 0;
    EdgeTerms terms{};
    OwnerTable table;
    std::array<std::vector<BorderCrossing>, kLanes> crossings;
    std::array<f64::BasePoint, kLanes> bases;
    std::vector<BorderShare> shares;
    std::uint64_t term_count = 0, conflicts = 0;
};

/// Whether the segment's box meets the box of the supports.
bool PixelWeights::State::reaches(const VisibleSegment& segment) const {
    const double reach = kernel.lanes.radius * kSlack + kMargin;
    const glm::dvec2 a = segment.a.grid - first, b = segment.b.grid - first;
    return std::min(a.x, b.x) <= reach + (count - 1) && std::max(a.x, b.x) >= -reach &&
           std::min(a.y, b.y) <= reach && std::max(a.y, b.y) >= -reach;
}

void PixelWeights::State::addBorder(Owner left, Owner right) {
    for (int slot = 0; slot < 2; ++slot)
        for (int i = 0; i < count; ++i)
            if (terms.crossed[slot] >> i & 1u)
                crossings[i].push_back({terms.order[slot][i], terms.position[slot][i], terms.doubt[slot][i],
                                        terms.spread[slot][i], slot == 0 ? left : right,
                                        slot == 0 ? right : left});
}

/// Lanes whose point (sample.x + R, sample.y) the segment's box comes near to.
void PixelWeights::State::addBases(const EdgeInput& in, Owner left, Owner right) {
    const double R = kernel.lanes.radius, margin = kMargin;
    const glm::dvec2 a = glm::dvec2(in.a_x, in.a_y) - first, b = glm::dvec2(in.b_x, in.b_y) - first;
    if (std::min(a.y, b.y) > margin || std::max(a.y, b.y) < -margin) return;
    const double from = std::max(0.0, std::ceil(std::min(a.x, b.x) - R - margin));
    const double to = std::min(count - 1.0, std::floor(std::max(a.x, b.x) - R + margin));
    for (int i = static_cast<int>(from); i <= to; ++i)
        f64::considerBase(bases[i], radial(), R, in, first.x + i, left, right);
}

PixelWeights::PixelWeights(const Prefilter& filter, Precision precision)
    : state_(std::make_unique<State>(filter, precision)) {}
PixelWeights::~PixelWeights() = default;

void PixelWeights::begin(glm::dvec2 first_sample_px, int count) {
    state_->first = first_sample_px;
    state_->count = count;
    state_->table.clear();
    for (auto& list : state_->crossings) list.clear();
    state_->bases.fill(f64::noBasePoint());
}

void PixelWeights::add(const VisibleSegment& segment, const CarrierLine& line, Owner left, Owner right) {
    State& s = *state_;
    if (left == right || !s.reaches(segment)) return;
    const EdgeInput input = inputOf(s.first, segment, line);
    s.addBases(input, left, right);
    s.edge_terms(s.kernel.lanes, input, s.terms);
    const unsigned touched = s.terms.touched & ((1u << s.count) - 1u);
    if (touched == 0) return;
    s.term_count += static_cast<unsigned>(__builtin_popcount(touched));
    addLanes(s.table, left, s.terms.value, 1);
    addLanes(s.table, right, s.terms.value, -1);
    s.addBorder(left, right);
}

void PixelWeights::finish(const Owner* base_owner, std::vector<OwnerWeight>& out, std::size_t* offset) {
    State& s = *state_;
    for (int i = 0; i < s.count; ++i) {
        const Owner base = f64::isKnown(s.bases[i]) ? s.bases[i].owner : base_owner[i];
        s.conflicts += static_cast<unsigned>(shareBorder(s.crossings[i], s.radial(), base, s.shares));
        for (const BorderShare& share : s.shares)
            wrappingAdd(s.table.row(share.owner).weight[i], share.share);
    }
    const std::vector<OwnerTable::Row>& rows = s.table.sorted();
    for (int i = 0; i < s.count; ++i) {
        offset[i] = out.size();
        for (const OwnerTable::Row& row : rows)
            if (row.weight[i] != 0) out.push_back({row.owner, row.weight[i]});
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
