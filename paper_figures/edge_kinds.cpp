#include "paper_figures/edge_kinds.h"

#include <algorithm>
#include <cmath>

#include "paper_figures/traced_view.h"
#include "pipeline/field_rays.h"

namespace edgewise::figures {
namespace {

/// A point is another surface's when either tangent plane is farther from the other point: of a sub-sample's
/// side there. Along a crease, and around a bend, one of both planes holds its neighbour within that.
constexpr double kLeap = 2.0;
constexpr double kTurn = 0.9659;         // 15 degrees
constexpr double kLightStep = 1.0 / 32;  // smooth shading changes less from a sub-sample to the next

class Facts {
  public:
    Facts(const FieldWindow& window, const sdf::RayGrid& rays, const SampledFacts& facts)
        : window_(window), rays_(rays), facts_(facts) {}

    EdgeKind between(std::size_t a, std::size_t b) const {
        const FieldSamples& s = facts_.surface;
        const bool hit = std::isfinite(s.depth[a]);
        if (hit != std::isfinite(s.depth[b])) return EdgeKind::kContour;
        if (!hit) return EdgeKind::kNone;
        if (leaps(a, b)) return EdgeKind::kContour;
        if (glm::dot(s.normal[a], s.normal[b]) < kTurn) return EdgeKind::kInternal;
        if (s.surface[a] != s.surface[b] || step(s.color[a], s.color[b]) > kEdgeContrast)
            return EdgeKind::kTexture;
        return step(facts_.color[a], facts_.color[b]) > kLightStep ? EdgeKind::kLight : EdgeKind::kNone;
    }

  private:
    static double step(const glm::dvec4& a, const glm::dvec4& b) {
        const glm::dvec4 d = glm::abs(a - b);
        return std::max({d.x, d.y, d.z});
    }
    sdf::FieldRay rayOf(std::size_t i) const {
        const std::size_t stride = window_.stride();
        const double side = window_.per_side;
        return rays_.ray({window_.pixels.x0 + (static_cast<double>(i % stride) + 0.5) / side,
                          window_.pixels.y0 + (static_cast<double>(i / stride) + 0.5) / side});
    }
    bool leaps(std::size_t a, std::size_t b) const {
        const FieldSamples& s = facts_.surface;
        const sdf::FieldRay ray_a = rayOf(a), ray_b = rayOf(b);
        const glm::dvec3 p_a = ray_a.origin_world + s.depth[a] * ray_a.direction_world,
                         p_b = ray_b.origin_world + s.depth[b] * ray_b.direction_world;
        const auto off = [&](const glm::vec3& n) { return std::abs(glm::dot(p_a - p_b, glm::dvec3(n))); };
        const double depth = std::min(s.depth[a], s.depth[b]);
        const double side = 2.0 * (ray_a.pixel_radius + ray_a.pixel_slope * depth) / window_.per_side;
        return std::min(off(s.normal[a]), off(s.normal[b])) > kLeap * side;
    }

    const FieldWindow& window_;
    const sdf::RayGrid& rays_;
    const SampledFacts& facts_;
};

EdgeKind first(EdgeKind a, EdgeKind b) {
    if (a == EdgeKind::kNone || b == EdgeKind::kNone) return std::max(a, b);
    return std::min(a, b);
}

}  // namespace

const char* nameOf(EdgeKind kind) {
    switch (kind) {
        case EdgeKind::kContour:
            return "contour";
        case EdgeKind::kInternal:
            return "internal";
        case EdgeKind::kTexture:
            return "texture";
        case EdgeKind::kLight:
            return "light";
        default:
            return "none";
    }
}

std::vector<EdgeKind> edgeKinds(const FieldWindow& window, const sdf::RayGrid& rays,
                                const SampledFacts& facts) {
    const Facts pairs(window, rays, facts);
    const std::size_t side = static_cast<std::size_t>(window.per_side), stride = window.stride(),
                      width = static_cast<std::size_t>(window.pixels.width()),
                      rows = window.samples() / stride;
    std::vector<EdgeKind> kinds(width * static_cast<std::size_t>(window.pixels.height()), EdgeKind::kNone);
    for (std::size_t y = 0; y < rows; ++y)
        for (std::size_t x = 0; x < stride; ++x) {
            EdgeKind& kind = kinds[y / side * width + x / side];
            const std::size_t i = y * stride + x;
            if (x + 1 < stride) kind = first(kind, pairs.between(i, i + 1));
            if (y + 1 < rows) kind = first(kind, pairs.between(i, i + stride));
        }
    return kinds;
}

std::vector<EdgeKind> edgeKindsOf(const MethodInput& input, int per_side) {
    constexpr int kRowsAtOnce = 16;
    Scene plain_scene = input.scene;
    plain_scene.field = unlit(*input.scene.field);
    const MethodInput plain{plain_scene,  input.camera,  input.film,
                            input.filter, input.options, input.progress};
    FieldSettings settings;
    settings.trace.threshold /= per_side;
    const auto surfaces = makeCpuFieldTracer(plain, settings), colors = makeCpuFieldTracer(input, settings);
    const sdf::RayGrid rays = rayGrid(input.camera, input.film, input.scene.field->far);
    const PixelBox& crop = input.film.crop;
    std::vector<EdgeKind> kinds;
    for (int y = crop.y0; y < crop.y1; y += kRowsAtOnce) {
        const int end = std::min(y + kRowsAtOnce, crop.y1);
        // The row below is asked for what lies between.
        FieldWindow window;
        window.pixels = {crop.x0, y, crop.x1, std::min(end + 1, crop.y1)}, window.per_side = per_side;
        const SampledFacts facts{surfaces->trace(window), colors->trace(window).color};
        const std::vector<EdgeKind> band = edgeKinds(window, rays, facts);
        kinds.insert(kinds.end(), band.begin(),
                     band.begin() + static_cast<std::ptrdiff_t>(end - y) * crop.width());
    }
    return kinds;
}

}  // namespace edgewise::figures
