#include "pipeline/judge/edge_kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/field_plan.h"
#include "pipeline/field_rays.h"
#include "pipeline/field_shading.h"
#include "pipeline/srgb.h"
#include "sdf/field_of_all.h"
#include "sdf/scene_trace.h"

namespace edgewise::judge {
namespace {

/// A point is another surface's when either tangent plane is farther from the other point: of a sub-sample's
/// side there. Along a crease, and around a bend, one of both planes holds its neighbour within that.
constexpr double kLeap = 2.0;
constexpr double kTurn = 0.9659;         // 15 degrees
constexpr double kLightStep = 1.0 / 32;  // smooth light changes less from a sub-sample to the next

/// On the film, px.
glm::dvec2 placeOf(const FieldWindow& window, std::size_t i) {
    const std::size_t stride = window.stride();
    const double side = window.per_side;
    return {window.pixels.x0 + (static_cast<double>(i % stride) + 0.5) / side,
            window.pixels.y0 + (static_cast<double>(i / stride) + 0.5) / side};
}

class Pairs {
  public:
    Pairs(const FieldWindow& window, const sdf::RayGrid& rays, const LatticeFacts& facts)
        : window_(window), rays_(rays), facts_(facts) {}

    EdgeKind between(std::size_t a, std::size_t b) const {
        const FieldSamples& s = facts_.surface;
        const bool hit = std::isfinite(s.depth[a]);
        if (hit != std::isfinite(s.depth[b])) return EdgeKind::kContour;
        if (!hit) return EdgeKind::kNone;
        if (leaps(a, b)) return EdgeKind::kContour;
        if (glm::dot(s.normal[a], s.normal[b]) < kTurn) return EdgeKind::kInternal;
        if (s.surface[a] != s.surface[b] || step(s.color, a, b) > kEdgeContrast) return EdgeKind::kTexture;
        // A light that sets is not asked for beyond, and nothing is seen of that.
        if (facts_.sights[a] != facts_.sights[b] && step(facts_.lit, a, b) > kEdgeContrast)
            return EdgeKind::kShadow;
        const auto& seen = facts_.seen.empty() ? facts_.lit : facts_.seen;
        return step(seen, a, b) > kLightStep ? EdgeKind::kReflection : EdgeKind::kNone;
    }

  private:
    static double step(const std::vector<glm::dvec4>& colors, std::size_t a, std::size_t b) {
        const glm::dvec4 d = glm::abs(colors[a] - colors[b]);
        return std::max({d.x, d.y, d.z});
    }
    sdf::FieldRay rayOf(std::size_t i) const { return rays_.ray(placeOf(window_, i)); }
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
    const LatticeFacts& facts_;
};

EdgeKind first(EdgeKind a, EdgeKind b) {
    if (a == EdgeKind::kNone || b == EdgeKind::kNone) return std::max(a, b);
    return std::min(a, b);
}

std::unique_ptr<FieldTracer> tracerOf(const MethodInput& input, const FieldSettings& settings) {
#ifdef EDGEWISE_HAS_VULKAN
    if (input.scene.field->glsl) return makeVulkanFieldTracer(input, settings);
#endif
    return makeCpuFieldTracer(input, settings);
}

/// -1: the eye is within the solid.
double signOf(const MethodInput& input, const FieldSettings& settings, const sdf::RayGrid& rays) {
    if (input.scene.field->glsl || !rays.perspective) return 1.0;
    const sdf::Tape tape = loweredTree(*input.scene.field);
    return sdf::SceneTracer(*input.scene.field, tape, trustedSettings(*input.scene.field, settings.trace))
        .signAt(rays.eye_world);
}

bool showsOthers(const sdf::FieldScene& field) {
    return std::ranges::any_of(field.materials,
                               [](const auto& m) { return m.reflectance > 0.0 || m.transmittance > 0.0; });
}

/// One scene three times: with surfaces that shine, with lights alone, and whole.
class FactsTracer {
  public:
    FactsTracer(const MethodInput& input, int per_side)
        : in_(input),
          rays_(rayGrid(input.camera, input.film, input.scene.field->far)),
          whole_(input.scene),
          plain_(input.scene),
          direct_(input.scene) {
        settings_.trace.threshold /= per_side;
        if (!whole_.field->analytic.empty())
            whole_.field =
                std::make_shared<const sdf::FieldScene>(sdf::fieldOfAll(*whole_.field, rays_.eye_world));
        plain_.field = unlit(*whole_.field);
        const auto direct = std::make_shared<sdf::FieldScene>(*whole_.field);
        direct->reflections = direct->refractions = 0;
        direct_.field = direct;
        surfaces_ = tracer(plain_), lights_ = tracer(direct_);
        if (showsOthers(*whole_.field)) colors_ = tracer(whole_);
        sign_ = signOf(inputOf(whole_), settings_, rays_);
    }

