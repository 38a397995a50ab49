// The oracle against the product and against the other witness: three that share no formula.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "analytic/exact/kernel_weights.h"
#include "tests/witness/product_weights.h"
#include "tests/witness/random_scenes.h"
#include "tests/witness/scanline_quadrature.h"

namespace edgewise {
namespace {

using witness::RandomScene;
using witness::SceneKind;

constexpr std::uint64_t kSeeds = 2;
constexpr int kStarEdges = 24;
/// As in nsaa_truth_test: roundings of one term, in units of 2^-53.
constexpr double kTermRoundings = 10;

exact::Region regionAround(glm::ivec2 pixel, double reach) {
    return {pixel.x + 0.5 - reach, pixel.y + 0.5 - reach, pixel.x + 0.5 + reach, pixel.y + 0.5 + reach};
}

class ExactTruth : public testing::TestWithParam<SceneKind> {};

TEST_P(ExactTruth, WeightsOfEveryKernelAgree) {
    double worst = 0.0, worst_error = 0.0;
    std::size_t owners = 0, tied = 0;
    for (const Prefilter& filter : witness::allPrefilters()) {
        const exact::KernelWeights kernel(filter);
        for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
            const RandomScene random = witness::makeRandomScene(GetParam(), seed, kStarEdges);
            const glm::ivec2 pixel = random.centre;
            const exact::Point sample{exact::Rational(pixel.x + 0.5), exact::Rational(pixel.y + 0.5)};
            std::map<Owner, exact::Weight> truth;
            exact::Real rest = 1;
            for (const exact::Face& face :
                 exact::visibleFaces(random.scene, regionAround(pixel, filter.radius))) {
                const exact::Weight w = kernel.of(face, sample);
                truth[face.owner].value += w.value, truth[face.owner].error += w.error;
                rest -= w.value;
                tied += face.tied.size() > 1;
                worst_error = std::max(worst_error, double(w.error));
            }
            truth[kBackground].value = rest;
            const VisibleMap map =
                visibleMap(random.scene, witness::windowAround(glm::dvec2(pixel) + 0.5, filter.radius));
            const auto product = witness::productWeights(map, filter, pixel);
            for (const OwnerWeight& w : product.weights)
                truth[w.owner].value -= exact::Real(w.weight) / std::pow(2.0, 60);
            const double bound = double(product.terms + 1) * (kTermRoundings * 0x1p-53 + 0x1p-60);
            for (const auto& [owner, off] : truth) {
                EXPECT_LE(std::fabs(double(off.value)), bound)
                    << filter.name << " seed " << seed << " owner " << owner;
                worst = std::max(worst, std::fabs(double(off.value)));
                ++owners;
            }
        }
    }
    fmt::print(
        "{} owners, {} faces of several surfaces, worst difference {:.1e}, oracle's own error {:.1e}\n",
        owners, tied, worst, worst_error);
    EXPECT_LT(worst_error, 1e-30);
    EXPECT_GT(owners, 40u);
    if (GetParam() == SceneKind::kCoplanarDuplicates) {
        EXPECT_GT(tied, 0u);
    }
}

INSTANTIATE_TEST_SUITE_P(Exact, ExactTruth, testing::ValuesIn(witness::allSceneKinds()),
                         [](const auto& one) { return nameOf(one.param); });

}  // namespace
}  // namespace edgewise
