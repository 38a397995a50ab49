#include "paper_figures/field_slice.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "paper_figures/picture_row.h"
#include "sdf/evaluate.h"
#include "sdf/trace_step.h"

namespace edgewise::figures {

double valueOn(const sdf::Tape& field, glm::dvec2 p) {
    return sdf::valueAt(field, glm::dvec3(p, 0.0)) / field.lipschitz;
}

glm::dvec2 normalOn(const sdf::Tape& field, glm::dvec2 p) {
    return glm::normalize(glm::dvec2(sdf::gradientAt(field, glm::dvec3(p, 0.0)).gradient));
}

March marchAlong(const sdf::Tape& field, const SliceRay& ray, sdf::Relaxation relaxation, double omega,
                 int most_steps) {
    const sdf::tracing::TraceRules rules{
        static_cast<int>(relaxation), omega, ray.t_max, 0.0, ray.pixel_slope, 1.0, 0.0};
    sdf::tracing::TraceState state = sdf::tracing::traceFrom(rules, ray.t_min);
    March march;
    while (!sdf::tracing::traceEnded(state) && static_cast<int>(march.steps.size()) < most_steps) {
        MarchStep step;
        step.t = sdf::tracing::traceAt(state);
        step.relaxed = state.step > state.radius * (1.0 + 1e-12) && state.radius > 0.0;
        const double value = ray.sign * valueOn(field, ray.at(step.t));
        const int failed = state.failed;
        state = sdf::tracing::traceTake(rules, state, value);
        step.radius = std::abs(value), step.failed = state.failed > failed;
        march.steps.push_back(step);
    }
    march.t = state.t, march.candidate_t = state.candidate_t;
    march.hit = state.end == sdf::tracing::kRayHit;
    return march;
}

void drawSolid(const SlicePanel& panel, const sdf::Tape& field, Drawing& drawing) {
    constexpr int kPerUnit = 2;  ///< texels a pixel of the drawing
    ImageBuffer image({0, 0, int(panel.size.x) * kPerUnit, int(panel.size.y) * kPerUnit});
    const double texel = 1.0 / (panel.scale * kPerUnit);
    for (int y = 0; y < image.box.y1; ++y)
        for (int x = 0; x < image.box.x1; ++x) {
            const glm::dvec2 p = panel.low + texel * glm::dvec2(x + 0.5, image.box.y1 - y - 0.5);
            const double value = valueOn(field, p);
            const double grey = std::abs(value) < 1.2 * texel ? 0.05 : value < 0.0 ? 0.55 : 1.0;
            image.rgba[image.index(x, y)] = glm::dvec4(glm::dvec3(grey), 1.0);
        }
    drawing.picture(panel.corner, panel.size, pictureOf(image, "solid", "").file.bytes);
}

sdf::Tape ballsField(const std::vector<SliceBall>& balls) {
    sdf::Tree tree;
    std::vector<std::uint32_t> children;
    for (const SliceBall& ball : balls)
        children.push_back(tree.add(sdf::Kind::kTranslate, {ball.middle.x, ball.middle.y, 0.0},
                                    {tree.add(sdf::Kind::kSphere, {ball.radius})}));
    tree.root = tree.add(sdf::Kind::kUnion, {}, children);
    return sdf::lower(tree);
}

}  // namespace edgewise::figures
