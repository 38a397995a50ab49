#include "sdf/describe_hits.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sdf/pattern_point.h"
#include "sdf/prune.h"

namespace edgewise::sdf {
namespace {

/// Shorter tapes are not worth shortening: that takes as long as asking them once or twice.
constexpr std::size_t kFewInstructions = 24;

/// A hit of less exact arithmetic that lies behind the surface is moved as far before it.
void describe(const Tape& tape, SurfaceHit& hit, std::size_t materials) {
    const double height = describeHit(tape, hit, materials);
    if (!(hit.inside ? height > 0.0 : height < 0.0)) return;
    hit.p_world -= hit.normal_world * (2.0 * height);
    hit.height = -height;
}

struct Extent {
    glm::dvec3 low{HUGE_VAL}, high{-HUGE_VAL};
    explicit Extent(std::span<SurfaceHit* const> hits) {
        for (const SurfaceHit* hit : hits)
            low = glm::min(low, hit->p_world), high = glm::max(high, hit->p_world);
    }
    int longestAxis() const {
        const glm::dvec3 size = high - low;
        return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    }
};

/// Halves along the longest axis.
void describeHalves(const Tape& tape, std::span<SurfaceHit*> hits, int axis, std::size_t materials) {
    const std::size_t half = hits.size() / 2;
    std::nth_element(
        hits.begin(), hits.begin() + static_cast<std::ptrdiff_t>(half), hits.end(),
        [axis](const SurfaceHit* a, const SurfaceHit* b) { return a->p_world[axis] < b->p_world[axis]; });
    describeHits(tape, hits.first(half), materials, true);
    describeHits(tape, hits.subspan(half), materials, true);
}

}  // namespace

void describeHits(const Tape& tape, std::span<SurfaceHit*> hits, std::size_t materials, bool prune) {
    if (!prune || tape.size() <= kFewInstructions || hits.size() <= 2) {
        for (SurfaceHit* hit : hits) describe(tape, *hit, materials);
        return;
    }
    const Extent extent(hits);
    const glm::dvec3 centre = 0.5 * (extent.low + extent.high);
    const double radius = glm::distance(extent.high, centre) * (1.0 + 1e-9);
    const Tape near = pruneTape(tape, centre, radius);
    describeHalves(near, hits, extent.longestAxis(), materials);
}

}  // namespace edgewise::sdf
