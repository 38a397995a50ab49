// What is seen through: opacity of triangles, compositing, and whole pictures with panes.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/composite.h"
#include "pipeline/error.h"
#include "pipeline/methods/nsaa.h"
#include "pipeline/opacity.h"
#include "tests/pipeline/test_scene.h"
#include "tests/witness/dice.h"

namespace edgewise {
namespace {

constexpr int kFilmPx = 12;
const glm::dvec3 kBlue(0.25, 0.5, 1.0);

/// A triangle parallel to the film that covers all of it, or with `right` only where x > 0.
test::Corners pane(float depth, bool right = false) {
    const float far = 100.0f * depth, left = right ? 0.0f : -far;
    if (right) return {glm::vec3(0, -far, -depth), glm::vec3(far, 0, -depth), glm::vec3(0, far, -depth)};
    return {glm::vec3(left, -far, -depth), glm::vec3(far, -far, -depth), glm::vec3(0, far, -depth)};
}

/// One node and one material a pane, the later ones nearer.
Scene stackOf(const std::vector<glm::dvec4>& colors, AlphaMode mode = AlphaMode::kBlend) {
    std::vector<Geometry> geometry;
    for (std::size_t i = 0; i < colors.size(); ++i)
        geometry.push_back(test::makeGeometry({pane(float(2 * colors.size() - i))}));
    Scene scene = test::makeScene(std::move(geometry));
    scene.materials.resize(colors.size(), scene.materials[0]);
    for (std::size_t i = 0; i < colors.size(); ++i) {
        scene.materials[i].base_color = colors[i];
        scene.materials[i].alpha_mode = mode;
        scene.geometry[i].material = std::uint32_t(i);
    }
    return scene;
}

struct Picture {
    const Scene& scene;
    RenderOptions options;
    Prefilter filter = makePrefilter("gaussian", {}, {});
    ResolvedCamera camera = test::makePerspective();
    Film film = test::makeFilm(kFilmPx, kFilmPx);
    Progress progress{};

