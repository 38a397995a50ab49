// SDF scenes as triangles for one film: where they are, how they are lit, what is said of them.
#include "pipeline/field_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <glm/gtc/constants.hpp>
#include <random>

#include "pipeline/error.h"
#include "pipeline/field_parts.h"
#include "pipeline/film_footprint.h"
#include "pipeline/judge/metrics.h"
#include "pipeline/judge/silhouette.h"
#include "pipeline/scoped_path.h"
#include "sdf/evaluate.h"
#include "sdf/field_of_all.h"
#include "tests/pipeline/field_pictures.h"

namespace edgewise {
namespace {

using sdf::Kind;
using test::FieldPicture;

constexpr double kBar = 0.25;  // px: the contract's, of silhouettes

sdf::SurfaceLight lamp(bool shadows) {
    sdf::SurfaceLight light;
    light.direction_world = glm::normalize(glm::dvec3(-0.5, -0.8, -0.35));
    light.intensity = 2.4;
    light.shadows = shadows;
    return light;
}

/// Looks at the origin from (2, 1.6, 3), 36 degrees.
FieldPicture looking(int width, int height) {
    FieldPicture picture(width, height);
    picture.field->lights = {lamp(false)};
    picture.field->ambient = glm::dvec3(0.2);
    Camera& camera = picture.camera.camera;
    camera.perspective = true;
    camera.yfov = glm::radians(36.0);
    camera.znear = 0.004;
    const glm::dvec3 eye(2.0, 1.6, 3.0), back = glm::normalize(eye);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back));
    camera.world_from_camera = glm::dmat4(glm::dvec4(right, 0), glm::dvec4(glm::cross(back, right), 0),
                                          glm::dvec4(back, 0), glm::dvec4(eye, 1));
    picture.camera.camera_from_world = glm::inverse(camera.world_from_camera);
    return picture;
}
std::uint32_t at(sdf::Tree& tree, const glm::dvec3& place, std::uint32_t child) {
    return tree.add(Kind::kTranslate, {place.x, place.y, place.z}, {child});
}

#ifdef EDGEWISE_HAS_ORACLE

/// A ball's silhouette: directions at asin(radius / distance) from its centre's.
struct BallOutline {
    glm::dvec3 centre_eye;
    double radius, scale_px;
    glm::dvec2 middle_px;
    /// A pixel in world units where the ball has it least, w / (scale sqrt(1 + r^2)), by points all over it.
    double leastPixel() const {
        double least = HUGE_VAL;
        for (int n = 0; n < 20000; ++n) {
            const double z = 1.0 - (2.0 * n + 1.0) / 20000.0, turn = 2.399963229728653 * n;
            const double rho = std::sqrt(1.0 - z * z);
            const glm::dvec3 p =
                centre_eye + radius * glm::dvec3(rho * std::cos(turn), rho * std::sin(turn), z);
            least = std::min(least, -p.z / (scale_px * std::sqrt(1.0 + slope2(glm::dvec2(p) / -p.z))));
        }
        return least;
    }
    static double slope2(const glm::dvec2& q) { return glm::dot(q, q); }
    /// How far beyond the outline a ray may pass and still hit: within an eighth of half a pixel at its
    /// length t = w sqrt(1 + r^2), which is seen larger by as much again.
    double threshold(const glm::dvec2& p_px) const {
        return 0.125 * 0.5 * (1.0 + slope2((p_px - middle_px) / scale_px));
    }
    /// Angle beyond the outline.
    double beyond(const glm::dvec2& p_px) const {
        const glm::dvec2 q = (p_px - middle_px) / scale_px;
        const glm::dvec3 along = glm::normalize(glm::dvec3(q.x, -q.y, -1.0));
        const double cosine = glm::dot(along, glm::normalize(centre_eye));
        return std::acos(cosine) - std::asin(radius / glm::length(centre_eye));
    }
    /// To first order: what is measured is far below the ellipse's radii.
    double distance(const glm::dvec2& p_px) const {
        const double h = 1e-3;
        const glm::dvec2 slope(beyond(p_px + glm::dvec2(h, 0)) - beyond(p_px - glm::dvec2(h, 0)),
                               beyond(p_px + glm::dvec2(0, h)) - beyond(p_px - glm::dvec2(0, h)));
        return std::abs(beyond(p_px)) / (glm::length(slope) / (2 * h));
    }
};

