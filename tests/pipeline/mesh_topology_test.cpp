// Meshes have as many parts and handles as the solid has, sharp and thin as it may be there.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/mat3x3.hpp>
#include <numeric>
#include <random>

#include "pipeline/judge/mesh_quality.h"
#include "pipeline/polygonize.h"
#include "sdf/field_scene.h"
#include "sdf/mesh_edit.h"

namespace edgewise {
namespace {

using sdf::Kind;

struct TurnedBox {
    glm::dvec3 size, axis, centre;
    double degrees;
};

sdf::Tree ballMinus(const TurnedBox& b) {
    sdf::Tree tree;
    const auto ball = tree.add(Kind::kSphere, {1.0}),
               box = tree.add(Kind::kBox, {b.size.x, b.size.y, b.size.z});
    const auto turned = tree.add(Kind::kRotate, {b.axis.x, b.axis.y, b.axis.z, b.degrees}, {box});
    const auto moved = tree.add(Kind::kTranslate, {b.centre.x, b.centre.y, b.centre.z}, {turned});
    tree.root = tree.add(Kind::kDifference, {}, {ball, moved});
    return tree;
}

Polygonized dualMesh(const sdf::Tree& tree, int resolution) {
    auto field = std::make_shared<sdf::FieldScene>();
    field->tree = tree;
    field->materials.resize(1);
    Scene scene;
    scene.source = "test";
    scene.field = std::move(field);
    PolygonizeOptions options;
    options.resolution = resolution;
    return polygonize(scene, options);
}

class Sets {
  public:
    explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::size_t of(std::size_t x) const { return parent_[x] == x ? x : of(parent_[x]); }
    void join(std::size_t a, std::size_t b) { parent_[of(a)] = of(b); }
    std::size_t count() const {
        std::size_t n = 0;
        for (std::size_t x = 0; x < parent_.size(); ++x) n += parent_[x] == x;
        return n;
    }

  private:
    std::vector<std::size_t> parent_;
};

/// The unit ball without a box, in the box's frame: the centre of the ball, and half the box's sides. What is
/// left shrinks onto the part K of the sphere outside the box: it has K's parts, and its surface twice K's
/// Euler number. K and the rest of the sphere lie on either side of the closed curves in which the sphere
/// passes the box's surface, so that K's Euler number is twice its parts less the curves.
class BallMinusBox {
  public:
    explicit BallMinusBox(const TurnedBox& b) : half_(0.5 * b.size) {
        const glm::dvec3 n = glm::normalize(b.axis);
        const double angle = b.degrees * glm::pi<double>() / 180.0, c = std::cos(angle), s = std::sin(angle);
        // Rodrigues, the other way round.
        const glm::dvec3 p = -b.centre;
        centre_ = c * p - s * glm::cross(n, p) + (1.0 - c) * glm::dot(n, p) * n;
    }
    std::size_t parts() const {
        std::array<double, 6> beyond;  // of the faces' planes, from the ball's centre
        std::vector<std::size_t> caps;
        for (std::size_t f = 0; f < 6; ++f) {
            beyond[f] = half_[f / 2] - (f % 2 ? 1.0 : -1.0) * centre_[f / 2];
            if (beyond[f] < 1.0) caps.push_back(f);
        }
        Sets sets(caps.size());
        for (std::size_t i = 0; i < caps.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const double d = beyond[caps[i]], e = beyond[caps[j]];
                if (caps[i] / 2 != caps[j] / 2 && (d <= 0.0 || e <= 0.0 || d * d + e * e <= 1.0))
                    sets.join(i, j);
            }
        return sets.count();
    }
    /// No neck, gap or hole is much thinner.
    double thinnest() const {
        double least = 1e300;
        for (int n = 0; n < 27; ++n) {  // faces, edges' lines and corners of the box
            glm::dvec3 off(0.0);
            for (int axis = 0, code = n; axis < 3; ++axis, code /= 3)
                if (code % 3 > 0) off[axis] = (code % 3 == 1 ? -half_[axis] : half_[axis]) - centre_[axis];
            if (n > 0) least = std::min(least, std::abs(glm::length(off) - 1.0));
        }
        return least;
    }
    std::int64_t euler() const {
        return 4 * static_cast<std::int64_t>(parts()) - 2 * static_cast<std::int64_t>(curves());
    }

