// makeVulkanFieldTracer: rays of every generation on the device, in bands under --memory; light by the host.
//
// Tracing is nearly all of the work, and the device's; between two generations the host has a few hundred
// operations a ray, which sdf::Shader has in double: so both devices' pictures have one shading.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <chrono>
#include <cmath>
#include <numeric>

#include "pipeline/field_plan.h"
#include "pipeline/field_rays.h"
#include "pipeline/field_shading.h"
#include "pipeline/field_tracer.h"
#include "pipeline/vulkan/cone_bands.h"

namespace edgewise {
namespace {

using namespace vulkan;

/// Secondary rays begin no nearer to the surface, times the distance from the eye: 2^-18, 64 roundings of
/// float.
constexpr double kFloatEpsilon = 0x1p-18;

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A sphere around a box; infinite for an unbounded or unknown one.
glm::dvec4 sphereAround(const sdf::Box& box, double margin) {
    if (!box.bounded() || box.empty()) return {0.0, 0.0, 0.0, INFINITY};
    const glm::dvec3 low(box.low[0], box.low[1], box.low[2]), high(box.high[0], box.high[1], box.high[2]);
    return {0.5 * (low + high), 0.5 * glm::distance(low, high) + margin};
}

sdf::TraceSettings settingsFor(const MethodInput& input, sdf::TraceSettings trace) {
    trace.epsilon = std::max(trace.epsilon, kFloatEpsilon);
    return sdf::trustedSettings(*input.scene.field, trace);
}

class VulkanFieldTracer : public FieldTracer {
  public:
    VulkanFieldTracer(const MethodInput& input, const FieldSettings& settings)
        : input_(input),
          settings_(settingsFor(input, settings.trace)),
          cones_(settings.cones),
          scene_(*input.scene.field),
          tape_(scene_.glsl ? sdf::Tape{} : loweredTree(scene_)),
          grid_(rayGrid(input.camera, input.film, scene_.far)),
          closed_(scene_, tape_, settings_),
          shader_(fieldShading(input, settings_, false), closed_) {
        const auto start = std::chrono::steady_clock::now();
        device_.emplace();
        if (scene_.glsl || tape_.size() > 0) makeRays();
        batches_.emplace(scene_, tape_, shaders_, settings_, rays_ ? &*rays_ : nullptr, around_, most_,
                         [this] { return input_.progress.cancelled(); });
        // A map's sign is found by its rays.
        if (!scene_.glsl) sign_ = signOfView(closed_, grid_, input.film);
        if (cones_ && tiles_) makeCones();
        setup_seconds_ = secondsSince(start);
    }

    FieldSamples trace(const FieldWindow& window) override {
        return withDeviceErrors([&] { return traceBands(window); });
    }

    FieldCones traceCones(const FieldWindow& window) override {
        return withDeviceErrors([&] {
            const auto start = std::chrono::steady_clock::now();
            FieldCones out = cone_bands_ ? cone_bands_->trace(window) : emptyCones(window);
            const std::uint64_t evaluations =
                std::accumulate(out.evaluations.begin(), out.evaluations.end(), std::uint64_t{0});
            primary_.evaluations += evaluations, primary_.primary += out.samples();
            if (tiles_) tiles_->counts().evaluations += evaluations;
            seconds_ += secondsSince(start);
            return out;
        });
    }

    std::vector<glm::dvec4> shade(std::span<const sdf::TravellingRay> rays,
                                  std::span<const sdf::SurfaceHit> hits,
                                  std::vector<std::uint32_t>* sights) override {
        return withDeviceErrors([&] {
            const auto start = std::chrono::steady_clock::now();
            auto colors = shadeWavefront(shader_, *batches_, rays, hits, secondary_, sights);
            seconds_ += secondsSince(start);
            return colors;
        });
    }

    RayBatches& batches() override { return *batches_; }

    void report(MethodResult& result) const override {
        result.device = device_->traits().name;
        result.setup_seconds += setup_seconds_;
        if (tiles_)
            for (const PassTime& time : tiles_->times()) result.stages.push_back({time.name, time.seconds});
        const double host = seconds_ - deviceSeconds();
        result.stages.push_back({"shade", std::max(host, 0.0)});
        addCounts(result.counts);
        addPlan(result);
    }

