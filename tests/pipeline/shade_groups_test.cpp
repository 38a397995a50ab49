// Shading in groups gives the bits of shading one sample, with every instruction set.
#include "pipeline/shade_groups.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "pipeline/project.h"
#include "tests/pipeline/shipped_picture.h"

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
    std::uniform_real_distribution<double> near(-3.0, 3.0);
    std::uniform_int_distribution<int> times(1, 20);
    std::vector<Asked> asked;
    while (asked.size() < 2000) {
        const ScreenTriangle& t = screen.triangles[any(random)];
        const glm::dvec2 middle = (t.p_px[0] + t.p_px[1] + t.p_px[2]) / 3.0;
        for (int i = times(random); i > 0; --i)
            asked.push_back({t.owner, glm::floor(middle + glm::dvec2(near(random), near(random))) + 0.5});
    }
    std::shuffle(asked.begin(), asked.end(), random);
    return asked;
}

class ShadeGroups : public testing::TestWithParam<std::string> {};

TEST_P(ShadeGroups, GivesTheBitsOfOneSampleWithEveryInstructionSet) {
    const unsigned seed = 2718;
    const test::ShippedPicture picture = test::shippedPicture(GetParam(), 64);
    ScreenPieces pieces;
    Progress progress;
    const ScreenScene screen = project(picture.scene, picture.camera, picture.film, pieces, progress);
    ASSERT_FALSE(screen.triangles.empty());
    const Shading shading(picture.scene, picture.camera, picture.film, screen, pieces);
    const std::vector<Asked> asked = someSamples(screen, seed);
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

INSTANTIATE_TEST_SUITE_P(Scenes, ShadeGroups,
                         testing::Values("zone-plate", "log-grid", "torus-20k", "torus-sequence",
                                         "random-2k"),
                         [](const auto& p) { return test::testName(p.param); });

}  // namespace
}  // namespace edgewise
