// Weights of whole windows of pixels: the box against rationals, the other kernels against 30 digits or more.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "tests/exact/pixel_truth.h"
#include "tests/witness/kernels.h"
#include "tests/witness/product_weights.h"
#include "tests/witness/random_scenes.h"

namespace edgewise {
namespace {

using exact::Rational;
using test::PixelTruth;
using witness::RandomScene;
using witness::SceneKind;

constexpr double kUnit = 0x1p-53;
constexpr double kKernelTarget = 1e-13;

exact::Point sampleOf(glm::ivec2 pixel) {
    return {Rational(pixel.x + 0.5), Rational(pixel.y + 0.5)};
}

/// One scene over a square of pixels around its centre, for kernels up to `radius`.
struct Scene {
    Scene(const RandomScene& random, int reach, double radius)
        : centre(random.centre),
          reach_px(reach),
          map(visibleMap(random.scene, witness::windowAround(glm::dvec2(centre), reach + radius))),
          truth(exact::visibleFaces(random.scene, region(reach + radius))) {}

    exact::Region region(double r) const { return {centre.x - r, centre.y - r, centre.x + r, centre.y + r}; }

    template <class Visit>
    void forPixels(const Visit& visit) const {
        for (int y = centre.y - reach_px; y < centre.y + reach_px; ++y)
            for (int x = centre.x - reach_px; x < centre.x + reach_px; ++x) visit(glm::ivec2(x, y));
    }

    glm::ivec2 centre;
    int reach_px;
    VisibleMap map;
    PixelTruth truth;
};

/// Whether a segment has a point in the closed square; its ends are rounded to double, which moves a touch.
bool meets(const VisibleSegment& s, glm::dvec2 sample, double radius) {
    const glm::dvec2 a = (s.a.grid - sample) + s.a.rest, e = (s.b.grid - s.a.grid) + (s.b.rest - s.a.rest);
    double from = 0, to = 1;
    for (int k = 0; k < 2; ++k) {
        if (e[k] == 0) {
            if (std::abs(a[k]) > radius) return false;
            continue;
        }
        const double t0 = (-radius - a[k]) / e[k], t1 = (radius - a[k]) / e[k];
        from = std::max(from, std::min(t0, t1)), to = std::min(to, std::max(t0, t1));
    }
    return from <= to;
}

/// How many segments of each owner meet the support.
std::map<Owner, std::size_t> segmentsOf(const VisibleMap& map, glm::dvec2 sample, double radius) {
    std::map<Owner, std::size_t> count;
    for (const VisibleSegment& s : map.segments)
        if (meets(s, sample, radius)) ++count[s.left], ++count[s.right];
    return count;
}

class WeightBars : public testing::TestWithParam<SceneKind> {
  protected:
    struct Worst {
        std::size_t pixels = 0, weights = 0, partial = 0;
        double error = 0, of_bound = 0, oracle = 0;
    };

    void boxes(std::uint64_t seeds, int factor, int reach) {
        Worst worst;
        for (std::uint64_t seed = 1; seed <= seeds; ++seed)
            for (const double radius : {0.5, 1.25, 3.0})
                boxes(magnified(makeRandomScene(GetParam(), seed, 60), factor), reach, radius, worst);
        fmt::print(
            "{}, seeds 1 to {}: {} pixels, {} weights, {} in part, worst error {:.1e}, {:.2f} of its bound\n",
            nameOf(GetParam()), seeds, worst.pixels, worst.weights, worst.partial, worst.error,
            worst.of_bound);
        EXPECT_LE(worst.of_bound, 1.0);
        EXPECT_GT(worst.partial, 100u);
    }

    void kernels(const std::vector<Prefilter>& filters, std::uint64_t seed, int factor, int reach) {
        std::string text;
        for (const Prefilter& filter : filters) {
            const Scene scene(magnified(makeRandomScene(GetParam(), seed, 24), factor), reach, filter.radius);
            const Worst worst = kernel(scene, filter);
            text += fmt::format(", {} {:.1e}", filter.name, worst.error);
            EXPECT_LE(worst.error, kKernelTarget) << filter.name;
            EXPECT_LT(worst.oracle, 1e-30) << filter.name;
            EXPECT_EQ(worst.pixels, std::size_t(4 * reach * reach));
            EXPECT_GT(worst.partial, std::size_t(4 * reach)) << filter.name << ": less than two edges across";
        }
        fmt::print("{}, seed {}, {} pixels, worst errors{}\n", nameOf(GetParam()), seed, 4 * reach * reach,
                   text);
    }

  private:
    static Prefilter boxOf(double radius) { return makePrefilter("box", radius, {}); }

    static void boxes(const RandomScene& random, int reach, double radius, Worst& worst) {
        const Prefilter filter = boxOf(radius);
        const Scene scene(random, reach, radius);
        scene.forPixels([&](glm::ivec2 pixel) {
            auto off = scene.truth.boxWeights(sampleOf(pixel), Rational(radius));
            for (const auto& [owner, w] : off) worst.partial += w > 0 && w < 1;
            for (const OwnerWeight& w : witness::productWeights(scene.map, filter, pixel).weights)
                off[w.owner] -= Rational(w.weight) / Rational(0x1p60);
            auto segments = segmentsOf(scene.map, glm::dvec2(pixel) + 0.5, radius);
            for (const auto& [owner, difference] : off) {
                const double error = std::abs(static_cast<double>(difference));
                const double bound = (4.0 * static_cast<double>(segments[owner]) + 2.0) * kUnit;
                worst.error = std::max(worst.error, error);
                worst.of_bound = std::max(worst.of_bound, error / bound);
                ++worst.weights;
            }
            ++worst.pixels;
        });
    }

    static Worst kernel(const Scene& scene, const Prefilter& filter) {
        const exact::KernelWeights exact_kernel(filter);
        Worst worst;
        scene.forPixels([&](glm::ivec2 pixel) {
            auto off = scene.truth.weights(exact_kernel, sampleOf(pixel));
            for (const auto& [owner, w] : off)
                worst.partial += abs(w.value) > 1e-20 && abs(w.value - 1) > 1e-20;
            for (const OwnerWeight& w : witness::productWeights(scene.map, filter, pixel).weights)
                off[w.owner].value -= exact::Real(w.weight) * exact::Real(0x1p-60);
            for (const auto& [owner, w] : off) {
                worst.error = std::max(worst.error, std::abs(static_cast<double>(w.value)));
                worst.oracle = std::max(worst.oracle, static_cast<double>(w.error));
                ++worst.weights;
            }
            ++worst.pixels;
        });
        return worst;
    }
};

TEST_P(WeightBars, BoxesAreTheOraclesRationals) {
    boxes(1, 1, 4);
}

TEST_P(WeightBars, KernelsAreTheOraclesDigits) {
    kernels(
        {makePrefilter("cone", {}, {}), makePrefilter("gaussian", {}, {}), makePrefilter("mitchell", {}, {})},
        3, 1, 1);
}

TEST_P(WeightBars, NightlyBoxes) {
    boxes(10, 4, 16);
}

/// 1024 pixels a scene.
TEST_P(WeightBars, NightlyKernels) {
    auto filters = witness::allPrefilters();
    std::erase_if(filters, [](const Prefilter& filter) { return filter.name == "box"; });
    kernels(filters, 5, 4, 16);
}

INSTANTIATE_TEST_SUITE_P(Exact, WeightBars, testing::ValuesIn(witness::allSceneKinds()),
                         [](const auto& one) { return nameOf(one.param); });

}  // namespace
}  // namespace edgewise
