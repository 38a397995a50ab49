// Meshes of SDF scenes: closed, manifold, nowhere through themselves, and where the surface is.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/gtc/constants.hpp>
#include <random>

#include "pipeline/error.h"
#include "pipeline/judge/mesh_quality.h"
#include "pipeline/load_gltf.h"
#include "pipeline/polygonize.h"
#include "pipeline/polygonize_within.h"
#include "pipeline/write_mesh.h"
#include "sdf/dual_cells.h"
#include "sdf/field_scene.h"
#include "sdf/mesh_embedding.h"
#include "sdf/mesh_qef.h"
#include "sdf/triangle_tree.h"

namespace edgewise {
namespace {

using sdf::Kind;

Scene sceneOf(sdf::Tree tree) {
    auto field = std::make_shared<sdf::FieldScene>();
    field->tree = std::move(tree);
    field->materials.resize(1);
    Scene scene;
    scene.source = "test";
    scene.field = std::move(field);
    return scene;
}
sdf::Tree shape(Kind kind, std::vector<double> numbers) {
    sdf::Tree tree;
    tree.root = tree.add(kind, std::move(numbers));
    return tree;
}
/// A ball without a turned box.
sdf::Tree ballMinusBox() {
    sdf::Tree tree;
    const auto ball = tree.add(Kind::kSphere, {1.0}), box = tree.add(Kind::kBox, {1.3, 1.3, 1.3});
    const auto turned = tree.add(Kind::kRotate, {1.0, 2.0, 0.5, 38.0}, {box});
    const auto moved = tree.add(Kind::kTranslate, {0.55, 0.5, 0.6}, {turned});
    tree.root = tree.add(Kind::kDifference, {}, {ball, moved});
    return tree;
}
sdf::Tree gyroidShell() {
    sdf::Tree tree;
    const auto ball = tree.add(Kind::kSphere, {1.0}), gyroid = tree.add(Kind::kGyroid, {0.62, 0.07});
    tree.root = tree.add(Kind::kIntersection, {}, {ball, gyroid});
    return tree;
}
sdf::Tree blobs(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> place(-0.8, 0.8), radius(0.15, 0.3);
    sdf::Tree tree;
    std::vector<std::uint32_t> balls;
    for (int n = 0; n < 12; ++n) {
        const auto ball = tree.add(Kind::kSphere, {radius(random)});
        balls.push_back(tree.add(Kind::kTranslate, {place(random), place(random), place(random)}, {ball}));
    }
    tree.root = tree.add(Kind::kSmoothUnion, {0.1}, balls);
    return tree;
}

Polygonized meshOf(const sdf::Tree& tree, Mesher mesher, int resolution) {
    PolygonizeOptions options;
    options.mesher = mesher, options.resolution = resolution;
    return polygonize(sceneOf(tree), options);
}
MeshDistance farthest(const Polygonized& made, const sdf::Tree& tree) {
    return distanceOf(made.mesh, sdf::lower(tree), made.lattice, true, 4).value_or(MeshDistance{});
}

/// Of every mesh that either mesher makes.
void expectClean(const Polygonized& made, const std::string& what) {
    const MeshQuality quality = qualityOf(made.mesh);
    EXPECT_TRUE(quality.closed()) << what;
    EXPECT_TRUE(quality.manifold()) << what << ": " << quality.nonmanifold_edges << " edges, "
                                    << quality.nonmanifold_vertices << " vertices";
    EXPECT_GT(quality.volume, 0.0) << what << ": turned inside out";
    EXPECT_EQ(selfIntersections(made.mesh).value_or(0), 0u) << what;
}

TEST(Polygonize, MeshesHaveTheShapesOwnEulerNumber) {
    const struct {
        const char* name;
        sdf::Tree tree;
        std::int64_t euler;
        double volume;
    } cases[] = {
        {"sphere", shape(Kind::kSphere, {1.0}), 2, 4.0 / 3.0 * glm::pi<double>()},
        {"torus", shape(Kind::kTorus, {1.0, 0.3}), 0, 2.0 * glm::pi<double>() * glm::pi<double>() * 0.09},
        // Menger's sponge of one level: a cube's surface with five handles.
        {"menger", shape(Kind::kMenger, {2.0, 1.0}), -8, 8.0 * 20.0 / 27.0},
        {"shell",
         [] {
             sdf::Tree tree;
             tree.root = tree.add(Kind::kShell, {0.3}, {tree.add(Kind::kSphere, {1.0})});
             return tree;
         }(),
         4, 4.0 / 3.0 * glm::pi<double>() * (1.15 * 1.15 * 1.15 - 0.85 * 0.85 * 0.85)},
    };
    for (const auto& c : cases)
        for (const Mesher mesher : {Mesher::kMarchingCubes, Mesher::kDual}) {
            const Polygonized made = meshOf(c.tree, mesher, 24);
            expectClean(made, c.name);
            const MeshQuality quality = qualityOf(made.mesh);
            EXPECT_EQ(quality.euler, c.euler) << c.name;
            // Chords lie within the surface by about cell^2 / (8 R), cut edges of marching cubes by a cell:
            // far less than a cell all over the surface.
            EXPECT_NEAR(quality.volume, c.volume, 0.5 * quality.area * made.lattice.step) << c.name;
        }
}

TEST(Polygonize, DualFindsFlatShapesExactlyAndLeavesOutWhatTheyDoNotNeed) {
    const sdf::Tree box = shape(Kind::kBox, {1.3, 0.9, 1.7});
    const Polygonized made = meshOf(box, Mesher::kDual, 24);
    expectClean(made, "box");
    const MeshQuality quality = qualityOf(made.mesh);
    EXPECT_EQ(quality.triangles, 12u);
    EXPECT_EQ(quality.vertices, 8u);
    EXPECT_GT(made.counts.collapsed, 1000u);
    // Positions about 1, and planes met to 1e-10 of a cell.
    EXPECT_NEAR(quality.volume, 1.3 * 0.9 * 1.7, 1e-9);
    const sdf::Tree sponge = shape(Kind::kMenger, {2.0, 2.0});
    const Polygonized holes = meshOf(sponge, Mesher::kDual, 48);
    expectClean(holes, "sponge");
    EXPECT_NEAR(qualityOf(holes.mesh).volume, 8.0 * 400.0 / 729.0, 1e-9);
    EXPECT_LE(farthest(holes, sponge).surface_to_mesh, 1e-9);
    EXPECT_LE(farthest(holes, sponge).mesh_to_surface, 1e-9);
}

TEST(Polygonize, HardFieldsAreManifoldAndNowhereThroughThemselves) {
    std::uint64_t mended = 0, doubled = 0;
    for (const int resolution : {20, 33}) {
        for (const Mesher mesher : {Mesher::kMarchingCubes, Mesher::kDual}) {
            const Polygonized made = meshOf(gyroidShell(), mesher, resolution);
            expectClean(made, "gyroid");
            mended += made.counts.mended;
        }
        expectClean(meshOf(ballMinusBox(), Mesher::kDual, resolution), "ball minus box");
        for (std::uint64_t seed = 1; seed <= 3; ++seed)
            expectClean(meshOf(blobs(seed), Mesher::kDual, resolution), "blobs " + std::to_string(seed));
    }
    const sdf::Tape tape = sdf::lower(gyroidShell());
    for (const sdf::DualVertex& v :
         sdf::dualComplex({tape, sdf::latticeOf(glm::dvec3(-1.02), glm::dvec3(1.02), 20)}).vertices)
        doubled += v.loops > 1;
    EXPECT_GT(mended, 10u);   // triangles did meet before they were mended
    EXPECT_GT(doubled, 10u);  // cells do hold several parts of the surface
}

TEST(Polygonize, DualIsNearerThanMarchingCubesAndConverges) {
    const sdf::Tree ball = shape(Kind::kSphere, {1.0});
    double before = 0.0;
    for (const int resolution : {16, 32}) {
        const Polygonized made = meshOf(ball, Mesher::kDual, resolution);
        const MeshDistance distance = farthest(made, ball);
        if (distance.surface_samples == 0) GTEST_SKIP() << "this build has no CGAL";
        // Corners on the ball, sides of at most two cells: sagitta (2 step)^2 / 8 of sides and of triangles.
        EXPECT_LE(distance.surface_to_mesh, made.lattice.step * made.lattice.step);
        EXPECT_LE(distance.mesh_to_surface, made.lattice.step * made.lattice.step);
        if (before > 0.0) {
            EXPECT_LT(distance.surface_to_mesh, 0.4 * before);
        }
        before = distance.surface_to_mesh;
    }
    const sdf::Tree cut = ballMinusBox();
    const MeshDistance dual = farthest(meshOf(cut, Mesher::kDual, 32), cut),
                       cubes = farthest(meshOf(cut, Mesher::kMarchingCubes, 32), cut);
    EXPECT_LT(dual.surface_to_mesh, cubes.surface_to_mesh);
}

TEST(Polygonize, WithoutABoundIntervalsFindTheSameSurface) {
    // Without wedges, which are known by the bound.
    const sdf::Tape tape = sdf::lower(shape(Kind::kTorus, {0.8, 0.25}));
    const sdf::Lattice lattice = sdf::latticeOf(glm::dvec3(-1.2), glm::dvec3(1.2), 24);
    sdf::MeshCounts counts;
    const sdf::SurfaceMesh a = sdf::dualContouring({tape, lattice, true}, counts),
                           b = sdf::dualContouring({tape, lattice, false}, counts);
    EXPECT_EQ(a.triangles.size(), b.triangles.size());
    EXPECT_DOUBLE_EQ(qualityOf(a).volume, qualityOf(b).volume);
}

TEST(Polygonize, GltfHoldsWhatWasMade) {
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("edgewise_mesh_" + std::to_string(::getpid()) + ".glb");
    const Scene scene = sceneOf(ballMinusBox());
    PolygonizeOptions options;
    options.resolution = 16;
    const Polygonized made = polygonize(scene, options);
    writeMesh(path, made.mesh, scene, "test");
    const Scene read = loadGltf(path, {});
    std::filesystem::remove(path);
    EXPECT_EQ(read.triangle_count, made.mesh.triangles.size());
    double volume = 0.0;
    for (const Geometry& g : read.geometry) {
        for (const auto& t : g.triangles)
            volume +=
                glm::dot(g.position_world[t[0]], glm::cross(g.position_world[t[1]], g.position_world[t[2]])) /
                6.0;
        for (const glm::dvec3& n : g.normal_world) EXPECT_GT(glm::length(n), 0.0);
    }
    // Each coordinate is off by at most 2^-24: the volume by the area times that times sqrt(3).
    EXPECT_NEAR(volume, qualityOf(made.mesh).volume, qualityOf(made.mesh).area * 0x1p-24 * 2.0);
}

std::string problemOf(const sdf::Tree& tree, const PolygonizeOptions& options) {
    try {
        polygonize(sceneOf(tree), options);
    } catch (const InputError& error) {
        return error.what();
    } catch (const FailureError& error) {
        return error.what();
    }
    return "";
}

TEST(Polygonize, RefusesInOneLine) {
    const sdf::Tree plane = shape(Kind::kPlane, {0.0, 1.0, 0.0, 0.0});
    EXPECT_NE(problemOf(plane, {}).find("unbounded"), std::string::npos);
    PolygonizeOptions boxed;
    boxed.resolution = 16;
    boxed.box = WorldBox{glm::dvec3(-1.0), glm::dvec3(1.0)};
    EXPECT_NE(problemOf(plane, boxed).find("open"), std::string::npos);
    boxed.box = WorldBox{glm::dvec3(3.0), glm::dvec3(4.0)};
    EXPECT_NE(problemOf(shape(Kind::kSphere, {1.0}), boxed).find("no surface"), std::string::npos);
    PolygonizeOptions huge;
    huge.resolution = sdf::kMostResolution;
    EXPECT_NE(problemOf(shape(Kind::kSphere, {1.0}), huge).find("MiB"), std::string::npos);
    Scene none;
    none.source = "mesh.glb";
    EXPECT_THROW(polygonize(none, {}), InputError);
    EXPECT_THROW(parseMesher("best"), InputError);
}

/// Bricks divided here and there, up to three times: every cell size beside every other.
TEST(Polygonize, CellsOfManySizesMeetWithoutSeams) {
    std::uint64_t seed = 20, mixed = 0, triangles = 0;
    for (const sdf::Tree& tree : {ballMinusBox(), gyroidShell(), blobs(4)}) {
        const sdf::Tape tape = sdf::lower(tree);
        const sdf::Lattice lattice = sdf::latticeOf(glm::dvec3(-1.3), glm::dvec3(1.3), 20);
        std::mt19937_64 random(++seed);
        sdf::BrickList bricks = sdf::findBricks(tape, lattice, true);
        for (int round = 0; round < 3; ++round)
            for (std::uint32_t b = 0, count = std::uint32_t(bricks.bricks.size()); b < count; ++b)
                if (!bricks.bricks[b].divided && random() % 4 == 0)
                    sdf::divideBrick(tape, lattice, true, b, bricks);
        const sdf::DualComplex complex =
            sdf::dualComplex({tape, lattice}, sdf::TapeAt(tape, lattice, true), std::move(bricks));
        // Polygons as they are, closed: each side is another's, the other way round.
        for (std::uint32_t p = 0; p < complex.polygons.size(); ++p) {
            const sdf::DualPolygon& polygon = complex.polygons[p];
            int sides = 0;
            for (int k = 0; k < 4; ++k) {
                if (!polygon.isSide(k)) continue;
                ++sides;
                const sdf::DualPolygon& other = complex.polygons.at(polygon.across[k]);
                const int j = polygon.across_side[k];
                EXPECT_EQ(other.across[j], p);
                EXPECT_EQ(std::minmax(polygon.vertex[k], polygon.vertex[(k + 1) % 4]),
                          std::minmax(other.vertex[j], other.vertex[(j + 1) % 4]));
            }
            EXPECT_GE(sides, 3);
            mixed += polygon.mixed, triangles += sides == 3;
        }
    }
    EXPECT_GT(mixed, 500u);
    EXPECT_GT(triangles, 50u);
}

TEST(Polygonize, DividesCellsUntilTheErrorIsMet) {
    const sdf::Tree cut = ballMinusBox();
    PolygonizeOptions options;
    options.resolution = 24;
    for (const double error : {0.03, 0.01}) {
        options.most_off = error;
        const Polygonized made = polygonize(sceneOf(cut), options);
        expectClean(made, "within " + std::to_string(error));
        const MeshDistance distance = farthest(made, cut);
        EXPECT_LE(distance.surface_to_mesh, error);
        EXPECT_LE(distance.mesh_to_surface, error);
    }
    // What cells miss whole is found: a plate thinner than a quarter of one.
    const sdf::Tree plate = shape(Kind::kBox, {1.0, 0.01, 0.9});
    options.most_off = 0.01;
    const Polygonized thin = polygonize(sceneOf(plate), options);
    expectClean(thin, "plate");
    EXPECT_NEAR(qualityOf(thin.mesh).volume, 0.009, 1e-6);
}

TEST(Polygonize, SaysSoonWhatCannotBeMet) {
    const Scene ball = sceneOf(shape(Kind::kSphere, {1.0}));
    PolygonizeOptions options;
    options.resolution = 32;
    std::string problem;
    try {
        polygonizeWithin(1e-9, "1e-9", "--max-error", ball, options);
    } catch (const FailureError& error) {
        problem = error.what();
    }
    EXPECT_NE(problem.find("1e-9 is not met"), std::string::npos) << problem;
    EXPECT_EQ(problem.find('\n'), std::string::npos);
    // What is flat is exact, however little is asked for.
    const Scene box = sceneOf(shape(Kind::kBox, {1.3, 0.9, 1.7}));
    try {
        EXPECT_EQ(polygonizeWithin(1e-9, "1e-9", "--max-error", box, options).made.mesh.triangles.size(),
                  12u);
    } catch (const FailureError& error) {
        EXPECT_NE(std::string(error.what()).find("CGAL"), std::string::npos) << error.what();
    }
}

/// Less may be off in one half of the world than in the other.
TEST(Polygonize, CellsFollowWhatIsAllowedAtTheirPlaces) {
    const sdf::Tree tree = shape(Kind::kTorus, {1.0, 0.35});
    PolygonizeOptions options;
    options.resolution = 24;
    const auto allowedAt = [](const glm::dvec3& p, double radius) {
        return std::clamp(0.05 * (p.x - radius), 5e-4, 1e-2);
    };
    const sdf::MostOff allowed{sdf::MostOff::LeastWithin(allowedAt)};
    MeasuredMesh measured;
    try {
        measured = polygonizeWithin(allowed, "what is allowed", "test", sceneOf(tree), options);
    } catch (const FailureError& error) {
        ASSERT_NE(std::string(error.what()).find("no CGAL"), std::string::npos) << error.what();
        GTEST_SKIP() << error.what();
    }
    EXPECT_LE(measured.distance.worst_part, 1.0);
    const Polygonized& made = measured.made;
    expectClean(made, "two sizes");
    std::size_t fine = 0, coarse = 0;
    for (const sdf::Triangle& t : made.mesh.triangles) {
        const glm::dvec3 centre = (made.mesh.position_world[t[0]] + made.mesh.position_world[t[1]] +
                                   made.mesh.position_world[t[2]]) /
                                  3.0;
        const double off = std::abs(std::hypot(std::hypot(centre.x, centre.z) - 1.0, centre.y) - 0.35);
        EXPECT_LE(off, allowedAt(centre, 0.0));
        ++(centre.x < 0.0 ? fine : coarse);
    }
    EXPECT_GT(fine, 2 * coarse);
}

TEST(Polygonize, RoundPartsHaveNoMoreTrianglesThanTheyNeed) {
    const Polygonized fine = meshOf(shape(Kind::kSphere, {1.0}), Mesher::kDual, 64);
    expectClean(fine, "ball");
    EXPECT_GT(fine.counts.collapsed, 1000u);
    // Nearer than an eightieth of a cell at edges' middles and centres: nowhere further off than twice that.
    const MeshDistance distance = farthest(fine, shape(Kind::kSphere, {1.0}));
    EXPECT_LE(distance.surface_to_mesh, 2.0 * fine.lattice.step / 64.0);
}

TEST(Polygonize, CgalMeshesSmoothSurfacesAndRefusesSharpOnes) {
    const sdf::Tree ball = shape(Kind::kSphere, {1.0});
    PolygonizeOptions options;
    options.mesher = Mesher::kCgal;
    options.resolution = 20;
    const std::string sharp = problemOf(ballMinusBox(), options);
    if (sharp.find("no CGAL") != std::string::npos) GTEST_SKIP() << sharp;
    EXPECT_NE(sharp.find("sharp edge"), std::string::npos) << sharp;
    const Polygonized made = polygonize(sceneOf(ball), options);
    expectClean(made, "cgal's ball");
    const MeshQuality quality = qualityOf(made.mesh);
    EXPECT_EQ(quality.euler, 2);
    EXPECT_GT(quality.smallest_angle_degrees, 29.9);
    // Asked of it: circles' centres are within a tenth of a cell of the surface.
    const MeshDistance distance = farthest(made, ball);
    EXPECT_LE(distance.mesh_to_surface, 0.1 * made.lattice.step);
    // Parts that do not touch have seeds of their own.
    sdf::Tree two;
    const auto small = two.add(Kind::kSphere, {0.4}, {}, 0), large = two.add(Kind::kSphere, {0.7}, {}, 0);
    const auto moved = two.add(Kind::kTranslate, {1.5, 0.2, 0.0}, {small});
    two.root = two.add(Kind::kUnion, {}, {large, moved});
    EXPECT_EQ(qualityOf(polygonize(sceneOf(two), options).mesh).components, 2u);
}

TEST(TriangleTree, FindsWhatIsNear) {
    std::mt19937_64 random(31);
    std::uniform_real_distribution<double> at(-1.0, 1.0), size(-0.1, 0.1);
    std::vector<glm::dvec3> x;
    std::vector<sdf::Triangle> triangles;
    for (std::uint32_t n = 0; n < 300; ++n) {
        const glm::dvec3 p(at(random), at(random), at(random));
        for (int i = 0; i < 3; ++i) x.push_back(p + glm::dvec3(size(random), size(random), size(random)));
        triangles.push_back({3 * n, 3 * n + 1, 3 * n + 2});
    }
    const sdf::TriangleTree tree(x, triangles);
    int near = 0, far = 0;
    for (int n = 0; n < 400; ++n) {
        const glm::dvec3 p(at(random), at(random), at(random));
        // The triangle's own points, closely sampled, say the same but for the samples' distance.
        double nearest = 1e300;
        for (const sdf::Triangle& t : triangles)
            for (int i = 0; i <= 20; ++i)
                for (int j = 0; i + j <= 20; ++j)
                    nearest = std::min(nearest, glm::distance(p, x[t[0]] + (x[t[1]] - x[t[0]]) * (i / 20.0) +
                                                                     (x[t[2]] - x[t[0]]) * (j / 20.0)));
        const double spacing = 0.2 * std::sqrt(3.0) / 20.0;
        EXPECT_TRUE(tree.near(p, nearest * (1.0 + 1e-12))) << n;  // rounding of the samples
        if (nearest > spacing) {
            EXPECT_FALSE(tree.near(p, nearest - spacing)) << n;
        }
        (nearest < 0.1 ? near : far) += 1;
    }
    EXPECT_GT(near, 50);
    EXPECT_GT(far, 50);
}

TEST(Polygonize, UnboundedSolidsEndAtTheCap) {
    sdf::Tree tree;
    const auto ground = tree.add(Kind::kPlane, {0.0, 1.0, 0.0, 0.0}, {}, 0);
    const auto ball = tree.add(Kind::kSphere, {0.5}, {}, 0);
    const auto raised = tree.add(Kind::kTranslate, {0.1, 0.0, -0.2}, {ball});
    tree.root = tree.add(Kind::kUnion, {}, {ground, raised});
    const Scene capped = cappedAt(sceneOf(tree), {{-1.0, -0.5, -1.2}, {1.1, 1.0, 1.0}});
    PolygonizeOptions options;
    options.resolution = 40;
    const Polygonized made = polygonize(capped, options);
    expectClean(made, "ground and half a ball");
    const MeshQuality quality = qualityOf(made.mesh);
    EXPECT_EQ(quality.euler, 2);
    // A slab, half a ball on it: chords of the ball lie within it, by a cell's sagitta all over it.
    const double slab = 2.1 * 0.5 * 2.2, half_ball = 2.0 / 3.0 * glm::pi<double>() * 0.125;
    const double sagitta = made.lattice.step * made.lattice.step / (8.0 * 0.5) * 2.0;
    EXPECT_LE(quality.volume, slab + half_ball);
    EXPECT_GE(quality.volume, slab + half_ball - 2.0 * glm::pi<double>() * 0.25 * sagitta);
    std::size_t walls = 0, own = 0;
    for (std::size_t t = 0; t < made.mesh.triangles.size(); ++t) {
        const glm::dvec3& p = made.mesh.position_world[made.mesh.triangles[t][0]];
        const bool bare = made.mesh.material[t] == sdf::kNoMaterial;
        (bare ? walls : own) += 1;
        if (bare) {
            EXPECT_LT(p.y, 1e-9);
        }
    }
    EXPECT_GT(walls, 9u);
    EXPECT_GT(own, 100u);
}

TEST(MeshEmbedding, TellsWhichTrianglesMeet) {
    const std::vector<glm::dvec3> x{{0, 0, 0},  {1, 0, 0},       {0, 1, 0},    {0.2, 0.2, -1}, {0.2, 0.2, 1},
                                    {5, 5, 1},  {2, 0, 0},       {1, 1, 0},    {0.1, 0.1, 0},  {0.9, 0.9, 0},
                                    {1, -1, 0}, {0.5, 0.0, 1.0}, {0.3, 0.3, 0}};
    const auto meet = [&](sdf::Triangle a, sdf::Triangle b) {
        EXPECT_EQ(sdf::trianglesMeet(x, a, b), sdf::trianglesMeet(x, b, a));
        return sdf::trianglesMeet(x, a, b);
    };
    EXPECT_TRUE(meet({0, 1, 2}, {3, 4, 5}));    // pierced
    EXPECT_FALSE(meet({0, 1, 2}, {1, 7, 2}));   // a square's halves
    EXPECT_FALSE(meet({0, 1, 2}, {1, 6, 7}));   // one corner, one plane, a side that goes on
    EXPECT_TRUE(meet({0, 1, 2}, {0, 8, 9}));    // one corner, one plane, over each other
    EXPECT_TRUE(meet({0, 1, 2}, {0, 1, 12}));   // folded over a side
    EXPECT_FALSE(meet({0, 1, 2}, {0, 1, 11}));  // bent at a side
    EXPECT_FALSE(meet({0, 1, 2}, {0, 10, 1}));  // one plane, either side
    EXPECT_TRUE(meet({0, 1, 2}, {2, 3, 4}));    // one corner, through the face
}

TEST(MeshQef, FindsCornersEdgesAndLeavesSmoothPartsAlone) {
    const glm::dvec3 corner(0.3, -0.2, 0.7), about(0.0);
    const std::vector<sdf::TangentPlane> three{{corner + glm::dvec3(0, 1, 2), {1, 0, 0}},
                                               {corner + glm::dvec3(3, 0, 1), {0, 1, 0}},
                                               {corner + glm::dvec3(1, 1, 0), {0, 0, 1}}};
    const sdf::PlanesPoint at_corner = sdf::nearestToPlanes(three, about, 0.01);
    EXPECT_EQ(at_corner.rank, 3);
    EXPECT_LE(glm::distance(at_corner.place, corner), 1e-14);
    const sdf::PlanesPoint on_edge = sdf::nearestToPlanes(std::span(three).first(2), about, 0.01);
    EXPECT_EQ(on_edge.rank, 2);
    EXPECT_LE(glm::distance(on_edge.place, glm::dvec3(0.3, -0.2, 0.0)), 1e-14);
    EXPECT_EQ(sdf::nearestToPlanes(std::span(three).first(1), about, 0.01).rank, 1);
}

}  // namespace
}  // namespace edgewise
