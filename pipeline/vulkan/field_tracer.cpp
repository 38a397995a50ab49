// makeVulkanFieldTracer: rays on the device, in bands under --memory; colours by the host from its hits.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <chrono>
#include <cmath>

#include "pipeline/field_tracer.h"
#include "pipeline/lighting.h"
#include "pipeline/vulkan/field_window.h"

namespace edgewise {
namespace {

using namespace vulkan;

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A sphere around a box; infinite for an unbounded or unknown one.
glm::dvec4 sphereAround(const sdf::Box& box, double margin) {
    if (!box.bounded() || box.empty()) return {0.0, 0.0, 0.0, INFINITY};
    const glm::dvec3 low(box.low[0], box.low[1], box.low[2]), high(box.high[0], box.high[1], box.high[2]);
    return {0.5 * (low + high), 0.5 * glm::distance(low, high) + margin};
}

class VulkanFieldTracer : public FieldTracer {
  public:
    VulkanFieldTracer(const MethodInput& input, const FieldSettings& settings)
        : input_(input), settings_(settings), scene_(*input.scene.field), light_(input.scene, input.camera) {
        const auto start = std::chrono::steady_clock::now();
        settings_.trace.prune = settings.trace.prune && !input.options.keeps("empty");
        device_.emplace();
        shaders_ = makeFieldShaders(scene_, settings_.trace, input.film.width, input.film.height,
                                    settings_.trace.prune);
        rays_.emplace(*device_, shaders_, settings_.trace, settings_.trace.prune);
        if (!scene_.glsl && !input.options.keeps("empty")) bounds_ = boundsOf();
        setup_seconds_ = secondsSince(start);
    }

    FieldSamples trace(const FieldWindow& window) override {
        return withDeviceErrors([&] { return traceBands(window); });
    }

    void report(MethodResult& result) const override {
        result.device = device_->traits().name;
        result.setup_seconds += setup_seconds_;
        for (const PassTime& time : rays_->times()) result.stages.push_back({time.name, time.seconds});
        result.stages.push_back({"shade", shade_seconds_});
        const FieldCounts& counts = rays_->counts();
        result.counts["field_evaluations"] += counts.evaluations + counts.cone_evaluations;
        result.counts["cone_evaluations"] += counts.cone_evaluations;
        result.counts["trace_iterations"] += counts.iterations;
        result.counts["failed_steps"] += counts.failed_steps;
        result.counts["tiles"] += counts.tiles;
        result.counts["empty_tiles"] += counts.empty_tiles;
        result.counts["dispatches"] += counts.dispatches;
        result.counts["listed_rows"] += counts.list_rows;
        result.counts["lists"] += counts.lists;
        result.counts["long_lists"] += counts.long_lists;
        addPlan(result);
    }

  private:
    glm::dvec4 boundsOf() const {
        // What ends a ray is a hit within the threshold, and the levels of a bound may lie farther out.
        const sdf::Box box = levelBox(scene_.tree, scene_.tree.root);
        const glm::dvec4 around = sphereAround(box, 0.0);
        if (!std::isfinite(around.w)) return around;
        const glm::dvec3 eye(glm::inverse(input_.camera.camera_from_world)[3]);
        const double farthest = glm::distance(eye, glm::dvec3(around)) + around.w;
        const Camera& camera = input_.camera.camera;
        const double pixel = camera.perspective ? farthest * std::tan(0.5 * camera.yfov) / input_.film.height
                                                : camera.ymag / input_.film.height;
        const double level = shaders_.lipschitz * std::max(1.0, settings_.trace.threshold) * pixel * 2.0;
        return sphereAround(levelBox(scene_.tree, scene_.tree.root, level), 1e-5 * farthest);
    }

    FieldSamples traceBands(const FieldWindow& window) {
        FieldSamples samples;
        const std::size_t stride = window.stride(),
                          rows = window.samples() / std::max<std::size_t>(stride, 1);
        resize(samples, window.samples());
        // A quarter of --memory for the device's buffers: the picture and the samples have the rest.
        const std::size_t most = FieldRays::most(*device_, shaders_, (input_.options.memory_mib << 20) / 4);
        const std::size_t tile_row = (stride + kFieldTile - 1) / kFieldTile * kFieldTile * kFieldTile;
        const std::size_t band = std::max<std::size_t>(1, most / tile_row) * kFieldTile;
        for (std::size_t first = 0; first < rows; first += band)
            traceBand(window, first, std::min(rows, first + band), samples);
        return samples;
    }

