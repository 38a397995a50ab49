#include "pipeline/facing.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdio>
#include <random>

#include "tests/pipeline/test_scene.h"

namespace edgewise {
namespace {

using boost::multiprecision::cpp_rational;
using Exact = std::array<cpp_rational, 3>;

/// Through both maps, exactly.
Exact toEye(const glm::dmat4& camera_from_world, const glm::dmat4& world_from_file, const glm::vec3& p) {
    Exact at{p.x, p.y, p.z};
    for (const glm::dmat4* m : {&world_from_file, &camera_from_world}) {
        Exact next;
        for (int row = 0; row < 3; ++row) {
            next[row] = (*m)[3][row];
            for (int k = 0; k < 3; ++k) next[row] += cpp_rational((*m)[k][row]) * at[k];
        }
        at = next;
    }
    return at;
}

/// The sign of n . a for the eye, of n.z for a parallel view: positive where the front is seen.
int exactSide(const std::array<Exact, 3>& p, bool perspective) {
    Exact u, v, n;
    for (int k = 0; k < 3; ++k) u[k] = p[1][k] - p[0][k], v[k] = p[2][k] - p[0][k];
    for (int k = 0; k < 3; ++k) n[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    const cpp_rational d = n[0] * p[0][0] + n[1] * p[0][1] + n[2] * p[0][2];
    return perspective ? -d.sign() : n[2].sign();
}

struct Maps {
    glm::dmat4 world_from_file{1.0}, camera_from_world{1.0};
};

/// Both lead the file's origin to the eye exactly, and, for a parallel view, its z axis to the eye's.
Maps makeMaps(std::mt19937& random, bool perspective, bool moved) {
    std::uniform_real_distribution<double> spread(-1.0, 1.0);
    Maps maps;
    for (glm::dmat4* m : {&maps.world_from_file, &maps.camera_from_world})
        for (int k = 0; k < 3; ++k)
            for (int row = 0; row < 3; ++row)
                (*m)[k][row] = perspective || k < 2 || row == 2 ? spread(random) : 0.0;
    if (!moved) return maps;
    // There and back by a power of two, in which the file's small coordinates lose their digits.
    maps.world_from_file = glm::dmat4(1.0);
    maps.world_from_file[3].x = 1024.0;
    for (int row = 0; row < 3; ++row)
        maps.camera_from_world[3][row] = -1024.0 * maps.camera_from_world[0][row];
    return maps;
}

/// A triangle in the plane x = 0, which the eye sees edge-on, but for one corner: its normal leans by `off`.
std::array<glm::vec3, 3> nearlyEdgeOn(std::mt19937& random, float off) {
    std::uniform_real_distribution<float> spread(-1.0f, 1.0f);
    std::array<glm::vec3, 3> corners;
    for (glm::vec3& p : corners) p = {0.0f, spread(random), spread(random)};
    corners[random() % 3].x = off;
    return corners;
}

int sideBy(const Maps& maps, bool perspective, const std::array<glm::vec3, 3>& file) {
    Geometry geometry = test::makeGeometry({file}, maps.world_from_file);
    std::array<glm::dvec3, 3> eye;
    for (int k = 0; k < 3; ++k)
        eye[k] = glm::dvec3(maps.camera_from_world * glm::dvec4(geometry.position_world[k], 1.0));
    ScreenMap map;
    map.perspective = perspective, map.scale_px = 1024.0;
    const Facing facing(test::makeScene({geometry}), maps.camera_from_world, map);
    return facing.side(0, eye[0], eye[1], eye[2]);
}

int truth(const Maps& maps, bool perspective, const std::array<glm::vec3, 3>& file) {
    std::array<Exact, 3> exact;
    for (int k = 0; k < 3; ++k) exact[k] = toEye(maps.camera_from_world, maps.world_from_file, file[k]);
    return exactSide(exact, perspective);
}

struct Seen {
    std::size_t sure = 0, unsure = 0, edge_on = 0;
};

Seen judge(bool perspective, bool moved) {
    std::mt19937 random(5);
    Seen seen;
    for (int i = 0; i < 4000; ++i) {
        const Maps maps = makeMaps(random, perspective, moved);
        const float off = i % 40 == 0 ? 0.0f : std::ldexp(i % 2 ? 1.0f : -1.0f, -(i % 80));
        const auto file = nearlyEdgeOn(random, off);
        const int side = sideBy(maps, perspective, file), exact = truth(maps, perspective, file);
        if (side != 0) {
            EXPECT_EQ(side, exact) << "triangle " << i << ", off by " << off;
        }
        ++(side != 0 ? seen.sure : seen.unsure);
        seen.edge_on += exact == 0;
    }
    std::printf("seed 5, %s%s: %zu sure, %zu not, %zu edge-on\n", perspective ? "perspective" : "parallel",
                moved ? ", moved" : "", seen.sure, seen.unsure, seen.edge_on);
    return seen;
}

/// Triangles from 1 to 2^-79 off being seen edge-on, and some exactly so.
TEST(Facing, IsRightWhereItIsSure) {
    for (const bool perspective : {true, false})
        for (const bool moved : {false, true}) {
            const Seen seen = judge(perspective, moved);
            EXPECT_GT(seen.sure, 1000u);
            EXPECT_GT(seen.unsure, 1000u);
            EXPECT_GE(seen.edge_on, 100u);
        }
}

}  // namespace
}  // namespace edgewise