  private:
    void makeRays() {
        const bool prune = settings_.prune && !input_.options.keeps("empty");
        shaders_ = makeFieldShaders(scene_, settings_, input_.film.width, input_.film.height, prune,
                                    cones_ ? &*cones_ : nullptr, textRulesFor(device_->traits()));
        tiles_.emplace(*device_, shaders_, settings_.prepass, prune);
        rays_.emplace(*device_, shaders_, settings_, *tiles_);
        // A sixteenth of --memory for the device's buffers, several times that for the host's rays and hits;
        // the picture and the samples have the rest.
        most_ = FieldRays::most(*device_, shaders_, (input_.options.memory_mib << 20) / 16);
        // A device that is a program on the CPU gains nothing by more, and the host's lists stay in caches.
        if (!device_->traits().real_gpu) most_ = std::min(most_, std::size_t{1} << 17);
        if (!scene_.glsl && !input_.options.keeps("empty") && scene_.bound_holds) around_ = sphereOf();
    }

    void makeCones() {
        cone_rays_.emplace(*device_, shaders_, *cones_, *tiles_);
        const std::size_t most =
            ConeRays::most(*device_, shaders_, *cones_, (input_.options.memory_mib << 20) / 16);
        cone_bands_.emplace(
            grid_, *batches_, *cone_rays_, most, sign_, scene_.glsl.has_value(),
            [this] { return input_.progress.cancelled(); },
            [this](const std::vector<sdf::TravellingRay>& rays, const std::vector<sdf::SurfaceHit>& hits) {
                return shadeWavefront(shader_, *batches_, rays, hits, secondary_);
            });
    }
    FieldCones emptyCones(const FieldWindow& window) const {
        FieldCones out;
        out.rays.resize(window.samples());
        out.evaluations.resize(out.samples()), out.begin.resize(out.samples() + 1);
        return out;
    }

    /// What ends a ray is a hit within the threshold, and the levels of a bound may lie farther out.
    FieldSphere sphereOf() const {
        const glm::dvec4 solid = sphereAround(levelBox(scene_.tree, scene_.tree.root), 0.0);
        if (!std::isfinite(solid.w)) return {};
        const double farthest = glm::distance(grid_.eye_world, glm::dvec3(solid)) + solid.w;
        const double pixel = grid_.halfPixel() * (grid_.perspective ? farthest : 1.0);
        const double reach = std::max(1.0, cones_ ? coneReach(*cones_) : settings_.threshold);
        const double level = 2.0 * reach * pixel;
        const sdf::Box box = levelBox(scene_.tree, scene_.tree.root, level * shaders_.lipschitz);
        return {sphereAround(box, 1e-5 * farthest), level};
    }

    FieldSamples traceBands(const FieldWindow& window) {
        const auto start = std::chrono::steady_clock::now();
        FieldSamples samples = FieldSamples::sized(window.samples());
        const std::size_t stride = window.stride(),
                          rows = window.samples() / std::max<std::size_t>(stride, 1);
        const std::size_t tile_row = (stride + kFieldTile - 1) / kFieldTile * kFieldTile * kFieldTile;
        const std::size_t band = std::max<std::size_t>(1, most_ / tile_row) * kFieldTile;
        for (std::size_t first = 0; first < rows; first += band)
            traceBand(window, first, std::min(rows, first + band), samples);
        seconds_ += secondsSince(start);
        return samples;
    }

    void traceBand(const FieldWindow& window, std::size_t first, std::size_t last, FieldSamples& samples) {
        std::vector<sdf::TravellingRay> rays = raysOf(grid_, window, first, last, sign_);
        const std::vector<sdf::SurfaceHit> hits = batches_->nearest(rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (rays[i].sign == 0.0) rays[i].sign = hits[i].ofField() && hits[i].inside ? -1.0 : 1.0;
            primary_.evaluations += hits[i].evaluations;
            primary_.primary += rays[i].ray.t_max > rays[i].ray.t_min;
        }
        const std::vector<glm::dvec4> colors = shadeWavefront(shader_, *batches_, rays, hits, secondary_);
        const std::size_t stride = window.stride();
        tbb::parallel_for(first, last, [&](std::size_t row) {
            for (std::size_t column = 0; column < stride; ++column) {
                const std::size_t ray = rayIndex(column, row - first, stride);
                fill(samples, row * stride + column, rays[ray].ray, hits[ray], colors[ray]);
            }
        });
    }

    static void fill(FieldSamples& samples, std::size_t at, const sdf::FieldRay& ray,
                     const sdf::SurfaceHit& hit, const glm::dvec4& color) {
        samples.color[at] = color;
        samples.evaluations[at] = hit.evaluations, samples.iterations[at] = hit.iterations;
        samples.take(at, ray, hit);
        if (hit.hit) samples.residual[at] = static_cast<float>(hit.value);
    }

