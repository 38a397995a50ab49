#include "tests/witness/random_scenes.h"

#include <array>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>

#include "tests/witness/dice.h"
#include "tests/witness/scene_builder.h"

namespace edgewise::witness {
namespace {

using glm::dvec2;
using glm::dvec3;

struct Maker {
    Dice dice;
    glm::ivec2 pixel;
    SceneBuilder builder;

    dvec2 sample() const { return dvec2(pixel) + 0.5; }
    dvec3 lift(dvec2 p, double z) const { return {p.x, p.y, z}; }

    DepthPlane randomPlane(double depth) { return {dice.uniform(-.1, .1), dice.uniform(-.1, .1), depth}; }

    void triangles(int count, double reach, double size) {
        for (int k = 0; k < count; ++k) {
            const dvec2 at = dice.around(sample(), reach);
            std::array<dvec3, 3> p;
            for (dvec3& corner : p) corner = lift(dice.around(at, size), dice.uniform(0, 1));
            builder.add(p);
        }
    }

    void quad(const std::array<dvec2, 4>& p, std::uint32_t plane, bool other_diagonal = false) {
        const int s = other_diagonal ? 1 : 0;
        builder.addOnPlane({p[s], p[s + 1], p[s + 2]}, plane);
        builder.addOnPlane({p[s], p[s + 2], p[(s + 3) % 4]}, plane);
    }

    void rectangle(dvec2 lo, dvec2 hi, std::uint32_t plane, bool other_diagonal = false) {
        quad({lo, dvec2(hi.x, lo.y), hi, dvec2(lo.x, hi.y)}, plane, other_diagonal);
    }

    /// Bar k lies over bar k + 1: its near end at the crossing with k + 1, its far end under k - 1.
    void ring() {
        const int bars = dice.integer(3, 5);
        const double turn = 2 * std::numbers::pi / bars, start = dice.angle(), reach = dice.uniform(0.3, 0.8);
        const dvec2 centre = dice.around(sample(), 0.3);
        for (int k = 0; k < bars; ++k) {
            const dvec2 out = unitVector(start + k * turn), along(-out.y, out.x);
            const dvec2 middle = centre + reach * out;
            const double half = dice.uniform(0.1, 0.25), length = 2.5;
            const DepthPlane tilt{along.x * 0.1, along.y * 0.1, 0};
            const dvec2 a = middle - length * along, b = middle + length * along;
            const auto z = [&](dvec2 p) { return glm::dot(p - middle, dvec2(tilt.dz_dx, tilt.dz_dy)); };
            const std::array<dvec2, 4> p = {a - half * out, b - half * out, b + half * out, a + half * out};
            const auto plane =
                builder.addPlane({lift(p[0], z(p[0])), lift(p[1], z(p[1])), lift(p[2], z(p[2]))});
            quad(p, plane, dice.coin());
        }
    }

    void torus(bool keep_back_faces) {
        constexpr int kAround = 10, kAcross = 6;
        const glm::dmat4 turned = glm::rotate(
            glm::dmat4(1), dice.angle(),
            glm::normalize(dvec3(dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(0.1, 1))));
        const dvec2 centre = dice.around(sample(), 0.5);
        std::array<std::array<dvec3, kAcross>, kAround> p;
        for (int i = 0; i < kAround; ++i)
            for (int j = 0; j < kAcross; ++j) {
                const dvec2 ring = unitVector(2 * std::numbers::pi * i / kAround);
                const dvec2 tube = unitVector(2 * std::numbers::pi * j / kAcross);
                const double r = 2 + 0.9 * tube.x;
                const dvec3 q = dvec3(turned * glm::dvec4(r * ring.x, r * ring.y, 0.9 * tube.y, 1));
                p[i][j] = lift(toGrid(dvec2(q) + centre), q.z);
            }
        const auto face = [&](const std::array<dvec3, 3>& t) {
            if (keep_back_faces || orientation(dvec2(t[0]), dvec2(t[1]), dvec2(t[2])) > 0) builder.add(t);
        };
        for (int i = 0; i < kAround; ++i)
            for (int j = 0; j < kAcross; ++j) {
                const int i1 = (i + 1) % kAround, j1 = (j + 1) % kAcross;
                face({p[i][j], p[i1][j], p[i1][j1]});
                face({p[i][j], p[i1][j1], p[i][j1]});
            }
    }

