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

LaneSurface laneSurface(std::span<const ScreenTriangle> pieces) {
    static_assert(sizeof(ScreenTriangle) % sizeof(double) == 0);
    LaneSurface lanes;
    lanes.pieces_px = &pieces[0].p_px[0].x;
    lanes.piece_count = pieces.size();
    lanes.piece_stride = sizeof(ScreenTriangle) / sizeof(double);
    return lanes;
}

}  // namespace

void Shading::Groups::begin(std::size_t most) {
    slots_.assign(std::bit_ceil(2 * most + 1), 0);
    groups_.clear();
    items_.clear();
    items_.reserve(most);
}

void Shading::Groups::add(Owner owner, glm::dvec2 sample_px, std::uint32_t entry) {
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
    for (const Group& group : groups_) {
        Surface surface = shading.surfaceOf(group.owner);
        const auto geometry = static_cast<std::size_t>(surface.geometry - shading.scene_.geometry.data());
        if (const auto& look = shading.plain_looks_[geometry])
            finishPlain(shading, surface, *look, group, out);
        else
            finishAny(shading, surface, group, out);
    }
}

/// The last batch is filled up with its last sample.
template <class Visit>
void Shading::Groups::forEachBatch(std::uint32_t first, const Visit& visit) {
    while (first != kEnd) {
        std::uint32_t entries[kSurfaceLanes];
        int count = 0;
        for (; count < kSurfaceLanes && first != kEnd; ++count, first = items_[first].next) {
            const Item& item = items_[first];
            samples_.x_px[count] = item.sample_px.x, samples_.y_px[count] = item.sample_px.y;
            entries[count] = item.entry;
        }
        for (int i = count; i < kSurfaceLanes; ++i) {
            samples_.x_px[i] = samples_.x_px[count - 1];
            samples_.y_px[i] = samples_.y_px[count - 1];
        }
        visit(entries, count);
    }
}

void Shading::Groups::fill(std::uint32_t first, const glm::dvec3& color, std::span<Shade> out) const {
    for (; first != kEnd; first = items_[first].next) out[items_[first].entry].color = color;
}

void Shading::Groups::finishPlain(const Shading& shading, const Surface& surface, const LaneMaterial& look,
                                  Group group, std::span<Shade> out) {
    const Geometry& geometry = *surface.geometry;
    const bool smooth = !geometry.normal_world.empty();
    if (shading.lighting_.isUniform() && (!smooth || sameAtCorners(geometry.normal_world, surface.vertex))) {
        Surface copy_of = surface;
        return fill(group.first, shading.constant(copy_of)->color, out);
    }
    LaneSurface lanes = laneSurface(shading.pieces_.of(group.owner, shading.screen_));
    lanes.smooth = smooth;
    lanes.mapped = false;
    for (int k = 0; k < 3; ++k) {
        copy(shading.cornerEye(surface, k), lanes.p_eye[k]);
        if (smooth) copy(shading.cornerNormal(surface, k), lanes.normal_eye[k]);
    }
    copy(shading.flatNormal(surface), lanes.flat_normal);
    LaneColors colors;
    forEachBatch(group.first, [&](const std::uint32_t* entries, int count) {
        functions_.shade(frame_, lanes, look, samples_, count, colors);
        for (int i = 0; i < count; ++i)
            out[entries[i]].color = {colors.channel[0][i], colors.channel[1][i], colors.channel[2][i]};
    });
}

void Shading::Groups::finishAny(const Shading& shading, Surface& surface, Group group, std::span<Shade> out) {
    if (const auto shade = shading.constant(surface)) return fill(group.first, shade->color, out);
    shading.placeCorners(surface);
    if (shading.isOneTexel(surface))
        return fill(group.first,
                    shading.shadeClosest(surface, group.owner, items_[group.first].sample_px).color, out);
    LaneSurface lanes = laneSurface(shading.pieces_.of(group.owner, shading.screen_));
    lanes.mapped = surface.mapped;
    for (int k = 0; k < 3; ++k) copy(surface.p_eye[k], lanes.p_eye[k]);
    LanePlaces places{};
    forEachBatch(group.first, [&](const std::uint32_t* entries, int count) {
        functions_.locate(frame_, lanes, samples_, count, places);
        const auto at = [](const double(&v)[3][kSurfaceLanes], int i) {
            return glm::dvec3(v[0][i], v[1][i], v[2][i]);
        };
        for (int i = 0; i < count; ++i)
            out[entries[i]].color = shading
                                        .shadeAt(surface, {at(places.barycentric, i), at(places.d_dx, i),
                                                           at(places.d_dy, i), at(places.p_eye, i)})
                                        .color;
    });
}

}  // namespace edgewise
