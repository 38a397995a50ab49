// "Sphere Tracing AA" (Lottes 2016), frame by frame: for the method and for those that study it.
#pragma once

#include <vector>

#include "pipeline/field_rays.h"
#include "pipeline/grain.h"
#include "pipeline/methods/color_spread.h"
#include "pipeline/methods/method.h"
#include "sdf/coverage_trace.h"
#include "sdf/shader.h"

namespace edgewise {

struct LottesSettings {
    double distance = 0.75;  ///< a ray ends within that many pixel diameters of a surface
    bool disk = false;       ///< F: a disk with a soft rim, else a Gaussian
    double scale = 2.0;      ///< of F: 2^(-scale r^2), r in pixels
    double grain = 0.01;     ///< root mean square, linear, the same in all channels
    GrainSpectrum spectrum = GrainSpectrum::kBlue;
    bool coverage = true;  ///< false: all rays count in full, so that the bias of F alone can be seen
};

struct LottesRay {
    glm::dvec2 p_px{0.0};
    glm::dvec4 color{0.0};  ///< alpha 0: it met nothing
    double coverage = 1.0;
};

/// Where the ray of a pixel lies in `frame`, from the pixel's corner, in [0, 1): the R2 sequence (Roberts
/// 2018: steps of 1/g and 1/g^2, g^3 = g + 1) from a start that is drawn for each pixel and seed.
glm::dvec2 lottesJitter(int x, int y, std::uint64_t frame, std::uint64_t seed);

class LottesFrames {
  public:
    /// The input, with its SDF scene, outlives it.
    LottesFrames(const MethodInput& in, const LottesSettings& settings);
    LottesFrames(const LottesFrames&) = delete;

    /// Rays of the crop and of as much around it as the 11 rays of its pixels take.
    PixelBox window() const;
    std::vector<LottesRay> trace(std::uint64_t frame, sdf::RayCounts& counts) const;
    /// The crop's pixels from the window's rays, with grain: sum(F coverage colour) / sum(F coverage) over
    /// the pixel's own ray and its neighbours', rows of 3, 5 and 3. Where no ray has coverage, F alone weighs
    /// them; where F is 0 too, the pixel's own ray counts.
    std::vector<glm::dvec4> reconstruct(const std::vector<LottesRay>& rays, std::uint64_t frame) const;
    /// Adds to each pixel's spread the colours of those of its 11 rays that have a weight.
    void spread(const std::vector<LottesRay>& rays, std::vector<ColorSpread>& spreads) const;

  private:
    LottesRay rayOf(int x, int y, std::uint64_t frame, sdf::RayCounts& counts) const;
    glm::dvec4 pixel(const std::vector<LottesRay>& rays, int x, int y) const;
    double f(const LottesRay& ray, int x, int y) const;
    /// Of the 11 rays of a pixel: visit(ray).
    template <class Visit>
    void forRays(const std::vector<LottesRay>& rays, int x, int y, const Visit& visit) const;

    const MethodInput& in_;
    LottesSettings settings_;
    const sdf::FieldScene& scene_;
    sdf::Tape tape_;
    sdf::SceneTracer surfaces_;  ///< for rays to lights and beyond mirrors
    sdf::Shader shader_;
    sdf::RayGrid grid_;
};

}  // namespace edgewise