    void traceBand(const FieldWindow& window, std::size_t first, std::size_t last, FieldSamples& samples) {
        const glm::dvec4 lists = std::isfinite(bounds_.w) ? bounds_ : sphereAround(scene_.bounds, 0.0);
        const std::vector<GpuRay> rays = raysOf(input_, window, first, last, scene_.far, bounds_);
        const FieldAnswers answers =
            rays_->trace(rays, std::isfinite(lists.w) ? lists : glm::dvec4(0.0, 0.0, 0.0, scene_.far),
                         [&] { return input_.progress.cancelled(); });
        const auto start = std::chrono::steady_clock::now();
        const std::size_t stride = window.stride();
        tbb::parallel_for(first, last, [&](std::size_t row) {
            for (std::size_t column = 0; column < stride; ++column) {
                const std::size_t ray = rayIndex(column, row - first, stride);
                fill(samples, row * stride + column, rays[ray], answers.states[ray], answers.hits[ray]);
            }
        });
        shade_seconds_ += secondsSince(start);
    }

    static void resize(FieldSamples& samples, std::size_t count) {
        samples.color.resize(count), samples.depth.resize(count), samples.normal.resize(count);
        samples.surface.resize(count), samples.residual.resize(count);
        samples.evaluations.resize(count), samples.iterations.resize(count);
    }

    void fill(FieldSamples& samples, std::size_t at, const GpuRay& ray, const GpuRayState& state,
              const GpuHit& hit) const {
        samples.evaluations[at] = state.evaluations, samples.iterations[at] = state.iterations;
        samples.depth[at] = INFINITY, samples.surface[at] = kNone, samples.normal[at] = glm::vec3(0.0f);
        samples.residual[at] = 0.0f;
        samples.color[at] = glm::dvec4(input_.options.background, 0.0);
        if (!state.hit()) return;
        const glm::dvec3 normal(hit.normal[0], hit.normal[1], hit.normal[2]);
        samples.depth[at] = hit.t, samples.normal[at] = normal;
        samples.residual[at] = static_cast<float>(hit.value * shaders_.lipschitz);
        samples.surface[at] =
            std::min<std::uint32_t>(hit.material, static_cast<std::uint32_t>(scene_.materials.size()) - 1);
        const glm::dvec3 p = glm::dvec3(ray.origin[0], ray.origin[1], ray.origin[2]) +
                             double(hit.t) * glm::dvec3(ray.direction[0], ray.direction[1], ray.direction[2]);
        samples.color[at] = glm::dvec4(shade(hit, samples.surface[at], p, normal), 1.0);
    }

    glm::dvec3 shade(const GpuHit& hit, std::uint32_t index, const glm::dvec3& p, const glm::dvec3& n) const {
        const sdf::SurfaceMaterial& material = scene_.materials[index];
        const glm::dvec3 color =
            shaders_.user_albedo ? glm::dvec3(hit.color[0], hit.color[1], hit.color[2]) : material.color;
        if (material.shading == sdf::SurfaceMaterial::Shading::kUnlit) return color + material.emission;
        const glm::dvec3 p_eye(input_.camera.camera_from_world * glm::dvec4(p, 1.0));
        const glm::dvec3 n_eye = glm::dmat3(input_.camera.camera_from_world) * n;
        glm::dvec3 light = light_.isRig() ? glm::dvec3(kRigAmbient) : scene_.ambient;
        for (std::size_t i = 0; i < light_.count(); ++i) {
            const auto arrival = light_.arrival(i, p_eye);
            light += arrival.illuminance * (std::max(0.0, glm::dot(n_eye, arrival.towards)) / M_PI);
        }
        return material.emission + color * light;
    }

    void addPlan(MethodResult& result) const {
        const FieldCounts& counts = rays_->counts();
        result.plan.push_back(
            {"prepass", settings_.trace.prepass,
             settings_.trace.prepass
                 ? fmt::format("cones of {} tiles of 8x8 samples took {} evaluations; {} tiles "
                               "are empty",
                               counts.tiles, counts.cone_evaluations, counts.empty_tiles)
                 : std::string("switched off")});
        const bool lists = !shaders_.prune.empty();
        result.plan.push_back(
            {"prune", lists,
             lists ? fmt::format("{} of {} like children count in a tile's segment, in the mean",
                                 counts.list_rows / std::max<std::uint64_t>(counts.lists, 1),
                                 shaders_.field.rows())
                   : std::string(!settings_.trace.prune ? "switched off"
                                                        : "no fold of many like children: the shader is "
                                                          "straight-line")});
        if (shaders_.field.batches.empty()) return;
        for (const sdf::GlslBatch& batch : shaders_.field.batches)
            result.notes.push_back(fmt::format("{} children of a fold are a loop over a table", batch.rows));
    }

    const MethodInput& input_;
    FieldSettings settings_;
    const sdf::FieldScene& scene_;
    Lighting light_;
    std::optional<Device> device_;
    FieldShaders shaders_;
    std::optional<FieldRays> rays_;
    glm::dvec4 bounds_{0.0, 0.0, 0.0, INFINITY};
    double setup_seconds_ = 0.0, shade_seconds_ = 0.0;
};

}  // namespace

std::unique_ptr<FieldTracer> makeVulkanFieldTracer(const MethodInput& input, const FieldSettings& settings) {
    return withDeviceErrors([&]() -> std::unique_ptr<FieldTracer> {
        return std::make_unique<VulkanFieldTracer>(input, settings);
    });
}

}  // namespace edgewise
