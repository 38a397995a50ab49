#include "paper_figures/lottes_study.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "paper_figures/cone_view.h"
#include "pipeline/error.h"
#include "pipeline/judge/metrics.h"
#include "pipeline/methods/temporal_mean.h"
#include "sdf/shading_text.h"

namespace edgewise::figures {
namespace {

/// The reach of the 11 rays to either side of a row's middle.
constexpr int kRowReach[3]{1, 2, 1};

ImageBuffer imageOf(const PixelBox& box, std::span<const glm::dvec4> pixels) {
    ImageBuffer image(box);
    std::copy(pixels.begin(), pixels.end(), image.rgba.begin());
    return image;
}

ImageBuffer imageOf(const PixelBox& box, const TemporalMean& mean) {
    ImageBuffer image(box);
    for (std::size_t i = 0; i < image.rgba.size(); ++i) image.rgba[i] = mean.mean(i);
    return image;
}

class Study {
  public:
    Study(const LottesEffort& effort, Progress& progress)
        : progress_(progress), view_(effort.scene, effort.width, effort.height) {
        out_.effort = effort;
        out_.settings.grain = effort.grain;
    }

    LottesStudy made() {
        progress_.stage("lottes", 2 * static_cast<std::size_t>(out_.effort.frames) + 2);
        out_.reference = view_.made(fmt::format("ssaa:{}", out_.effort.reference_side), inner_).image;
        progress_.advance(1);
        out_.none = view_.made("none", inner_).image;
        progress_.advance(1);
        out_.none_rmse = judge::compareImages(out_.none, out_.reference).rmse;
        runFrames();
        LottesSettings without = out_.settings;
        without.coverage = false;
        out_.mean_without_coverage = meanOf(without);
        out_.rmse_without_coverage = judge::compareImages(out_.mean_without_coverage, out_.reference).rmse;
        return std::move(out_);
    }

  private:
    void runFrames() {
        const MethodInput in = view_.input(inner_);
        const LottesFrames lottes(in, out_.settings);
        TemporalMean mean;
        sdf::RayCounts counts;
        for (int frame = 0; frame < out_.effort.frames; ++frame) {
            stopIfCancelled();
            const std::vector<LottesRay> rays = lottes.trace(frame, counts);
            const std::vector<glm::dvec4> pixels = lottes.reconstruct(rays, frame);
            mean.add(pixels);
            if (frame < out_.effort.shown) out_.frames.push_back(imageOf(in.film.crop, pixels));
            if (frame == 0) pickPixel(lottes, rays);
            if (((frame + 1) & frame) == 0) addPoint(mean, in.film.crop);
            progress_.advance(1);
        }
        out_.deviation = mean.deviation();
        out_.mean = imageOf(in.film.crop, mean);
    }

    void addPoint(const TemporalMean& mean, const PixelBox& box) {
        out_.points.push_back({static_cast<int>(mean.frames()), mean.deviationOfMean(),
                               judge::compareImages(imageOf(box, mean), out_.reference).rmse});
    }

    ImageBuffer meanOf(const LottesSettings& settings) {
        const MethodInput in = view_.input(inner_);
        const LottesFrames lottes(in, settings);
        TemporalMean mean;
        sdf::RayCounts counts;
        for (int frame = 0; frame < out_.effort.frames; ++frame) {
            stopIfCancelled();
            mean.add(lottes.reconstruct(lottes.trace(frame, counts), frame));
            progress_.advance(1);
        }
        return imageOf(in.film.crop, mean);
    }

    void pickPixel(const LottesFrames& lottes, const std::vector<LottesRay>& rays) {
        double most = -1.0;
        const PixelBox& crop = view_.film.crop;
        for (int y = crop.y0; y < crop.y1; ++y)
            for (int x = crop.x0; x < crop.x1; ++x) {
                const std::vector<LottesWeight> those = raysOf(lottes, rays, {x, y});
                glm::dvec3 mean(0.0);
                for (const LottesWeight& w : those) mean += glm::dvec3(w.ray.color) / double(those.size());
                double spread = 0.0;
                for (const LottesWeight& w : those)
                    spread += glm::dot(glm::dvec3(w.ray.color) - mean, glm::dvec3(w.ray.color) - mean);
                if (spread > most) most = spread, out_.pixel = {x, y}, out_.rays = those;
            }
    }

    std::vector<LottesWeight> raysOf(const LottesFrames& lottes, const std::vector<LottesRay>& rays,
                                     glm::ivec2 pixel) const {
        const PixelBox window = lottes.window();
        std::vector<LottesWeight> those;
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -kRowReach[dy + 1]; dx <= kRowReach[dy + 1]; ++dx) {
                const glm::ivec2 at = pixel + glm::ivec2(dx, dy);
                const LottesRay& ray =
                    rays[static_cast<std::size_t>(at.y - window.y0) * window.width() + (at.x - window.x0)];
                const glm::dvec2 way = ray.p_px - (glm::dvec2(pixel) + 0.5);
                those.push_back(
                    {at, ray, sdf::shading::gaussianWeight(glm::dot(way, way), out_.settings.scale)});
            }
        return those;
    }

    void stopIfCancelled() {
        if (progress_.cancelled()) throw Interrupted();
    }

    /// Of the methods inside: they are stopped, and say nothing of their own.
    struct Inner : Progress {
        explicit Inner(Progress& outer_) : outer(outer_) {}
        bool cancelled() override { return outer.cancelled(); }
        Progress& outer;
    };

    Progress& progress_;
    Inner inner_{progress_};
    ConeView view_;
    LottesStudy out_;
};

}  // namespace

LottesStudy studyLottes(const LottesEffort& effort, Progress& progress) {
    return Study(effort, progress).made();
}

}  // namespace edgewise::figures
