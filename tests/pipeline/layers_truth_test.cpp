// Stacks of see-through layers against the independent judge: who lies over whom, and with which weight.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/witness/dice.h"
#include "tests/witness/product_weights.h"
#include "tests/witness/random_scenes.h"
#include "tests/witness/scanline_quadrature.h"

namespace edgewise {
namespace {

using witness::RandomScene;
using witness::Real;
using witness::SceneKind;

constexpr std::uint64_t kSeeds = 4;
constexpr int kStarEdges = 24;
/// As in nsaa_truth_test: roundings of one term, in units of 2^-53.
constexpr double kTermRoundings = 10;

using Layers = std::vector<Owner>;

/// Two of three triangles are see-through, at random.
ScreenScene seenThrough(ScreenScene scene, std::uint64_t seed) {
    witness::Dice dice(seed);
    Owner last = 0;
    for (const ScreenTriangle& t : scene.triangles) last = std::max(last, t.owner);
    scene.see_through.resize(last + 1);
    for (std::uint8_t& through : scene.see_through) through = dice.integer(0, 2) != 0;
    return scene;
}

std::map<Layers, Real> byLayers(const VisibleMap& map, const std::vector<OwnerWeight>& weights) {
    std::map<Layers, Real> out;
    for (const OwnerWeight& w : weights) {
        const auto layers = map.stacks.layersOf(w.owner);
        out[Layers(layers.begin(), layers.end())] += Real(w.weight) * 0x1p-60L;
    }
    return out;
}

std::map<Layers, Real> byLayers(const witness::Judgement& truth) {
    std::map<Layers, Real> out;
    std::map<Owner, Layers> named;
    for (const auto& [layers, name] : truth.stacks) named[name] = layers;
    for (const auto& [owner, weight] : truth.weight)
        out[named.contains(owner) ? named[owner] : Layers{owner}] += weight;
    return out;
}

struct Met {
    std::size_t pixels = 0, stacks = 0, deep = 0, on_background = 0;
    Real worst = 0;
};

class LayersTruth : public testing::TestWithParam<SceneKind> {
  protected:
    void compare(const Prefilter& filter, std::uint64_t seed, Met& met) const {
        const RandomScene random = witness::makeRandomScene(GetParam(), seed, kStarEdges);
        const ScreenScene scene = seenThrough(random.scene, seed);
        const witness::ScanlineQuadrature judge(witness::kernelLike(filter));
        const VisibleMap map =
            visibleMap(scene, witness::windowAround(glm::dvec2(random.centre) + 0.5, filter.radius));
        const auto product = witness::productWeights(map, filter, random.centre);
        const auto truth = judge.judge(scene, glm::dvec2(random.centre) + 0.5);
        FixedWeight sum = 0;
        for (const OwnerWeight& w : product.weights) sum += w.weight;
        EXPECT_EQ(sum, FixedWeight{1} << kWeightBits) << "seed " << seed;
        EXPECT_EQ(product.label_conflicts, 0u) << "seed " << seed;
        const Real bound = truth.error + Real(product.terms + 1) * (kTermRoundings * 0x1p-53L + 0x1p-60L);
        auto difference = byLayers(map, product.weights);
        for (const auto& [layers, weight] : byLayers(truth)) {
            difference[layers] -= weight;
            met.stacks += layers.size() > 1 && weight != 0;
            met.deep += layers.size() > 3 && weight != 0;
            met.on_background += layers.size() > 1 && layers.back() == kBackground && weight != 0;
        }
        for (const auto& [layers, off] : difference) {
            EXPECT_LE(std::fabs(off), bound) << filter.name << " seed " << seed << ", " << layers.size()
                                             << " layers from " << layers.front();
            EXPECT_LE(std::fabs(off), 1e-12L) << "the target; seed " << seed;
            met.worst = std::max(met.worst, std::fabs(off));
        }
        ++met.pixels;
    }
};

TEST_P(LayersTruth, WeightsOfStacksAreTheIntegrals) {
    Met met;
    for (const char* name : {"box", "gaussian", "mitchell"})
        for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) compare(makePrefilter(name, {}, {}), seed, met);
    fmt::print(
        "seeds 1 to {}: {} pixels, {} stacks, {} of more than 3 layers, {} over the background, worst "
        "{:.1e}\n",
        kSeeds, met.pixels, met.stacks, met.deep, met.on_background, double(met.worst));
    EXPECT_GT(met.stacks, 0u);
    const SceneKind kind = GetParam();
    if (kind == SceneKind::kPiercing || kind == SceneKind::kMixed || kind == SceneKind::kNearCoincident) {
        EXPECT_GT(met.deep, 5u);
        EXPECT_GT(met.on_background, 3u);
    }
}

INSTANTIATE_TEST_SUITE_P(Pipeline, LayersTruth, testing::ValuesIn(witness::allSceneKinds()),
                         [](const auto& one) { return nameOf(one.param); });

}  // namespace
}  // namespace edgewise
