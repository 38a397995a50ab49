#include "pipeline/vulkan/field_tiles.h"

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

struct GpuCone {
    float origin[3], direction[3];
    float radius, spread, t_min, t_max, reach, reach_slope, sign;
};
struct GpuTile {
    float begin, list_begin, list_end;
    std::uint32_t evaluations;
};
static_assert(sizeof(GpuRay) == 44 && sizeof(GpuCone) == 52 && sizeof(GpuTile) == 16);

glm::dvec3 vectorOf(const float (&v)[3]) {
    return {v[0], v[1], v[2]};
}

/// Rounded so that a bound stays one.
float roundedUp(double x) {
    return std::nextafter(static_cast<float>(x), INFINITY);
}

/// The axis is the mean of the rays: for each, |origin - axis origin| and |direction - axis direction|.
GpuCone coneOf(std::span<const GpuRay> rays, float reach) {
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
        cone.reach = std::max(cone.reach, reach * ray.pixel_radius);
        cone.reach_slope = std::max(cone.reach_slope, reach * ray.pixel_slope);
        const float sign = ray.sign == 0.0f ? 1.0f : ray.sign;
        cone.sign = first || cone.sign == sign ? sign : 0.0f;
        first = false;
    }
    cone.radius = roundedUp(radius), cone.spread = roundedUp(spread);
    return cone;
}

