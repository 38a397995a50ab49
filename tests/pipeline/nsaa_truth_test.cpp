// The whole claim: every owner's weight at a pixel, against the independent
// judge, for all scenes and all filters.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "tests/witness/product_weights.h"
#include "tests/witness/random_scenes.h"
#include "tests/witness/scanline_quadrature.h"

namespace edgewise {
namespace {

using witness::ProductWeights;
using witness::RandomScene;
using witness::Real;
using witness::SceneKind;

constexpr std::uint64_t kSeeds = 3;
constexpr int kStarEdges = 60;
constexpr FixedWeight kOne = FixedWeight{1} << kWeightBits;
/// Roundings of one term, in units of 2^-53: ten in the closed form, each on a
/// value below 1.
constexpr double kTermRoundings = 10;

Real toReal(FixedWeight w) {
    return Real(w) * 0x1p-60L;
}

using Case = std::tuple<SceneKind, Prefilter>;
class NsaaTruth : public testing::TestWithParam<Case> {
  protected:
    SceneKind kind() const { return std::get<0>(GetParam()); }
    const Prefilter& filter() const { return std::get<1>(GetParam()); }
};

ProductWeights weightsAt(const ScreenScene& scene, const Prefilter& filter, glm::ivec2 pixel) {
    const Window window = witness::windowAround(glm::dvec2(pixel) + 0.5, filter.radius);
    return witness::productWeights(visibleMap(scene, window), filter, pixel);
}

std::map<Owner, FixedWeight> byOwner(const ProductWeights& product) {
    std::map<Owner, FixedWeight> weights;
    for (const OwnerWeight& w : product.weights) weights[w.owner] += w.weight;
    return weights;
}

FixedWeight sumOf(const ProductWeights& product) {
    FixedWeight sum = 0;
    for (const OwnerWeight& w : product.weights) sum += w.weight;
    return sum;
}

TEST_P(NsaaTruth, WeightsAreTheIntegrals) {
    const witness::ScanlineQuadrature judge(witness::kernelLike(filter()));
    Real worst = 0, worst_of_bound = 0, worst_estimate = 0;
    std::uint64_t terms = 0;
    std::size_t owners = 0;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        const RandomScene random = witness::makeRandomScene(kind(), seed, kStarEdges);
        for (glm::ivec2 pixel : {random.pixels[0], random.pixels[1]}) {
            const ProductWeights product = weightsAt(random.scene, filter(), pixel);
            const witness::Judgement truth = judge.judge(random.scene, glm::dvec2(pixel) + 0.5);
            const auto weights = byOwner(product);
            const Real bound = truth.error + Real(product.terms + 1) * (kTermRoundings * 0x1p-53L + 0x1p-60L);
            std::set<Owner> all;
            for (const auto& [owner, w] : truth.weight) all.insert(owner);
            for (const auto& [owner, w] : weights) all.insert(owner);
            for (Owner owner : all) {
                const auto found = weights.find(owner);
                const Real ours = found == weights.end() ? 0 : toReal(found->second);
                const Real error = std::fabs(ours - truth.of(owner));
                EXPECT_LE(error, bound)
                    << "seed " << seed << " pixel " << pixel.x << "," << pixel.y << " owner " << owner;
                EXPECT_LE(error, 1e-12L) << "the target; seed " << seed;
                worst = std::max(worst, error);
                worst_of_bound = std::max(worst_of_bound, error / bound);
                owners += truth.of(owner) != 0;
            }
            EXPECT_EQ(sumOf(product), kOne) << "seed " << seed;
            EXPECT_EQ(product.label_conflicts, 0u) << "seed " << seed;
            worst_estimate = std::max(worst_estimate, truth.error);
            terms += product.terms;
        }
    }
    fmt::print(
        "worst {:.1e} ({:.2f} of its bound), judge's estimate {:.1e}, {} "
        "owners, {} terms\n",
        double(worst), double(worst_of_bound), double(worst_estimate), owners, terms);
}

ScreenScene moved(ScreenScene scene, glm::dvec2 by_px) {
    scene.anchor_px += by_px;
    for (ScreenTriangle& t : scene.triangles)
        for (glm::dvec2& p : t.p_px) p += by_px;
    return scene;
}

TEST_P(NsaaTruth, WholePixelsMoveNoBit) {
    if (kind() == SceneKind::kHuge) GTEST_SKIP() << "corners would leave the guard band";
    const glm::ivec2 by(37, -3);
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        const RandomScene random = witness::makeRandomScene(kind(), seed, kStarEdges);
        const glm::ivec2 pixel = random.pixels[0];
        const auto here = byOwner(weightsAt(random.scene, filter(), pixel));
        const auto there = byOwner(weightsAt(moved(random.scene, by), filter(), pixel + by));
        EXPECT_EQ(here, there) << "seed " << seed;
    }
}

