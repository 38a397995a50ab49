#include "paper_figures/changed_hits.h"

#include <algorithm>
#include <cmath>

namespace edgewise::figures {
namespace {

std::vector<double> depthsAround(const TracedView& view, const FieldSamples& samples, int x, int y) {
    std::vector<double> depths;
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, view.film.height - 1); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, view.film.width - 1); ++i)
            if (i != x || j != y) depths.push_back(samples.depth[view.index(i, j)]);
    return depths;
}

HitChange kindOf(const TracedView& view, const std::vector<double>& around, double before, double after) {
    const auto shown = [&](double depth) {
        return std::ranges::any_of(around, [&](double other) { return sameHit(view, other, depth); });
    };
    if (shown(after)) return HitChange::kSilhouette;
    const auto [least, most] = std::ranges::minmax(around);
    if (least <= after && after <= most) return HitChange::kGrazing;
    return shown(before) ? HitChange::kAlone : HitChange::kNarrow;
}

}  // namespace

std::vector<ChangedHit> changedHits(const TracedView& view, const FieldSamples& before,
                                    const FieldSamples& after) {
    std::vector<ChangedHit> changed;
    for (int y = 0; y < view.film.height; ++y)
        for (int x = 0; x < view.film.width; ++x) {
            const double was = before.depth[view.index(x, y)], is = after.depth[view.index(x, y)];
            if (sameHit(view, was, is)) continue;
            changed.push_back({x, y, was, is, kindOf(view, depthsAround(view, before, x, y), was, is)});
        }
    return changed;
}

}  // namespace edgewise::figures
