#include "pipeline/shade.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/pipeline/test_scene.h"

namespace edgewise {
namespace {

using test::Corners;

/// A projected scene that lives as long as its shading.
struct Shot {
    Scene scene;
    ResolvedCamera camera;
    Film film;
    ScreenPieces pieces;
    ScreenScene screen;
    Shading shading;

    Shot(Scene what, const ResolvedCamera& from, int width, int height)
        : scene(std::move(what)),
          camera(from),
          film(test::makeFilm(width, height)),
          screen(project(scene, camera, film, pieces)),
          shading(scene, camera, film, screen, pieces) {}
};

Image checker() {
    Image image{2, 2, {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}}, "checker"};
    return image;
}

void expectNear(const glm::dvec3& got, const glm::dvec3& want, double bound) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(got[k], want[k], bound) << "channel " << k;
}

/// Colours equal to eye-space positions: then the colour at a pixel is the ray's hit, partly behind the eye
/// or not. The rounding bound counts u = 2^-53 for the dozen operations on values up to 16 and is doubled for
/// conditioning of triangles that the test keeps fat; vertices are not rounded to the grid here.
TEST(Shade, PerspectiveCorrectAlsoBehindTheEye) {
    std::mt19937 random(41);
    std::uniform_real_distribution<float> side(-4, 4), depth(-6, 3);
    std::vector<Corners> triangles(300);
    for (auto& t : triangles)
        for (auto& p : t) p = {side(random), side(random), depth(random)};
    Geometry geometry = test::makeGeometry(triangles);
    for (const glm::dvec3& p : geometry.position_world) geometry.color.push_back(glm::dvec4(p, 1.0));
    const Shot shot(test::makeScene({geometry}), test::makePerspective(), 64, 48);
    std::size_t checked = 0, behind = 0;
    for (Owner owner = 0; owner < triangles.size(); ++owner)
        for (const ScreenTriangle& piece : shot.pieces.of(owner, shot.screen)) {
            const glm::dvec2 centre = (piece.p_px[0] + piece.p_px[1] + piece.p_px[2]) / 3.0;
            if (std::max(std::fabs(centre.x), std::fabs(centre.y)) > 1000) continue;
            const DepthPlane& z = shot.screen.planes[piece.plane];
            const glm::dvec2 from = centre - shot.screen.anchor_px;
            const double w = 1.0 / (z.dz_dx * from.x + z.dz_dy * from.y + z.z_anchor);
            const glm::dvec3 hit(w * (centre.x - 32) / 24, w * (24 - centre.y) / 24, -w);
            const Corners& t = triangles[owner];
            const double height =
                glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) / 8.0;  // over its longest side
            if (height < 0.1 || piece.p_px[0] == piece.p_px[1]) continue;
            const double slant =
                1.0 / std::fabs(glm::dot(shot.pieces.plane_normal_eye[piece.plane], glm::normalize(hit)));
            expectNear(shot.shading.atPoint(owner, centre).color, hit,
                       0x1p-53 * 16 * 12 * 2 * slant / height);
            EXPECT_EQ(shot.shading.atPoint(owner, centre), shot.shading.closest(owner, centre));
            ++checked;
            behind += std::max({t[0].z, t[1].z, t[2].z}) > 0;
        }
    std::printf("seed 41: %zu points, %zu on triangles that reach behind the eye\n", checked, behind);
    EXPECT_GT(behind, 100u);
}

TEST(Shade, ClosestPointOfATriangle) {
    // On the screen: (0, 0), (8, 0), (0, 8) px of an 8 x 8 film, at distance 1.
    const Shot shot(test::makeScene({test::makeGeometry({{{{-1, 1, -1}, {1, 1, -1}, {-1, -1, -1}}}})}),
                    test::makePerspective(), 8, 8);
    auto closest = [&](double x, double y) {
        return glm::dvec2(x, y) + shot.shading.closestOffset(0, {x, y});
    };
    EXPECT_EQ(closest(1.5, 2.5), glm::dvec2(1.5, 2.5));
    EXPECT_EQ(closest(-3, -2), glm::dvec2(0, 0));
    EXPECT_EQ(closest(3, -2), glm::dvec2(3, 0));
    EXPECT_EQ(closest(8, 8), glm::dvec2(4, 4));
}

