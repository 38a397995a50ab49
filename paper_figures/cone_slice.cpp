#include "paper_figures/cone_slice.h"

#include <algorithm>

namespace edgewise::figures {

ConeMarch marchCone(const sdf::Tape& field, const SliceRay& ray, const sdf::ConeSettings& settings) {
    constexpr std::size_t kMostSteps = 400;
    sdf::TraceSettings trace;
    trace.relaxation = sdf::Relaxation::kNone;
    const sdf::FieldRay traced{glm::dvec3(ray.origin, 0.0),
                               glm::dvec3(ray.direction, 0.0),
                               ray.t_min,
                               ray.t_max,
                               0.0,
                               ray.pixel_slope};
    const sdf::cones::ConeRules rules = sdf::coneRules(traced, trace, settings);
    sdf::cones::ConeState state = sdf::cones::coneFrom(rules, ray.t_min);
    ConeMarch march;
    march.slope = rules.slope;
    while (!sdf::cones::coneEnded(state) && march.steps.size() < kMostSteps) {
        const double t = sdf::cones::coneAt(state), value = valueOn(field, ray.at(t));
        const double before = march.steps.empty() ? t : march.steps.back().t;
        state = sdf::cones::coneTake(rules, state, value);
        march.steps.push_back({t, value, sdf::cones::coneRadiusAt(rules, t), state.open});
        if (state.closed)
            march.groups.push_back(
                {{sdf::cones::coneSampleAt(state), state.entry_t, sdf::cones::coneLeast(state), state.hard},
                 state.open ? t : before});
    }
    march.full = state.end == sdf::cones::kConeFull;
    return march;
}

}  // namespace edgewise::figures
