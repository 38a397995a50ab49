#include "pipeline/shade.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

namespace edgewise {

/// An owner's triangle, in eye space.
struct Shading::Surface {
    const Geometry* geometry;
    const Material* material;
    std::array<std::uint32_t, 3> vertex;
    bool back_facing;
    std::uint32_t plane;
};

/// A place on a triangle: perspective-correct barycentrics and how they change along the screen's axes.
struct Shading::Location {
    glm::dvec3 barycentric{0.0};
    glm::dvec3 d_dx{0.0}, d_dy{0.0};  ///< per pixel
};

namespace {

double cross2(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

/// From s to the nearest point of the segment a, b; the differences of grid points are exact.
glm::dvec2 offsetToSegment(glm::dvec2 a, glm::dvec2 b, glm::dvec2 s) {
    const glm::dvec2 along = b - a;
    const double t = -glm::dot(a - s, along) / glm::dot(along, along);
    return t <= 0.0 ? a - s : (t >= 1.0 ? b - s : (a - s) + along * t);
}

bool inside(const ScreenTriangle& piece, glm::dvec2 s) {
    for (int k = 0; k < 3; ++k)
        if (cross2(piece.p_px[(k + 1) % 3] - piece.p_px[k], s - piece.p_px[k]) < 0.0) return false;
    return true;
}

/// Inside [0, 1] and summing to 1: nothing is extrapolated, not even from a triangle seen almost edge-on.
glm::dvec3 clampToTriangle(const glm::dvec3& barycentric) {
    const glm::dvec3 clamped = glm::clamp(barycentric, 0.0, 1.0);
    const double sum = clamped.x + clamped.y + clamped.z;
    return sum > 0.0 ? clamped / sum : glm::dvec3(1.0 / 3.0);
}

template <class Vector>
auto interpolate(const std::vector<Vector>& values, const std::array<std::uint32_t, 3>& vertex,
                 const glm::dvec3& w) {
    return values[vertex[0]] * w.x + values[vertex[1]] * w.y + values[vertex[2]] * w.z;
}

template <class Vector>
bool sameAtCorners(const std::vector<Vector>& values, const std::array<std::uint32_t, 3>& vertex) {
    return values[vertex[0]] == values[vertex[1]] && values[vertex[0]] == values[vertex[2]];
}

std::optional<glm::dvec3> unit(const glm::dvec3& v) {
    const double size = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
    if (size == 0.0) return std::nullopt;
    const glm::dvec3 scaled = v / size;
    return scaled / std::sqrt(glm::dot(scaled, scaled));
}

}  // namespace

double rigLight(const glm::dvec3& normal_eye) {
    double light = kRigAmbient;
    for (const RigLight& lamp : {kRigKey, kRigFill})
        light += std::max(0.0, glm::dot(normal_eye, lamp.towards)) * lamp.intensity;
    return light;
}

Shading::Shading(const Scene& scene, const ResolvedCamera& camera, const Film& film,
                 const ScreenScene& screen, const ScreenPieces& pieces)
    : scene_(scene),
      camera_from_world_(camera.camera_from_world),
      map_(makeScreenMap(camera, film)),
      screen_(screen),
      pieces_(pieces),
      pyramids_(scene.images.size()) {
    std::vector<std::uint32_t> used;
    for (const Material& material : scene.materials)
        if (material.base_color_map.present())
            used.push_back(scene.textures[material.base_color_map.texture].image);
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::erase(used, kNone);
    tbb::parallel_for(std::size_t(0), used.size(),
                      [&](std::size_t i) { pyramids_[used[i]].emplace(scene.images[used[i]]); });
}

Shading::Surface Shading::surfaceOf(Owner owner) const {
    const TriangleRef at = findTriangle(scene_, owner);
    const Geometry& geometry = scene_.geometry[at.geometry];
    return {&geometry, &scene_.materials[geometry.material], geometry.triangles[at.triangle],
            pieces_.back_facing[owner] != 0, screen_.triangles[pieces_.first[owner]].plane};
}

/// Barycentrics of the plane's point on the pixel's ray. A corner a is moved along the ray r = (u, v, -1)
/// onto z = 0, a' = a + a.z (u, v): det(r, b, c) does not change by that, so the weight of a is cross(b',
/// c'), whether or not the corners lie behind the eye. Orthographic: a' = a - (u, v). The weights are affine
/// in (u, v).
Shading::Location Shading::locate(const Surface& surface, glm::dvec2 uv) const {
    std::array<glm::dvec2, 3> moved;
    std::array<double, 3> slope;  // d a' / d(u, v), times the identity
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 p(camera_from_world_ *
                           glm::dvec4(surface.geometry->position_world[surface.vertex[k]], 1.0));
        slope[k] = map_.perspective ? p.z : -1.0;
        moved[k] = glm::dvec2(p) + slope[k] * uv;
    }
    glm::dvec3 weight, d_du, d_dv;
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        weight[k] = cross2(moved[i], moved[j]);
        d_du[k] = slope[i] * moved[j].y - moved[i].y * slope[j];
        d_dv[k] = moved[i].x * slope[j] - slope[i] * moved[j].x;
    }
    const double sum = weight.x + weight.y + weight.z;
    if (sum == 0.0) return {glm::dvec3(1.0 / 3.0), {}, {}};
    auto derivative = [&](const glm::dvec3& d) {
        return (d - (weight / sum) * (d.x + d.y + d.z)) / (sum * map_.scale_px);
    };
    return {clampToTriangle(weight / sum), derivative(d_du), -derivative(d_dv)};
}

/// Towards the viewer on either side, and the same for all triangles of a plane.
glm::dvec3 Shading::flatNormal(const Surface& surface) const {
    return pieces_.plane_normal_eye[surface.plane];
}

