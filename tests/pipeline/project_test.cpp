#include "pipeline/project.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <random>
#include <set>
#include <tuple>

#include "pipeline/grid_orientation.h"
#include "pipeline/screen_map.h"
#include "tests/pipeline/test_scene.h"

namespace edgewise {
namespace {

using test::Corners;

/// Triangles around the eye: many reach behind it, through the near plane, beyond the guard band.
std::vector<Corners> aroundTheEye(std::mt19937& random, int count) {
    std::uniform_real_distribution<float> side(-4.0f, 4.0f), depth(-6.0f, 3.0f);
    std::vector<Corners> triangles(count);
    for (Corners& t : triangles)
        for (glm::vec3& p : t) p = {side(random), side(random), depth(random)};
    return triangles;
}

double depthAt(const ScreenScene& screen, const ScreenTriangle& t, glm::dvec2 p) {
    const DepthPlane& z = screen.planes[t.plane];
    return z.dz_dx * (p.x - screen.anchor_px.x) + z.dz_dy * (p.y - screen.anchor_px.y) + z.z_anchor;
}

bool covers(const ScreenTriangle& t, glm::dvec2 p) {
    for (int k = 0; k < 3; ++k)
        if (gridOrientation(t.p_px[k], t.p_px[(k + 1) % 3], p) < 0) return false;
    return true;
}

TEST(Project, PlacesVerticesByHand) {
    // 90 degrees on 8 rows: x_px = W/2 + 4 x/w, y_px = 4 - 4 y/w.
    const Scene scene = test::makeScene({test::makeGeometry({{{{-1, -1, -2}, {1, -1, -2}, {0, 1, -4}}}})});
    const ScreenScene screen = project(scene, test::makePerspective(), test::makeFilm(16, 8));
    ASSERT_EQ(screen.triangles.size(), 1u);
    const std::set<std::pair<double, double>> expected{{6, 6}, {10, 6}, {8, 3}};
    std::set<std::pair<double, double>> got;
    for (const auto& p : screen.triangles[0].p_px) got.insert({p.x, p.y});
    EXPECT_EQ(got, expected);
    EXPECT_DOUBLE_EQ(depthAt(screen, screen.triangles[0], {8, 6}), 1.0 / 2.0);
    EXPECT_DOUBLE_EQ(depthAt(screen, screen.triangles[0], {8, 3}), 1.0 / 4.0);
}

TEST(Project, OrthographicDepthIsEyeZ) {
    const Scene scene = test::makeScene({test::makeGeometry({{{{-1, -1, -2}, {1, -1, -2}, {0, 1, -4}}}})});
    const ScreenScene screen = project(scene, test::makeOrthographic(2.0), test::makeFilm(16, 8));
    ASSERT_EQ(screen.triangles.size(), 1u);
    EXPECT_DOUBLE_EQ(depthAt(screen, screen.triangles[0], {8, 6}), -2.0);
    EXPECT_DOUBLE_EQ(depthAt(screen, screen.triangles[0], {8, 2}), -4.0);
}

TEST(Project, MovesByWholePixelsExactly) {
    std::mt19937 random(5);
    const Scene scene = test::makeScene({test::makeGeometry(aroundTheEye(random, 300))});
    Film film = test::makeFilm(100, 75), shifted = film, offset = film;
    film.shift_px = {0.3, -0.7};
    shifted.shift_px = film.shift_px - glm::dvec2(13, -5);
    offset.shift_px = film.shift_px;
    offset.debug_offset_px = {13, -5};
    const auto camera = test::makePerspective();
    const ScreenScene plain = project(scene, camera, film), moved = project(scene, camera, offset);
    ASSERT_EQ(plain.triangles.size(), moved.triangles.size());
    ASSERT_EQ(plain.anchor_px + glm::dvec2(13, -5), moved.anchor_px);
    for (std::size_t i = 0; i < plain.triangles.size(); ++i)
        for (int k = 0; k < 3; ++k)
            EXPECT_EQ(plain.triangles[i].p_px[k] + glm::dvec2(13, -5), moved.triangles[i].p_px[k]);
    for (std::size_t i = 0; i < plain.planes.size(); ++i)
        EXPECT_EQ(std::memcmp(&plain.planes[i], &moved.planes[i], sizeof(DepthPlane)), 0);
}

/// Every piece is on the grid, in the band, oriented, listed with its owner; every triangle is counted once.
void expectWellFormed(const ScreenScene& screen, const ScreenPieces& pieces) {
    for (const ScreenTriangle& t : screen.triangles) {
        ASSERT_GT(gridOrientation(t.p_px[0], t.p_px[1], t.p_px[2]), 0);
        for (const auto& p : t.p_px)
            for (const double x : {p.x, p.y}) {
                ASSERT_EQ(x * 0x1p32, std::nearbyint(x * 0x1p32));
                ASSERT_LE(std::fabs(x), kGuardBandPx);
            }
    }
    for (Owner owner = 0; owner + 1 < pieces.first.size(); ++owner)
        for (const ScreenTriangle& t : pieces.of(owner, screen)) ASSERT_EQ(t.owner, owner);
    const ProjectionCounts& c = pieces.counts;
    EXPECT_EQ(c.triangles, c.no_area + c.culled + c.outside + c.vanished + c.visible);
}

struct Hit {
    bool inside = false;
    long double margin = 0;  ///< the smallest barycentric, or the distance to the near plane
    long double w = 0;
};

/// Ray against triangle in eye space, in long double.
Hit trace(const Corners& t, long double u, long double v, long double znear) {
    using V = glm::vec<3, long double>;
    const V a(t[0]), b(t[1]), c(t[2]), ray(u, v, -1.0L);
    const V e = b - a, f = c - a, n = glm::cross(e, f);
    const long double w = glm::dot(n, a) / glm::dot(n, ray);
    const V p = ray * w - a;
    const long double area = glm::dot(n, n);
    const long double by = glm::dot(glm::cross(p, f), n) / area, cy = glm::dot(glm::cross(e, p), n) / area;
    Hit hit{false, std::min({by, cy, 1 - by - cy, w - znear}), w};
    hit.inside = hit.margin >= 0;
    return hit;
}

TEST(Project, AgreesWithRaysAroundTheEye) {
    std::mt19937 random(17);
    const auto triangles = aroundTheEye(random, 400);
    const Scene scene = test::makeScene({test::makeGeometry(triangles)});
    const auto camera = test::makePerspective();
    const Film film = test::makeFilm(64, 48);
    ScreenPieces pieces;
    const ScreenScene screen = project(scene, camera, film, pieces);
    expectWellFormed(screen, pieces);
    std::uniform_real_distribution<double> x(0, 64), y(0, 48);
    std::size_t hits = 0, behind = 0, unclear = 0;
    double worst = 0;
    for (Owner owner = 0; owner < triangles.size(); ++owner) {
        const bool reaches_behind =
            std::max({triangles[owner][0].z, triangles[owner][1].z, triangles[owner][2].z}) > 0;
        for (int i = 0; i < 200; ++i) {
            const glm::dvec2 p(x(random), y(random));
            const Hit hit = trace(triangles[owner], (p.x - 32) / 24.0L, (24 - p.y) / 24.0L, 0.125L);
            // Vertices are off by 2^-33 px and the ray's own margin is relative: nearer than this either may
            // be right.
            if (std::fabs(hit.margin) < 0x1p-28L) {
                ++unclear;
                continue;
            }
            bool covered = false;
            for (const ScreenTriangle& t : pieces.of(owner, screen)) covered |= covers(t, p);
            ASSERT_EQ(covered, hit.inside)
                << owner << " at " << p.x << ", " << p.y << " margin " << double(hit.margin);
            if (!covered) continue;
            ++hits;
            behind += reaches_behind;
            const double z = depthAt(screen, pieces.of(owner, screen)[0], p);
            worst = std::max(worst, std::fabs(double(z * hit.w - 1)));
        }
    }
    std::printf(
        "seed 17: %zu hits, %zu on triangles that reach behind the eye, %zu unclear, worst relative depth "
        "error "
        "%.2g, %zu of %zu clipped\n",
        hits, behind, unclear, worst, pieces.counts.clipped, pieces.counts.visible);
    EXPECT_GT(behind, 1000u);
    EXPECT_GT(pieces.counts.clipped, 100u);
    EXPECT_LT(unclear, 10u);
}

/// A wavy sheet of quads through the near plane and past the eye: the edges of its pieces must cancel in
/// opposite pairs, except along its border and where planes cut it.
TEST(Project, NeighboursStayCrackFreeAfterClipping) {
    std::mt19937 random(31);
    std::uniform_real_distribution<float> jitter(-0.3f, 0.3f);
    constexpr int kSide = 40;
    std::vector<glm::vec3> p;
    for (int j = 0; j <= kSide; ++j)
        for (int i = 0; i <= kSide; ++i)
            p.push_back({(i - kSide / 2) * 0.25f + jitter(random) / 4, -1 + jitter(random) / 8,
                         (j - kSide / 2) * 0.25f + jitter(random) / 4});
    std::vector<Corners> triangles;
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) {
            const auto a = p[j * (kSide + 1) + i], b = p[j * (kSide + 1) + i + 1],
                       c = p[(j + 1) * (kSide + 1) + i + 1], d = p[(j + 1) * (kSide + 1) + i];
            triangles.push_back({a, d, c});
            triangles.push_back({a, c, b});
        }
    const Scene scene = test::makeScene({test::makeGeometry(triangles)});
    ScreenPieces pieces;
    const ScreenScene screen = project(scene, test::makePerspective(1e-6), test::makeFilm(640, 480), pieces);
    expectWellFormed(screen, pieces);
    using Edge = std::array<double, 4>;
    std::map<Edge, int> open;
    std::map<Edge, std::pair<std::uint32_t, std::uint32_t>> ids;
    for (const ScreenTriangle& t : screen.triangles)
        for (int k = 0; k < 3; ++k) {
            const glm::dvec2 a = t.p_px[k], b = t.p_px[(k + 1) % 3];
            const bool forward = std::tie(a.x, a.y) < std::tie(b.x, b.y);
            const Edge edge = forward ? Edge{a.x, a.y, b.x, b.y} : Edge{b.x, b.y, a.x, a.y};
            const int turn = pieces.back_facing[t.owner] ? -1 : 1;  // back faces were turned round
            open[edge] += (forward ? 1 : -1) * turn;
            ids[edge] = std::minmax(t.vertex[k], t.vertex[(k + 1) % 3]);
        }
    std::size_t uncancelled = 0, cut = 0;
    const std::uint32_t first_made = (kSide + 1) * (kSide + 1);
    for (const auto& [edge, balance] : open) {
        if (balance == 0) continue;
        const bool both_made = ids[edge].first >= first_made;
        cut += both_made;
        uncancelled += !both_made;
    }
    std::printf("seed 31: %zu clipped triangles, %zu edges along cutting planes, %zu border edges\n",
                pieces.counts.clipped, cut, uncancelled);
    EXPECT_GT(pieces.counts.clipped, 60u);
    // What is left is the border in front of the eye: the far row and half of the two sides, one edge cut on
    // each.
    EXPECT_GE(uncancelled, std::size_t(kSide + 2 * (kSide / 2)));
    EXPECT_LE(uncancelled, std::size_t(kSide + 2 * (kSide / 2 + 1)));
}

/// The near plane is the world's z = 0, and the triangle tilted by 1e-15 against it: eye space in double
/// would leave it nearly no digits.
TEST(Project, CutsAtTheSmallestAnglesWhereTheTriangleMeetsTheNearPlane) {
    ResolvedCamera camera = test::makePerspective(1.0);
    camera.camera_from_world = glm::translate(glm::dmat4(1.0), {0.0, 0.0, -1.0});
    for (const float tilt : {1e-3f, 1e-9f, 1e-12f, 1e-15f, 1e-18f}) {
        const glm::vec3 a(-1, 1, -tilt), b(1, 1, -tilt), c(0, -3, 2.7f * tilt);
        const Scene scene = test::makeScene({test::makeGeometry({{{a, b, c}}})});
        const ScreenScene screen = project(scene, camera, test::makeFilm(64, 64));
        const long double t = -static_cast<long double>(a.z) / (static_cast<long double>(c.z) - a.z);
        const auto cut_px = static_cast<double>(32 - 32 * (1 + t * (c.y - 1.0L)));
        double lowest = 0.0;
        for (const ScreenTriangle& piece : screen.triangles)
            for (const auto& p : piece.p_px) lowest = std::max(lowest, p.y);
        EXPECT_NEAR(lowest, cut_px, kGridPx) << tilt;
    }
}

/// An edge from just behind the eye to 20 decades farther before it, either way round and to either side: the
/// digits of the cut come from the near end, which is still 2^22 times the near plane away. The neighbour
/// gets the same bits.
TEST(Project, CutsBesideTheEyeWhereTheOtherEndIsFar) {
    const double znear = 0x1p-53;
    for (const float side : {1.0f, -1.0f})
        for (const bool reversed : {false, true}) {
            const glm::vec3 near_end(side * -3e-10f, 0, 7e-10f), far_end(side * 2.4e9f, 0.7e6f, -5.6e9f);
            const glm::vec3 above(0, 2, -3), below(0, -2, -3);
            const glm::vec3 a = reversed ? far_end : near_end, b = reversed ? near_end : far_end;
            ScreenPieces pieces;
            const ScreenScene screen =
                project(test::makeScene({test::makeGeometry({{{a, b, above}}, {{b, a, below}}})}),
                        test::makePerspective(znear), test::makeFilm(64, 64), pieces);
            const long double t = (near_end.z + static_cast<long double>(znear)) /
                                  (static_cast<long double>(near_end.z) - far_end.z);
            const auto at = [&](int axis) {
                const long double from = near_end[axis], to = far_end[axis];
                return static_cast<double>(32 * (from + t * (to - from)) / znear);
            };
            const glm::dvec2 cut_px(32 + at(0), 32 - at(1));
            std::array<std::set<std::pair<double, double>>, 2> found;
            for (const Owner owner : {0u, 1u})
                for (const ScreenTriangle& piece : pieces.of(owner, screen))
                    for (const auto& p : piece.p_px)
                        if (glm::distance(p, cut_px) < 1.0) found[owner].insert({p.x, p.y});
            ASSERT_EQ(found[0].size(), 1u);
            EXPECT_EQ(found[0], found[1]);
            const glm::dvec2 off =
                glm::abs(glm::dvec2(found[0].begin()->first, found[0].begin()->second) - cut_px);
            for (int axis = 0; axis < 2; ++axis)  // four roundings in double, here as there
                EXPECT_LE(off[axis], kGridPx + 8 * 0x1p-53 * std::abs(cut_px[axis])) << side << reversed;
        }
}

TEST(Project, CoplanarTrianglesAndDuplicatesShareDepthBits) {
    const glm::dmat4 world =
        glm::rotate(glm::translate(glm::dmat4(1.0), {0.1, 0.2, -5.3}), 0.7, {1.0, 2.0, 3.0});
    const glm::vec3 a(0, 0, 0.1f), b(1, 0, 0.1f), c(1, 1, 0.1f), d(0, 1, 0.1f);
    const std::vector<Corners> square{{a, b, c}, {a, c, d}, {b, c, d}};
    const ScreenScene screen =
        project(test::makeScene({test::makeGeometry(square, world), test::makeGeometry(square, world)}),
                test::makePerspective(), test::makeFilm(640, 480));
    ASSERT_EQ(screen.triangles.size(), 6u);
    EXPECT_EQ(screen.triangles[0].plane, screen.triangles[1].plane);
    EXPECT_EQ(screen.triangles[0].plane, screen.triangles[2].plane);
    EXPECT_NE(screen.triangles[0].plane, screen.triangles[3].plane);
    EXPECT_EQ(std::memcmp(&screen.planes[0], &screen.planes[1], sizeof(DepthPlane)), 0);
    EXPECT_EQ(screen.triangles[0].vertex, screen.triangles[3].vertex);
}

TEST(Project, CullsBackFacesOfSingleSidedMaterials) {
    Scene scene = test::makeScene({test::makeGeometry({{{{-1, -1, -2}, {1, -1, -2}, {0, 1, -2}}},
                                                       {{{-1, -1, -3}, {0, 1, -3}, {1, -1, -3}}},
                                                       {{{0, 0, -3}, {1, 1, -3}, {2, 2, -3}}}})});
    ScreenPieces pieces;
    EXPECT_EQ(project(scene, test::makePerspective(), test::makeFilm(64, 64), pieces).triangles.size(), 2u);
    EXPECT_EQ(pieces.back_facing, (std::vector<std::uint8_t>{0, 1, 0}));
    scene.materials[0].double_sided = false;
    for (const auto& camera : {test::makePerspective(), test::makeOrthographic(2.0)}) {
        const ScreenScene screen = project(scene, camera, test::makeFilm(64, 64), pieces);
        ASSERT_EQ(screen.triangles.size(), 1u);
        EXPECT_EQ(screen.triangles[0].owner, 0u);
        EXPECT_EQ(pieces.counts.culled, 1u);
        EXPECT_EQ(pieces.counts.no_area, 1u);
    }
}

TEST(Project, EdgeOnFarAndEmptyScenes) {
    ResolvedCamera camera = test::makePerspective();
    camera.camera.zfar = 10.0;
    ScreenPieces pieces;
    const Scene scene =
        test::makeScene({test::makeGeometry({{{{0, 0, 0}, {1, 0, -5}, {0, 0, -5}}},         // through the eye
                                             {{{-1, -1, -11}, {1, -1, -11}, {0, 1, -12}}},  // beyond
                                             {{{-1, -1, 1}, {1, -1, 2}, {0, 1, 3}}}})});    // behind
    EXPECT_TRUE(project(scene, camera, test::makeFilm(64, 64), pieces).triangles.empty());
    EXPECT_EQ(pieces.counts.no_area, 1u);
    EXPECT_EQ(pieces.counts.outside, 2u);
    EXPECT_TRUE(project(test::makeScene({}), camera, test::makeFilm(64, 64), pieces).triangles.empty());
    EXPECT_EQ(pieces.first, std::vector<std::uint32_t>{0});
}

}  // namespace
}  // namespace edgewise