  private:
    struct Crossing {
        glm::dvec3 place;
        std::array<std::size_t, 2> faces;
    };
    /// Where the sphere passes the box's twelve edges.
    std::vector<Crossing> crossings() const {
        std::vector<Crossing> found;
        for (int axis = 0; axis < 3; ++axis)
            for (int n = 0; n < 4; ++n) {
                const int u = (axis + 1) % 3, v = (axis + 2) % 3;
                glm::dvec3 p = centre_;
                p[u] = n & 1 ? half_[u] : -half_[u], p[v] = n & 2 ? half_[v] : -half_[v];
                const double off2 = 1.0 - glm::dot(p - centre_, p - centre_);
                if (off2 <= 0.0) continue;
                for (const double side : {-1.0, 1.0}) {
                    glm::dvec3 at = p;
                    at[axis] = centre_[axis] + side * std::sqrt(off2);
                    if (std::abs(at[axis]) < half_[axis])
                        found.push_back({at, {std::size_t(2 * u + (n & 1)), std::size_t(2 * v + (n >> 1))}});
                }
            }
        return found;
    }
    std::size_t curves() const {
        const std::vector<Crossing> all = crossings();
        Sets sets(all.size());
        std::size_t whole = 0;
        for (std::size_t f = 0; f < 6; ++f) {
            const int axis = int(f / 2), u = (axis + 1) % 3, v = (axis + 2) % 3;
            const double plane = f % 2 ? half_[axis] : -half_[axis], off = plane - centre_[axis];
            if (std::abs(off) >= 1.0) continue;
            const double radius = std::sqrt(1.0 - off * off);
            const auto within = [&](double angle) {
                return std::abs(centre_[u] + radius * std::cos(angle)) < half_[u] &&
                       std::abs(centre_[v] + radius * std::sin(angle)) < half_[v];
            };
            std::vector<std::pair<double, std::size_t>> on;
            for (std::size_t n = 0; n < all.size(); ++n)
                if (all[n].faces[0] == f || all[n].faces[1] == f)
                    on.push_back({std::atan2(all[n].place[v] - centre_[v], all[n].place[u] - centre_[u]), n});
            std::sort(on.begin(), on.end());
            if (on.empty()) whole += within(0.3);
            for (std::size_t n = 0; n < on.size(); ++n) {
                const bool last = n + 1 == on.size();
                const double next = last ? on[0].first + 2.0 * glm::pi<double>() : on[n + 1].first;
                if (within(0.5 * (on[n].first + next))) sets.join(on[n].second, on[last ? 0 : n + 1].second);
            }
        }
        return whole + sets.count();
    }