    void fan(int wedges, dvec2 hub, bool flat, double skip) {
        const double start = dice.angle();
        std::vector<dvec3> rim;
        for (int k = 0; k < wedges; ++k) {
            const double angle = start + 2 * std::numbers::pi * (k + dice.uniform(0, 0.8)) / wedges;
            rim.push_back(lift(toGrid(hub + dice.uniform(0.4, 3) * unitVector(angle)),
                               flat ? 0.5 : dice.uniform(0, 1)));
        }
        for (int k = 0; k < wedges; ++k)
            if (dice.uniform(0, 1) >= skip) builder.add({lift(hub, 0.5), rim[k], rim[(k + 1) % wedges]});
    }

    dvec2 specialPoint() { return dvec2(pixel) + 0.5 * dvec2(dice.integer(0, 2), dice.integer(0, 2)); }

    void bricks() {
        const auto plane = builder.addPlane(randomPlane(0.5));
        const dvec2 x = dice.uniform(0.4, 0.9) * unitVector(dice.coin() ? 0 : dice.angle()), y(-x.y, x.x);
        const dvec2 start = dice.around(sample(), 0.5);
        for (int row = -3; row < 3; ++row)
            for (int column = -3; column < 3; ++column) {
                const dvec2 at = start + double(row) * y + (column + 0.37 * (row & 1)) * x;
                if (dice.integer(0, 9)) quad({at, at + x, at + x + y, at + y}, plane, dice.coin());
            }
    }

    void duplicates() {
        const auto plane = builder.addPlane(randomPlane(0.5));
        const dvec2 at = dice.around(sample(), 0.4), x = dice.uniform(1, 2) * unitVector(dice.angle()),
                    y(-x.y, x.x);
        for (int copy = 0; copy < 3; ++copy) quad({at - x, at - y, at + x, at + y}, plane, copy & 1);
        for (int decal = 0; decal < 3; ++decal) {
            const dvec2 p = dice.around(at, 0.6), u = 0.4 * unitVector(dice.angle()), v(-u.y, u.x);
            quad({p - u, p - v, p + u, p + v}, plane, dice.coin());
        }
        triangles(2, 1, 2);
    }

    void sliver() {
        const dvec2 a = dice.around(sample(), 2.5), along = dice.uniform(0.5, 6) * unitVector(dice.angle());
        const dvec2 across = dice.magnitude(-5, -2) / glm::length(along) * dvec2(-along.y, along.x);
        const double z = dice.uniform(0.6, 1);
        builder.add({lift(a, z), lift(a + along, z + dice.uniform(-.1, .1)),
                     lift(a + dice.uniform(0, 1) * along + across, z)});
    }

    void axisAligned() {
        for (int k = 0; k < 6; ++k) {
            const dvec2 lo = dvec2(pixel) + 0.5 * dvec2(dice.integer(-4, 2), dice.integer(-4, 2));
            const dvec2 size = 0.5 * dvec2(dice.integer(1, 6), dice.integer(1, 6));
            rectangle(lo, lo + size,
                      builder.addPlane(dice.coin() ? randomPlane(dice.uniform(0, 1))
                                                   : DepthPlane{0, 0, dice.integer(1, 3) * 0.25}),
                      dice.coin());
        }
    }

    void nearCoincident() {
        const DepthPlane base = randomPlane(0.5);
        for (int k = 0; k < 6; ++k) {
            const double apart = k == 0 ? 0 : dice.magnitude(-13, -6);
            const auto plane = builder.addPlane(DepthPlane{base.dz_dx + apart * dice.uniform(-1, 1),
                                                           base.dz_dy + apart * dice.uniform(-1, 1),
                                                           base.z_anchor + apart * dice.uniform(-1, 1)});
            const dvec2 p = dice.around(sample(), 0.5);
            const double start = dice.angle(), size = dice.uniform(1, 4);
            builder.addOnPlane({p + size * unitVector(start), p + size * unitVector(start + 2.1),
                                p + size * unitVector(start + 4.2)},
                               plane);
        }
    }