/// What the default rig sends back from a white dielectric of roughness 1 (alpha = 1: D = 1/pi, and each half
/// of V is 1 / (1 + cosine)) seen from +z.
double rigOnWhite(const glm::dvec3& n) {
    double sum = 0.15;
    const std::pair<glm::dvec3, double> lamps[] = {{glm::dvec3(2, 3, 6) / 7.0, 0.8},
                                                   {glm::dvec3(-6, 2, 3) / 7.0, 0.2}};
    for (const auto& [l, intensity] : lamps) {
        const double nl = std::max(0.0, glm::dot(n, l));
        const double fresnel = 0.04 + 0.96 * std::pow(1 - std::sqrt((1 + l.z) / 2), 5);
        sum += intensity * nl * (1 - fresnel + fresnel / ((1 + nl) * (1 + std::fabs(n.z))));
    }
    return sum;
}

void makeMatte(Material& material) {
    material.unlit = false;
    material.metallic = 0.0;
}

/// Some thirty roundings of values up to 1.
constexpr double kLitError = 32 * 0x1p-53;

TEST(Shade, AWhiteSurfaceThatFacesTheKeyLightIsAboutWhite) {
    EXPECT_NEAR(rigOnWhite(glm::dvec3(2, 3, 6) / 7.0), 1.0, 0.03);
}

TEST(Shade, FlatNormalsFaceTheViewerOnBothSides) {
    Scene scene = test::makeScene({test::makeGeometry(
        {{{{-1, -1, -2}, {1, -1, -2}, {0, 1, -2}}}, {{{-1, -1, -2}, {0, 1, -2}, {1, -1, -2}}}})});
    makeMatte(scene.materials[0]);
    const Shot shot(scene, test::makePerspective(), 8, 8);
    ASSERT_TRUE(shot.shading.constant(0) && shot.shading.constant(1));
    const Shade shade = *shot.shading.constant(0);
    expectNear(shade.color, glm::dvec3(rigOnWhite({0, 0, 1})), kLitError);
    EXPECT_EQ(*shot.shading.constant(1), shade);
    EXPECT_EQ(shot.shading.closest(1, {2.5, 3.5}), shade);
}

TEST(Shade, InterpolatesAndFlipsNormals) {
    Geometry geometry = test::makeGeometry(
        {{{{-1, 1, -1}, {-1, -1, -1}, {1, 1, -1}}}, {{{-1, 1, -1}, {1, 1, -1}, {-1, -1, -1}}}});
    const glm::dvec3 a(0, 0, 2), b(1, 0, 0), c(0, 3, 0);
    geometry.normal_world = {a, b, c, -a, -c, -b};
    Scene scene = test::makeScene({geometry});
    makeMatte(scene.materials[0]);
    const Shot shot(scene, test::makePerspective(), 8, 8);
    EXPECT_FALSE(shot.shading.constant(0));
    // (2, 2) px lies at barycentrics 1/2, 1/4, 1/4.
    const double expected = rigOnWhite(glm::normalize(glm::dvec3(0.25, 0.25, 0.5)));
    EXPECT_NEAR(shot.shading.atPoint(0, {2, 2}).color.r, expected, kLitError);
    EXPECT_EQ(shot.shading.atPoint(0, {2, 2}), shot.shading.atPoint(1, {2, 2}));
}

