#include "pipeline/vulkan/cone_rays.h"

#include <bit>

#include "pipeline/error.h"

namespace edgewise::vulkan {
namespace {

static_assert(sizeof(GpuConeState) == 44 && sizeof(GpuGroup) == 12);

}  // namespace

sdf::ConeGroup GpuGroup::group() const {
    return {std::bit_cast<float>(t_hard & 0x7fffffffu), entry_t, least, (t_hard >> 31) != 0};
}

double coneReach(const sdf::ConeSettings& settings) {
    sdf::FieldRay unit;
    unit.pixel_radius = 1.0;
    return sdf::coneRules(unit, {}, settings).radius;
}

ConeRays::ConeRays(const Device& device, const FieldShaders& shaders, const sdf::ConeSettings& settings,
                   FieldTiles& tiles)
    : device_(device),
      settings_(settings),
      tiles_(tiles),
      groups_(tiles.pass("field_groups", shaders.groups)),
      room_(groupsARound(settings)) {}

std::size_t ConeRays::most(const Device& device, const FieldShaders& shaders,
                           const sdf::ConeSettings& settings, std::size_t bytes) {
    return FieldTiles::most(device, shaders, bytes, sizeof(GpuConeState),
                            groupsARound(settings) * sizeof(GpuGroup));
}

void ConeRays::begin(std::span<const GpuRay> rays, const glm::dvec4& bounds,
                     const std::function<bool()>& cancelled) {
    count_ = static_cast<std::uint32_t>(rays.size());
    fresh_ = 1;
    grow(device_, buffers_.states, "cone states", count_ * sizeof(GpuConeState));
    grow(device_, buffers_.answers, "cone groups", std::size_t{count_} * room_ * sizeof(GpuGroup));
    tiles_.begin(buffers_, rays, coneReach(settings_), bounds, cancelled);
}

bool ConeRays::goOn(const std::function<bool()>& cancelled) {
    const std::uint32_t pruned = tiles_.prunes() ? 1 : 0, steps = tiles_.evaluationsADispatch();
    std::uint32_t paused = 0;
    do {
        if (cancelled && cancelled()) throw Interrupted();
        tiles_.run("groups", groups_, buffers_, {count_, 0, steps, fresh_, pruned}, count_);
        paused = tiles_.pausedRays();
        fresh_ = 0;
    } while (tiles_.activeRays() > 0);
    fresh_ = 2;
    return paused > 0;
}

}  // namespace edgewise::vulkan
