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

std::vector<PlanEntry> fieldPlan(const sdf::FieldScene& scene) {
    const bool traced = !scene.tree.empty() || scene.glsl, bounded = traced && scene.bound_holds;
    const std::string why_not = traced ? kBoundBroken : "the scene has no field";
    std::vector<PlanEntry> plan;
    plan.push_back(
        {"prepass", bounded, bounded ? "cones find how far the rays of a tile are free" : why_not});
    const bool pruned = bounded && !scene.glsl;
    plan.push_back({"prune", pruned,
                    pruned    ? "tapes are shortened where children do not count"
                    : bounded ? "raw GLSL has no tape"
                              : why_not});
    addClosedForms(scene, {}, plan);
    return plan;
}

}  // namespace edgewise
