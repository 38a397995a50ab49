#include "pipeline/field_plan.h"

#include <fmt/format.h>

namespace edgewise {

void addClosedForms(const sdf::FieldScene& scene, const sdf::TraceSettings& settings,
                    std::vector<PlanEntry>& plan) {
    const bool convex = settings.convex && scene.convex.has_value();
    plan.push_back({"convex", convex,
                    convex         ? "rays are traced within the scene's convex bound alone"
                    : scene.convex ? "switched off"
                                   : "the scene names no convex bound"});
    plan.push_back({"analytic", !scene.analytic.empty(),
                    fmt::format("{} shapes are met in closed form", scene.analytic.size())});
}

}  // namespace edgewise
