// Shading with a memory gives the bits of shading without one.
#include <gtest/gtest.h>

#include <random>

#include "pipeline/project.h"
#include "pipeline/shade.h"
#include "tests/pipeline/shipped_picture.h"

namespace edgewise {
namespace {

/// Neighbouring samples of the same few triangles, as a tile's pixels ask, and now and then another triangle.
class ShadeMemo : public testing::TestWithParam<std::string> {};

TEST_P(ShadeMemo, ChangesNoBit) {
    const unsigned seed = 4711;
    std::mt19937 random(seed);
    const test::ShippedPicture picture = test::shippedPicture(GetParam(), 64);
    ScreenPieces pieces;
    Progress progress;
    const ScreenScene screen = project(picture.scene, picture.camera, picture.film, pieces, progress);
    ASSERT_FALSE(screen.triangles.empty());
    const Shading shading(picture.scene, picture.camera, picture.film, screen, pieces);
    Shading::Memo memo;
    std::uniform_int_distribution<std::size_t> any(0, screen.triangles.size() - 1);
    std::uniform_real_distribution<double> near(-3.0, 3.0);
    std::vector<std::size_t> few(12);
    for (int round = 0; round < 400; ++round) {
        few[static_cast<std::size_t>(round) % few.size()] = any(random);
        for (const std::size_t i : few) {
            const ScreenTriangle& t = screen.triangles[i];
            const glm::dvec2 middle = (t.p_px[0] + t.p_px[1] + t.p_px[2]) / 3.0;
            const glm::dvec2 sample = glm::floor(middle + glm::dvec2(near(random), near(random))) + 0.5;
            const Shade with = shading.closest(t.owner, sample, memo),
                        without = shading.closest(t.owner, sample);
            ASSERT_EQ(with.color, without.color) << "seed " << seed << " triangle " << t.owner;
            ASSERT_EQ(with.alpha, without.alpha);
            const auto texel = shading.ofOneTexel(t.owner);
            ASSERT_TRUE(!texel || *texel == without);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShadeMemo,
                         testing::Values("zone-plate", "log-grid", "torus-20k", "torus-sequence",
                                         "random-2k"),
                         [](const auto& p) { return test::testName(p.param); });

}  // namespace
}  // namespace edgewise
