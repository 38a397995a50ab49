#include "pipeline/shade_groups.h"

#include <algorithm>
#include <bit>

namespace edgewise {
namespace {

void copy(const glm::dvec3& from, double (&to)[3]) {
    for (int axis = 0; axis < 3; ++axis) to[axis] = from[axis];
}
void copy(glm::dvec2 from, double (&to)[2]) {
    to[0] = from.x, to[1] = from.y;
}

LaneFrame laneFrame(const ScreenMap& map, const Lighting& lighting, const std::vector<LaneLight>& lights) {
    LaneFrame frame{};
    frame.perspective = map.perspective;
    frame.uniform_view = lighting.viewIsUniform();
    frame.scale_px = map.scale_px;
    copy(map.offset_px, frame.offset_px);
    copy(map.whole_px, frame.whole_px);
    copy(map.fraction_px, frame.fraction_px);
    frame.lights = lights.data();
    frame.light_count = static_cast<int>(lights.size());
    return frame;
}

/// Of lights that are the same everywhere.
void fillLights(const Lighting& lighting, std::vector<LaneLight>& lights) {
    lights.clear();
    if (!lighting.isDirectional()) return;
    const glm::dvec3 eye(0.0);
    for (std::size_t i = 0; i < lighting.count(); ++i) {
        const Arrival arrival = lighting.arrival(i, eye);
        const f64::Halfway half = lighting.halfway(i, lighting.view(eye), arrival.towards);
        LaneLight& light = lights.emplace_back();
        copy(arrival.towards, light.towards);
        copy(arrival.illuminance, light.illuminance);
        copy(half.h, light.h);
        light.fresnel = half.fresnel;
    }
}

}  // namespace

void Shading::Groups::begin(std::size_t most) {
    most_ = most;
    groups_.clear();
    items_.clear();
}

void Shading::Groups::add(Owner owner, glm::dvec2 sample_px, std::uint32_t entry) {
    if (items_.empty()) slots_.assign(std::bit_ceil(2 * most_ + 1), 0);
    const std::size_t last = slots_.size() - 1;
    std::size_t slot = (owner * 0x9e3779b97f4a7c15ull >> 32) & last;
    while (slots_[slot] != 0 && groups_[slots_[slot] - 1].owner != owner) slot = (slot + 1) & last;
    if (slots_[slot] == 0) {
        groups_.push_back({owner, kEnd});
        slots_[slot] = static_cast<std::uint32_t>(groups_.size());
    }
    std::uint32_t& first = groups_[slots_[slot] - 1].first;
    items_.push_back({sample_px, entry, first});
    first = static_cast<std::uint32_t>(items_.size() - 1);
}

void Shading::Groups::finish(const Shading& shading, std::span<Shade> out) {
    fillLights(shading.lighting_, lights_);
    frame_ = laneFrame(shading.map_, shading.lighting_, lights_);
    for (const Group& group : groups_) finish(shading, group, out);
    flush(shading, out);
}

void Shading::Groups::finish(const Shading& shading, Group group, std::span<Shade> out) {
    if (shading.pieces_.of(group.owner, shading.screen_).size() != 1)
        return finishSingly(shading, group, out);
    Surface surface = shading.surfaceOf(group.owner);
    const Geometry& geometry = *surface.geometry;
    const auto& look =
        shading.plain_looks_[static_cast<std::size_t>(&geometry - shading.scene_.geometry.data())];
    const bool alike =
        look && !(shading.lighting_.isUniform() &&
                  (geometry.normal_world.empty() || sameAtCorners(geometry.normal_world, surface.vertex)));
    if (!alike) {
        if (const auto shade = shading.constant(surface)) return fill(group.first, shade->color, out);
        shading.placeCorners(surface);
        const glm::dvec2 some_sample = items_[group.first].sample_px;
        if (shading.isOneTexel(surface))
            return fill(group.first, shading.shadeClosest(surface, group.owner, some_sample).color, out);
    }
    enqueue(shading, group, surface, alike ? &*look : nullptr, out);
}

/// Few: those that the near plane cuts in two.
void Shading::Groups::finishSingly(const Shading& shading, Group group, std::span<Shade> out) const {
    for (std::uint32_t i = group.first; i != kEnd; i = items_[i].next)
        out[items_[i].entry].color = shading.closest(group.owner, items_[i].sample_px).color;
}

void Shading::Groups::fill(std::uint32_t first, const glm::dvec3& color, std::span<Shade> out) const {
    for (; first != kEnd; first = items_[first].next) out[items_[first].entry].color = color;
}

void Shading::Groups::enqueue(const Shading& shading, Group group, const Surface& surface,
                              const LaneMaterial* look, std::span<Shade> out) {
    const bool smooth = !surface.geometry->normal_world.empty();
    if (look != batch_.look || smooth != batch_.smooth) flush(shading, out);
    batch_.look = look, batch_.smooth = smooth;
    LaneTriangle triangle;
    const ScreenTriangle& piece = shading.pieces_.of(group.owner, shading.screen_)[0];
    for (int k = 0; k < 3; ++k) {
        copy(piece.p_px[k], triangle.corner_px[k]);
        copy(look ? shading.cornerEye(surface, k) : surface.p_eye[k], triangle.p_eye[k]);
        copy(look && smooth ? shading.cornerNormal(surface, k) : glm::dvec3(0.0), triangle.normal_eye[k]);
    }
    if (look && !smooth) copy(shading.flatNormal(surface), triangle.normal_eye[0]);
    for (std::uint32_t i = group.first; i != kEnd;) {
        functions_.spread(triangle, batch_.count, batch_.lanes);
        if (!look) batch_.surface[batch_.surface_count] = surface;
        for (; batch_.count < kSurfaceLanes && i != kEnd; ++batch_.count, i = items_[i].next) {
            batch_.lanes.sample_px[0][batch_.count] = items_[i].sample_px.x;
            batch_.lanes.sample_px[1][batch_.count] = items_[i].sample_px.y;
            batch_.item[batch_.count] = i;
            batch_.owner[batch_.count] = group.owner;
            batch_.surface_of[batch_.count] = batch_.surface_count;
        }
        ++batch_.surface_count;
        if (batch_.count == kSurfaceLanes) flush(shading, out);
    }
}

void Shading::Groups::flush(const Shading& shading, std::span<Shade> out) {
    if (batch_.count > 0) batch_.look ? flushAlike(shading, out) : flushApart(shading, out);
    batch_.count = batch_.surface_count = 0;
}

void Shading::Groups::flushAlike(const Shading& shading, std::span<Shade> out) {
    LaneColors colors;
    const unsigned no_normal =
        functions_.shade(frame_, *batch_.look, batch_.smooth, batch_.lanes, batch_.count, colors);
    for (int i = 0; i < batch_.count; ++i) {
        const Item& item = items_[batch_.item[i]];
        out[item.entry].color = {colors.channel[0][i], colors.channel[1][i], colors.channel[2][i]};
        if (no_normal >> i & 1)
            out[item.entry].color = shading.closest(batch_.owner[i], item.sample_px).color;
    }
}

void Shading::Groups::flushApart(const Shading& shading, std::span<Shade> out) {
    LanePlaces places;
    functions_.locate(frame_, batch_.lanes, batch_.count, places);
    for (int i = 0; i < batch_.count; ++i) {
        const Surface& surface = batch_.surface[batch_.surface_of[i]];
        const auto at = [i](const double(&v)[3][kSurfaceLanes]) {
            return glm::dvec3(v[0][i], v[1][i], v[2][i]);
        };
        Location location{at(places.barycentric), glm::dvec3(0.0), glm::dvec3(0.0), at(places.p_eye)};
        if (surface.mapped) location.d_dx = at(places.d_dx), location.d_dy = at(places.d_dy);
        out[items_[batch_.item[i]].entry].color = shading.shadeAt(surface, location).color;
    }
}

}  // namespace edgewise
