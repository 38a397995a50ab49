// Cone-traced supersampling on small pictures whose coverage is known in closed form.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <random>

#include "pipeline/error.h"
#include "pipeline/load_scene.h"
#include "pipeline/resolve_camera.h"
#include "pipeline/scene_catalog.h"
#include "sdf/evaluate.h"
#include "sdf/field_of_all.h"
#include "tests/pipeline/edge_pictures.h"

namespace edgewise::test {
namespace {

using sdf::Kind;

constexpr unsigned kSeed = 20236;
const double kRadius = std::sqrt(0.5);  // of a pixel's cone: through its corners
constexpr double kHard = 0.125 * 0.5;   // a ray has hit where the distance is below: TraceSettings::threshold

/// A log along the edge, its axis kLog beside it: at its outline its surface faces across the edge.
constexpr double kLog = 60.0;
FieldPicture logPicture(const Edge& edge) {
    FieldPicture picture = flatPicture(kSide, kSide);
    sdf::Tree& tree = picture.field->tree;
    onEdge(tree, tree.add(Kind::kTranslate, {-kLog, 0, 0}, {tree.add(Kind::kCylinder, {kLog, 400})}), edge);
    tree.root = static_cast<std::uint32_t>(tree.nodes.size() - 1);
    picture.field->materials[0] = unlitWhite();
    return picture;
}

/// Points of a mask within a half-plane at that distance from the middle, in radii of the cone.
int pointsWithin(const glm::dvec2& n, double distance, int columns, int rows) {
    int count = 0;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const bool corner = columns == 6 && row % 5 == 0 && column % 5 == 0;
            const glm::dvec2 p((2 * column + 1.0) / columns - 1.0, (2 * row + 1.0) / rows - 1.0);
            count += !corner && glm::dot(n, p) + distance < 0.0;
        }
    return count;
}

/// Steps of at most the cone's radius pass the log's nearest point within half of it: the least distance is
/// too long by the square of that over twice the log's own radius.
double distanceError(double radius) {
    const double half_step = 0.5 * radius;
    return half_step * half_step / (2.0 * kLog);
}

/// Points of the mask of a plane at the log's distance, but for those that lie on it within its error.
TEST(ConeMethods, AnOutlineIsItsMasksPoints) {
    int partly = 0;
    double worst_4x8 = 0.0, worst_6x6 = 0.0;
    for (const double degrees : {7.0, 31.0, 45.5, 78.0, 200.0, 290.0})
        for (const double offset : {-0.31, 0.137}) {
            const Edge edge = edgeAt(degrees, offset);
            FieldPicture picture = logPicture(edge);
            for (const bool six : {true, false})
                for (const double coverage : {1.0, 2.0}) {
                    const MethodResult seen =
                        picture.made(fmt::format("ctss:mask={},coverage={}", six ? "6x6" : "4x8", coverage));
                    forPixels([&](int x, int y) {
                        const double d = edge.at({x + 0.5, y + 0.5}), radius = coverage * kRadius;
                        const auto points = [&](double distance) {
                            if (distance >= radius) return 0.0;   // no group at all
                            if (distance <= -radius) return 1.0;  // the cone is within
                            return (six ? pointsWithin(edge.n, distance / radius, 6, 6)
                                        : pointsWithin(edge.n, distance / radius, 8, 4)) /
                                   32.0;
                        };
                        EXPECT_LE(redOf(seen, x, y), points(d - 1e-9))
                            << degrees << " degrees, pixel " << x << "," << y;
                        EXPECT_GE(redOf(seen, x, y), points(d + distanceError(radius) + 1e-9))
                            << degrees << " degrees, pixel " << x << "," << y;
                        partly += points(d) > 0.0 && points(d) < 1.0;
                        if (coverage != 1.0) return;
                        double& worst = six ? worst_6x6 : worst_4x8;
                        worst = std::max(worst, std::abs(redOf(seen, x, y) - boxShare(edge, x, y)));
                    });
                }
        }
    std::printf("%d pixels partly; off the pixel's own coverage by at most %.3f (6x6), %.3f (4x8)\n", partly,
                worst_6x6, worst_4x8);
    EXPECT_GT(partly, 1000);
}

/// Of a disk of radius 1, the part on the far side of a line at distance d.
double diskShare(double d) {
    if (std::abs(d) >= 1.0) return d < 0.0 ? 1.0 : 0.0;
    return (std::acos(d) - d * std::sqrt(1.0 - d * d)) / std::acos(-1.0);
}

/// A cone's disk is wider than the pixel: by how much their shares differ is the method's own; the mask's 32
/// points are off the disk by half a column of six, and by their uneven share of it.
TEST(ConeMethods, AnOutlineIsCoveredToTheMasksError) {
    double disk_to_box = 0.0;
    for (double degrees = 1.0; degrees < 45.0; degrees += 1.0)
        for (double d = -1.0; d <= 1.0; d += 0.01)
            disk_to_box =
                std::max(disk_to_box, std::abs(diskShare(d / kRadius) - boxShare(edgeAt(degrees, 0.0).n, d)));
    const double mask_to_disk = (3.0 + 1.0) / 32.0;
    double worst = 0.0, sum = 0.0;
    int edges = 0;
    std::mt19937 random(kSeed);
    std::printf("seed %u\n", kSeed);
    std::uniform_real_distribution<> turn(0.0, 360.0), offset(-0.5, 0.5);
    for (int i = 0; i < 12; ++i) {
        const Edge edge = edgeAt(turn(random), offset(random));
        const MethodResult seen = logPicture(edge).made("ctss");
        forPixels([&](int x, int y) {
            const double exact = boxShare(edge, x, y);
            const double off = std::abs(redOf(seen, x, y) - exact);
            worst = std::max(worst, off);
            if (exact > 0.0 && exact < 1.0) sum += off * off, ++edges;
        });
    }
    std::printf("off by at most %.3f (disk %.3f, mask %.3f); rms on %d edge pixels %.4f\n", worst,
                disk_to_box, mask_to_disk, edges, std::sqrt(sum / edges));
    EXPECT_GT(edges, 200);
    EXPECT_LE(worst, disk_to_box + mask_to_disk);
}

/// Figure 5 (b), and Algorithm 1 as printed: what the cone touches is whole.
TEST(ConeMethods, UniformWeightsAndAPrintedSkyExtrude) {
    const Edge edge = edgeAt(31.0, 0.137);
    FieldPicture picture = wallPicture(edge);
    const MethodResult uniform = picture.made("ctss:weights=uniform"),
                       printed = picture.made("ctss:sky=normalize");
    int beyond = 0;
    forPixels([&](int x, int y) {
        const double d = edge.at({x + 0.5, y + 0.5});
        const bool points = pointsWithin(edge.n, d / kRadius, 6, 6) > 0 && d < kRadius;
        EXPECT_EQ(redOf(uniform, x, y), points ? 1.0 : 0.0);
        EXPECT_EQ(redOf(printed, x, y), points ? 1.0 : 0.0);
        beyond += points && d > 0.0;
    });
    EXPECT_GT(beyond, 10) << "no pixel was extruded";
}

/// Ends at the ray's own hit, and takes all bits that are left.
TEST(ConeMethods, TheRelaxedOneSoftensTheOuterSideAlone) {
    const Edge edge = edgeAt(31.0, 0.137);
    const MethodResult seen = wallPicture(edge).made("ctss-r");
    int hard = 0, soft = 0;
    forPixels([&](int x, int y) {
        const double d = edge.at({x + 0.5, y + 0.5});
        const double expected = d < kHard     ? 1.0
                                : d < kRadius ? pointsWithin(edge.n, d / kRadius, 6, 6) / 32.0
                                              : 0.0;
        EXPECT_EQ(redOf(seen, x, y), expected);
        hard += d < kHard && d > -kRadius, soft += expected > 0.0 && expected < 1.0;
    });
    EXPECT_GT(hard, 10);
    EXPECT_GT(soft, 10);
}

/// A red wall before a green one: with one bit to fill, what is behind is never asked.
TEST(ConeMethods, ThresholdOfBitsEndsTheTrace) {
    const Edge edge = edgeAt(31.0, 0.137);
    FieldPicture picture = flatPicture(kSide, kSide);
    sdf::Tree& tree = picture.field->tree;
    const auto near = wallOn(tree, edge);
    const auto far = tree.add(Kind::kPlane, {0, 0, 1, -20});
    tree.nodes[near].material = 0, tree.nodes[far].material = 1;
    tree.root = tree.add(Kind::kUnion, {}, {near, far});
    picture.field->materials.assign(2, unlitWhite());
    picture.field->materials[0].color = {1, 0, 0}, picture.field->materials[1].color = {0, 1, 0};
    const MethodResult all = picture.made("ctss"), one = picture.made("ctss:visible=1");
    int mixed = 0;
    forPixels([&](int x, int y) {
        const glm::dvec4 a = all.image.rgba[all.image.index(x, y)], b = one.image.rgba[one.image.index(x, y)];
        EXPECT_EQ(a.x + a.y, 1.0) << "bits are shared out";
        EXPECT_EQ(b.x, a.x > 0.0 ? 1.0 : 0.0);
        EXPECT_EQ(b.y, a.x > 0.0 ? 0.0 : 1.0);
        mixed += a.x > 0.0 && a.x < 1.0;
    });
    EXPECT_GT(mixed, 20);
}

/// Planes that fall away from the eye: without backtracing, steps of the cone's radius end within them.
TEST(ConeMethods, BacktracedHitsAreNotWithinTheSolid) {
    const auto deepest = [](double tilt, const std::string& method) {
        FieldPicture picture = flatPicture(kSide, kSide);
        picture.field->tree.add(Kind::kPlane, {0, std::sin(tilt), std::cos(tilt), 0});
        picture.field->materials[0] = unlitWhite();
        picture.options.aovs = {Aov::kDepth};
        const MethodResult seen = picture.made(method);
        double most = -HUGE_VAL;
        forPixels([&](int x, int y) {
            const double depth = 10.0 + (0.5 * kSide - (y + 0.5)) * std::tan(tilt);
            if (depth < 1.0) return;
            const float z = std::bit_cast<float>(seen.image.aov.pixel(seen.image.index(x, y))[0]);
            most = std::max(most, z - depth);
        });
        return most;
    };
    double on = -HUGE_VAL, off = -HUGE_VAL;
    for (double tilt = 0.9; tilt < 1.4; tilt += 0.05) {
        on = std::max(on, deepest(tilt, "ctss:alpha=1"));
        off = std::max(off, deepest(tilt, "ctss:alpha=1,backtrace=off"));
    }
    std::printf("deepest sample %.3f px behind the plane; without backtracing %.3f\n", on, off);
    EXPECT_LE(on, 0x1p-17);  // depths are floats up to 64
    EXPECT_GT(off, 0.05);
}

struct ShippedCones {
    Scene scene;
    Film film;
    ResolvedCamera camera;
    Prefilter filter = makePrefilter("box", {}, {});
    RenderOptions options;
    Progress progress;