glm::dvec3 Shading::cornerNormal(const Surface& surface, int corner) const {
    const glm::dvec3& world = surface.geometry->normal_world[surface.vertex[corner]];
    const auto normal = unit(glm::dmat3(camera_from_world_) * world);
    if (!normal) return flatNormal(surface);
    return surface.back_facing ? -*normal : *normal;
}

glm::dvec3 Shading::normalAt(const Surface& surface, const glm::dvec3& w) const {
    if (surface.geometry->normal_world.empty()) return flatNormal(surface);
    const auto normal = unit(cornerNormal(surface, 0) * w.x + cornerNormal(surface, 1) * w.y +
                             cornerNormal(surface, 2) * w.z);
    return normal.value_or(flatNormal(surface));
}

const MipPyramid* Shading::pyramidOf(const Surface& surface) const {
    const Material& material = *surface.material;
    if (!material.base_color_map.present() || surface.geometry->uv[material.base_color_map.uv].empty())
        return nullptr;
    const std::uint32_t image = scene_.textures[material.base_color_map.texture].image;
    return image == kNone ? nullptr : &*pyramids_[image];
}

glm::dvec4 Shading::textureAt(const Surface& surface, const Location& at) const {
    const auto& uv = surface.geometry->uv[surface.material->base_color_map.uv];
    const TextureFootprint footprint{interpolate(uv, surface.vertex, at.d_dx),
                                     interpolate(uv, surface.vertex, at.d_dy)};
    return sampleTexture(scene_.textures[surface.material->base_color_map.texture], *pyramidOf(surface),
                         interpolate(uv, surface.vertex, at.barycentric), footprint);
}

/// Opaque materials ignore alpha; a mask is there or not.
double Shading::alphaOf(const Surface& surface, double base_alpha) const {
    switch (surface.material->alpha_mode) {
        case AlphaMode::kMask:
            return base_alpha >= surface.material->alpha_cutoff ? 1.0 : 0.0;
        case AlphaMode::kBlend:
            return std::clamp(base_alpha, 0.0, 1.0);
        default:
            return 1.0;
    }
}

std::optional<glm::dvec4> Shading::constantBase(const Surface& surface) const {
    const Geometry& geometry = *surface.geometry;
    glm::dvec4 base = surface.material->base_color;
    const bool opaque = surface.material->alpha_mode == AlphaMode::kOpaque;
    if (glm::dvec3(base) == glm::dvec3(0.0) && (opaque || base.a == 0.0)) return base;
    if (const MipPyramid* pyramid = pyramidOf(surface)) {
        if (!pyramid->uniform()) return std::nullopt;
        base *= *pyramid->uniform();
    }
    if (geometry.color.empty()) return base;
    if (!sameAtCorners(geometry.color, surface.vertex)) return std::nullopt;
    return base * geometry.color[surface.vertex[0]];
}

std::optional<Shade> Shading::constant(const Surface& surface) const {
    const auto base = constantBase(surface);
    if (!base) return std::nullopt;
    const glm::dvec3 color(*base);
    const double alpha = alphaOf(surface, base->a);
    if (surface.material->unlit || color == glm::dvec3(0.0)) return Shade{color, alpha};
    const auto& normals = surface.geometry->normal_world;
    if (normals.empty()) return Shade{color * rigLight(flatNormal(surface)), alpha};
    if (!sameAtCorners(normals, surface.vertex)) return std::nullopt;
    return Shade{color * rigLight(cornerNormal(surface, 0)), alpha};
}

std::optional<Shade> Shading::constant(Owner owner) const {
    return constant(surfaceOf(owner));
}

Shade Shading::shadeAt(const Surface& surface, glm::dvec2 image_plane) const {
    const Location at = locate(surface, image_plane);
    glm::dvec4 base = surface.material->base_color;
    if (pyramidOf(surface)) base *= textureAt(surface, at);
    if (!surface.geometry->color.empty())
        base *= interpolate(surface.geometry->color, surface.vertex, at.barycentric);
    glm::dvec3 color(base);
    if (!surface.material->unlit) color *= rigLight(normalAt(surface, at.barycentric));
    return {color, alphaOf(surface, base.a)};
}

Shade Shading::atPoint(Owner owner, glm::dvec2 p_px) const {
    const Surface surface = surfaceOf(owner);
    if (const auto shade = constant(surface)) return *shade;
    return shadeAt(surface, map_.toImagePlane(p_px, glm::dvec2(0.0)));
}

glm::dvec3 Shading::normal(Owner owner, glm::dvec2 p_px) const {
    const Surface surface = surfaceOf(owner);
    return normalAt(surface, locate(surface, map_.toImagePlane(p_px, glm::dvec2(0.0))).barycentric);
}

glm::dvec2 Shading::closestOffset(Owner owner, glm::dvec2 sample_px) const {
    glm::dvec2 best(0.0);
    double best_px2 = std::numeric_limits<double>::infinity();
    for (const ScreenTriangle& piece : pieces_.of(owner, screen_)) {
        if (inside(piece, sample_px)) return glm::dvec2(0.0);
        for (int k = 0; k < 3; ++k) {
            const glm::dvec2 offset = offsetToSegment(piece.p_px[k], piece.p_px[(k + 1) % 3], sample_px);
            if (glm::dot(offset, offset) >= best_px2) continue;
            best = offset;
            best_px2 = glm::dot(offset, offset);
        }
    }
    return best;
}

Shade Shading::closest(Owner owner, glm::dvec2 sample_px) const {
    const Surface surface = surfaceOf(owner);
    if (const auto shade = constant(surface)) return *shade;
    return shadeAt(surface, map_.toImagePlane(sample_px, closestOffset(owner, sample_px)));
}

}  // namespace edgewise
