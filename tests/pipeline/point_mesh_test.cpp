// Meshes of fields that are asked at many points at once, against closed forms of the same solids.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/glm.hpp>
#include <limits>

#include "pipeline/judge/mesh_quality.h"
#include "sdf/point_mesh.h"
#include "sdf/point_slopes.h"
#include "sdf/scene_error.h"

namespace edgewise {
namespace {

using Map = std::function<double(const glm::dvec3&)>;

/// In double, or as a device would have it: positions and values in float.
class TestField : public sdf::PointField {
  public:
    TestField(Map map, bool in_float, double lipschitz = 1.0)
        : map_(std::move(map)), in_float_(in_float), lipschitz_(lipschitz) {}
    std::vector<double> values(std::span<const glm::dvec3> points) const override {
        std::vector<double> values;
        for (const glm::dvec3& p : points)
            values.push_back(in_float_ ? double(float(map_(glm::dvec3(glm::vec3(p))))) : map_(p));
        return values;
    }
    double lipschitz() const override { return lipschitz_; }
    double rounding() const override { return in_float_ ? 0x1p-24 : 0x1p-53; }

  private:
    const Map map_;
    const bool in_float_;
    const double lipschitz_;
};

const glm::dmat3 kTurn = [] {
    const glm::dvec3 a = glm::normalize(glm::dvec3(1.0, 2.0, 0.5)),
                     b = glm::normalize(glm::cross(a, glm::dvec3(0.0, 0.0, 1.0)));
    return glm::dmat3(a, b, glm::cross(a, b));
}();

double toBox(const glm::dvec3& p, const glm::dvec3& half) {
    const glm::dvec3 q = glm::abs(p) - half;
    return glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}
double ball(const glm::dvec3& p) {
    return glm::length(p) - 1.0;
}
/// Its edges curve where they cut the ball.
double ballMinusBox(const glm::dvec3& p) {
    return std::max(ball(p), -toBox(kTurn * (p - glm::dvec3(0.55, 0.5, 0.6)), glm::dvec3(0.65)));
}
double turnedBox(const glm::dvec3& p) {
    return toBox(kTurn * p, {0.7, 0.5, 0.9});
}

struct Made {
    sdf::SurfaceMesh mesh;
    sdf::Lattice lattice;
    sdf::MeshCounts counts;
    bool bound_holds = true;
};
Made meshOf(const sdf::PointField& field, bool dual, int resolution) {
    Made made;
    made.lattice = sdf::latticeOf(glm::dvec3(-1.25), glm::dvec3(1.25), resolution);
    made.mesh = sdf::meshOfPoints({field, made.lattice, dual}, made.counts, made.bound_holds);
    return made;
}

void expectClosed(const Made& made, std::int64_t euler) {
    const MeshQuality quality = qualityOf(made.mesh);
    EXPECT_TRUE(quality.closed());
    EXPECT_TRUE(quality.manifold());
    EXPECT_EQ(quality.euler, euler);
    ASSERT_EQ(made.mesh.normal_world.size(), made.mesh.triangles.size());
    ASSERT_EQ(made.mesh.material.size(), made.mesh.triangles.size());
}

double farthestVertex(const Made& made, const Map& map) {
    double farthest = 0.0;
    for (const glm::dvec3& p : made.mesh.position_world) farthest = std::max(farthest, std::abs(map(p)));
    return farthest;
}

TEST(PointMesh, BallsHaveTheirVerticesOnThem) {
    for (const bool in_float : {false, true})
        for (const bool dual : {true, false}) {
            SCOPED_TRACE(testing::Message() << (in_float ? "float" : "double") << (dual ? " dual" : ""));
            const TestField field(ball, in_float);
            const Made made = meshOf(field, dual, 48);
            expectClosed(made, 2);
            EXPECT_TRUE(made.bound_holds);
            // What is left of Newton's last step: 3 of them, from half a cell's sagitta at most, of a field
            // whose value is its distance; float: a value's and three coordinates' roundings.
            EXPECT_LE(farthestVertex(made, ball), in_float ? 4 * 0x1p-23 : 1e-13);
            // The octree leaves out what is far.
            EXPECT_GT(made.counts.pruned, 0u);
            EXPECT_LT(made.counts.bricks, 7u * 7u * 7u);
            // The volume of a ball, less what chords cut off: 2 pi r h^2 / 8 per direction, of chords h.
            const double volume = qualityOf(made.mesh).volume, exact = 4.0 / 3.0 * 3.14159265358979323846;
            EXPECT_LT(volume, exact);
            EXPECT_GT(volume, exact * (1.0 - 3.0 * made.lattice.step * made.lattice.step));
        }
}

TEST(PointMesh, NormalsAreTheSurfaces) {
    const TestField field(ball, true);
    const Made made = meshOf(field, true, 32);
    double least = 1.0;
    for (std::size_t t = 0; t < made.mesh.triangles.size(); ++t)
        for (int i = 0; i < 3; ++i)
            least = std::min(least,
                             glm::dot(made.mesh.normal_world[t][i],
                                      glm::normalize(made.mesh.position_world[made.mesh.triangles[t][i]])));
    // Asked 2 % of the way to the centre, or two reaches of an eighth; slopes' roundings are as many times
    // sqrt(2^-24) / 4, for two values and two places.
    const double inward = 0.02 * made.lattice.step + 0.25 * slopeReach(field, made.lattice);
    EXPECT_GT(least, 1.0 - 0.5 * std::pow(inward + 8.0 * 4.0 * 0x1p-14, 2));
}

TEST(PointMesh, SharpEdgesAndCornersStay) {
    for (const bool in_float : {false, true}) {
        SCOPED_TRACE(in_float ? "float" : "double");
        const Made made = meshOf(TestField(turnedBox, in_float), true, 40);
        expectClosed(made, 2);
        // Each of the eight corners is a vertex: exactly by planes; in float, whose slopes near an edge see
        // both of its sides, as far off the three planes as is let pass: 0.01 of a cell.
        const double most = in_float ? std::sqrt(3.0) * 0.01 * made.lattice.step : 1e-9;
        for (int n = 0; n < 8; ++n) {
            const glm::dvec3 corner =
                glm::transpose(kTurn) *
                (glm::dvec3(n & 1 ? 1 : -1, n & 2 ? 1 : -1, n & 4 ? 1 : -1) * glm::dvec3(0.7, 0.5, 0.9));
            double nearest = INFINITY;
            for (const glm::dvec3& p : made.mesh.position_world)
                nearest = std::min(nearest, glm::distance(p, corner));
            EXPECT_LE(nearest, most) << n;
        }
        // Normals are a face's, and not between two: but for slivers along edges, whose places are within a
        // slope's reach of the other face. With normals asked at 2 % alone it is one in 13.
        const double reach = slopeReach(TestField(turnedBox, in_float), made.lattice);
        std::size_t normals = 0, between = 0;
        for (std::size_t t = 0; t < made.mesh.triangles.size(); ++t) {
            const auto& p = made.mesh.position_world;
            const sdf::Triangle& v = made.mesh.triangles[t];
            const glm::dvec3 cross = glm::cross(p[v[1]] - p[v[0]], p[v[2]] - p[v[0]]);
            if (glm::length(cross) < 200.0 * reach * reach) continue;
            normals += 3;
            for (const glm::dvec3& normal : made.mesh.normal_world[t]) {
                const glm::dvec3 own = glm::abs(kTurn * normal);
                between += !(std::max({own.x, own.y, own.z}) > 1.0 - 1e-5);
            }
        }
        EXPECT_GT(normals, 3000u);
        EXPECT_LE(between, in_float ? normals / 100 : 0);
        std::printf("%zu of %zu normals are between two faces'\n", between, normals);
        // Marching cubes cut them off.
        const Made cubes = meshOf(TestField(turnedBox, in_float), false, 40);
        expectClosed(cubes, 2);
        EXPECT_LT(qualityOf(cubes.mesh).volume, qualityOf(made.mesh).volume);
        EXPECT_LT(std::abs(qualityOf(made.mesh).volume / (8.0 * 0.7 * 0.5 * 0.9) - 1.0),
                  0.1 * std::abs(qualityOf(cubes.mesh).volume / (8.0 * 0.7 * 0.5 * 0.9) - 1.0));
    }
}

TEST(PointMesh, CurvedSharpEdgesAreFoundWhereMarchingCubesCutsThemOff) {
    const TestField field(ballMinusBox, true);
    for (const int resolution : {33, 48, 64}) {
        double farthest[2];
        for (const bool dual : {false, true}) {
            const Made made = meshOf(field, dual, resolution);
            expectClosed(made, 2);
            if (!dual) {
                EXPECT_EQ(selfIntersections(made.mesh).value_or(0), 0u) << resolution;
            }
            const auto distance = distanceOf(made.mesh, field, made.lattice, 4);
            if (!distance) GTEST_SKIP() << "without CGAL nobody measures";
            EXPECT_GT(distance->surface_samples, 1000u);
            farthest[dual] = std::max(distance->mesh_to_surface, distance->surface_to_mesh);
        }
        EXPECT_LT(farthest[1], 0.5 * farthest[0]) << resolution;
    }
}

TEST(PointMesh, DistanceIsTheSagittaOfChords) {
    // Of a ball the mesh is within by less than its longest edge's sagitta, and outside by nothing.
    const TestField field(ball, false);
    const Made made = meshOf(field, true, 32);
    const auto distance = distanceOf(made.mesh, field, made.lattice, 4);
    if (!distance) GTEST_SKIP() << "without CGAL nobody measures";
    double closest = 1.0;
    for (const sdf::Triangle& t : made.mesh.triangles) {
        const auto& p = made.mesh.position_world;
        closest = std::min(closest, glm::length((p[t[0]] + p[t[1]] + p[t[2]]) / 3.0));
    }
    EXPECT_GE(distance->mesh_to_surface, 1.0 - closest - 1e-12);
    EXPECT_LE(distance->mesh_to_surface, 1.5 * (1.0 - closest));
    EXPECT_LE(distance->surface_to_mesh, 1.5 * (1.0 - closest));
    EXPECT_GE(distance->surface_to_mesh, 0.5 * (1.0 - closest));
}

TEST(PointMesh, ABoundThatLiesLeavesNothingOut) {
    // Values change four times as fast as is said: cells would be left out that the surface passes.
    const Map steep = [](const glm::dvec3& p) { return 4.0 * ballMinusBox(p); };
    const Made told = meshOf(TestField(steep, false, 4.0), true, 40),
               lied = meshOf(TestField(steep, false, 1.0), true, 40);
    EXPECT_TRUE(told.bound_holds);
    EXPECT_FALSE(lied.bound_holds);
    // There is an end to that.
    EXPECT_THROW(meshOf(TestField(steep, false, 1.0), true, 2048), sdf::SceneError);
    expectClosed(lied, 2);
    EXPECT_EQ(told.mesh.triangles.size(), lied.mesh.triangles.size());
    // In another order.
    EXPECT_NEAR(qualityOf(told.mesh).volume, qualityOf(lied.mesh).volume, 1e-12);
}

TEST(PointMesh, WhatReachesTheEndIsRefused) {
    for (const bool dual : {true, false}) {
        const TestField plane([](const glm::dvec3& p) { return p.y; }, false);
        EXPECT_THROW(meshOf(plane, dual, 16), sdf::SceneError);
        // All of the lattice is inside.
        const TestField full([](const glm::dvec3&) { return -100.0; }, false);
        EXPECT_THROW(meshOf(full, dual, 16), sdf::SceneError);
    }
}

TEST(PointMesh, BoundsAreFound) {
    const auto shifted = [](const glm::dvec3& p) { return ball(p - glm::dvec3(20.0, -3.0, 0.5)); };
    const auto box = sdf::boxOfPoints(TestField(shifted, true), 1000.0);
    ASSERT_TRUE(box);
    const double low[3] = {19.0, -4.0, -0.5};
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(box->low[axis], low[axis]);
        EXPECT_GE(box->high[axis], low[axis] + 2.0);
        // Cubes go when their centres' values say so: by half their diagonal, of sides of 1/64 of the box.
        EXPECT_GT(box->low[axis], low[axis] - 0.2);
        EXPECT_LT(box->high[axis], low[axis] + 2.2);
    }
    EXPECT_FALSE(sdf::boxOfPoints(TestField([](const glm::dvec3& p) { return p.y; }, true), 1000.0));
    const auto nothing = sdf::boxOfPoints(TestField([](const glm::dvec3&) { return 1e4; }, true), 1000.0);
    ASSERT_TRUE(nothing);
    EXPECT_TRUE(nothing->empty());
    const Map steep = [](const glm::dvec3& p) { return 4.0 * ball(p); };
    EXPECT_THROW(sdf::boxOfPoints(TestField(steep, true), 1000.0), sdf::SceneError);
}

TEST(PointMesh, SlopesAreOffByTheirRoundingsAlone) {
    const TestField in_float(ballMinusBox, true), in_double(ballMinusBox, false);
    const sdf::Lattice lattice = sdf::latticeOf(glm::dvec3(-1.25), glm::dvec3(1.25), 32);
    const glm::dvec3 p[] = {{-0.6, -0.5, -0.62}};
    const glm::dvec3 exact = glm::normalize(p[0]);
    const glm::dvec3 rough = slopesAt(in_float, p, slopeReach(in_float, lattice))[0],
                     fine = slopesAt(in_double, p, slopeReach(in_double, lattice))[0];
    // Two values' and two positions' roundings over twice the reach, on three axes.
    EXPECT_LE(glm::distance(rough, exact), 3 * 4 * 0x1p-24 * 1.25 / (2.0 * slopeReach(in_float, lattice)));
    EXPECT_LE(glm::distance(fine, exact), 3 * 4 * 0x1p-53 * 1.25 / (2.0 * slopeReach(in_double, lattice)));
}

}  // namespace
}  // namespace edgewise
