#include "pipeline/vulkan/field_rays.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>

#include "pipeline/error.h"
#include "pipeline/vulkan/user_glsl.h"

namespace edgewise::vulkan {
namespace {

constexpr std::size_t kBuffers = 8;
constexpr std::uint32_t kTileRays = 64;

struct GpuCone {
    float origin[3], direction[3];
    float radius, spread, t_min, t_max, pixel_radius, pixel_slope, sign;
};
struct GpuTile {
    float begin, list_begin, list_end;
    std::uint32_t evaluations;
};
static_assert(sizeof(GpuRay) == 44 && sizeof(GpuRayState) == 72 && sizeof(GpuHit) == 32);
static_assert(sizeof(GpuCone) == 52 && sizeof(GpuTile) == 16);

glm::dvec3 vectorOf(const float (&v)[3]) {
    return {v[0], v[1], v[2]};
}

/// Rounded so that a bound stays one.
float roundedUp(double x) {
    return std::nextafter(static_cast<float>(x), INFINITY);
}

/// The axis is the mean of the rays: for each, |origin - axis origin| and |direction - axis direction|.
GpuCone coneOf(std::span<const GpuRay> rays) {
    glm::dvec3 origin(0.0), direction(0.0);
    double count = 0.0;
    for (const GpuRay& ray : rays) {
        if (ray.t_max < ray.t_min) continue;
        origin += vectorOf(ray.origin), direction += vectorOf(ray.direction), ++count;
    }
    GpuCone cone{};
    cone.t_max = -1.0f;
    if (count == 0.0) return cone;
    cone.t_min = INFINITY;
    // Rays that go apart have no cone: they begin where the first of them does.
    if (glm::length(direction) < 1e-3 * count) {
        for (const GpuRay& ray : rays)
            if (ray.t_max >= ray.t_min) cone.t_min = std::min(cone.t_min, ray.t_min);
        return cone;
    }
    const glm::vec3 o(origin / count), d(glm::normalize(direction));
    for (int k = 0; k < 3; ++k) cone.origin[k] = o[k], cone.direction[k] = d[k];
    double radius = 0.0, spread = 0.0;
    bool first = true;
    for (const GpuRay& ray : rays) {
        if (ray.t_max < ray.t_min) continue;
        radius = std::max(radius, glm::distance(vectorOf(ray.origin), glm::dvec3(o)));
        spread = std::max(spread, glm::distance(vectorOf(ray.direction), glm::dvec3(d)));
        cone.t_min = std::min(cone.t_min, ray.t_min), cone.t_max = std::max(cone.t_max, ray.t_max);
        cone.pixel_radius = std::max(cone.pixel_radius, ray.pixel_radius);
        cone.pixel_slope = std::max(cone.pixel_slope, ray.pixel_slope);
        const float sign = ray.sign == 0.0f ? 1.0f : ray.sign;
        cone.sign = first || cone.sign == sign ? sign : 0.0f;
        first = false;
    }
    cone.radius = roundedUp(radius), cone.spread = roundedUp(spread);
    return cone;
}

Buffer tableOf(const Device& device, const sdf::GlslField& field) {
    return bufferOf(device, "field table", field.table.empty() ? std::vector<std::uint32_t>{0} : field.table);
}

/// A buffer of at least so many bytes: the one there is, or a new one.
void grow(const Device& device, std::unique_ptr<Buffer>& buffer, const char* name, std::size_t bytes) {
    if (buffer && buffer->bytes() >= bytes) return;
    buffer.reset();
    buffer = std::make_unique<Buffer>(device, name, bytes);
}

std::vector<std::uint32_t> everyRow(const sdf::GlslField& field) {
    std::vector<std::uint32_t> rows;
    for (const sdf::GlslBatch& batch : field.batches)
        for (std::uint32_t row = 0; row < batch.rows; ++row) rows.push_back(row);
    if (rows.empty()) rows.push_back(0);
    return rows;
}

std::size_t listBytes(const FieldShaders& shaders, std::size_t tiles) {
    return tiles * shaders.tile_stride * sizeof(std::uint32_t);
}

}  // namespace

GpuRay gpuRay(const sdf::FieldRay& ray, double sign) {
    GpuRay made;
    for (int k = 0; k < 3; ++k) {
        made.origin[k] = static_cast<float>(ray.origin_world[k]);
        made.direction[k] = static_cast<float>(ray.direction_world[k]);
    }
    made.t_min = static_cast<float>(ray.t_min), made.t_max = static_cast<float>(ray.t_max);
    made.pixel_radius = static_cast<float>(ray.pixel_radius);
    made.pixel_slope = static_cast<float>(ray.pixel_slope);
    made.sign = static_cast<float>(sign);
    return made;
}

void FieldCounts::add(const FieldCounts& more) {
    rays += more.rays, evaluations += more.evaluations, iterations += more.iterations;
    failed_steps += more.failed_steps, cone_evaluations += more.cone_evaluations;
    tiles += more.tiles, empty_tiles += more.empty_tiles, dispatches += more.dispatches;
    lists += more.lists, list_rows += more.list_rows, long_lists += more.long_lists;
}

FieldRays::FieldRays(const Device& device, const FieldShaders& shaders, const sdf::TraceSettings& settings,
                     bool prune, std::uint32_t turns)
    : device_(device),
      shaders_(shaders),
      settings_(settings),
      prune_(prune && !shaders.prune.empty()),
      turns_(turns > 0 ? turns : std::min(device.traits().loop_turns - 1535u, 1u << 20)),
      trace_(device, {"field_trace", shaders.trace}, kBuffers, sizeof(Push)),
      finish_(device, {"field_finish", shaders.finish}, kBuffers, sizeof(Push)),
      table_(tableOf(device, shaders.field)),
      flags_(device, "field flags", 8 * sizeof(std::uint32_t)) {
    // A hit's last turn takes two evaluations; a coarse segment one and those of its fine ones' short lists.
    if (2 * shaders.turnsOfEvaluation() + 8192 > device.traits().loop_turns)
        throw DeviceError(fmt::format("{} takes {} turns of loops; a field of {} like children needs more",
                                      device.traits().name, device.traits().loop_turns,
                                      shaders.field.rows()));
    if (!shaders.cones.empty())
        cones_ = std::make_unique<ComputePass>(device, ShaderCode("field_cones", shaders.cones), kBuffers,
                                               sizeof(Push));
    if (prune_)
        lists_ = std::make_unique<ComputePass>(device, ShaderCode("field_prune", shaders.prune), kBuffers,
                                               sizeof(Push));
}

std::size_t FieldRays::most(const Device& device, const FieldShaders& shaders, std::size_t bytes) {
    const std::size_t lists = listBytes(shaders, 1), largest = device.traits().max_storage_bytes;
    const std::size_t tile = kTileRays * (sizeof(GpuRay) + sizeof(GpuRayState) + sizeof(GpuHit)) +
                             sizeof(GpuCone) + sizeof(GpuTile) + lists;
    std::size_t tiles = std::min(bytes / tile, largest / (kTileRays * sizeof(GpuRayState)));
    if (lists > 0)
        tiles = std::min(tiles, (largest - std::min(largest, everyRow(shaders.field).size() * 4)) / lists);
    return std::max<std::size_t>(tiles, 1) * kTileRays;
}

std::uint32_t FieldRays::evaluationsADispatch() const {
    return std::clamp(turns_ / shaders_.turnsOfEvaluation(), 1u, 4096u);
}

void FieldRays::runPass(const std::string& name, ComputePass& pass, Push push, std::uint32_t invocations) {
    std::ranges::fill(flags_.view<std::uint32_t>(8), 0u);
    const vk::raii::CommandBuffers lists(device_.handle(),
                                         {*device_.commandPool(), vk::CommandBufferLevel::ePrimary, 1});
    const vk::raii::CommandBuffer& commands = lists.front();
    commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    const std::uint32_t row = Groups::kMostInRow * kTileRays;
    for (std::uint32_t first = 0; first < invocations; first += row) {
        push.first = first;
        pass.dispatch(commands, {*rays_, *states_, *hits_, *cone_table_, *tiles_, table_, *items_, flags_},
                      Groups::covering(std::min(invocations - first, row), kTileRays), push);
    }
    const vk::MemoryBarrier written(vk::AccessFlagBits::eShaderWrite, vk::AccessFlagBits::eHostRead);
    commands.pipelineBarrier(vk::PipelineStageFlagBits::eComputeShader, vk::PipelineStageFlagBits::eHost, {},
                             written, {}, {});
    commands.end();
    const auto start = std::chrono::steady_clock::now();
    device_.run(commands);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    pass.forgetSets();
    ++counts_.dispatches;
    const auto found = std::ranges::find(times_, name, &PassTime::name);
    if (found == times_.end())
        times_.push_back({name, seconds});
    else
        found->seconds += seconds;
    checkFlags();
}

void FieldRays::checkFlags() const {
    const auto flags = flags_.read<std::uint32_t>(8);
    if (flags[4] != 0)
        throw FailureError(shaders_.file,
                           fmt::format("line {}: a loop without end: the loops of one call take more than "
                                       "{} turns",
                                       flags[4], kUserTurns));
    if (flags[0] != 0)
        throw FailureError(shaders_.file,
                           fmt::format("the distance at ({:.9g}, {:.9g}, {:.9g}) is not a number",
                                       std::bit_cast<float>(flags[1]), std::bit_cast<float>(flags[2]),
                                       std::bit_cast<float>(flags[3])));
}

std::uint32_t FieldRays::activeRays() const {
    return flags_.read<std::uint32_t>(8)[5];
}

/// Until no cone can go on; then each tile knows where its lists begin and end.
void FieldRays::traceCones(std::uint32_t tiles, const glm::dvec4& bounds,
                           const std::function<bool()>& cancelled) {
    const auto cones = cone_table_->view<GpuCone>(tiles);
    const auto table = tiles_->view<GpuTile>(tiles);
    for (std::uint32_t i = 0; i < tiles; ++i) table[i] = {cones[i].t_min, 0.0f, 0.0f, 0};
    if (cones_ && settings_.prepass) {
        constexpr std::uint32_t kMostSteps = 64;
        std::uint32_t done = 0;
        do {
            if (cancelled && cancelled()) throw Interrupted();
            const std::uint32_t steps = std::min(evaluationsADispatch(), kMostSteps - done);
            runPass("cones", *cones_, {tiles, 0, steps, done == 0 ? 1u : 0u, 0}, tiles);
            done += steps;
        } while (activeRays() > 0 && done < kMostSteps);
    }
    for (std::uint32_t i = 0; i < tiles; ++i) {
        const GpuCone& cone = cones[i];
        const glm::dvec3 away = glm::dvec3(bounds) - vectorOf(cone.origin);
        const double middle = glm::dot(away, vectorOf(cone.direction));
        table[i].list_begin = table[i].begin;
        table[i].list_end = static_cast<float>(std::min<double>(cone.t_max, middle + bounds.w));
        counts_.empty_tiles += cone.t_max >= cone.t_min && table[i].begin > cone.t_max;
        counts_.cone_evaluations += table[i].evaluations;
    }
    counts_.tiles += tiles;
}

void FieldRays::makeLists(std::uint32_t tiles) {
    const std::uint32_t lists = tiles * kFieldCoarseSegments;
    runPass("prune", *lists_, {lists, 0, 0, 0, 0}, lists);
    const std::size_t begin = everyRow(shaders_.field).size();
    const auto items = items_->read<std::uint32_t>(begin + std::size_t{tiles} * shaders_.tile_stride);
    const auto table = tiles_->read<GpuTile>(tiles);
    for (std::uint32_t tile = 0; tile < tiles; ++tile)
        if (table[tile].list_end > table[tile].list_begin)
            countLists(items.subspan(begin + std::size_t{tile} * shaders_.tile_stride));
}

void FieldRays::countLists(std::span<const std::uint32_t> items) {
    for (std::uint32_t segment = 0; segment < kFieldSegments; ++segment) {
        std::size_t at = std::size_t{segment} * shaders_.fine_stride;
        for (const sdf::GlslBatch& batch : shaders_.field.batches) {
            const bool whole = items[at] == 0xffffffffu;
            ++counts_.lists;
            counts_.long_lists += whole;
            counts_.list_rows += whole ? batch.rows : items[at];
            at += 1 + std::min(batch.rows, kFieldListRows);
        }
    }
}

void FieldRays::countAnswers(std::span<const GpuRayState> states) {
    for (const GpuRayState& state : states) {
        counts_.evaluations += state.evaluations;
        counts_.iterations += state.iterations;
        counts_.failed_steps += static_cast<std::uint64_t>(state.at.failed);
    }
}

void FieldRays::finish(std::uint32_t count) {
    const std::uint32_t turns =
        static_cast<std::uint32_t>(settings_.discontinuity_steps) + shaders_.corners();
    const std::uint32_t at_once = shaders_.user_loops ? 1 : evaluationsADispatch();
    std::uint32_t from = 0;
    do {
        const std::uint32_t to = std::min(turns, from + at_once);
        runPass("hits", finish_, {count, 0, from | to << 16u, from == 0 ? 1u : 0u, prune_ ? 1u : 0u}, count);
        from = to;
    } while (from < turns);
}

FieldAnswers FieldRays::trace(std::span<const GpuRay> rays, const glm::dvec4& bounds,
                              const std::function<bool()>& cancelled, bool with_hits) {
    const auto count = static_cast<std::uint32_t>(rays.size()), tiles = count / kTileRays;
    const std::vector<std::uint32_t> rows = everyRow(shaders_.field);
    grow(device_, rays_, "field rays", rays.size_bytes());
    grow(device_, states_, "field states", count * sizeof(GpuRayState));
    grow(device_, hits_, "field hits", count * sizeof(GpuHit));
    grow(device_, cone_table_, "field cones", tiles * sizeof(GpuCone));
    grow(device_, tiles_, "field tiles", tiles * sizeof(GpuTile));
    grow(device_, items_, "field lists",
         rows.size() * sizeof(std::uint32_t) + (prune_ ? listBytes(shaders_, tiles) : 0));
    std::ranges::copy(rays, rays_->view<GpuRay>(count).begin());
    std::ranges::copy(rows, items_->view<std::uint32_t>(rows.size()).begin());
    const auto cones = cone_table_->view<GpuCone>(tiles);
    tbb::parallel_for(std::uint32_t(0), tiles, [&](std::uint32_t i) {
        cones[i] = coneOf(rays.subspan(std::size_t{i} * kTileRays, kTileRays));
    });
    traceCones(tiles, bounds, cancelled);
    if (prune_) makeLists(tiles);

    const std::uint32_t pruned = prune_ ? 1 : 0, steps = evaluationsADispatch();
    std::uint32_t fresh = 1;
    do {
        if (cancelled && cancelled()) throw Interrupted();
        runPass("trace", trace_, {count, 0, steps, fresh, pruned}, count);
        fresh = 0;
    } while (activeRays() > 0);

    if (with_hits) finish(count);
    const FieldAnswers answers{states_->read<GpuRayState>(count), hits_->read<GpuHit>(count)};
    counts_.rays += count;
    countAnswers(answers.states);
    return answers;
}

}  // namespace edgewise::vulkan