    explicit ShippedCones(const std::string& name) : scene(loadScene(findScene(name))) {
        CameraOptions wanted;
        wanted.size = glm::ivec2(80, 45);
        camera = resolveCamera(scene, wanted, film);
        options.device = DeviceChoice::kCpu;
    }
    MethodResult made(const std::string& method, std::optional<PixelBox> crop = {}) {
        if (crop) film.crop = *crop;
        return runMethod(parseMethod(method), {scene, camera, film, filter, options, progress});
    }
};

int differing(const ImageBuffer& a, const ImageBuffer& b) {
    int count = 0;
    for (int y = b.box.y0; y < b.box.y1; ++y)
        for (int x = b.box.x0; x < b.box.x1; ++x)
            count += std::memcmp(&a.rgba[a.index(x, y)], &b.rgba[b.index(x, y)], sizeof(glm::dvec4)) != 0 ||
                     a.edge[a.index(x, y)] != b.edge[b.index(x, y)];
    return count;
}

TEST(ConeMethods, ACropHasTheBitsOfTheWhole) {
    for (const char* method : {"ctss", "ctss-r", "ctss:coverage=3", "ctss+ssaa:2", "ctss-x"}) {
        const MethodResult whole = ShippedCones("primitives").made(method),
                           part = ShippedCones("primitives").made(method, PixelBox{13, 9, 50, 38});
        EXPECT_EQ(differing(whole.image, part.image), 0) << method;
    }
}

/// Borders that cut edges, shadows' borders and what is beside them.
TEST(ConeMethods, RandomCropsOfConesAndLinesHaveTheBitsOfTheWhole) {
    std::mt19937 random(kSeed);
    for (const char* name : {"primitives", "atrium"}) {
        const MethodResult whole = ShippedCones(name).made("ctss-x");
        int mixed = 0;
        for (int i = 0; i < 12; ++i) {
            const int x = static_cast<int>(random() % 40), y = static_cast<int>(random() % 24);
            const MethodResult part = ShippedCones(name).made("ctss-x", PixelBox{x, y, x + 11, y + 9});
            EXPECT_EQ(differing(whole.image, part.image), 0) << name << ", seed " << kSeed << ", " << i;
            for (const float edge : part.image.edge) mixed += edge > 0.0f;
        }
        EXPECT_GT(mixed, 100) << name;
    }
}

TEST(ConeMethods, ThreadsAndMemoryChangeNoBit) {
    for (const char* method : {"ctss", "ctss+ssaa:2", "ctss-x"}) {
        ShippedCones one("primitives");
        one.options.threads = 1, one.options.memory_mib = 1;
        EXPECT_EQ(differing(ShippedCones("primitives").made(method).image, one.made(method).image), 0)
            << method;
    }
}

/// Rays of pixels of one unit: the film moved by whole pixels has the same rays.
TEST(ConeMethods, AShiftByWholePixelsMovesThePicture) {
    const Edge edge = edgeAt(31.0, 0.137);
    for (const char* method : {"ctss", "ctss-r", "ctss+ssaa:2", "ctss-x"}) {
        FieldPicture still = wallPicture(edge), moved = wallPicture(edge);
        moved.film.shift_px = {3.0, -2.0};
        const MethodResult a = still.made(method), b = moved.made(method);
        int compared = 0;
        for (int y = 2; y < kSide; ++y)
            for (int x = 0; x + 3 < kSide; ++x, ++compared)
                // Lines hold their absolute place: it is rounded.
                EXPECT_NEAR(redOf(b, x, y), redOf(a, x + 3, y - 2),
                            std::string_view(method) == "ctss-x" ? kRounding : 0.0)
                    << method;
        EXPECT_GT(compared, 400);
    }
}

/// A ball and a checkered floor that rays meet in closed form.
FieldPicture closedForms() {
    FieldPicture picture = flatPicture(kSide, kSide);
    using Type = sdf::AnalyticShape::Type;
    picture.field->analytic.push_back({Type::kSphere, {1.3, 0.4, 2}, 6.2, {0, 1, 0}, 0.0, 0});
    picture.field->analytic.push_back(
        {Type::kPlane, {0, 0, 0}, 1.0, glm::normalize(glm::dvec3(0, 1, 1)), -8.0, 1});
    picture.field->materials.assign(2, unlitWhite());
    picture.field->materials[0].color = {1, 0, 0};
    picture.field->materials[1].pattern = sdf::SurfaceMaterial::Pattern::kChecker;
    picture.field->materials[1].color = {0, 1, 0}, picture.field->materials[1].second_color = {0, 0, 1};
    picture.field->materials[1].pattern_size = 5.0;
    return picture;
}

TEST(ConeMethods, ClosedFormsAreAntialiasedAndKeepTheirPatterns) {
    FieldPicture picture = closedForms();
    const MethodResult none = picture.made("none"), ctss = picture.made("ctss");
    const auto at = [](const MethodResult& r, int x, int y) {
        return glm::dvec3(r.image.rgba[r.image.index(x, y)]);
    };
    int flat = 0, mixed = 0, squares = 0;
    forPixels(
        [&](int x, int y) {
            bool same = true;
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i) same = same && at(none, x + i, y + j) == at(none, x, y);
            const glm::dvec3 c = at(ctss, x, y);
            mixed += c.x > 0.0 && c.x < 1.0;
            if (!same) return;
            EXPECT_EQ(c, at(none, x, y)) << x << "," << y;
            ++flat, squares += c.z == 1.0;
        },
        1);
    EXPECT_GT(flat, 100);
    EXPECT_GT(squares, 20) << "no square of the other colour";
    EXPECT_GT(mixed, 15) << "the ball's outline is not antialiased";
}