    void tiny() {
        for (int k = 0; k < 12; ++k) {
            const dvec2 at = k % 3 ? dice.around(sample(), 0.4) : specialPoint();
            std::array<dvec3, 3> p;
            for (dvec3& corner : p) corner = lift(dice.around(at, 1e-4), dice.uniform(1, 2));
            builder.add(p);
        }
        triangles(2, 1, 2);
    }

    void huge() {
        for (int k = 0; k < 7; ++k) {
            const dvec2 through = dice.around(sample(), 1.5);
            const double angle = dice.angle();
            const dvec2 far[2] = {unitVector(angle), unitVector(angle + dice.uniform(0.3, 2.9))};
            builder.add({lift(through, dice.uniform(0, 1)),
                         lift(through + dice.magnitude(2, 5.99) * far[0], dice.uniform(-50, 50)),
                         lift(through + dice.magnitude(2, 5.99) * far[1], dice.uniform(-50, 50))});
        }
    }

    void mixed() {
        triangles(3, 1, 2);
        sliver();
        fan(5, specialPoint(), false, 0.2);
        axisAligned();
        nearCoincident();
    }
};

void fill(Maker& make, SceneKind kind, int extent) {
    switch (kind) {
        case SceneKind::kPiercing:
            return make.triangles(10, 1.5, 2);
        case SceneKind::kCyclic:
            return make.ring();
        case SceneKind::kClosedMesh:
            return make.torus(false);
        case SceneKind::kClosedMeshBothSides:
            return make.torus(true);
        case SceneKind::kFan:
            return make.fan(make.dice.integer(3, 12), make.specialPoint(), make.dice.coin(), 0.15);
        case SceneKind::kTJunctions:
            return make.bricks();
        case SceneKind::kCoplanarDuplicates:
            return make.duplicates();
        case SceneKind::kSlivers:
            make.triangles(2, 1, 3);
            for (int k = 0; k < 10; ++k) make.sliver();
            return;
        case SceneKind::kAxisAligned:
            return make.axisAligned();
        case SceneKind::kNearCoincident:
            return make.nearCoincident();
        case SceneKind::kTiny:
            return make.tiny();
        case SceneKind::kHuge:
            return make.huge();
        case SceneKind::kStar:
            return make.fan(extent, make.specialPoint(), true, 0);
        case SceneKind::kMixed:
            return make.mixed();
    }
}

}  // namespace

std::vector<SceneKind> allSceneKinds() {
    std::vector<SceneKind> kinds;
    for (int k = 0; k <= int(SceneKind::kMixed); ++k) kinds.push_back(SceneKind(k));
    return kinds;
}

std::string nameOf(SceneKind kind) {
    constexpr std::array kNames = {"piercing",
                                   "cyclic",
                                   "closed_mesh",
                                   "closed_mesh_both_sides",
                                   "fan",
                                   "t_junctions",
                                   "coplanar_duplicates",
                                   "slivers",
                                   "axis_aligned",
                                   "near_coincident",
                                   "tiny",
                                   "huge",
                                   "star",
                                   "mixed"};
    return kNames[std::size_t(kind)];
}

RandomScene makeRandomScene(SceneKind kind, std::uint64_t seed, int extent) {
    Dice dice(seed * 64 + std::uint64_t(kind));
    const glm::ivec2 pixel{dice.integer(4, 1500), dice.integer(4, 1000)};
    const glm::dvec2 anchor = dice.coin() ? dice.around(glm::dvec2(pixel), 4) : glm::dvec2(0);
    Maker make{dice, pixel, SceneBuilder(anchor)};
    fill(make, kind, extent);
    RandomScene result{kind, seed, make.builder.scene(), pixel, {pixel}};
    for (int k = 0; k < 3; ++k)
        result.pixels.push_back(pixel + glm::ivec2(dice.integer(-2, 2), dice.integer(-2, 2)));
    return result;
}

RandomScene magnified(RandomScene random, int factor) {
    if (random.kind == SceneKind::kHuge) return random;
    const dvec2 centre(random.centre);
    const auto moved = [&](dvec2 p) { return centre + double(factor) * (p - centre); };
    for (ScreenTriangle& t : random.scene.triangles)
        for (dvec2& p : t.p_px) p = moved(p);
    for (DepthPlane& z : random.scene.planes) z.dz_dx /= factor, z.dz_dy /= factor;
    random.scene.anchor_px = moved(random.scene.anchor_px);
    return random;
}

}  // namespace edgewise::witness
