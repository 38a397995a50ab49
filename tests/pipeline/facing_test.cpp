#include "pipeline/facing.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
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
    return perspective ? -(n[0] * p[0][0] + n[1] * p[0][1] + n[2] * p[0][2]).sign() : n[2].sign();
}

struct Seen {
    std::size_t sure = 0, unsure = 0, nearly_edge_on = 0;
};

/// Triangles whose planes pass the eye at `distance` times their size, or at none.
Seen judge(std::mt19937& random, bool perspective, double distance) {
    std::uniform_real_distribution<double> spread(-1.0, 1.0);
    Seen seen;
    for (int i = 0; i < 400; ++i) {
        glm::dmat4 world_from_file(1.0), camera_from_world(1.0);
        for (int k = 0; k < 4; ++k)
            for (int row = 0; row < 3; ++row) {
                world_from_file[k][row] = spread(random) * (k == 3 ? 1e3 : 1.0);
                camera_from_world[k][row] = spread(random) * (k == 3 ? 1e3 : 1.0);
            }
        const glm::dmat4 file_from_eye = glm::inverse(camera_from_world * world_from_file);
        const double size = std::ldexp(1.0, i % 12 - 6);
        const glm::dvec3 a(spread(random), spread(random), -5.0 - spread(random));
        const glm::dvec3 along = perspective ? a : glm::dvec3(0, 0, 1);
        const glm::dvec3 off(distance * spread(random), distance * spread(random), 0.0);
        const glm::dvec3 b = a + size * (along + off), c = a + size * glm::dvec3(spread(random), 1.0, 0.0);
        std::array<glm::vec3, 3> file;
        for (int k = 0; k < 3; ++k)
            file[k] = glm::vec3(file_from_eye * glm::dvec4(k == 0 ? a : k == 1 ? b : c, 1.0));
        Geometry geometry = test::makeGeometry({file});
        geometry.world_from_file = world_from_file;
        std::array<glm::dvec3, 3> eye;
        std::array<Exact, 3> exact;
        for (int k = 0; k < 3; ++k) {
            geometry.position_world[k] =
                glm::dvec3(world_from_file * glm::dvec4(geometry.position_file[k], 1.0));
            eye[k] = glm::dvec3(camera_from_world * glm::dvec4(geometry.position_world[k], 1.0));
            exact[k] = toEye(camera_from_world, world_from_file, geometry.position_file[k]);
        }
        ScreenMap map;
        map.perspective = perspective, map.scale_px = 1024.0;
        const int side =
            Facing(test::makeScene({geometry}), camera_from_world, map).side(0, eye[0], eye[1], eye[2]);
        const int truth = exactSide(exact, perspective);
        if (side != 0) EXPECT_EQ(side, truth) << "triangle " << i;
        ++(side != 0 ? seen.sure : seen.unsure);
    }
    return seen;
}

TEST(Facing, IsRightWhereItIsSure) {
    std::mt19937 random(5);
    for (const bool perspective : {true, false}) {
        std::size_t sure = 0, unsure = 0;
        for (int e = 0; e >= -60; e -= 4) {
            const Seen seen = judge(random, perspective, std::ldexp(1.0, e));
            sure += seen.sure, unsure += seen.unsure;
        }
        std::printf("seed 5, %s: %zu sure, %zu not\n", perspective ? "perspective" : "parallel", sure,
                    unsure);
        EXPECT_GT(sure, 1000u);
        EXPECT_GT(unsure, 1000u);
    }
}

}  // namespace
}  // namespace edgewise
