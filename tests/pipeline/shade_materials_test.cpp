// Materials on a square that faces the camera: which way bumps lean, which channel means what, what is
// constant.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "pipeline/shade.h"
#include "tests/pipeline/test_scene.h"

namespace edgewise {
namespace {

Film movedFilm(glm::dvec2 offset_px) {
    Film film = test::makeFilm(8, 8);
    film.debug_offset_px = offset_px;
    return film;
}

struct Shot {
    Scene scene;
    ResolvedCamera camera = test::makeOrthographic(1.0);
    Film film;
    ScreenPieces pieces;
    ScreenScene screen;
    Shading shading;

    explicit Shot(Scene what, const ResolvedCamera& from = test::makeOrthographic(1.0),
                  glm::dvec2 offset_px = glm::dvec2(0.0))
        : scene(std::move(what)),
          camera(from),
          film(movedFilm(offset_px)),
          screen(project(scene, camera, film, pieces)),
          shading(scene, camera, film, screen, pieces) {}
    glm::dvec3 at(glm::dvec2 p_px = {3, 4.5}) const { return shading.atPoint(0, p_px).color; }
};

enum class Side { kFront, kBack };

/// One triangle at z = -1 over the film's lower left half, u to the right and v downwards: (0, 0) is the
/// film's upper left corner, (1, 1) its lower right one.
Scene plate(Side side = Side::kFront) {
    Geometry g = test::makeGeometry({{{{-1, 1, -1}, {-1, -1, -1}, {1, -1, -1}}}});
    g.uv[0] = {{0, 0}, {0, 1}, {1, 1}};
    if (side == Side::kBack) g.triangles[0] = {0, 2, 1};
    Scene scene = test::makeScene({g});
    scene.materials[0].unlit = false;
    scene.materials[0].metallic = 0.0;
    return scene;
}

Light sun(const glm::dvec3& towards) {
    Light light;
    light.type = Light::Type::kDirectional;
    light.intensity = 3.0;
    light.direction_world = -glm::normalize(towards);
    return light;
}

void addImage(Scene& scene, TextureUse& use, std::vector<glm::vec4> texels, int width = 1) {
    const int height = static_cast<int>(texels.size()) / width;
    use.texture = static_cast<std::uint32_t>(scene.textures.size());
    Texture texture;
    texture.image = static_cast<std::uint32_t>(scene.images.size());
    texture.mag = texture.min = TexelFilter::kNearest;
    texture.mip.reset();
    scene.textures.push_back(texture);
    scene.images.push_back({width, height, std::move(texels), ""});
}

glm::vec4 texelOf(const glm::dvec3& normal) {
    return glm::vec4(glm::vec3(0.5 * normal + 0.5), 1.0f);
}

const glm::dvec3 kLean = glm::normalize(glm::dvec3(0.6, 0.3, 1.0));
const glm::dvec3 kSun = glm::normalize(glm::dvec3(0.3, -0.2, 1.0));

/// What a white matte surface of this normal, seen from +z, sends back of the sun at kSun.
glm::dvec3 underTheSun(const glm::dvec3& n) {
    return brdf({glm::dvec3(1.0), 0.0, 1.0}, n, {0, 0, 1}, kSun) * (3.0 * std::max(0.0, glm::dot(n, kSun)));
}

void expectNear(const glm::dvec3& got, const glm::dvec3& want, double bound) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(got[k], want[k], bound) << "channel " << k;
}

/// The texels are floats: 2^-24 each, doubled by 2 t - 1, in three coordinates, times 3 lux.
constexpr double kTexelError = 32 * 0x1p-24;

struct NormalMapCase {
    const char* name;
    std::array<glm::dvec2, 3> uv;
    glm::dvec3 expected;  ///< where kLean points to on the screen
};

TEST(NormalMap, LeansAsThePictureLiesOnTheSurface) {
    const glm::dvec3 n = kLean;
    const NormalMapCase cases[] = {
        {"upright", {{{0, 0}, {0, 1}, {1, 1}}}, n},
        {"mirrored", {{{1, 0}, {1, 1}, {0, 1}}}, {-n.x, n.y, n.z}},
        {"upside down", {{{0, 1}, {0, 0}, {1, 0}}}, {n.x, -n.y, n.z}},
        {"a quarter turned: u runs down, v to the left", {{{0, 1}, {1, 1}, {1, 0}}}, {n.y, -n.x, n.z}},
        {"no area", {{{0, 0}, {1, 1}, {2, 2}}}, {0, 0, 1}}};
    for (const NormalMapCase& c : cases) {
        SCOPED_TRACE(c.name);
        Scene scene = plate();
        scene.geometry[0].uv[0].assign(c.uv.begin(), c.uv.end());
        scene.lights = {sun(kSun)};
        addImage(scene, scene.materials[0].normal_map, {texelOf(kLean)});
        expectNear(Shot(scene).at(), underTheSun(c.expected), kTexelError);
    }
}

TEST(NormalMap, ABumpIsLitFromTheSideThatTheLightComesFrom) {
    // Left half leans to the left, right half to the right: a ridge.
    Scene scene = plate();
    addImage(scene, scene.materials[0].normal_map,
             {texelOf(glm::normalize(glm::dvec3(-1, 0, 1))), texelOf(glm::normalize(glm::dvec3(1, 0, 1)))},
             2);
    scene.lights = {sun({1, 0, 1})};
    const Shot right(scene);
    EXPECT_GT(right.at({6.5, 7.5}).r, 0.5);
    EXPECT_NEAR(right.at({1.5, 7.5}).r, 0.0, 1e-6);  // a right angle, in floats
    scene.lights = {sun({-1, 0, 1})};
    const Shot left(scene);
    EXPECT_NEAR(left.at({6.5, 7.5}).r, 0.0, 1e-6);
    EXPECT_GT(left.at({1.5, 7.5}).r, 0.5);
}

TEST(NormalMap, ScaleFlattensAndBackFacesTurnRound) {
    Scene scene = plate();
    scene.lights = {sun(kSun)};
    addImage(scene, scene.materials[0].normal_map, {texelOf(kLean)});
    scene.materials[0].normal_scale = 0.5;
    const glm::dvec3 flatter = glm::normalize(kLean * glm::dvec3(0.5, 0.5, 1.0));
    expectNear(Shot(scene).at(), underTheSun(flatter), kTexelError);
    // The same surface from behind, u still to the right and v downwards on the screen. From the front, where
    // the map is meant for, u runs to the left: a slope towards +u there is one away from it here.
    Scene back = plate(Side::kBack);
    back.lights = {sun(kSun)};
    addImage(back, back.materials[0].normal_map, {texelOf(kLean)});
    expectNear(Shot(back).at(), underTheSun({-kLean.x, -kLean.y, kLean.z}), kTexelError);
}

TEST(NormalMap, TheFilesTangentsCount) {
    Scene scene = plate();
    scene.lights = {sun(kSun)};
    scene.geometry[0].normal_world.assign(3, {0, 0, 2});
    addImage(scene, scene.materials[0].normal_map, {texelOf(kLean)});
    scene.geometry[0].tangent_world.assign(3, {3, 0, 1, 1});  // made orthogonal to the normal
    expectNear(Shot(scene).at(), underTheSun(kLean), kTexelError);
    scene.geometry[0].tangent_world.assign(3, {0, -1, 0, -1});  // x runs down; y = -cross(z, x) to the left
    expectNear(Shot(scene).at(), underTheSun({-kLean.y, -kLean.x, kLean.z}), kTexelError);
}

TEST(NormalMap, LevelsHaveUnitNormals) {
    std::mt19937 random(63);
    std::uniform_real_distribution<double> side(-1, 1);
    Image image{8, 8, {}, ""};
    for (int i = 0; i < 64; ++i)
        image.texels.push_back(texelOf(glm::normalize(glm::dvec3(side(random), side(random), 1.2))));
    const MipPyramid normals(image, TexelKind::kNormal), values(image);
    double shortest = 1.0;
    for (int level = 1; level < normals.levels(); ++level)
        for (std::size_t i = 0; i < normals.level(level).texels.size(); ++i) {
            EXPECT_NEAR(glm::length(2.0 * glm::dvec3(normals.level(level).texels[i]) - 1.0), 1.0,
                        4 * 0x1p-24);
            shortest = std::min(shortest, glm::length(2.0 * glm::dvec3(values.level(level).texels[i]) - 1.0));
        }
    EXPECT_LT(shortest, 0.95) << "plain means had to be shorter";
}

TEST(Materials, ChannelsOfTheMaps) {
    Scene scene = plate();
    Material& m = scene.materials[0];
    m.base_color = {0.8, 0.4, 0.2, 1}, m.metallic = 0.5, m.roughness = 0.75;
    scene.lights = {sun(kSun)};
    addImage(scene, m.metallic_roughness_map, {{1, 0.5, 0.25, 1}});
    addImage(scene, m.emissive_map, {{0.5, 0.25, 1, 1}});
    addImage(scene, m.occlusion_map, {{0.25, 1, 1, 1}});
    m.emissive = {2, 2, 4};
    const Reflectance expected{{0.8, 0.4, 0.2}, 0.125, 0.375};
    const glm::dvec3 lit = brdf(expected, {0, 0, 1}, {0, 0, 1}, kSun) * (3.0 * kSun.z);
    expectNear(Shot(scene).at(), lit + glm::dvec3(1, 0.5, 4), 64 * 0x1p-53);
    // Under the rig the occlusion dims the ambient term alone.
    scene.lights.clear();
    const glm::dvec3 dim = Shot(scene).at();
    m.occlusion_strength = 0.0;
    const glm::dvec3 open = Shot(scene).at();
    expectNear(open - dim, glm::dvec3(0.8, 0.4, 0.2) * (0.15 * 0.75), 64 * 0x1p-53);
}

TEST(Materials, MetalsAreNotBlackUnderTheRig) {
    Scene scene = plate();
    scene.materials[0].metallic = 1.0, scene.materials[0].roughness = 0.0;
    scene.materials[0].base_color = {1.0, 0.8, 0.4, 1.0};
    expectNear(Shot(scene).at(), glm::dvec3(1.0, 0.8, 0.4) * 0.15, 0.01);
}

TEST(Materials, UnlitIsTheBaseColorAlone) {
    Scene scene = plate();
    scene.materials[0].unlit = true;
    scene.materials[0].base_color = {0.25, 0.5, 0.75, 1};
    scene.materials[0].emissive = {1, 1, 1};
    scene.lights = {sun(kSun)};
    EXPECT_EQ(Shot(scene).at(), glm::dvec3(0.25, 0.5, 0.75));
}

TEST(Materials, TextureTransformsMoveThePicture) {
    // Red, green / blue, white.
    const std::vector<glm::vec4> four{{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}};
    const auto colorWith = [&](const glm::dmat3& uv_from_vertex, glm::dvec2 p_px, int set = 0) {
        Scene scene = plate();
        scene.materials[0].unlit = true;
        scene.geometry[0].uv[1] = {{0.75, 0.25}, {0.75, 0.25}, {0.75, 0.25}};
        TextureUse& use = scene.materials[0].base_color_map;
        addImage(scene, use, four, 2);
        use.uv_from_vertex = uv_from_vertex;
        use.uv = set;
        return Shot(scene).at(p_px);
    };
    const glm::dvec2 left(1.0, 6.0), right(6.0, 7.0);  // (u, v) = (1/8, 3/4), (3/4, 7/8)
    const glm::dmat3 same(1.0);
    EXPECT_EQ(colorWith(same, left), glm::dvec3(0, 0, 1));
    EXPECT_EQ(colorWith(same, right), glm::dvec3(1, 1, 1));
    EXPECT_EQ(colorWith(same, left, 1), glm::dvec3(0, 1, 0));
    EXPECT_EQ(colorWith({1, 0, 0, 0, 1, 0, 0, 0.5, 1}, left), glm::dvec3(1, 0, 0));     // offset (0, 1/2)
    EXPECT_EQ(colorWith({0.5, 0, 0, 0, 0.5, 0, 0, 0, 1}, right), glm::dvec3(1, 0, 0));  // scale 1/2
    // The extension's rotation by a quarter, counter-clockwise: (u, v) -> (v, -u): (7/8, -3/4) = (7/8, 1/4).
    EXPECT_EQ(colorWith({0, -1, 0, 1, 0, 0, 0, 0, 1}, right), glm::dvec3(0, 1, 0));
}

/// A constant material, and the same through maps that vary where the triangle does not reach: then every
/// place is shaded for itself.
TEST(Materials, ConstantShadesAreThoseOfEveryPlace) {
    std::mt19937 random(64);
    std::uniform_real_distribution<double> unit(0, 1);
    std::size_t constant = 0, metals = 0, bumped = 0;
    for (int i = 0; i < 300; ++i) {
        Scene fixed = plate(i % 3 == 0 ? Side::kBack : Side::kFront);
        Material& m = fixed.materials[0];
        m.base_color = {unit(random), unit(random), unit(random), unit(random)};
        m.metallic = unit(random), m.roughness = unit(random), m.alpha_mode = static_cast<AlphaMode>(i % 3);
        m.alpha_cutoff = 0.0;  // a mask that is not there has no pieces
        m.emissive = glm::dvec3(i % 4 == 0 ? unit(random) : 0.0);
        if (i % 2 == 0) fixed.geometry[0].normal_world.assign(3, {unit(random) - 0.5, unit(random) - 0.5, 1});
        if (i % 5 < 2) fixed.lights = {sun({unit(random) - 0.5, unit(random) - 0.5, unit(random)})};
        Scene varying = fixed;
        const auto both = [&](TextureUse Material::*use, const glm::vec4& texel) {
            addImage(fixed, fixed.materials[0].*use, {texel});
            addImage(varying, varying.materials[0].*use, {texel, glm::vec4(0.1f), texel, texel}, 2);
            (varying.materials[0].*use).uv_from_vertex = glm::dmat3(0.25);
        };
        const auto texel = [&] { return glm::vec4(unit(random), unit(random), unit(random), 1); };
        both(&Material::base_color_map, texel());
        both(&Material::metallic_roughness_map, texel());
        both(&Material::occlusion_map, texel());
        both(&Material::emissive_map, texel());
        if (i % 7 < 4) both(&Material::normal_map, texelOf(kLean)), ++bumped;
        const Shot known(fixed), anywhere(varying);
        const auto shade = known.shading.constant(0);
        ASSERT_TRUE(shade);
        ASSERT_FALSE(anywhere.shading.constant(0));
        for (const glm::dvec2 p : {glm::dvec2(1, 2.5), glm::dvec2(3, 4.5), glm::dvec2(0.5, 7.5)}) {
            EXPECT_EQ(known.shading.atPoint(0, p), *shade);
            EXPECT_EQ(known.shading.closest(0, p - 4.0), *shade);
            const Shade there = anywhere.shading.atPoint(0, p);
            const double bright = std::max({1.0, shade->color.r, shade->color.g, shade->color.b});
            // An interpolated normal errs by 8 u; the sharpest highlight changes by 2^10 of its value a
            // radian.
            expectNear(there.color, shade->color, bright * 0x1p-53 * 8 * 0x1p10);
            EXPECT_EQ(there.alpha, shade->alpha);
        }
        ++constant, metals += m.metallic > 0.5;
    }
    std::printf("seed 64: %zu constant, %zu mostly metal, %zu with a normal map\n", constant, metals, bumped);
    EXPECT_GT(metals, 100u);
    EXPECT_GT(bumped, 100u);
}

TEST(Materials, WholePixelsDoNotShow) {
    Scene scene = plate();
    scene.lights = {sun(kSun), Light()};
    scene.lights[1].position_world = {0.3, 0.2, -0.1};
    scene.lights[1].range = 3.0;
    scene.materials[0].metallic = 0.5, scene.materials[0].roughness = 0.3;
    scene.geometry[0].normal_world = {{0.1, 0, 1}, {0, -0.2, 1}, {0.3, 0, 1}};
    const glm::vec4 left = texelOf(glm::normalize(glm::dvec3(-1, 0, 1))), right = texelOf(kLean);
    addImage(scene, scene.materials[0].normal_map, {left, right, right, left}, 2);
    scene.textures[0] = {.image = 0};  // linear, with levels
    const glm::dvec2 offset(16384, -8191);
    const Shot here(scene, test::makePerspective()), there(scene, test::makePerspective(), offset);
    glm::dvec3 before(0.0);
    for (const glm::dvec2 p : {glm::dvec2(1.25, 2.5), glm::dvec2(3.0, 4.75), glm::dvec2(12, -3)}) {
        EXPECT_EQ(here.shading.closest(0, p), there.shading.closest(0, p + offset));
        EXPECT_NE(here.shading.closest(0, p).color, before);
        before = here.shading.closest(0, p).color;
    }
}

TEST(Materials, PerspectiveAndLampsVary) {
    Scene scene = plate();
    EXPECT_TRUE(Shot(scene, test::makePerspective()).shading.constant(0));
    scene.lights = {sun(kSun)};
    EXPECT_FALSE(Shot(scene, test::makePerspective()).shading.constant(0));
    EXPECT_TRUE(Shot(scene).shading.constant(0));
    scene.lights[0].type = Light::Type::kPoint;
    const Shot lamp(scene);
    EXPECT_FALSE(lamp.shading.constant(0));
    // At the origin, one world unit in front of the plate's (0, 0): nearer there than at the corner.
    EXPECT_GT(lamp.at({4, 4.5}).r, lamp.at({0.5, 7.5}).r);
}

}  // namespace
}  // namespace edgewise
