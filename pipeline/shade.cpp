#include "pipeline/shade.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>
#include <set>

#include "pipeline/point_shader.h"

namespace edgewise {

namespace {

bool inside(const ScreenTriangle& piece, glm::dvec2 s) {
    for (int k = 0; k < 3; ++k)
        if (f64::sideOf(piece.p_px[k], piece.p_px[(k + 1) % 3], s) < 0.0) return false;
    return true;
}

template <class Vector>
auto interpolate(const std::vector<Vector>& values, const std::array<std::uint32_t, 3>& vertex,
                 const glm::dvec3& w) {
    return f64::mix3(values[vertex[0]], values[vertex[1]], values[vertex[2]], w);
}

glm::dvec2 mapPoint(const TextureUse& use, glm::dvec2 uv) {
    return glm::dvec2(use.uv_from_vertex * glm::dvec3(uv, 1.0));
}

/// A derivative: the shift does not count.
glm::dvec2 mapDirection(const TextureUse& use, glm::dvec2 duv) {
    return glm::dvec2(use.uv_from_vertex * glm::dvec3(duv, 0.0));
}

std::optional<glm::dvec3> nonzero(const glm::dvec3& v) {
    return f64::isZero(v) ? std::nullopt : std::optional(v);
}

std::optional<glm::dvec3> unit(const glm::dvec3& v) {
    return nonzero(f64::unitOrZero(v));
}

}  // namespace

Shading::Shading(const Scene& scene, const ResolvedCamera& camera, const Film& film,
                 const ScreenScene& screen, const ScreenPieces& pieces)
    : scene_(scene),
      camera_from_world_(camera.camera_from_world),
      world_from_camera_(glm::inverse(camera.camera_from_world)),
      map_(makeScreenMap(camera, film)),
      screen_(screen),
      pieces_(pieces),
      lighting_(scene, camera),
      pyramids_(scene.images.size()),
      normal_pyramids_(scene.images.size()) {
    std::set<std::pair<TexelKind, std::uint32_t>> used;
    const auto use = [&](const TextureUse& map, TexelKind kind) {
        if (map.present() && scene.textures[map.texture].image != kNone)
            used.emplace(kind, scene.textures[map.texture].image);
    };
    for (const Material& m : scene.materials) {
        use(m.base_color_map, TexelKind::kValue);
        if (m.unlit) continue;
        for (const TextureUse* map : {&m.metallic_roughness_map, &m.occlusion_map, &m.emissive_map})
            use(*map, TexelKind::kValue);
        use(m.normal_map, TexelKind::kNormal);
    }
    const std::vector<std::pair<TexelKind, std::uint32_t>> jobs(used.begin(), used.end());
    tbb::parallel_for(std::size_t(0), jobs.size(), [&](std::size_t i) {
        const auto [kind, image] = jobs[i];
        (kind == TexelKind::kNormal ? normal_pyramids_ : pyramids_)[image].emplace(scene.images[image], kind);
    });
    for (const Geometry& geometry : scene.geometry) plain_looks_.push_back(plainLookOf(geometry));
}

std::optional<LaneMaterial> Shading::plainLookOf(const Geometry& geometry) const {
    if (scene_.point_shader) return std::nullopt;
    Surface surface;
    surface.geometry = &geometry;
    surface.material = &scene_.materials[geometry.material];
    const Material& m = *surface.material;
    if (m.unlit || geometry.triangles.empty() || !geometry.color.empty() || !lighting_.isDirectional() ||
        pyramidOf(surface, m.normal_map, TexelKind::kNormal))
        return std::nullopt;
    for (const TextureUse* map :
         {&m.base_color_map, &m.metallic_roughness_map, &m.occlusion_map, &m.emissive_map})
        if (mapVaries(surface, *map)) return std::nullopt;
    surface.vertex = geometry.triangles[0];
    const Location anywhere{{1.0, 0.0, 0.0}, {}, {}, glm::dvec3(0.0)};
    const Reflectance look = reflectanceAt(surface, anywhere, glm::dvec3(baseAt(surface, anywhere)));
    const glm::dvec3 start = look.base * ambientAt(surface, anywhere) + emissiveAt(surface, anywhere);
    return LaneMaterial{
        {look.base.x, look.base.y, look.base.z}, look.metallic, look.roughness, {start.x, start.y, start.z}};
}

Shading::Surface Shading::surfaceOf(Owner owner) const {
    const TriangleRef at = findTriangle(scene_, owner);
    const Geometry& geometry = scene_.geometry[at.geometry];
    Surface surface;
    surface.owner = owner;
    surface.geometry = &geometry;
    surface.material = &scene_.materials[geometry.material];
    surface.vertex = geometry.triangles[at.triangle];
    surface.back_facing = pieces_.back_facing[owner] != 0;
    surface.plane = screen_.triangles[pieces_.first[owner]].plane;
    return surface;
}

void Shading::placeCorners(Surface& surface) const {
    for (int k = 0; k < 3; ++k) surface.p_eye[k] = cornerEye(surface, k);
    if (!surface.material->unlit) placeNormals(surface);
    surface.mapped = isMapped(surface);
}

void Shading::placeNormals(Surface& surface) const {
    if (surface.geometry->normal_world.empty()) return;
    for (int k = 0; k < 3; ++k) surface.normal_eye[k] = cornerNormal(surface, k);
}

bool Shading::isMapped(const Surface& surface) const {
    const Material& m = *surface.material;
    if (usesFootprint(surface, m.base_color_map)) return true;
    return !m.unlit && (usesFootprint(surface, m.metallic_roughness_map) ||
                        usesFootprint(surface, m.occlusion_map) || usesFootprint(surface, m.emissive_map) ||
                        usesFootprint(surface, m.normal_map, TexelKind::kNormal));
}

/// Without mip levels, and with one filter for near and far, the footprint decides nothing.
bool Shading::usesFootprint(const Surface& surface, const TextureUse& use, TexelKind kind) const {
    if (!mapVaries(surface, use, kind)) return false;
    const Texture& texture = scene_.textures[use.texture];
    return texture.mip || texture.mag != texture.min;
}

/// An unlit surface whose corners lie well inside one texel that is taken as it is: all of it has one colour.
/// Barycentrics and the map point are rounded some ten times; the margin allows for a hundred.
bool Shading::isOneTexel(const Surface& surface) const {
    const Material& material = *surface.material;
    const TextureUse& use = material.base_color_map;
    if (!material.unlit || !surface.geometry->color.empty() || !mapVaries(surface, use)) return false;
    const Texture& texture = scene_.textures[use.texture];
    if (texture.mip || texture.mag != TexelFilter::kNearest || texture.min != TexelFilter::kNearest)
        return false;
    const Image& image = pyramidOf(surface, use)->level(0);
    const auto& uv = surface.geometry->uv[use.uv];
    const glm::dvec2 size(image.width, image.height);
    glm::dvec2 largest(0.0), texel;
    for (const std::uint32_t v : surface.vertex) largest = glm::max(largest, glm::abs(uv[v]));
    for (int axis = 0; axis < 2; ++axis) {
        const auto& m = use.uv_from_vertex;
        const double terms =
            std::abs(m[0][axis]) * largest.x + std::abs(m[1][axis]) * largest.y + std::abs(m[2][axis]) + 2.0;
        const double margin = 100 * 0x1p-53 * terms * size[axis];
        for (int k = 0; k < 3; ++k) {
            const double x = mapPoint(use, uv[surface.vertex[k]])[axis] * size[axis], whole = std::floor(x);
            if (k == 0) texel[axis] = whole;
            if (whole != texel[axis] || !(x - whole > margin && whole + 1.0 - x > margin)) return false;
        }
    }
    return true;
}

/// Where nothing asks for the footprint, its divisions are left out.
Shading::Location Shading::locate(const Surface& surface, glm::dvec2 uv) const {
    const auto& [a, b, c] = surface.p_eye;
    if (surface.mapped) return f64::surfacePointAt(a, b, c, uv, map_.perspective, map_.scale_px);
    const Location at = f64::surfacePointAt(a, b, c, uv, map_.perspective, map_.scale_px);
    return {at.barycentric, glm::dvec3(0.0), glm::dvec3(0.0), at.p_eye};
}

glm::dvec3 Shading::cornerEye(const Surface& surface, int corner) const {
    const glm::dvec3& p_world = surface.geometry->position_world[surface.vertex[corner]];
    return glm::dvec3(camera_from_world_ * glm::dvec4(p_world, 1.0));
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

glm::dvec3 Shading::vertexNormalAt(const Surface& surface, const glm::dvec3& w) const {
    if (surface.geometry->normal_world.empty()) return flatNormal(surface);
    const auto& n = surface.normal_eye;
    const auto normal = unit(n[0] * w.x + n[1] * w.y + n[2] * w.z);
    return normal.value_or(flatNormal(surface));
}

/// Of the front, with the bitangent's sign; none where u and v do not span the triangle.
std::optional<glm::dvec4> Shading::tangentAt(const Surface& surface, const Location& at,
                                             const glm::dvec3& normal) const {
    const Geometry& geometry = *surface.geometry;
    const auto orthogonal = [&](const glm::dvec3& t) { return nonzero(f64::orthogonalTo(normal, t)); };
    if (!geometry.tangent_world.empty()) {
        const glm::dvec4 world = interpolate(geometry.tangent_world, surface.vertex, at.barycentric);
        const auto tangent = orthogonal(glm::dmat3(camera_from_world_) * glm::dvec3(world));
        const double sign = geometry.tangent_world[surface.vertex[0]].w < 0.0 ? -1.0 : 1.0;
        if (tangent) return glm::dvec4(*tangent, sign);
    }
    std::array<glm::dvec3, 3> p;
    std::array<glm::dvec2, 3> uv;
    for (int k = 0; k < 3; ++k) {
        p[k] = cornerEye(surface, k);  // a surface of one colour has no places
        uv[k] = mapPoint(surface.material->normal_map,
                         geometry.uv[surface.material->normal_map.uv][surface.vertex[k]]);
    }
    const auto tangent = orthogonal(f64::alongU(p[0], p[1], p[2], uv[0], uv[1], uv[2]));
    if (!tangent) return std::nullopt;
    const glm::dvec3 along_v = f64::alongV(p[0], p[1], p[2], uv[0], uv[1], uv[2]);
    return glm::dvec4(*tangent, f64::bitangentSign(normal, *tangent, along_v));
}

glm::dvec3 Shading::normalAt(const Surface& surface, const Location& at) const {
    const glm::dvec3 seen = vertexNormalAt(surface, at.barycentric);
    const auto texel = texelAt(surface, at, surface.material->normal_map, TexelKind::kNormal);
    if (!texel) return seen;
    const double side = surface.back_facing ? -1.0 : 1.0;
    const glm::dvec3 normal = side * seen;
    const auto tangent = tangentAt(surface, at, normal);
    if (!tangent) return seen;
    const auto bumped = nonzero(f64::bumpedNormal(normal, glm::dvec3(*tangent), tangent->w,
                                                  glm::dvec3(*texel), surface.material->normal_scale));
    return bumped ? side * *bumped : seen;
}

const MipPyramid* Shading::pyramidOf(const Surface& surface, const TextureUse& use, TexelKind kind) const {
    if (!use.present() || surface.geometry->uv[use.uv].empty()) return nullptr;
    const std::uint32_t image = scene_.textures[use.texture].image;
    if (image == kNone) return nullptr;
    return &*(kind == TexelKind::kNormal ? normal_pyramids_ : pyramids_)[image];
}

std::optional<glm::dvec4> Shading::texelAt(const Surface& surface, const Location& at, const TextureUse& use,
                                           TexelKind kind) const {
    const MipPyramid* pyramid = pyramidOf(surface, use, kind);
    if (!pyramid) return std::nullopt;
    const auto& uv = surface.geometry->uv[use.uv];
    const TextureFootprint footprint{mapDirection(use, interpolate(uv, surface.vertex, at.d_dx)),
                                     mapDirection(use, interpolate(uv, surface.vertex, at.d_dy))};
    return sampleTexture(scene_.textures[use.texture], *pyramid,
                         mapPoint(use, interpolate(uv, surface.vertex, at.barycentric)), footprint);
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

glm::dvec4 Shading::baseAt(const Surface& surface, const Location& at) const {
    glm::dvec4 base = surface.material->base_color;
    if (const auto texel = texelAt(surface, at, surface.material->base_color_map)) base *= *texel;
    if (!surface.geometry->color.empty())
        base *= interpolate(surface.geometry->color, surface.vertex, at.barycentric);
    return base;
}

Reflectance Shading::reflectanceAt(const Surface& surface, const Location& at, const glm::dvec3& base) const {
    const Material& material = *surface.material;
    const glm::dvec4 texel = texelAt(surface, at, material.metallic_roughness_map).value_or(glm::dvec4(1.0));
    return {base, std::clamp(material.metallic * texel.b, 0.0, 1.0),
            std::clamp(material.roughness * texel.g, 0.0, 1.0)};
}

glm::dvec3 Shading::emissiveAt(const Surface& surface, const Location& at) const {
    const Material& material = *surface.material;
    if (material.emissive == glm::dvec3(0.0)) return material.emissive;
    const auto texel = texelAt(surface, at, material.emissive_map);
    return texel ? material.emissive * glm::dvec3(*texel) : material.emissive;
}

double Shading::ambientAt(const Surface& surface, const Location& at) const {
    if (!lighting_.isRig()) return 0.0;
    const auto texel = texelAt(surface, at, surface.material->occlusion_map);
    return texel ? f64::occluded(kRigAmbient, surface.material->occlusion_strength, texel->r) : kRigAmbient;
}

glm::dvec3 Shading::litColor(const Surface& surface, const Location& at, const glm::dvec3& base) const {
    const Reflectance reflectance = reflectanceAt(surface, at, base);
    const glm::dvec3 n = normalAt(surface, at), v = lighting_.view(at.p_eye);
    glm::dvec3 color = base * ambientAt(surface, at) + emissiveAt(surface, at);
    for (std::size_t i = 0; i < lighting_.count(); ++i) {
        const Arrival light = lighting_.arrival(i, at.p_eye);
        const double cosine = glm::dot(n, light.towards);
        if (!(cosine > 0.0)) continue;
        const glm::dvec3 share =
            f64::reflectedShare(reflectance.base, reflectance.metallic, reflectance.roughness, n, v,
                                light.towards, lighting_.halfway(i, v, light.towards));
        color += share * (cosine * light.illuminance);
    }
    return color;
}

glm::dvec3 Shading::ownColor(const Surface& surface, const Location& at) const {
    const glm::dvec3 normal_eye = vertexNormalAt(surface, at.barycentric);
    return scene_.point_shader->color({surface.owner,
                                       glm::dvec3(world_from_camera_ * glm::dvec4(at.p_eye, 1.0)),
                                       glm::dmat3(world_from_camera_) * normal_eye, surface.back_facing});
}

Shade Shading::shadeAt(const Surface& surface, const Location& at) const {
    if (scene_.point_shader) return {ownColor(surface, at), 1.0};
    const glm::dvec4 base = baseAt(surface, at);
    const glm::dvec3 color(base);
    return {surface.material->unlit ? color : litColor(surface, at, color), alphaOf(surface, base.a)};
}

bool Shading::mapVaries(const Surface& surface, const TextureUse& use, TexelKind kind) const {
    const MipPyramid* pyramid = pyramidOf(surface, use, kind);
    return pyramid && !pyramid->uniform();
}

bool Shading::baseVaries(const Surface& surface) const {
    const Material& material = *surface.material;
    const bool opaque = material.alpha_mode == AlphaMode::kOpaque;
    if (glm::dvec3(material.base_color) == glm::dvec3(0.0) && (opaque || material.base_color.a == 0.0))
        return false;
    const auto& color = surface.geometry->color;
    return mapVaries(surface, material.base_color_map) ||
           (!color.empty() && !sameAtCorners(color, surface.vertex));
}

bool Shading::normalVaries(const Surface& surface) const {
    const Geometry& geometry = *surface.geometry;
    const TextureUse& map = surface.material->normal_map;
    if (!geometry.normal_world.empty() && !sameAtCorners(geometry.normal_world, surface.vertex)) return true;
    if (!pyramidOf(surface, map, TexelKind::kNormal)) return false;
    return mapVaries(surface, map, TexelKind::kNormal) ||
           (!geometry.tangent_world.empty() && !sameAtCorners(geometry.tangent_world, surface.vertex));
}

bool Shading::varies(const Surface& surface) const {
    if (scene_.point_shader) return true;
    const Material& material = *surface.material;
    if (baseVaries(surface)) return true;
    if (material.unlit) return false;
    return !lighting_.isUniform() || normalVaries(surface) ||
           mapVaries(surface, material.metallic_roughness_map) ||
           (lighting_.isRig() && mapVaries(surface, material.occlusion_map)) ||
           (material.emissive != glm::dvec3(0.0) && mapVaries(surface, material.emissive_map));
}

std::optional<Shade> Shading::constant(Surface& surface) const {
    if (varies(surface)) return std::nullopt;
    if (!surface.material->unlit) placeNormals(surface);
    return shadeAt(surface, {{1.0, 0.0, 0.0}, {}, {}, glm::dvec3(0.0)});
}

std::optional<Shade> Shading::constant(Owner owner) const {
    Surface surface = surfaceOf(owner);
    return constant(surface);
}

std::optional<Shade> Shading::ofOneTexel(Owner owner) const {
    const Surface surface = surfaceOf(owner);
    if (!isOneTexel(surface)) return std::nullopt;
    return shadeAt(surface, {{1.0, 0.0, 0.0}, {}, {}, glm::dvec3(0.0)});
}

bool Shading::varies(Owner owner) const {
    return varies(surfaceOf(owner));
}

Shade Shading::atPoint(Owner owner, glm::dvec2 p_px) const {
    Surface surface = surfaceOf(owner);
    if (const auto shade = constant(surface)) return *shade;
    placeCorners(surface);
    return shadeAt(surface, locate(surface, map_.toImagePlane(p_px, glm::dvec2(0.0))));
}

glm::dvec3 Shading::normal(Owner owner, glm::dvec2 p_px) const {
    Surface surface = surfaceOf(owner);
    placeCorners(surface);
    placeNormals(surface);
    surface.mapped = true;
    return normalAt(surface, locate(surface, map_.toImagePlane(p_px, glm::dvec2(0.0))));
}

glm::dvec2 Shading::closestOffset(Owner owner, glm::dvec2 sample_px) const {
    glm::dvec2 best(0.0);
    double best_px2 = std::numeric_limits<double>::infinity();
    for (const ScreenTriangle& piece : pieces_.of(owner, screen_)) {
        if (inside(piece, sample_px)) return glm::dvec2(0.0);
        for (int k = 0; k < 3; ++k) {
            const glm::dvec2 offset = f64::offsetToSegment(piece.p_px[k], piece.p_px[(k + 1) % 3], sample_px);
            if (glm::dot(offset, offset) >= best_px2) continue;
            best = offset;
            best_px2 = glm::dot(offset, offset);
        }
    }
    return best;
}

Shade Shading::shadeClosest(const Surface& surface, Owner owner, glm::dvec2 sample_px) const {
    return shadeAt(surface, locate(surface, map_.toImagePlane(sample_px, closestOffset(owner, sample_px))));
}

Shade Shading::closest(Owner owner, glm::dvec2 sample_px) const {
    Surface surface = surfaceOf(owner);
    if (const auto shade = constant(surface)) return *shade;
    placeCorners(surface);
    return shadeClosest(surface, owner, sample_px);
}

Shade Shading::closest(Owner owner, glm::dvec2 sample_px, Memo& memo) const {
    Memo::Slot& slot = memo.slots_[owner % Memo::kSlots];
    if (slot.owner != owner) {
        slot.surface = surfaceOf(owner);
        slot.constant = constant(slot.surface);
        if (!slot.constant) placeCorners(slot.surface);
        if (!slot.constant && isOneTexel(slot.surface))
            slot.constant = shadeClosest(slot.surface, owner, sample_px);
        slot.owner = owner;
    }
    return slot.constant ? *slot.constant : shadeClosest(slot.surface, owner, sample_px);
}

Shade Shading::mean(Owner owner, glm::dvec2 sample_px, std::span<const glm::dvec2> offsets_px) const {
    if (offsets_px.empty()) return closest(owner, sample_px);
    if (const auto shade = constant(owner)) return *shade;
    glm::dvec3 color(0.0), opaque(0.0);
    double alpha = 0.0;
    for (const glm::dvec2& offset : offsets_px) {
        const Shade shade = closest(owner, sample_px + offset);
        color += shade.color, opaque += shade.alpha * shade.color, alpha += shade.alpha;
    }
    const auto count = static_cast<double>(offsets_px.size());
    return {alpha > 0.0 ? opaque / alpha : color / count, alpha / count};
}

}  // namespace edgewise
