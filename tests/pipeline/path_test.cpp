// The method path:N, its sampler, and the default rig on SDF scenes.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <set>

#include "pipeline/field_shading.h"
#include "pipeline/lighting.h"
#include "pipeline/path_sampler.h"
#include "tests/pipeline/field_pictures.h"

namespace edgewise {
namespace {

using test::FieldPicture;

TEST(PathSampler, EveryPairsFirstPowersOfTwoAreNets) {
    // Of 2^6 points one lies in each of the 64 boxes of every shape.
    for (const std::uint32_t index : {0u, 1u, 7u, 30u})
        for (int bits = 0; bits <= 6; ++bits) {
            PixelPathSampler sampler(3, -4, 9);
            std::set<std::pair<int, int>> boxes;
            for (std::uint32_t s = 0; s < 64; ++s) {
                sampler.start(s);
                const glm::dvec2 p = sampler.pair(index);
                boxes.emplace(static_cast<int>(p.x * (1 << bits)), static_cast<int>(p.y * (64 >> bits)));
            }
            EXPECT_EQ(boxes.size(), 64u) << index << " " << bits;
        }
}

TEST(PathSampler, PairsAreInOrdersOfTheirOwn) {
    // Correlation of the first coordinates of two pairs over 256 samples, as of random numbers.
    PixelPathSampler sampler(1, 2, 0);
    for (std::uint32_t other = 1; other < 12; ++other) {
        double sum = 0.0;
        for (std::uint32_t s = 0; s < 256; ++s) {
            sampler.start(s);
            sum += (sampler.pair(0).x - 0.5) * (sampler.pair(other).x - 0.5) * 12.0 / 256.0;
        }
        EXPECT_LT(std::abs(sum), 5.0 / 16.0) << other;
    }
}

FieldPicture ballUnderSky() {
    FieldPicture picture = test::flatPicture(16, 16);
    sdf::SurfaceMaterial material;
    material.color = glm::dvec3(0.5);
    picture.field->materials = {material};
    picture.field->tree.add(sdf::Kind::kSphere, {5.0}, {}, 0);
    sdf::SurfaceLight off;  // a light of the scene's own keeps the rig away
    off.intensity = 0.0;
    picture.field->lights = {off};
    picture.options.background = glm::dvec3(1.0);
    return picture;
}

TEST(Path, AConvexBodyUnderAnEvenSkyIsItsAlbedo) {
    FieldPicture picture = ballUnderSky();
    const MethodResult result = picture.made("path:16");
    const glm::dvec4 middle = result.image.rgba[result.image.index(8, 8)];
    EXPECT_LT(glm::length(middle - glm::dvec4(0.5, 0.5, 0.5, 1.0)), 1e-12);
    EXPECT_EQ(result.image.rgba[0], glm::dvec4(1, 1, 1, 0));
    EXPECT_EQ(result.counts.at("rays_primary"), 16u * 256);
    double alpha = 0.0;
    for (const glm::dvec4& p : result.image.rgba) alpha += p.a;
    // The disk's area, as far as the hit's threshold inflates it; 16 samples in each of the pixels along its
    // rim are off by less than random ones.
    const double radius = 5.0 + 0.5 * sdf::TraceSettings{}.threshold, rim_px = 2.0 * M_PI * radius;
    EXPECT_NEAR(alpha, M_PI * radius * radius, 4.0 * std::sqrt(rim_px * 0.25 / 16.0));
}

TEST(Path, ThreadsAndCropsDoNotShow) {
    FieldPicture picture = ballUnderSky();
    const ImageBuffer whole = picture.made("path:3").image;
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    picture.film.crop = {2, 3, 9, 15};
    const ImageBuffer part = picture.made("path:3").image;
    for (int y = 3; y < 15; ++y)
        for (int x = 2; x < 9; ++x) EXPECT_EQ(part.rgba[part.index(x, y)], whole.rgba[whole.index(x, y)]);
}

TEST(FieldShading, TheRigIsFixedToTheCamera) {
    FieldPicture picture = ballUnderSky();
    picture.field->lights.clear();
    picture.camera.camera.world_from_camera = glm::dmat4(glm::dmat3({0, 0, -1}, {0, 1, 0}, {1, 0, 0}));
    const sdf::ShadingSettings rig = fieldShading(picture.input(), {}, false);
    ASSERT_EQ(rig.lights.size(), 2u);
    EXPECT_EQ(rig.ambient, glm::dvec3(kRigAmbient));
    // White Lambert that faces the key light shines with its intensity; the camera's z is the world's x.
    EXPECT_NEAR(rig.lights[0].intensity / M_PI, kRigKey.intensity, 1e-15);
    EXPECT_NEAR(-rig.lights[0].direction_world.x, kRigKey.towards.z, 1e-15);
    EXPECT_FALSE(rig.lights[0].shadows);
    picture.field->materials[0].emission = glm::dvec3(1.0);
    EXPECT_TRUE(fieldShading(picture.input(), {}, true).lights.empty());
    EXPECT_EQ(fieldShading(picture.input(), {}, false).lights.size(), 2u);
}

}  // namespace
}  // namespace edgewise