/// Outside, the union's distance is the nearest closed form's; planes are the half-spaces without the eye.
TEST(ConeMethods, ClosedFormsBecomeTheirDistances) {
    const FieldPicture picture = closedForms();
    for (const double side : {1.0, -1.0}) {
        const sdf::FieldScene all = sdf::fieldOfAll(*picture.field, {0, 0, side * 40.0});
        EXPECT_TRUE(all.analytic.empty());
        const sdf::Tape tape = sdf::lower(all.tree);
        std::mt19937 random(kSeed);
        std::uniform_real_distribution<> number(-20.0, 20.0);
        for (int i = 0; i < 200; ++i) {
            const glm::dvec3 p(number(random), number(random), number(random));
            const double ball = glm::distance(p, {1.3, 0.4, 2}) - 6.2,
                         plane = side * ((p.y + p.z) * std::sqrt(0.5) + 8.0);
            // Ten roundings of numbers up to 64.
            EXPECT_NEAR(sdf::valueAt(tape, p), std::min(ball, plane), 10 * 0x1p-52 * 64.0);
        }
    }
}

/// Factors of 2 leave every bit of f / L.
TEST(ConeMethods, AScaledFieldWithItsBoundHasTheSameBits) {
    const auto picture = [](double factor) {
        FieldPicture p = flatPicture(kSide, kSide);
        sdf::Tree& tree = p.field->tree;
        const auto wall = wallOn(tree, edgeAt(31.0, 0.137), -6.0);
        const auto ball = tree.add(Kind::kTranslate, {-3, 2, 3}, {tree.add(Kind::kSphere, {4.3})});
        tree.root = tree.add(Kind::kUnion, {}, {wall, ball});
        if (factor != 1.0) tree.root = tree.add(Kind::kScaleValue, {factor}, {tree.root});
        p.field->materials[0].color = {0.7, 0.5, 0.2};
        return p;
    };
    for (const char* method : {"ctss", "ctss-r", "ctss:mask=4x8,coverage=2", "ctss+ssaa:2", "ctss-x"}) {
        const MethodResult whole = picture(1.0).made(method);
        int edges = 0;
        for (const float edge : whole.image.edge) edges += edge == 1.0f;
        EXPECT_GT(edges, 30) << method;
        for (const double factor : {0.5, 0.25})
            EXPECT_EQ(differing(whole.image, picture(factor).made(method).image), 0)
                << method << " " << factor;
    }
}