/// Each triangle cut in three at a grid point inside, owners and planes kept.
ScreenScene split(const ScreenScene& scene) {
    ScreenScene result = scene;
    result.triangles.clear();
    std::uint32_t next_vertex = 0;
    for (const ScreenTriangle& t : scene.triangles)
        next_vertex = std::max({next_vertex, t.vertex[0] + 1, t.vertex[1] + 1, t.vertex[2] + 1});
    for (const ScreenTriangle& t : scene.triangles) {
        const glm::dvec2 inside = {
            std::nearbyint((t.p_px[0].x + t.p_px[1].x + t.p_px[2].x) / 3 / kGridPx) * kGridPx,
            std::nearbyint((t.p_px[0].y + t.p_px[1].y + t.p_px[2].y) / 3 / kGridPx) * kGridPx};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t n = (k + 1) % 3;
            ScreenTriangle part = t;
            part.p_px = {t.p_px[k], t.p_px[n], inside};
            part.vertex = {t.vertex[k], t.vertex[n], next_vertex};
            const glm::dvec2 u = part.p_px[1] - part.p_px[0], v = part.p_px[2] - part.p_px[0];
            if (u.x * v.y - u.y * v.x <= 1e-9) return scene;  // too thin to split without leaving it
            result.triangles.push_back(part);
        }
        ++next_vertex;
    }
    return result;
}

TEST_P(NsaaTruth, SplittingFlatTrianglesChangesNothing) {
    std::size_t compared = 0;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        const RandomScene random = witness::makeRandomScene(kind(), seed, kStarEdges);
        const ScreenScene parts = split(random.scene);
        if (parts.triangles.size() == random.scene.triangles.size()) continue;
        const ProductWeights whole = weightsAt(random.scene, filter(), random.centre);
        const ProductWeights pieces = weightsAt(parts, filter(), random.centre);
        const Real bound = Real(whole.terms + pieces.terms + 2) * (kTermRoundings * 0x1p-53L + 0x1p-60L);
        auto difference = byOwner(whole);
        for (const auto& [owner, w] : byOwner(pieces)) difference[owner] -= w;
        for (const auto& [owner, w] : difference)
            EXPECT_LE(std::fabs(toReal(w)), bound) << "seed " << seed << " owner " << owner;
        ++compared;
    }
    const bool thin =
        kind() == SceneKind::kSlivers || kind() == SceneKind::kTiny || kind() == SceneKind::kMixed;
    EXPECT_TRUE(compared > 0 || thin);
}

INSTANTIATE_TEST_SUITE_P(Pipeline, NsaaTruth,
                         testing::Combine(testing::ValuesIn(witness::allSceneKinds()),
                                          testing::ValuesIn(witness::allPrefilters())),
                         [](const auto& one) {
                             std::string name = nameOf(std::get<0>(one.param)) + "_";
                             for (char c : std::get<1>(one.param).name)
                                 name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                             return name;
                         });

}  // namespace
}  // namespace edgewise
