// References of ever finer meshes: what is left of an error, and what they are called.
#include "pipeline/compare/mesh_reference.h"

#include <gtest/gtest.h>

#include <cmath>

namespace edgewise::compare {
namespace {

ImageBuffer gray(double value) {
    ImageBuffer image(PixelBox{0, 0, 12, 12});
    for (glm::dvec4& pixel : image.rgba) pixel = glm::dvec4(glm::dvec3(value), 1.0);
    return image;
}

TEST(MeshReference, WhatIsLeftIsTheErrorWhereErrorsFallWithTheMeshs) {
    // Pictures that are off by 0.3 px^-1 times how far their meshes are.
    for (const auto& [first, second] : {std::pair(0.2, 0.1), std::pair(0.15, 0.01), std::pair(0.05, 0.0)}) {
        const PictureDistance moved{0.3 * (first - second), 0.9 * (first - second), 0.6 * (first - second)};
        const PictureDistance left = leftOf(moved, first, second);
        EXPECT_NEAR(left.rmse, 0.3 * second, 1e-15);
        EXPECT_NEAR(left.max, 0.9 * second, 1e-15);
        if (second > 0.0) {
            EXPECT_NEAR(*left.edge_rmse, 0.6 * second, 1e-15);
        }
    }
    EXPECT_GT(leftOf({1e-4, 1e-4, {}}, 0.1, 0.1).rmse, 1e-3);  // no nearer: nothing is known
    EXPECT_EQ(leftOf({0.0, 0.0, {}}, 0.1, 0.1).rmse, 0.0);
}

TEST(MeshReference, AMethodOnAFinerMeshKeepsItsOwnWords) {
    EXPECT_EQ(onMeshWithin(0.05, parseMethod("nsaa,visibility=slab")),
              "mesh:error=0.05,mesher=dual+nsaa,visibility=slab");
    EXPECT_EQ(onMeshWithin(0.1, parseMethod("mesh:mesher=marching-cubes+ssaa:4")),
              "mesh:error=0.1,mesher=marching-cubes+ssaa:4");
    EXPECT_EQ(parseMethod(onMeshWithin(0.025, parseMethod("nsaa"))).mesh->error_px, 0.025);
}

TEST(MeshReference, RowsOnTheFirstMeshAreJudgedOnItToo) {
    MeshReference reference;
    reference.levels.resize(2);
    reference.levels[0].mesh.mesher = "dual", reference.levels[0].mesh.asked_px = 0.004;
    const MadeOfMeshes made{gray(0.5), gray(0.6), {1e-3, 2e-3, {}}};
    Row row;
    judgeOnMesh(row, gray(0.52), reference, made);
    EXPECT_EQ(row.reference_error->rmse, 1e-3);
    EXPECT_FALSE(row.antialiasing);
    row.mesh = reference.levels[0].mesh;
    judgeOnMesh(row, gray(0.52), reference, made);
    EXPECT_NEAR(row.antialiasing->rmse, 0.02, 1e-12);
    row.mesh->asked_px = 0.002;
    row.antialiasing.reset();
    judgeOnMesh(row, gray(0.52), reference, made);
    EXPECT_FALSE(row.antialiasing);
}

}  // namespace
}  // namespace edgewise::compare
