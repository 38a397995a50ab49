#include "pipeline/methods/cone_tracer.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>

#include "pipeline/field_rays.h"
#include "pipeline/methods/over_device.h"
#include "pipeline/methods/stopwatch.h"
#include "sdf/field_of_all.h"

namespace edgewise {
namespace {

constexpr std::size_t kTile = 8;
/// Samples whose groups are held at once.
constexpr std::size_t kSamplesAtOnce = std::size_t{1} << 17;

class ConeTracer : public OverDevice {
  public:
    ConeTracer(const MethodInput& in, const FieldSettings& settings, std::unique_ptr<FieldTracer> device)
        : OverDevice(std::move(device)),
          settings_(*settings.cones),
          grid_(rayGrid(in.camera, in.film, 1.0)),
          background_(in.options.background, 0.0) {}

    /// By parts that end at multiples of 64 rows, where tiles do.
    FieldSamples trace(const FieldWindow& window) override {
        FieldSamples out = FieldSamples::sized(window.samples());
        out.mixed.resize(window.samples());
        const std::size_t row = window.stride() * static_cast<std::size_t>(window.per_side);
        const int rows = static_cast<int>(std::max<std::size_t>(kSamplesAtOnce / row / 64, 1)) * 64;
        for (int y = window.pixels.y0; y < window.pixels.y1;) {
            const int end = std::min((y + rows) & ~63, window.pixels.y1);
            tracePart(window, y, end, out);
            y = end;
        }
        return out;
    }
    void report(MethodResult& result) const override {
        device_->report(result);
        result.stages.insert(result.stages.end(), stages_.begin(), stages_.end());
        result.counts["groups"] = groups_, result.counts["groups_seen"] = seen_;
        result.counts["pixels_mixed"] = mixed_;
    }

  private:
    /// Groups of which something is seen, and their bits.
    struct Seen {
        std::vector<std::uint32_t> bits;  ///< by group
        std::vector<std::uint32_t> group;
        std::vector<sdf::TravellingRay> rays;
        std::vector<sdf::SurfaceHit> surfaces;
    };

    void tracePart(const FieldWindow& window, int y0, int y1, FieldSamples& out) {
        FieldWindow part = window;
        part.pixels.y0 = y0, part.pixels.y1 = y1;
        const std::size_t before =
            static_cast<std::size_t>(y0 - window.pixels.y0) * window.per_side * window.stride();
        if (!part.positions_px.empty())
            part.positions_px.assign(
                window.positions_px.begin() + static_cast<std::ptrdiff_t>(before),
                window.positions_px.begin() + static_cast<std::ptrdiff_t>(before + part.samples()));
        const FieldCones cones = device_->traceCones(part);
        watch_.lap();
        Seen seen = seenOf(cones, part.stride());
        watch_.book("masks", stages_);
        const std::vector<glm::dvec4> by_group = settings_.shade_at_once ? cones.colors : shaded(cones, seen);
        watch_.lap();
        tbb::parallel_for(std::size_t(0), cones.samples(),
                          [&](std::size_t i) { blend(cones, seen.bits, by_group, i, before + i, out); });
        groups_ += cones.groups.size(), seen_ += seen.group.size();
        for (std::size_t i = 0; i < cones.samples(); ++i) mixed_ += out.mixed[before + i];
        watch_.book("blend", stages_);
    }

    /// Of all groups; of unseen ones nothing.
    std::vector<glm::dvec4> shaded(const FieldCones& cones, Seen& seen) {
        const std::vector<glm::dvec4> colors = device_->shade(seen.rays, seen.surfaces);
        std::vector<glm::dvec4> by_group(cones.groups.size());
        for (std::size_t i = 0; i < seen.group.size(); ++i) by_group[seen.group[i]] = colors[i];
        return by_group;
    }