TEST(FieldMesh, ABallsSilhouetteIsItsEllipse) {
    FieldPicture picture = looking(96, 72);
    const glm::dvec3 centre(0.6, -0.3, 0.4);  // off the axis: no circle
    sdf::Tree& tree = picture.field->tree;
    tree.root = at(tree, centre, tree.add(Kind::kSphere, {0.8}));
    const FieldMesh mesh = meshForFilm(parseMethod("nsaa"), picture.input());
    EXPECT_LE(mesh.report.error_px, kBar);
    const BallOutline truth{glm::dvec3(picture.camera.camera_from_world * glm::dvec4(centre, 1.0)),
                            0.8,
                            36.0 / std::tan(glm::radians(18.0)),
                            {48.0, 36.0}};
    EXPECT_NEAR(mesh.report.pixel_world, truth.leastPixel(), 0.01 * truth.leastPixel());

    const PixelBox box = picture.film.crop;
    const judge::FilmMask field = judge::fieldMask(picture.input()),
                          triangles = judge::triangleMask(mesh.scene, picture.camera, picture.film);
    double worst_field = 0.0, worst_mesh = 0.0;
    for (const glm::dvec2& p : judge::contourPoints(field, box)) {
        worst_field = std::max(worst_field, truth.distance(p));
        EXPECT_LE(truth.distance(p), truth.threshold(p) * 1.01);  // to first order
    }
    for (const glm::dvec2& p : judge::contourPoints(triangles, box))
        worst_mesh = std::max(worst_mesh, truth.distance(p));
    const judge::SilhouetteDistance both = judge::silhouetteDistance(field, triangles, box);
    std::printf("sphere %.4f px, mesh %.4f px off the ellipse; %.4f and %.4f px between them, %zu points\n",
                worst_field, worst_mesh, both.first_to_second_px, both.second_to_first_px, both.first_points);
    EXPECT_GT(both.first_points, 100u);
    EXPECT_LE(worst_mesh, mesh.report.error_px);
    EXPECT_LE(both.worst(), kBar);
    EXPECT_LE(both.worst(), worst_field + worst_mesh + 0.01);
}

TEST(FieldMesh, SilhouettesThatDifferAreTold) {
    const judge::FilmMask left = [](const glm::dvec2&p) { return p.x < 10.2; },
                          right = [](const glm::dvec2&p) { return p.x < 10.65; },
                          none = [](const glm::dvec2&) { return false; };
    const judge::SilhouetteDistance apart = judge::silhouetteDistance(left, right, {0, 0, 20, 8});
    EXPECT_NEAR(apart.worst(), 0.45, 0.45 * 0.005 + 0x1p-11);  // 32 directions, bisection
    EXPECT_NEAR(apart.mean_px, 0.45, 0.45 * 0.005 + 0x1p-11);
    EXPECT_EQ(judge::silhouetteDistance(left, none, {0, 0, 20, 8}).worst(), HUGE_VAL);
}

TEST(FieldMesh, NsaaCoversWhatTheEllipseCovers) {
    FieldPicture picture = looking(64, 64);
    picture.field->materials[0] = test::unlitWhite();
    picture.field->tree.root = picture.field->tree.add(Kind::kSphere, {0.9});
    const MethodResult made = picture.made("nsaa");
    ASSERT_TRUE(made.mesh);
    EXPECT_GT(made.setup_seconds, 0.0);
    EXPECT_NE(made.notes.back().find("polygonized"), std::string::npos);
    double area = 0.0;
    for (const glm::dvec4& pixel : made.image.rgba) area += pixel.a;
    const double sine = 0.9 / glm::length(glm::dvec3(2.0, 1.6, 3.0));
    const double radius = 32.0 / std::tan(glm::radians(18.0)) * sine / std::sqrt(1.0 - sine * sine);
    // A border that is off by no more than the mesh is.
    EXPECT_NEAR(area, glm::pi<double>() * radius * radius,
                2.0 * glm::pi<double>() * radius * made.mesh->error_px);
}