TEST(Shade, ConstantOnlyWhereNothingVaries) {
    Geometry geometry = test::makeGeometry(
        {{{{-1, 1, -1}, {-1, -1, -1}, {1, 1, -1}}}, {{{1, -1, -1}, {1, 1, -1}, {-1, -1, -1}}}});
    geometry.color = {{1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}, {0, 0, 1, 1}};
    geometry.uv[0].assign(6, {0.25, 0.25});
    Scene scene = test::makeScene({geometry});
    const Shot coloured(scene, test::makePerspective(), 8, 8);
    EXPECT_EQ(coloured.shading.constant(0), (Shade{{1, 0, 0}, 1}));
    EXPECT_FALSE(coloured.shading.constant(1));
    scene.images = {checker(), {2, 1, {{.5, .5, .5, 1}, {.5, .5, .5, 1}}, "grey"}};
    scene.textures = {{.image = 0}, {.image = 1}};
    scene.materials[0].base_color_map.texture = 0;
    EXPECT_FALSE(Shot(scene, test::makePerspective(), 8, 8).shading.constant(0));
    scene.materials[0].base_color_map.texture = 1;
    EXPECT_EQ(Shot(scene, test::makePerspective(), 8, 8).shading.constant(0), (Shade{{.5, 0, 0}, 1}));
}

TEST(Texture, PyramidKeepsTheMean) {
    std::mt19937 random(43);
    std::uniform_real_distribution<float> value(0, 1);
    Image image{13, 6, {}, ""};
    for (int i = 0; i < 13 * 6; ++i) image.texels.push_back({value(random), value(random), value(random), 1});
    const MipPyramid pyramid(image);
    ASSERT_EQ(pyramid.levels(), 4);  // 13x6, 6x3, 3x1, 1x1
    glm::dvec3 mean(0.0);
    for (const auto& t : image.texels) mean += glm::dvec3(t) / (13.0 * 6.0);
    // A float rounding a level.
    expectNear(glm::dvec3(pyramid.level(3).texels[0]), mean, 3 * 0x1p-24);
}

TEST(Texture, WrapsAndFilters) {
    const Image image = checker();
    const MipPyramid pyramid(image);
    Texture texture{.image = 0};
    auto at = [&](double u, double v) { return glm::dvec3(sampleTexture(texture, pyramid, {u, v}, {})); };
    texture.mag = TexelFilter::kNearest;
    EXPECT_EQ(at(0.1, 0.1), glm::dvec3(1, 0, 0));
    EXPECT_EQ(at(0.9, 0.1), glm::dvec3(0, 1, 0));
    EXPECT_EQ(at(-0.1, 5.9), glm::dvec3(1, 1, 1));
    texture.wrap_s = Wrap::kMirroredRepeat;
    EXPECT_EQ(at(-0.1, 0.1), glm::dvec3(1, 0, 0));
    EXPECT_EQ(at(1.1, 0.1), glm::dvec3(0, 1, 0));
    texture.wrap_s = Wrap::kClampToEdge;
    EXPECT_EQ(at(1e18, 0.1), glm::dvec3(0, 1, 0));
    texture.mag = TexelFilter::kLinear;
    EXPECT_EQ(at(0.5, 0.25), glm::dvec3(0.5, 0.5, 0));
    EXPECT_EQ(at(0.0, 0.25), glm::dvec3(1, 0, 0));
    texture.wrap_s = Wrap::kRepeat;
    EXPECT_EQ(at(0.0, 0.25), glm::dvec3(0.5, 0.5, 0));
}

TEST(Texture, LevelsFollowTheFootprint) {
    Image image{4, 4, {}, ""};
    for (int i = 0; i < 16; ++i) image.texels.push_back(glm::vec4(i == 5 ? 1.0f : 0.0f));
    const MipPyramid pyramid(image);
    const Texture texture{.image = 0};
    auto at = [&](double texels) {
        return sampleTexture(texture, pyramid, {0.375, 0.375}, {{texels / 4, 0.0}, {0.0, 0.25}}).r;
    };
    EXPECT_EQ(at(1.0), 1.0);
    EXPECT_EQ(at(4.0), 1.0 / 16);  // level 2: one texel
    EXPECT_EQ(at(1000.0), 1.0 / 16);
    // Level 1 is 2 x 2 with 1/4 in the first; 0.375 * 2 - 0.5 = 0.25 of a texel towards the next.
    EXPECT_EQ(at(2.0), 0.25 * 0.75 * 0.75);
    EXPECT_NEAR(at(2.0 * std::sqrt(2.0)), (0.25 * 0.75 * 0.75 + 1.0 / 16) / 2, 4 * 0x1p-53);
}

}  // namespace
}  // namespace edgewise