    Seen seenOf(const FieldCones& cones, std::size_t stride) const {
        Seen seen;
        seen.bits.resize(cones.groups.size());
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cones.samples(), 256), [&](const auto& part) {
            for (std::size_t i = part.begin(); i != part.end(); ++i) maskSample(cones, i, seen.bits);
        });
        const std::vector<std::uint32_t> samples = addInOrder(cones, stride, seen);
        seen.rays.resize(seen.group.size()), seen.surfaces.resize(seen.group.size());
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, seen.group.size(), 256), [&](const auto& part) {
            for (std::size_t k = part.begin(); k != part.end(); ++k) {
                seen.rays[k] = cones.rays[samples[k]];
                seen.surfaces[k] = cones.surfaces[seen.group[k]];
            }
        });
        return seen;
    }

    /// The first group that is seen of each sample, tile by tile, then the second of those that have more:
    /// devices trace what goes on from neighbours together. Gives their samples.
    static std::vector<std::uint32_t> addInOrder(const FieldCones& cones, std::size_t stride, Seen& seen) {
        std::vector<std::vector<std::uint32_t>> samples(1), groups(1);
        const auto addSample = [&](std::size_t i) {
            std::size_t rank = 0;
            for (std::uint32_t g = cones.begin[i]; g < cones.begin[i + 1]; ++g) {
                if (seen.bits[g] == 0) continue;
                if (rank == groups.size()) groups.emplace_back(), samples.emplace_back();
                samples[rank].push_back(static_cast<std::uint32_t>(i)), groups[rank].push_back(g);
                ++rank;
            }
        };
        forTiles(cones.samples(), stride, addSample);
        for (std::size_t rank = 1; rank < groups.size(); ++rank) {
            groups[0].insert(groups[0].end(), groups[rank].begin(), groups[rank].end());
            samples[0].insert(samples[0].end(), samples[rank].begin(), samples[rank].end());
        }
        seen.group = std::move(groups[0]);
        return std::move(samples[0]);
    }

    /// Samples of 8 x 8 neighbours one after the other.
    template <class Work>
    static void forTiles(std::size_t samples, std::size_t stride, const Work& work) {
        const std::size_t rows = samples / stride;
        for (std::size_t y = 0; y < rows; y += kTile)
            for (std::size_t x = 0; x < stride; x += kTile)
                for (std::size_t row = y; row < std::min(y + kTile, rows); ++row)
                    for (std::size_t column = x; column < std::min(x + kTile, stride); ++column)
                        work(row * stride + column);
    }

    void maskSample(const FieldCones& cones, std::size_t i, std::vector<std::uint32_t>& bits) const {
        const std::uint32_t first = cones.begin[i], last = cones.begin[i + 1];
        if (first == last) return;
        // Most samples are filled by their only group, whose normal does not matter.
        if (sdf::fillsMask(cones.groups[first], settings_)) return void(bits[first] = ~0u);
        sdf::ConeBlend blend(settings_);
        const glm::dvec3& ahead = cones.rays[i].ray.direction_world;
        const glm::dvec3 right =
            glm::normalize(grid_.right_world - ahead * glm::dot(grid_.right_world, ahead));
        const glm::dvec3 down = glm::normalize(grid_.down_world - ahead * glm::dot(grid_.down_world, ahead));
        for (std::uint32_t g = first; g < last && blend.open(); ++g) {
            const glm::dvec3& normal = cones.surfaces[g].normal_world;
            bits[g] = blend.uncovered(sdf::groupMask(cones.groups[g], normal, right, down, settings_));
            blend.add(bits[g], glm::dvec4(0.0));
        }
    }

    void blend(const FieldCones& cones, const std::vector<std::uint32_t>& bits,
               const std::vector<glm::dvec4>& colors, std::size_t i, std::size_t to,
               FieldSamples& out) const {
        sdf::ConeBlend blend(settings_);
        int colours = 0;
        for (std::uint32_t g = cones.begin[i]; g < cones.begin[i + 1]; ++g) {
            if (bits[g] == 0) continue;
            blend.add(bits[g], colors[g]);
            ++colours;
        }
        out.color[to] = blend.over(background_);
        out.mixed[to] = colours + (blend.skyShows() ? 1 : 0) > 1;
        out.evaluations[to] = out.iterations[to] = cones.evaluations[i];
        takeCentre(cones, i, to, out);
    }

    /// Where the ray itself meets a surface.
    static void takeCentre(const FieldCones& cones, std::size_t i, std::size_t to, FieldSamples& out) {
        for (std::uint32_t g = cones.begin[i]; g < cones.begin[i + 1]; ++g) {
            if (!cones.groups[g].hard) continue;
            out.take(to, cones.rays[i].ray, cones.surfaces[g]);
            return;
        }
    }

    const sdf::ConeSettings settings_;
    const sdf::RayGrid grid_;
    const glm::dvec4 background_;
    Stopwatch watch_;
    std::vector<StageTime> stages_;
    std::uint64_t groups_ = 0, seen_ = 0, mixed_ = 0;
};

}  // namespace

FieldTracerMaker coneTracerMaker(const FieldTracerMaker& make) {
    return [make](const MethodInput& in, const FieldSettings& settings) -> std::unique_ptr<FieldTracer> {
        return std::make_unique<ConeTracer>(in, settings, make(in, settings));
    };
}

Scene sceneOfCones(const MethodInput& input) {
    Scene scene = input.scene;
    const glm::dvec3 eye(glm::inverse(input.camera.camera_from_world)[3]);
    scene.field = std::make_shared<const sdf::FieldScene>(sdf::fieldOfAll(*scene.field, eye));
    return scene;
}

}  // namespace edgewise