    double deviceSeconds() const {
        double sum = 0.0;
        if (tiles_)
            for (const PassTime& time : tiles_->times()) sum += time.seconds;
        return sum;
    }

    void addCounts(std::map<std::string, std::uint64_t>& into) const {
        const FieldCounts counts = tiles_ ? tiles_->counts() : FieldCounts{};
        into["instructions_of_tape"] = tape_.size();
        into["rays"] += primary_.primary, into["evaluations"] += primary_.evaluations;
        into["field_evaluations"] += counts.evaluations + counts.cone_evaluations;
        into["secondary_evaluations"] += counts.evaluations - primary_.evaluations;
        into["cone_evaluations"] += counts.cone_evaluations;
        into["iterations"] += counts.iterations, into["failed_steps"] += counts.failed_steps;
        into["shadow_rays"] += secondary_.shadow, into["reflection_rays"] += secondary_.reflection;
        into["refraction_rays"] += secondary_.refraction;
        into["tiles"] += counts.tiles, into["tiles_empty"] += counts.empty_tiles;
        into["dispatches"] += counts.dispatches;
        into["lists"] += counts.lists, into["listed_rows"] += counts.list_rows;
        into["long_lists"] += counts.long_lists;
    }

    void addPlan(MethodResult& result) const {
        const bool batches = !shaders_.field.batches.empty();
        result.plan.push_back({"prepass", rays_ && settings_.prepass, prepassWords()});
        result.plan.push_back({"prune", rays_ && !shaders_.prune.empty(), pruneWords()});
        result.plan.push_back({"table", batches, tableWords()});
        addClosedForms(scene_, settings_, result.plan);
    }
    std::string prepassWords() const {
        if (!rays_) return "the scene has no field";
        if (!scene_.bound_holds) return kBoundBroken;
        if (!settings_.prepass) return "switched off";
        const FieldCounts& counts = tiles_->counts();
        return fmt::format("cones of {} tiles of 64 rays took {} evaluations; {} tiles are empty",
                           counts.tiles, counts.cone_evaluations, counts.empty_tiles);
    }
    std::string pruneWords() const {
        if (!rays_) return "the scene has no field";
        if (!scene_.bound_holds) return kBoundBroken;
        if (!settings_.prune || input_.options.keeps("empty")) return "switched off";
        if (shaders_.prune.empty())
            return "no fold has so many like children that a loop pays: the shader is straight-line";
        const FieldCounts& counts = tiles_->counts();
        const double lists = static_cast<double>(std::max<std::uint64_t>(counts.lists, 1));
        return fmt::format("of {} like children {:.1f} count in a segment of a tile's depth, by {} lists",
                           shaders_.field.rows(),
                           static_cast<double>(counts.list_rows) / lists *
                               static_cast<double>(shaders_.field.batches.size()),
                           counts.lists);
    }
    std::string tableWords() const {
        const auto& batches = shaders_.field.batches;
        if (batches.empty()) return "no fold has so many like children that a loop pays";
        std::string words;
        for (const sdf::GlslBatch& batch : batches)
            words += fmt::format("{}{}", words.empty() ? "" : ", ", batch.rows);
        return words + " children of folds are loops over a table";
    }

    const MethodInput input_;
    const sdf::TraceSettings settings_;
    const std::optional<sdf::ConeSettings> cones_;
    const sdf::FieldScene& scene_;
    const sdf::Tape tape_;
    const sdf::RayGrid grid_;
    const sdf::SceneTracer closed_;
    const sdf::Shader shader_;
    std::optional<Device> device_;
    FieldShaders shaders_;
    std::optional<FieldTiles> tiles_;
    std::optional<FieldRays> rays_;
    std::size_t most_ = std::size_t{1} << 20;
    FieldSphere around_;
    std::optional<FieldBatches> batches_;
    std::optional<ConeRays> cone_rays_;
    std::optional<ConeBands> cone_bands_;
    double sign_ = 0.0, setup_seconds_ = 0.0, seconds_ = 0.0;
    sdf::RayCounts primary_, secondary_;
};

}  // namespace

std::unique_ptr<FieldTracer> makeVulkanFieldTracer(const MethodInput& input, const FieldSettings& settings) {
    return withDeviceErrors([&]() -> std::unique_ptr<FieldTracer> {
        return std::make_unique<VulkanFieldTracer>(input, settings);
    });
}

}  // namespace edgewise