double errorOf(const MethodResult& seen, const Edge& edge) {
    double sum = 0.0;
    forPixels([&](int x, int y) { sum += std::pow(redOf(seen, x, y) - boxShare(edge, x, y), 2); });
    return std::sqrt(sum / (kSide * kSide));
}

TEST(ConeMethods, ConesOfSubPixelsAreFiner) {
    double ctss = 0.0, both = 0.0;
    for (const double degrees : {7.0, 31.0, 78.0}) {
        const Edge edge = edgeAt(degrees, 0.137);
        FieldPicture picture = wallPicture(edge);
        ctss += errorOf(picture.made("ctss"), edge), both += errorOf(picture.made("ctss+ssaa:2"), edge);
    }
    std::printf("rms error: ctss %.5f, ctss+ssaa:2 %.5f\n", ctss / 3, both / 3);
    EXPECT_LT(both, 0.6 * ctss);  // half the radius, so half the error, and more masks to even it out
}

TEST(ConeMethods, WhatTheyCannotDoIsRefusedInALine) {
    FieldPicture picture = wallPicture(edgeAt(31.0, 0.137));
    for (const char* wrong :
         {"ctss+ssaa", "ctss+fxaa", "ctss+ssaa:0", "none+ssaa:2", "ctss:alpha=2", "ctss:mask=5x5",
          "ctss:visible=33", "ctss:visible=1.5", "ctss:coverage=0", "ctss:coverage=nan", "ctss:3",
          "ctss-x:mask=6x6", "ctss-x+ssaa:2", "ctss-r:sky=off"}) {
        try {
            picture.made(wrong);
            ADD_FAILURE() << wrong << " was taken";
        } catch (const InputError& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << wrong;
            EXPECT_NE(std::string(error.what()), "") << wrong;
        }
    }
    picture.scene.field.reset();
    EXPECT_THROW(picture.made("ctss"), InputError);
}

}  // namespace
}  // namespace edgewise::test
