#include "pipeline/vulkan/field_rays.h"

#include <algorithm>

#include "pipeline/error.h"

namespace edgewise::vulkan {
namespace {

static_assert(sizeof(GpuRayState) == 72 && sizeof(GpuHit) == 32);

}  // namespace

FieldRays::FieldRays(const Device& device, const FieldShaders& shaders, const sdf::TraceSettings& settings,
                     FieldTiles& tiles)
    : device_(device),
      shaders_(shaders),
      settings_(settings),
      tiles_(tiles),
      trace_(tiles.pass("field_trace", shaders.trace)),
      finish_(tiles.pass("field_finish", shaders.finish)) {}

std::size_t FieldRays::most(const Device& device, const FieldShaders& shaders, std::size_t bytes) {
    return FieldTiles::most(device, shaders, bytes, sizeof(GpuRayState), sizeof(GpuHit));
}

void FieldRays::countAnswers(std::span<const GpuRayState> states) {
    for (const GpuRayState& state : states) {
        tiles_.counts().evaluations += state.evaluations;
        tiles_.counts().iterations += state.iterations;
        tiles_.counts().failed_steps += static_cast<std::uint64_t>(state.at.failed);
    }
}

void FieldRays::finish(std::uint32_t count, std::uint32_t first_turn) {
    const std::uint32_t turns =
        static_cast<std::uint32_t>(settings_.discontinuity_steps) + shaders_.corners();
    const std::uint32_t at_once = shaders_.user_loops ? 1 : tiles_.evaluationsADispatch();
    const std::uint32_t pruned = tiles_.prunes() ? 1 : 0;
    std::uint32_t from = first_turn;
    do {
        const std::uint32_t to = std::min(turns, from + at_once), fresh = from == first_turn ? 1 : 0;
        tiles_.run("hits", finish_, buffers_, {count, 0, from | to << 16u, fresh, pruned}, count);
        from = to;
    } while (from < turns);
}

FieldAnswers FieldRays::trace(std::span<const GpuRay> rays, const glm::dvec4& bounds,
                              const std::function<bool()>& cancelled, bool with_hits) {
    const auto count = static_cast<std::uint32_t>(rays.size());
    grow(device_, buffers_.states, "field states", count * sizeof(GpuRayState));
    grow(device_, buffers_.answers, "field hits", count * sizeof(GpuHit));
    tiles_.begin(buffers_, rays, settings_.threshold, bounds, cancelled);

    const std::uint32_t pruned = tiles_.prunes() ? 1 : 0, steps = tiles_.evaluationsADispatch();
    std::uint32_t fresh = 1;
    do {
        if (cancelled && cancelled()) throw Interrupted();
        tiles_.run("trace", trace_, buffers_, {count, 0, steps, fresh, pruned}, count);
        fresh = 0;
    } while (tiles_.activeRays() > 0);

    if (with_hits) finish(count, 0);
    const FieldAnswers answers{buffers_.states->read<GpuRayState>(count),
                               buffers_.answers->read<GpuHit>(count)};
    tiles_.counts().rays += count;
    countAnswers(answers.states);
    return answers;
}

std::span<const GpuHit> FieldRays::describe(std::span<const GpuRay> rays, std::span<const float> t) {
    const auto count = static_cast<std::uint32_t>(rays.size());
    grow(device_, buffers_.states, "field states", count * sizeof(GpuRayState));
    grow(device_, buffers_.answers, "field hits", count * sizeof(GpuHit));
    tiles_.place(buffers_, rays);
    const auto states = buffers_.states->view<GpuRayState>(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        states[i] = {};
        states[i].at.t = t[i], states[i].sign = rays[i].sign;
        states[i].end = rays[i].t_max < rays[i].t_min ? FieldEnd::kEmpty : FieldEnd::kSurface;
    }
    finish(count, static_cast<std::uint32_t>(settings_.discontinuity_steps));
    return buffers_.answers->read<GpuHit>(count);
}

}  // namespace edgewise::vulkan