double difference(const ImageBuffer& a, glm::ivec2 p, const ImageBuffer& b, glm::ivec2 q) {
    const glm::dvec4 d = glm::abs(a.rgba[a.index(p.x, p.y)] - b.rgba[b.index(q.x, q.y)]);
    return std::max({d.r, d.g, d.b, d.a});
}

/// A ground with squares, a ball of two materials in it, shadows: everything but edges is alike.
TEST(FieldMesh, IsLitAsTheFieldIs) {
    FieldPicture picture = looking(80, 60);
    auto& materials = picture.field->materials;
    materials.resize(3);
    materials[0].pattern = sdf::SurfaceMaterial::Pattern::kChecker;
    materials[0].second_color = glm::dvec3(0.1);
    materials[0].pattern_size = 3.0;  // larger than a pixel as far as is seen
    materials[1].color = glm::dvec3(0.8, 0.3, 0.1);
    materials[2].color = glm::dvec3(0.1, 0.3, 0.8);
    materials[2].shading = sdf::SurfaceMaterial::Shading::kBlinnPhong;
    picture.field->lights = {lamp(true)};
    sdf::Tree& tree = picture.field->tree;
    const auto ground = tree.add(Kind::kPlane, {0.0, 1.0, 0.0, -0.6}, {}, 0);
    const auto ball = tree.add(Kind::kSphere, {0.7}, {}, 1),
               box = tree.add(Kind::kBox, {0.8, 0.8, 0.8}, {}, 2);
    const auto cut = tree.add(Kind::kDifference, {}, {ball, at(tree, {0.5, 0.5, 0.5}, box)});
    // Far away the wall covers the ground.
    const auto wall = tree.add(Kind::kPlane, {0.0, 0.0, 1.0, -2.5}, {}, 1),
               side = tree.add(Kind::kPlane, {1.0, 0.0, 0.0, -40.0}, {}, 2);
    tree.root = tree.add(Kind::kUnion, {}, {wall, ground, cut, side});
    const MethodResult traced = picture.made("none"), mesh = picture.made("mesh+none");
    std::size_t off = 0;
    double beyond = -1.0;
    for (int y = 1; y < 59; ++y)
        for (int x = 1; x < 79; ++x) {
            const double worst = difference(traced.image, {x, y}, mesh.image, {x, y});
            double around = 0.0;
            for (int n = 0; n < 9; ++n)
                around = std::max(
                    around, difference(traced.image, {x, y}, traced.image, {x + n % 3 - 1, y + n / 3 - 1}));
            off += worst > 0.02;
            beyond = std::max(beyond, worst - around);
        }
    std::printf("%zu of 4524 pixels differ by more than 0.02; by %.2g more than from neighbours\n", off,
                beyond);
    // Pixels whose centre is within a quarter of a pixel of an edge: of contours, creases, shadows, squares.
    EXPECT_LT(off, 4524u / 20);
    EXPECT_LT(beyond,
              0.004);  // what moves by a quarter of a pixel stays between neighbours; normals interpolated
    EXPECT_EQ(mesh.counts.at("triangles"), mesh.mesh->triangles + 3 * 190u);  // discs have 192 corners
}

TEST(FieldMesh, DependsOnTheFilmAndNotOnItsCrop) {
    FieldPicture picture = looking(48, 48);
    picture.field->tree.root = picture.field->tree.add(Kind::kTorus, {0.7, 0.25});
    const MethodResult whole = picture.made("nsaa");
    picture.film.crop = {20, 8, 31, 30};
    const MethodResult part = picture.made("nsaa");
    EXPECT_EQ(whole.mesh->triangles, part.mesh->triangles);
    for (int y = 8; y < 30; ++y)
        for (int x = 20; x < 31; ++x)
            EXPECT_EQ(whole.image.rgba[whole.image.index(x, y)], part.image.rgba[part.image.index(x, y)]);
}