Buffer tableOf(const Device& device, const sdf::GlslField& field) {
    return field.table.empty() ? bufferOf(device, "field table", std::vector<std::uint32_t>{0})
                               : bufferOf(device, "field table", field.table);
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

void grow(const Device& device, std::unique_ptr<Buffer>& buffer, const char* name, std::size_t bytes) {
    if (buffer && buffer->bytes() >= bytes) return;
    buffer.reset();
    buffer = std::make_unique<Buffer>(device, name, bytes);
}

FieldTiles::FieldTiles(const Device& device, const FieldShaders& shaders, bool prepass, bool prune,
                       std::uint32_t turns)
    : device_(device),
      shaders_(shaders),
      turns_(turns > 0 ? turns : std::min(device.traits().loop_turns - 1535u, 1u << 20)),
      table_(tableOf(device, shaders.field)),
      flags_(device, "field flags", 8 * sizeof(std::uint32_t)) {
    // A hit's last turn takes two evaluations; a coarse segment one and those of its fine ones' short lists.
    if (2 * shaders.turnsOfEvaluation() + 8192 > device.traits().loop_turns)
        throw DeviceError(fmt::format("{} takes {} turns of loops; a field of {} like children needs more",
                                      device.traits().name, device.traits().loop_turns,
                                      shaders.field.rows()));
    if (prepass && !shaders.cones.empty())
        cones_ = std::make_unique<ComputePass>(pass("field_cones", shaders.cones));
    if (prune && !shaders.prune.empty())
        lists_ = std::make_unique<ComputePass>(pass("field_prune", shaders.prune));
}

ComputePass FieldTiles::pass(const char* name, const std::vector<std::uint32_t>& code) const {
    const auto uniform = shaders_.uniform_table ? std::optional<int>(kFieldTableBinding) : std::nullopt;
    return {device_, ShaderCode(name, code), BufferSlots(kBuffers, uniform), sizeof(Push)};
}

std::size_t FieldTiles::most(const Device& device, const FieldShaders& shaders, std::size_t bytes,
                             std::size_t state_bytes, std::size_t answer_bytes) {
    const std::size_t lists = listBytes(shaders, 1), largest = device.traits().max_storage_bytes;
    const std::size_t tile =
        kTileRays * (sizeof(GpuRay) + state_bytes + answer_bytes) + sizeof(GpuCone) + sizeof(GpuTile) + lists;
    std::size_t tiles =
        std::min(bytes / tile, largest / (kTileRays * std::max({sizeof(GpuRay), state_bytes, answer_bytes})));
    if (lists > 0)
        tiles = std::min(tiles, (largest - std::min(largest, everyRow(shaders.field).size() * 4)) / lists);
    return std::max<std::size_t>(tiles, 1) * kTileRays;
}

void FieldTiles::place(FieldBuffers& buffers, std::span<const GpuRay> rays) {
    const std::vector<std::uint32_t> rows = everyRow(shaders_.field);
    const std::size_t tiles = rays.size() / kTileRays;
    grow(device_, buffers.rays, "field rays", rays.size_bytes());
    grow(device_, buffers.states, "field states", 1);
    grow(device_, buffers.answers, "field answers", 1);
    grow(device_, buffers.cones, "field cones", tiles * sizeof(GpuCone));
    grow(device_, buffers.tiles, "field tiles", tiles * sizeof(GpuTile));
    grow(device_, buffers.items, "field lists",
         rows.size() * sizeof(std::uint32_t) + (prunes() ? listBytes(shaders_, tiles) : 0));
    std::ranges::copy(rays, buffers.rays->view<GpuRay>(rays.size()).begin());
    std::ranges::copy(rows, buffers.items->view<std::uint32_t>(rows.size()).begin());
}

void FieldTiles::begin(FieldBuffers& buffers, std::span<const GpuRay> rays, double reach,
                       const glm::dvec4& bounds, const std::function<bool()>& cancelled) {
    place(buffers, rays);
    const auto tiles = static_cast<std::uint32_t>(rays.size() / kTileRays);
    const auto cones = buffers.cones->view<GpuCone>(tiles);
    const float rounded = roundedUp(reach);
    tbb::parallel_for(std::uint32_t(0), tiles, [&](std::uint32_t i) {
        cones[i] = coneOf(rays.subspan(std::size_t{i} * kTileRays, kTileRays), rounded);
    });
    march(buffers, tiles, bounds, cancelled);
    if (prunes()) makeLists(buffers, tiles);
}

void FieldTiles::run(const char* name, ComputePass& pass, const FieldBuffers& buffers, Push push,
                     std::uint32_t invocations) {
    std::ranges::fill(flags_.view<std::uint32_t>(8), 0u);
    const vk::raii::CommandBuffers lists(device_.handle(),
                                         {*device_.commandPool(), vk::CommandBufferLevel::ePrimary, 1});
    const vk::raii::CommandBuffer& commands = lists.front();
    commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    const std::uint32_t row = Groups::kMostInRow * kTileRays;
    for (std::uint32_t first = 0; first < invocations; first += row) {
        push.first = first;
        pass.dispatch(commands,
                      {*buffers.rays, *buffers.states, *buffers.answers, *buffers.cones, *buffers.tiles,
                       table_, *buffers.items, flags_},
                      Groups::covering(std::min(invocations - first, row), kTileRays), push);
    }
    const vk::MemoryBarrier written(vk::AccessFlagBits::eShaderWrite, vk::AccessFlagBits::eHostRead);
    commands.pipelineBarrier(vk::PipelineStageFlagBits::eComputeShader, vk::PipelineStageFlagBits::eHost, {},
                             written, {}, {});
    commands.end();
    const auto start = std::chrono::steady_clock::now();
    device_.run(commands);
    book(name, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    pass.forgetSets();
    ++counts_.dispatches;
    checkFlags();
}

void FieldTiles::book(const char* name, double seconds) {
    const auto found = std::ranges::find(times_, name, &PassTime::name);
    if (found == times_.end())
        times_.push_back({name, seconds});
    else
        found->seconds += seconds;
}

std::uint32_t FieldTiles::evaluationsADispatch() const {
    return std::clamp(turns_ / shaders_.turnsOfEvaluation(), 1u, 4096u);
}

void FieldTiles::checkFlags() const {
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

/// Until no cone can go on; then each tile knows where its lists begin and end.
void FieldTiles::march(FieldBuffers& buffers, std::uint32_t tiles, const glm::dvec4& bounds,
                       const std::function<bool()>& cancelled) {
    const auto cones = buffers.cones->view<GpuCone>(tiles);
    const auto table = buffers.tiles->view<GpuTile>(tiles);
    for (std::uint32_t i = 0; i < tiles; ++i) table[i] = {cones[i].t_min, 0.0f, 0.0f, 0};
    if (cones_) {
        constexpr std::uint32_t kMostSteps = 64;
        std::uint32_t done = 0;
        do {
            if (cancelled && cancelled()) throw Interrupted();
            const std::uint32_t steps = std::min(evaluationsADispatch(), kMostSteps - done);
            run("cones", *cones_, buffers, {tiles, 0, steps, done == 0 ? 1u : 0u, 0}, tiles);
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

void FieldTiles::makeLists(FieldBuffers& buffers, std::uint32_t tiles) {
    const std::uint32_t lists = tiles * kFieldCoarseSegments;
    run("prune", *lists_, buffers, {lists, 0, 0, 0, 0}, lists);
    const std::size_t begin = everyRow(shaders_.field).size();
    const auto items = buffers.items->read<std::uint32_t>(begin + std::size_t{tiles} * shaders_.tile_stride);
    const auto table = buffers.tiles->read<GpuTile>(tiles);
    for (std::uint32_t tile = 0; tile < tiles; ++tile)
        if (table[tile].list_end > table[tile].list_begin)
            countLists(items.subspan(begin + std::size_t{tile} * shaders_.tile_stride));
}

void FieldTiles::countLists(std::span<const std::uint32_t> items) {
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

}  // namespace edgewise::vulkan