    glm::dvec3 half_, centre_;
};

void expectShape(const Polygonized& made, std::size_t parts, std::int64_t euler, const std::string& what) {
    const MeshQuality quality = qualityOf(made.mesh);
    EXPECT_TRUE(quality.closed() && quality.manifold()) << what;
    EXPECT_EQ(quality.components, parts) << what;
    EXPECT_EQ(quality.euler, euler) << what;
    EXPECT_EQ(selfIntersections(made.mesh).value_or(0), 0u) << what;
}

TEST(MeshTopology, TheWitnessKnowsSimpleCases) {
    const auto of = [](const glm::dvec3& size, const glm::dvec3& at) {
        const BallMinusBox solid({size, {1, 2, 3}, at, 0.0});
        return std::pair(solid.parts(), solid.euler());
    };
    EXPECT_EQ(of({1, 1, 1}, {1, 0, 0}), std::pair(std::size_t(1), std::int64_t(2)));      // a notch
    EXPECT_EQ(of({0.5, 0.5, 4}, {0, 0, 0}), std::pair(std::size_t(1), std::int64_t(0)));  // a hole through it
    EXPECT_EQ(of({0.5, 4, 4}, {0, 0, 0}), std::pair(std::size_t(2), std::int64_t(4)));    // two halves
    EXPECT_EQ(of({1.6, 1.6, 1.6}, {0, 0, 0}), std::pair(std::size_t(6), std::int64_t(12)));  // six caps
    // Six caps joined at twelve places: a cage.
    EXPECT_EQ(of({1.3, 1.3, 1.3}, {0, 0, 0}), std::pair(std::size_t(1), std::int64_t(-12)));
}

TEST(MeshTopology, BallsWithoutTurnedBoxesHaveNoIslandsAndNoHoles) {
    constexpr std::uint64_t kSeed = 10;
    std::mt19937_64 random(kSeed);
    std::uniform_real_distribution<double> side(0.7, 1.4), at(-0.6, 0.6), turn(-1.0, 1.0), degrees(0.0, 90.0);
    const auto three = [&](auto& of) { return glm::dvec3(of(random), of(random), of(random)); };
    std::uint64_t turned = 0;
    constexpr int kResolution = 48;
    for (int n = 0; n < 4;) {
        const TurnedBox box{three(side), three(turn), three(at), degrees(random)};
        const BallMinusBox solid(box);
        if (solid.thinnest() < 2.0 * 2.0 / kResolution) continue;  // two cells
        ++n;
        const Polygonized made = dualMesh(ballMinus(box), kResolution);
        expectShape(made, solid.parts(), solid.euler(),
                    "seed " + std::to_string(kSeed) + ", " + std::to_string(n));
        turned += made.counts.turned;
    }
    EXPECT_GT(turned, 100u);  // wedges were thinner than cells
    // The solid of the bars.
    const TurnedBox box{glm::dvec3(1.3), {1.0, 2.0, 0.5}, {0.55, 0.5, 0.6}, 38.0};
    for (const int resolution : {40, 64}) {
        const Polygonized made = dualMesh(ballMinus(box), resolution);
        expectShape(made, 1, 2, "A");
        if (const auto distance = distanceOf(made.mesh, sdf::lower(ballMinus(box)), made.lattice, true, 4)) {
            // Edges' middles are within a hundredth of a cell of sharp edges, cells are divided from 0.016
            // on, and thinning adds as much again at most.
            EXPECT_LE(distance->surface_to_mesh, 0.032 * made.lattice.step) << resolution;
        }
    }
}

TEST(MeshTopology, SeveralSolidsStaySeveral) {
    const auto two = [](double radius, double apart) {
        sdf::Tree tree;
        const auto a = tree.add(Kind::kSphere, {1.0}), b = tree.add(Kind::kSphere, {radius});
        const auto moved = tree.add(Kind::kTranslate, {1.0 + radius + apart, 0.1, 0.0}, {b});
        tree.root = tree.add(Kind::kUnion, {}, {a, moved});
        return tree;
    };
    expectShape(dualMesh(two(1.0, 0.3), 32), 2, 4, "two balls");
    // As small as cells: a part by itself all the same.
    const Polygonized small = dualMesh(two(0.06, 0.1), 48);
    expectShape(small, 2, 4, "a ball and a small one");
    EXPECT_EQ(small.counts.debris, 0u);
    // They touch along a crease.
    expectShape(dualMesh(two(0.8, -0.05), 40), 1, 2, "two balls that meet");
}

TEST(MeshEdit, NeverLetsTrianglesMeet) {
    sdf::SurfaceMesh mesh;  // an octahedron
    mesh.position_world = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    sdf::MeshEdit edit(mesh, 0.5);
    EXPECT_FALSE(edit.move(4, {1.5, 1.5, -0.5}));  // through a face below
    EXPECT_EQ(edit.at(4).z, 1.0);
    EXPECT_TRUE(edit.move(4, {0, 0, 2}));
    sdf::Diamond d;
    ASSERT_TRUE(edit.diamondOf(0, 2, d));
    EXPECT_FALSE(edit.divide(d, {-3, -3, 0}));
    EXPECT_TRUE(edit.divide(d, {0.7, 0.7, 0.1}));
    ASSERT_TRUE(edit.diamondOf(1, 4, d));
    EXPECT_TRUE(edit.turn(d));
    EXPECT_FALSE(edit.isEdge(1, 4));
    EXPECT_TRUE(edit.collapse(6, 0));
    edit.compact();
    const MeshQuality quality = qualityOf(mesh);
    EXPECT_TRUE(quality.closed() && quality.manifold());
    EXPECT_EQ(quality.euler, 2);
    EXPECT_EQ(quality.triangles, 8u);
    EXPECT_EQ(selfIntersections(mesh).value_or(0), 0u);
}

}  // namespace
}  // namespace edgewise