TEST(FieldMesh, AStoreGivesTheSameMeshAgain) {
    FieldPicture picture = looking(48, 48);
    picture.field->tree.root = picture.field->tree.add(Kind::kTorus, {0.7, 0.25});
    const ScopedPath folder = temporaryFolder();
    const MeshStore store(folder.path());
    const MethodSpec nsaa = parseMethod("nsaa");
    EXPECT_FALSE(store.find({}));
    const FieldMesh first = meshForFilm(nsaa, picture.input(), &store);
    ASSERT_TRUE(store.find({}));
    EXPECT_FALSE(store.find({0.1, "dual"}));
    const FieldMesh again = meshForFilm(nsaa, picture.input(), &store);
    EXPECT_EQ(first.report.surface_to_mesh, again.report.surface_to_mesh);
    EXPECT_GE(again.report.seconds, 0.5 * first.report.seconds);  // what it took, not what reading it takes
    EXPECT_EQ(runOnMesh(nsaa, first, picture.input()).image.rgba,
              runOnMesh(nsaa, again, picture.input()).image.rgba);
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        std::filesystem::resize_file(entry.path(), 1000);
    EXPECT_FALSE(store.find({}));
}

TEST(FieldMesh, IsAsFineAsItIsAskedFor) {
    FieldPicture picture = looking(48, 48);
    picture.field->tree.root = picture.field->tree.add(Kind::kSphere, {0.9});
    std::size_t before = 0;
    for (const char* method : {"mesh:error=0.4+nsaa", "mesh:error=0.1+nsaa", "mesh:error=0.025+nsaa"}) {
        const MeshReport report = meshForFilm(parseMethod(method), picture.input()).report;
        EXPECT_LE(report.error_px, 1.05 * parseMethod(method).mesh->error_px) << method;
        EXPECT_GT(report.triangles, before) << method;
        before = report.triangles;
    }
}

#endif

TEST(FieldMesh, HalfSpacesAreTakenApart) {
    sdf::FieldScene field;
    sdf::Tree& tree = field.tree;
    const auto ground = tree.add(Kind::kPlane, {0.0, 2.0, 0.0, -0.5}),
               wall = at(tree, {0.0, 0.0, -3.0}, tree.add(Kind::kPlane, {0.0, 0.0, 1.0, 0.0}));
    const auto ball = tree.add(Kind::kSphere, {1.0});
    tree.root = tree.add(Kind::kUnion, {}, {ground, tree.add(Kind::kUnion, {}, {wall, ball})});
    const FieldParts parts = partsOf(field);
    ASSERT_EQ(parts.half_spaces.size(), 2u);
    EXPECT_EQ(parts.half_spaces[0].normal_world, glm::dvec3(0, 1, 0));
    EXPECT_EQ(parts.half_spaces[0].offset, -0.5);
    EXPECT_EQ(parts.half_spaces[1].offset, -3.0);
    EXPECT_EQ(parts.rest.tree.root, ball);
}

/// Turned, scaled and moved: where the tree's own value says that it is.
TEST(FieldMesh, ATurnedPlaneIsAHalfSpaceToo) {
    sdf::FieldScene field;
    sdf::Tree& tree = field.tree;
    const auto plane = tree.add(Kind::kPlane, {0.2, 0.9, -0.1, 0.3});
    const auto scaled = tree.add(Kind::kScale, {2.5}, {plane});
    tree.root = at(tree, {0.5, -1, 2}, tree.add(Kind::kRotate, {1, 2, 3, 70}, {scaled}));
    const FieldParts parts = partsOf(field);
    ASSERT_EQ(parts.half_spaces.size(), 1u);
    EXPECT_TRUE(parts.rest.tree.empty());
    const HalfSpace& half = parts.half_spaces[0];
    const sdf::Tape tape = sdf::lower(tree);
    for (const glm::dvec3& p : {glm::dvec3(0), glm::dvec3(1, 2, 3), glm::dvec3(-4, 0.5, 7)})
        EXPECT_NEAR(glm::dot(p, half.normal_world) - half.offset, sdf::valueAt(tape, p), 1e-14);
}

