#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "pipeline/field_shading.h"
#include "pipeline/methods/lottes.h"
#include "pipeline/methods/stopwatch.h"
#include "pipeline/sobol.h"
#include "sdf/shading_text.h"

namespace edgewise {
namespace {

constexpr int kMostSteps = 1024;

/// The reach of the 11 rays to either side of a row's middle, by row from the one above.
constexpr int kRowReach[3] = {1, 2, 1};

}  // namespace

/// In units of 2^-64, which wrap around by themselves: 1/g = 0.7548776662466927..., 1/g^2 =
/// 0.5698402909980532...
glm::dvec2 lottesJitter(int x, int y, std::uint64_t frame, std::uint64_t seed) {
    constexpr std::uint64_t kFirst = 0xc13fa9a902a6328fu, kSecond = 0x91e10da5c79e7b1cu;
    const std::uint64_t pixel =
        (std::uint64_t(static_cast<std::uint32_t>(y)) << 32) | static_cast<std::uint32_t>(x);
    const std::uint64_t start = mixed(mixed(seed) ^ mixed(pixel));
    const std::uint64_t u = start + frame * kFirst, v = mixed(start) + frame * kSecond;
    return glm::dvec2(u >> 32, v >> 32) * 0x1p-32;
}

LottesFrames::LottesFrames(const MethodInput& in, const LottesSettings& settings)
    : in_(in),
      settings_(settings),
      scene_(*in.scene.field),
      tape_(loweredTree(scene_)),
      surfaces_(scene_, tape_, {}),
      shader_(fieldShading(in, {}, false), surfaces_),
      grid_(rayGrid(in.camera, in.film, scene_.far)) {}

PixelBox LottesFrames::window() const {
    const PixelBox& crop = in_.film.crop;
    return {crop.x0 - 2, crop.y0 - 1, crop.x1 + 2, crop.y1 + 1};
}

LottesRay LottesFrames::rayOf(int x, int y, std::uint64_t frame, sdf::RayCounts& counts) const {
    LottesRay out;
    out.p_px = glm::dvec2(x, y) + lottesJitter(x, y, frame, in_.options.seed);
    const sdf::FieldRay ray = grid_.ray(out.p_px);
    const sdf::CoverageHit hit = coverageAlong(scene_, tape_, surfaces_, ray, settings_.distance, kMostSteps);
    ++counts.primary;
    counts.evaluations += hit.surface.evaluations;
    out.color = shader_.shade(ray, hit.surface, counts, hit.sign);
    if (settings_.coverage) out.coverage = hit.coverage;
    return out;
}

std::vector<LottesRay> LottesFrames::trace(std::uint64_t frame, sdf::RayCounts& counts) const {
    const PixelBox box = window();
    std::vector<LottesRay> rays(static_cast<std::size_t>(box.width()) * box.height());
    tbb::enumerable_thread_specific<sdf::RayCounts> parts;
    tbb::parallel_for(box.y0, box.y1, [&](int y) {
        checkCancelled(in_.progress);
        LottesRay* row = rays.data() + static_cast<std::size_t>(y - box.y0) * box.width();
        for (int x = box.x0; x < box.x1; ++x) row[x - box.x0] = rayOf(x, y, frame, parts.local());
    });
    for (const sdf::RayCounts& part : parts) counts += part;
    return rays;
}

template <class Visit>
void LottesFrames::forRays(const std::vector<LottesRay>& rays, int x, int y, const Visit& visit) const {
    const PixelBox box = window();
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -kRowReach[dy + 1]; dx <= kRowReach[dy + 1]; ++dx)
            visit(rays[static_cast<std::size_t>(y + dy - box.y0) * box.width() + (x + dx - box.x0)]);
}

double LottesFrames::f(const LottesRay& ray, int x, int y) const {
    const glm::dvec2 way = ray.p_px - (glm::dvec2(x, y) + 0.5);
    return settings_.disk ? sdf::shading::diskWeight(dot(way, way), settings_.scale)
                          : sdf::shading::gaussianWeight(dot(way, way), settings_.scale);
}

glm::dvec4 LottesFrames::pixel(const std::vector<LottesRay>& rays, int x, int y) const {
    glm::dvec4 covered(0.0), all(0.0);
    double covered_sum = 0.0, all_sum = 0.0;
    forRays(rays, x, y, [&](const LottesRay& ray) {
        const double weight = f(ray, x, y);
        all += weight * ray.color, all_sum += weight;
        covered += weight * ray.coverage * ray.color, covered_sum += weight * ray.coverage;
    });
    // Below this the quotient has no digits left to trust.
    if (covered_sum > 1e-12) return covered / covered_sum;
    const PixelBox box = window();
    return all_sum > 1e-12 ? all / all_sum
                           : rays[static_cast<std::size_t>(y - box.y0) * box.width() + (x - box.x0)].color;
}

void LottesFrames::spread(const std::vector<LottesRay>& rays, std::vector<ColorSpread>& spreads) const {
    const PixelBox& crop = in_.film.crop;
    tbb::parallel_for(crop.y0, crop.y1, [&](int y) {
        for (int x = crop.x0; x < crop.x1; ++x) {
            ColorSpread& here = spreads[static_cast<std::size_t>(y - crop.y0) * crop.width() + (x - crop.x0)];
            forRays(rays, x, y, [&](const LottesRay& ray) {
                if (f(ray, x, y) * ray.coverage > 0.0) here.add(ray.color);
            });
        }
    });
}

std::vector<glm::dvec4> LottesFrames::reconstruct(const std::vector<LottesRay>& rays,
                                                  std::uint64_t frame) const {
    const PixelBox& crop = in_.film.crop;
    std::vector<glm::dvec4> pixels(static_cast<std::size_t>(crop.width()) * crop.height());
    tbb::parallel_for(crop.y0, crop.y1, [&](int y) {
        for (int x = crop.x0; x < crop.x1; ++x) {
            const double grain = settings_.grain > 0.0 ? settings_.grain * grainAt(settings_.spectrum, x, y,
                                                                                   frame, in_.options.seed)
                                                       : 0.0;
            pixels[static_cast<std::size_t>(y - crop.y0) * crop.width() + (x - crop.x0)] =
                pixel(rays, x, y) + glm::dvec4(glm::dvec3(grain), 0.0);
        }
    });
    return pixels;
}

}  // namespace edgewise