    MethodInput input() { return {scene, camera, film, filter, options, progress}; }
    MethodResult render(const char* method) { return runMethod(parseMethod(method), input()); }
};

Picture pictureOf(const Scene& scene) {
    Picture picture{scene, {}};
    picture.options.background = kBlue;
    return picture;
}

void expectNear(const glm::dvec4& found, const glm::dvec4& expected, double error, const char* what) {
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(found[c], expected[c], error) << what << ", channel " << c;
}

TEST(Opacity, FactorsColoursAndTexturesTogetherDecide) {
    Scene scene = stackOf({{1, 1, 1, 1}, {1, 1, 1, 0.5}, {1, 1, 1, 0}});
    EXPECT_EQ(opacityOf(scene), (std::vector{Opacity::kOpaque, Opacity::kSeeThrough, Opacity::kInvisible}));
    scene.geometry[0].color = {{1, 1, 1, 1}, {1, 1, 1, 0.5}, {1, 1, 1, 1}};
    EXPECT_EQ(opacityOf(scene)[0], Opacity::kSeeThrough);
    for (Material& m : scene.materials) m.alpha_mode = AlphaMode::kOpaque;
    EXPECT_TRUE(opacityOf(scene).empty());
}

TEST(Opacity, AMaskIsDecidedWhereItsAlphaLiesOnOneSide) {
    Scene scene = stackOf({{1, 1, 1, 0.75}, {1, 1, 1, 0.25}}, AlphaMode::kMask);
    EXPECT_EQ(opacityOf(scene), (std::vector{Opacity::kOpaque, Opacity::kInvisible}));
    scene.images = {{2, 1, {{1, 1, 1, 0.5}, {1, 1, 1, 1}}, "leaf"}};
    scene.textures = {{.image = 0}};
    scene.materials[0].base_color_map.texture = 0;
    scene.geometry[0].uv[0].assign(3, {0.5, 0.5});
    EXPECT_EQ(opacityOf(scene)[0], Opacity::kSeeThrough) << "0.375 to 0.75 holds the cutoff 0.5";
    scene.materials[0].alpha_cutoff = 0.25;
    EXPECT_EQ(opacityOf(scene)[0], Opacity::kOpaque);
}

TEST(Composite, IsOverFromFrontToBack) {
    const std::vector<Shade> shades{{{1, 0, 0}, 0.5}, {{0, 1, 0}, 0.25}, {{0, 0, 1}, 0.125}};
    const std::vector<Owner> over_background{0, 1, kBackground}, over_triangle{0, 1, 2};
    const auto shade = [&](Owner o) { return shades[o]; };
    const Shade seen = composite(over_background, shade, {1, 1, 1});
    EXPECT_EQ(seen.color, glm::dvec3(0.5 + 0.375, 0.125 + 0.375, 0.375));
    EXPECT_EQ(seen.alpha, 1 - 0.375);
    EXPECT_EQ(composite(over_triangle, shade, {1, 1, 1}), (Shade{{0.5, 0.125, 0.375}, 1.0}))
        << "what ends a stack is there whole";
}

TEST(Layers, EveryMethodCompositesTheSameStack) {
    const Scene scene = stackOf({{1, 1, 0, 1}, {1, 0, 0, 0.5}, {0, 1, 0, 0}, {0, 1, 1, 0.25}});
    // cyan 1/4 over red 1/2 over yellow; the pane of alpha 0 is not there
    const glm::dvec4 expected(0.75 * 0.5 + 0.375, 0.25 + 0.375, 0.25, 1.0);
    for (const char* method : {"none", "ssaa:3", "msaa:4", "csaa:32", "nsaa"}) {
        const MethodResult result = pictureOf(scene).render(method);
        for (const glm::dvec4& p : result.image.rgba) expectNear(p, expected, 0x1p-50, method);
    }
}

TEST(Layers, PanesOverTheBackgroundLeaveTheirAlpha) {
    const Scene scene = stackOf({{1, 0, 0, 0.5}, {0, 1, 0, 0.25}});
    const double left = 0.5 * 0.75;
    const glm::dvec4 expected(glm::dvec3(0.75 * 0.5, 0.25, 0) + left * kBlue, 1 - left);
    for (const char* method : {"none", "ssaa:3", "msaa:4", "csaa:32", "nsaa"}) {
        const MethodResult result = pictureOf(scene).render(method);
        for (const glm::dvec4& p : result.image.rgba) expectNear(p, expected, 0x1p-50, method);
    }
}

TEST(Layers, AnEdgeOfAPaneIsAnEdge) {
    Scene scene = stackOf({{1, 0, 0, 1}, {0, 1, 0, 0.5}});
    scene.geometry[1] = test::makeGeometry({pane(1.0f, true)});
    scene.geometry[1].node = scene.geometry[1].material = scene.geometry[1].first_triangle = 1;
    Picture picture = pictureOf(scene);
    picture.filter = makePrefilter("box", 0.75, {});
    const MethodResult result = picture.render("nsaa");
    // The pane's edge is x = 6 px: the support of column 5 reaches 1/4 px of its 3/2 px beyond it.
    const double beyond = 0.25 / 1.5;
    const std::size_t i = result.image.index(5, 6);
    expectNear(result.image.rgba[i], {1 - beyond / 2, beyond / 2, 0, 1}, 0x1p-50, "nsaa");
    EXPECT_EQ(result.image.edge[i], 1.0f);
    EXPECT_EQ(result.image.edge[result.image.index(2, 6)], 0.0f);
}

TEST(Layers, AReportListsEveryLayerOfEveryStack) {
    const Scene scene = stackOf({{1, 1, 0, 0.5}, {1, 0, 0, 0.5}, {0, 1, 1, 0.25}});
    Picture picture = pictureOf(scene);
    const PixelReport report = pixelWeights(picture.input(), 4, 7);
    ASSERT_EQ(report.owners.size(), 3u);
    EXPECT_EQ(report.owners[0].layers, (std::vector<Owner>{2}));
    EXPECT_EQ(report.owners[1].layers, (std::vector<Owner>{2, 1}));
    EXPECT_EQ(report.owners[2].layers, (std::vector<Owner>{2, 1, 0}));
    EXPECT_EQ(report.owners[0].weight, 0.25);
    EXPECT_EQ(report.owners[1].weight, 0.375);
    EXPECT_EQ(report.owners[2].weight, 0.1875);
    EXPECT_EQ(report.background, 0.1875);
    EXPECT_EQ(report.sum, 1.0);
}

TEST(Layers, PastTheCapAPixelIsNamed) {
    std::vector<glm::dvec4> colors(kMaxLayers, {1, 1, 1, 0.5});
    const Scene allowed = stackOf(colors);
    EXPECT_NO_THROW(pictureOf(allowed).render("nsaa"));
    colors.push_back({1, 1, 1, 0.5});
    const Scene refused = stackOf(colors);
    for (const char* method : {"none", "ssaa:2", "msaa:2", "nsaa"}) {
        try {
            pictureOf(refused).render(method);
            ADD_FAILURE() << method;
        } catch (const FailureError& error) {
            EXPECT_EQ(std::string(error.what()).substr(0, 6), "pixel ") << error.what();
        }
    }
}

/// Panes and solids at random, every colour constant.
Scene randomPanes(witness::Dice& dice, int count) {
    std::vector<test::Corners> triangles;
    for (int i = 0; i < count; ++i) {
        const double depth = dice.uniform(1, 4);
        test::Corners corners;
        for (glm::vec3& p : corners) {
            const glm::dvec2 at = dice.around({0, 0}, 1.5 * depth);
            p = glm::vec3(at, -depth * dice.uniform(0.8, 1.2));
        }
        triangles.push_back(corners);
    }
    std::vector<Geometry> geometry;
    for (const auto& t : triangles) geometry.push_back(test::makeGeometry({t}));
    Scene scene = test::makeScene(std::move(geometry));
    scene.materials.resize(std::size_t(count), scene.materials[0]);
    for (std::size_t i = 0; i < std::size_t(count); ++i) {
        const bool pane = dice.integer(0, 3) != 0;
        // Few colours, so that stacks of one class do meet.
        scene.materials[i].base_color = {dice.coin() ? 1.0 : 0.25, dice.coin() ? 0.75 : 0.0, 0.5,
                                         pane ? 0.25 * dice.integer(1, 3) : 1.0};
        scene.materials[i].alpha_mode = pane ? AlphaMode::kBlend : AlphaMode::kOpaque;
        scene.geometry[i].material = std::uint32_t(i);
    }
    return scene;
}

TEST(Layers, ManySamplesApproachTheIntegral) {
    constexpr std::uint64_t kSeed = 7;
    witness::Dice dice(kSeed);
    std::uint64_t stacks = 0;
    double coarse = 0.0, fine = 0.0;
    for (int i = 0; i < 4; ++i) {
        const Scene scene = randomPanes(dice, 14);
        Picture picture = pictureOf(scene);
        const MethodResult exact = picture.render("nsaa"), four = picture.render("ssaa:4"),
                           many = picture.render("ssaa:32");
        stacks += exact.counts.at("stacks");
        for (std::size_t k = 0; k < exact.image.rgba.size(); ++k)
            for (int c = 0; c < 4; ++c) {
                coarse += std::pow(four.image.rgba[k][c] - exact.image.rgba[k][c], 2);
                fine += std::pow(many.image.rgba[k][c] - exact.image.rgba[k][c], 2);
            }
    }
    const double values = 4.0 * 4.0 * kFilmPx * kFilmPx;
    coarse = std::sqrt(coarse / values), fine = std::sqrt(fine / values);
    fmt::print("seed {}: {} stacks; RMSE of ssaa:4 {:.2e}, of ssaa:32 {:.2e}\n", kSeed, stacks, coarse, fine);
    EXPECT_GT(stacks, 100u);
    // Errors of a grid on random edges fall as N^-3/4 or faster: by 22 from 16 to 1024 samples.
    EXPECT_LT(fine, coarse / 8);
    EXPECT_LT(fine, 1e-3);
}

TEST(Layers, CropsMemoryAndOmissionsChangeNothing) {
    constexpr std::uint64_t kSeed = 11;
    witness::Dice dice(kSeed);
    const Scene scene = randomPanes(dice, 20);
    Picture picture = pictureOf(scene);
    const MethodResult whole = picture.render("nsaa");
    picture.film.crop = {3, 2, 9, 11};
    const MethodResult part = picture.render("nsaa");
    for (int y = 2; y < 11; ++y)
        for (int x = 3; x < 9; ++x)
            EXPECT_EQ(part.image.rgba[part.image.index(x, y)], whole.image.rgba[whole.image.index(x, y)]);
    picture.film.crop = {0, 0, kFilmPx, kFilmPx};
    picture.options.no_skip = {"all"};
    const MethodResult forced = picture.render("nsaa");
    EXPECT_GE(whole.counts.at("stacks"), 20u);
    const double terms = double(forced.counts.at("terms")) / (kFilmPx * kFilmPx);
    for (std::size_t k = 0; k < whole.image.rgba.size(); ++k)
        expectNear(forced.image.rgba[k], whole.image.rgba[k], 8 * terms * 10 * 0x1p-53, "forced");
}

}  // namespace
}  // namespace edgewise