TEST(FieldMesh, APixelIsAsLargeAsWhatMovesAPointByOne) {
    const FieldPicture picture = looking(64, 48);
    const FilmFootprint footprint(picture.camera, picture.film);
    const double scale = 24.0 / std::tan(glm::radians(18.0));
    const auto film = [&](const glm::dvec3& p) {
        const glm::dvec3 eye(picture.camera.camera_from_world * glm::dvec4(p, 1.0));
        return scale * glm::dvec2(eye.x, eye.y) / -eye.z;
    };
    for (const glm::dvec3& p : {glm::dvec3(0.0), glm::dvec3(0.6, -0.3, 0.9), glm::dvec3(-0.5, 0.5, -1.0)}) {
        const double h = 1e-5;
        double most = 0.0;
        for (int n = 0; n < 2000; ++n) {  // directions all over the sphere
            const double z = 1.0 - (2.0 * n + 1.0) / 2000.0, turn = 2.399963229728653 * n;
            const double r = std::sqrt(1.0 - z * z);
            const glm::dvec3 along(r * std::cos(turn), r * std::sin(turn), z);
            most = std::max(most, glm::distance(film(p + h * along), film(p)) / h);
        }
        EXPECT_NEAR(most * footprint.pixelAt(p), 1.0, 0.005);  // directions are 0.04 apart
    }
}

/// Lower bounds, by points of the balls and of the film.
TEST(FieldMesh, NoPixelIsSmallerAndNothingSeenIsNearer) {
    constexpr std::uint64_t kSeed = 7;
    std::mt19937_64 random(kSeed);
    std::uniform_real_distribution<double> at(-6.0, 6.0), size(0.0, 2.0), side(-1.0, 1.0);
    const FieldPicture picture = looking(64, 48);
    const FilmFootprint footprint(picture.camera, picture.film);
    std::size_t across = 0, unseen = 0;
    for (int n = 0; n < 300; ++n) {
        const glm::dvec3 centre(at(random), at(random), at(random));
        const double radius = size(random), away = footprint.awayFromView(centre, 0.0);
        const double least = footprint.leastPixel(centre, radius);
        EXPECT_GT(least, 0.0);
        EXPECT_TRUE(!footprint.sees(centre) || away <= 1e-12) << "seed " << kSeed << ", " << n;
        across += away > 0.0 && away < radius, unseen += away >= radius;
        for (int m = 0; m < 50; ++m) {
            const glm::dvec3 way(side(random), side(random), side(random));
            const glm::dvec3 p = centre + radius * way / std::max(1.0, glm::length(way));
            EXPECT_GE(footprint.pixelAt(p), least * (1.0 - 1e-12)) << "seed " << kSeed << ", " << n;
            EXPECT_TRUE(!footprint.sees(p) || glm::distance(p, centre) >= away * (1.0 - 1e-12))
                << "seed " << kSeed << ", " << n;
        }
    }
    EXPECT_GT(across, 20u);
    EXPECT_GT(unseen, 100u);
}

#ifdef EDGEWISE_HAS_ORACLE

/// Far balls have fewer triangles than near ones, those behind the eye and beside the film fewer still; each
/// seen one is within its own pixels of its closed form.
TEST(FieldMesh, EachPlaceIsAsFineAsItsOwnPixels) {
    FieldPicture picture = looking(160, 120);
    sdf::Tree& tree = picture.field->tree;
    const glm::dvec3 along = glm::normalize(glm::dvec3(2.0, 1.6, 3.0)),
                     beside = glm::normalize(glm::cross(along, glm::dvec3(0, 1, 0)));
    const std::vector<glm::dvec3> centres{glm::dvec3(0.0), -16.0 * along - 2.0 * beside, 8.0 * along,
                                          12.0 * beside};
    std::vector<std::uint32_t> balls;
    for (const glm::dvec3& centre : centres)
        balls.push_back(at(tree, centre, tree.add(Kind::kSphere, {0.7})));
    tree.root = tree.add(Kind::kUnion, {}, balls);
    const FieldMesh mesh = meshForFilm(parseMethod("nsaa"), picture.input());
    EXPECT_LE(mesh.report.error_px, 0.2);
    const FilmFootprint footprint(picture.camera, picture.film);
    ASSERT_TRUE(footprint.sees(centres[0]) && footprint.sees(centres[1]));
    ASSERT_FALSE(footprint.sees(centres[2]) || footprint.sees(centres[3]));
    std::vector<std::size_t> triangles(centres.size(), 0);
    double worst_px = 0.0;
    for (const Geometry& geometry : mesh.scene.geometry)
        for (const auto& t : geometry.triangles) {
            const auto& x = geometry.position_world;
            const glm::dvec3 p = (x[t[0]] + x[t[1]] + x[t[2]]) / 3.0;
            for (std::size_t ball = 0; ball < centres.size(); ++ball) {
                if (glm::distance(p, centres[ball]) > 1.0) continue;
                ++triangles[ball];
                const double rounding = 0x1p-24 * std::max({glm::length(x[t[0]]), glm::length(x[t[1]]),
                                                            glm::length(x[t[2]])});  // to float32
                const double off = std::abs(glm::distance(p, centres[ball]) - 0.7) - rounding;
                if (ball < 2) worst_px = std::max(worst_px, off / footprint.pixelAt(p));
            }
        }
    std::printf("near %zu, far %zu, behind %zu, beside %zu triangles; %.3f px at most\n", triangles[0],
                triangles[1], triangles[2], triangles[3], worst_px);
    EXPECT_LE(worst_px, mesh.report.error_px);
    EXPECT_LT(3 * triangles[1], triangles[0]);
    EXPECT_LE(triangles[2], triangles[1]);
    EXPECT_LE(triangles[3], triangles[1]);
    for (const std::size_t count : triangles) EXPECT_GE(count, 4u);  // closed
}

