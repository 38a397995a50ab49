// Shading in groups gives the bits of shading one sample, with every instruction set.
#include "pipeline/shade_groups.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/pipeline/shaded_picture.h"

namespace edgewise {
namespace {

struct Asked {
    Owner owner;
    glm::dvec2 sample_px;
};

/// As a tile asks: samples in and around triangles, some triangles often, others once.
std::vector<Asked> someSamples(const ScreenScene& screen, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<std::size_t> any(0, screen.triangles.size() - 1);
    std::uniform_int_distribution<int> times(1, 20);
    std::vector<Asked> asked;
    while (asked.size() < 2000) {
        const ScreenTriangle& t = screen.triangles[any(random)];
        for (int i = times(random); i > 0; --i) asked.push_back({t.owner, test::sampleNear(t, random)});
    }
    std::shuffle(asked.begin(), asked.end(), random);
    return asked;
}

class ShadeGroups : public testing::TestWithParam<std::string> {};

TEST_P(ShadeGroups, GivesTheBitsOfOneSampleWithEveryInstructionSet) {
    const unsigned seed = 2718;
    const test::ShadedPicture shaded(GetParam());
    const Shading& shading = shaded.shading;
    const std::vector<Asked> asked = someSamples(shaded.screen, seed);
    int sets = 0;
    for (const char* set : {"scalar", "sse2", "avx2", "avx512"}) {
        if (!surfaceFunctionsFor(set).shade) continue;
        ++sets;
        setenv("EDGEWISE_ISA", set, 1);
        Shading::Groups groups;
        unsetenv("EDGEWISE_ISA");
        for (int round = 0; round < 2; ++round) {  // nothing stays from the tile before
            groups.begin(asked.size());
            for (std::uint32_t i = 0; i < asked.size(); ++i)
                groups.add(asked[i].owner, asked[i].sample_px, i);
            std::vector<Shade> shades(asked.size(), Shade{glm::dvec3(-1.0), 0.25});
            groups.finish(shading, shades);
            for (std::size_t i = 0; i < asked.size(); ++i) {
                const Shade one = shading.closest(asked[i].owner, asked[i].sample_px);
                ASSERT_EQ(shades[i].color, one.color)
                    << set << " seed " << seed << " triangle " << asked[i].owner;
                ASSERT_EQ(shades[i].alpha, 0.25);
            }
        }
    }
    EXPECT_GE(sets, 2);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShadeGroups, test::shadedScenes(),
                         [](const auto& p) { return test::testName(p.param); });

}  // namespace
}  // namespace edgewise