    LatticeFacts trace(const FieldWindow& window) {
        LatticeFacts facts;
        facts.surface = surfaces_->trace(window);
        const std::size_t count = window.samples();
        std::vector<sdf::TravellingRay> rays(count);
        for (std::size_t i = 0; i < count; ++i)
            rays[i].ray = rays_.ray(placeOf(window, i)), rays[i].sign = sign_;
        std::vector<sdf::SurfaceHit> hits = lights_->batches().describe(rays, facts.surface.depth);
        if (colors_) facts.seen = colors_->shade(rays, hits);
        facts.lit = lights_->shade(rays, std::move(hits), &facts.sights);
        return facts;
    }
    const sdf::RayGrid& rays() const { return rays_; }

  private:
    MethodInput inputOf(const Scene& scene) const {
        return {scene, in_.camera, in_.film, in_.filter, in_.options, in_.progress};
    }
    std::unique_ptr<FieldTracer> tracer(const Scene& scene) {
        inputs_.push_back(std::make_unique<MethodInput>(inputOf(scene)));
        return tracerOf(*inputs_.back(), settings_);
    }

    const MethodInput& in_;
    sdf::RayGrid rays_;
    FieldSettings settings_;
    Scene whole_, plain_, direct_;
    std::vector<std::unique_ptr<MethodInput>> inputs_;
    std::unique_ptr<FieldTracer> surfaces_, lights_, colors_;
    double sign_ = 1.0;
};

constexpr std::array<const char*, 6> kNames{"none", "contour", "internal", "texture", "shadow", "reflection"};
constexpr std::array<const char*, 6> kColors{"#1c1c1c", "#d7263d", "#2f6fe0",
                                             "#2a9d3f", "#e0a100", "#b04fc4"};

glm::dvec3 linearColor(EdgeKind kind) {
    const std::string text = colorOf(kind);
    const auto part = [&](std::size_t at) {
        return decodeSrgb(std::stoi(text.substr(at, 2), nullptr, 16) / 255.0);
    };
    return {part(1), part(3), part(5)};
}

}  // namespace

const char* nameOf(EdgeKind kind) {
    return kNames[static_cast<std::size_t>(kind)];
}

const char* colorOf(EdgeKind kind) {
    return kColors[static_cast<std::size_t>(kind)];
}

std::string edgeKindDefinitions() {
    return fmt::format(
        "<dt>kinds of edges</dt><dd>what lies between neighbouring rays of a lattice within a pixel; a pixel "
        "with several has the first of these. Contour: one ray meets nothing, or both tangent planes miss "
        "the other ray's point by more than {} of the lattice's steps. Internal: the normals differ by more "
        "than {:.0f} degrees. Texture: another material, or a pattern's colours differ by more than 1/255. "
        "Shadow: other lights are seen, and lit colours differ by more than 1/255. Reflection: what mirrors "
        "and glass show, or a highlight, changes by more than 1/{:.0f} in linear light. No edge: all the "
        "other pixels, those among them where something thinner than a step slips through the lattice. By "
        "the pixel that the edge crosses, however wide the filter is</dd>",
        kLeap, glm::degrees(std::acos(kTurn)), 1.0 / kLightStep);
}

std::vector<EdgeKind> edgeKinds(const FieldWindow& window, const sdf::RayGrid& rays,
                                const LatticeFacts& facts) {
    const Pairs pairs(window, rays, facts);
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
    FactsTracer tracer(input, per_side);
    const PixelBox& crop = input.film.crop;
    std::vector<EdgeKind> kinds;
    for (int y = crop.y0; y < crop.y1; y += kRowsAtOnce) {
        const int end = std::min(y + kRowsAtOnce, crop.y1);
        // The row below is asked for what lies between.
        FieldWindow window;
        window.pixels = {crop.x0, y, crop.x1, std::min(end + 1, crop.y1)}, window.per_side = per_side;
        const std::vector<EdgeKind> band = edgeKinds(window, tracer.rays(), tracer.trace(window));
        kinds.insert(kinds.end(), band.begin(),
                     band.begin() + static_cast<std::ptrdiff_t>(end - y) * crop.width());
    }
    return kinds;
}

ImageBuffer edgeKindPicture(const std::vector<EdgeKind>& kinds, const PixelBox& box) {
    ImageBuffer image(box);
    for (std::size_t i = 0; i < kinds.size(); ++i) image.rgba[i] = glm::dvec4(linearColor(kinds[i]), 1.0);
    return image;
}

}  // namespace edgewise::judge