#endif

std::string problemOf(FieldPicture& picture, const std::string& method) {
    try {
        picture.made(method);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(FieldMesh, RefusesInOneLine) {
    FieldPicture picture = looking(16, 16);
    picture.field->tree.root = picture.field->tree.add(Kind::kGyroid, {0.5, 0.1});
    EXPECT_NE(problemOf(picture, "nsaa").find("unbounded"), std::string::npos);
    EXPECT_NE(problemOf(picture, "mesh+ctss").find("traces"), std::string::npos);
    EXPECT_NE(problemOf(picture, "mesh").find("mesh+ssaa:4"), std::string::npos);
    EXPECT_NE(problemOf(picture, "mesh:error=0+none").find("error"), std::string::npos);
    EXPECT_NE(problemOf(picture, "mesh:device=cpu+none").find("no parameter"), std::string::npos);
    EXPECT_NE(problemOf(picture, "mesh:mesher=best+none").find("dual"), std::string::npos);
    picture.field->tree = {};
    picture.field->tree.root = picture.field->tree.add(Kind::kPlane, {0.0, -1.0, 0.0, 0.0});
    EXPECT_NE(problemOf(picture, "nsaa").find("the eye is within"), std::string::npos);
}

TEST(FieldMesh, ASceneWithoutSurfaceIsBackground) {
    FieldPicture picture = looking(16, 16);
    picture.options.background = glm::dvec3(0.25, 0.5, 0.75);
    sdf::Tree& tree = picture.field->tree;
    const auto one = at(tree, {-2, 0, 0}, tree.add(Kind::kSphere, {0.5})),
               other = at(tree, {2, 0, 0}, tree.add(Kind::kSphere, {0.5}));
    tree.root = tree.add(Kind::kIntersection, {}, {one, other});
    for (const glm::dvec4& pixel : picture.made("nsaa").image.rgba)
        EXPECT_EQ(pixel, glm::dvec4(0.25, 0.5, 0.75, 0.0));
}

/// A closed form around the eye hides what is beyond it, and nothing within.
TEST(FieldMesh, ASphereAroundTheEyeIsSeenFromWithin) {
    sdf::FieldScene field;
    field.analytic.push_back({.center_world = {1, 0, 0}, .radius = 4.0});
    field.tree.root = field.tree.add(Kind::kSphere, {0.5});
    const glm::dvec3 eye(3, 0, 0);
    const sdf::FieldScene all = sdf::fieldOfAll(field, eye);
    const sdf::Tape tape = sdf::lower(all.tree);
    EXPECT_NEAR(sdf::valueAt(tape, eye), 2.0, 1e-15);                  // to the wall
    EXPECT_NEAR(sdf::valueAt(tape, glm::dvec3(1, 0, 0)), 0.5, 1e-15);  // to the ball
    EXPECT_LT(sdf::valueAt(tape, glm::dvec3(5.5, 0, 0)), 0.0);
    EXPECT_TRUE(sdf::levelBox(all.tree, all.tree.root).bounded());
}

}  // namespace
}  // namespace edgewise
