// Shading with a memory gives the bits of shading without one.
#include <gtest/gtest.h>

#include "tests/pipeline/shaded_picture.h"

namespace edgewise {
namespace {

/// Neighbouring samples of the same few triangles, as a tile's pixels ask, and now and then another triangle.
class ShadeMemo : public testing::TestWithParam<std::string> {};

TEST_P(ShadeMemo, ChangesNoBit) {
    const unsigned seed = 4711;
    std::mt19937 random(seed);
    const test::ShadedPicture shaded(GetParam());
    const Shading& shading = shaded.shading;
    const ScreenScene& screen = shaded.screen;
    Shading::Memo memo;
    std::uniform_int_distribution<std::size_t> any(0, screen.triangles.size() - 1);
    std::vector<std::size_t> few(12);
    for (int round = 0; round < 400; ++round) {
        few[static_cast<std::size_t>(round) % few.size()] = any(random);
        for (const std::size_t i : few) {
            const ScreenTriangle& t = screen.triangles[i];
            const glm::dvec2 sample = test::sampleNear(t, random);
            const Shade with = shading.closest(t.owner, sample, memo),
                        without = shading.closest(t.owner, sample);
            ASSERT_EQ(with.color, without.color) << "seed " << seed << " triangle " << t.owner;
            ASSERT_EQ(with.alpha, without.alpha);
            const auto texel = shading.ofOneTexel(t.owner);
            ASSERT_TRUE(!texel || *texel == without);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShadeMemo, test::shadedScenes(),
                         [](const auto& p) { return test::testName(p.param); });

}  // namespace
}  // namespace edgewise
