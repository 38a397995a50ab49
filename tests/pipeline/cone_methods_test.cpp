// Cone-traced supersampling and ctss-x on small pictures whose coverage is known in closed form.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <random>

#include "pipeline/error.h"
#include "pipeline/load_scene.h"
#include "pipeline/resolve_camera.h"
#include "pipeline/scene_catalog.h"
#include "sdf/evaluate.h"
#include "sdf/field_of_all.h"
#include "tests/pipeline/field_pictures.h"

namespace edgewise::test {
namespace {

using sdf::Kind;

constexpr unsigned kSeed = 20236;
constexpr int kSide = 24;
const double kRadius = std::sqrt(0.5);  // of a pixel's cone: through its corners
constexpr double kHardX = 0.5 / 64.0;   // ctss-x's
constexpr double kHard = 0.125 * 0.5;   // a ray has hit where the distance is below: TraceSettings::threshold

/// A line through the picture: a solid lies where at(q) < 0; q in pixels, y down.
struct Edge {
    glm::dvec2 n;
    double c = 0.0;
    double at(const glm::dvec2& q) const { return glm::dot(n, q) + c; }
};
Edge edgeAt(double degrees, double offset) {
    const double angle = glm::radians(degrees);
    const glm::dvec2 n(std::cos(angle), std::sin(angle));
    return {n, offset - glm::dot(n, glm::dvec2(0.5 * kSide))};
}

/// Of a pixel, the part within the edge: the corners' triangles by inclusion and exclusion.
double boxShare(const glm::dvec2& n, double at_centre) {
    const double a = std::abs(n.x), b = std::abs(n.y), c = 0.5 * (a + b) - at_centre;
    const auto triangle = [&](double s) { return s > 0.0 ? s * s / (2.0 * a * b) : 0.0; };
    return triangle(c) - triangle(c - a) - triangle(c - b) + triangle(c - a - b);
}
/// Of an area from positions up to 32 px, over the 2 a b that triangles are divided by: some ten roundings.
constexpr double kRounding = 10.0 * 0x1p-52 * 32.0 / (2.0 * 0.1);
double boxShare(const Edge& edge, int x, int y) {
    return boxShare(edge.n, edge.at({x + 0.5, y + 0.5}));
}

/// A node turned and put so that its local x = 0 is on the edge, its inner side -x.
std::uint32_t onEdge(sdf::Tree& tree, std::uint32_t node, const Edge& edge, double z = 0.0) {
    const double degrees = glm::degrees(std::atan2(-edge.n.y, edge.n.x));
    const double offset = -edge.at(glm::dvec2(0.5 * kSide));
    const auto turned = tree.add(Kind::kRotate, {0, 0, 1, degrees}, {node});
    return tree.add(Kind::kTranslate, {offset * edge.n.x, -offset * edge.n.y, z}, {turned});
}
/// A wall with front and back at z = -4 and 4, its side on the edge.
std::uint32_t wallOn(sdf::Tree& tree, const Edge& edge, double z = 0.0) {
    const auto box = tree.add(Kind::kBox, {100, 100, 8});
    return onEdge(tree, tree.add(Kind::kTranslate, {-50, 0, 0}, {box}), edge, z);
}

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

FieldPicture wallPicture(const Edge& edge) {
    FieldPicture picture = flatPicture(kSide, kSide);
    wallOn(picture.field->tree, edge);
    picture.field->tree.root = static_cast<std::uint32_t>(picture.field->tree.nodes.size() - 1);
    picture.field->materials[0] = unlitWhite();
    return picture;
}

double redOf(const MethodResult& result, int x, int y) {
    return result.image.rgba[result.image.index(x, y)].x;
}
void forPixels(const std::function<void(int, int)>& pixel, int margin = 0) {
    for (int y = margin; y < kSide - margin; ++y)
        for (int x = margin; x < kSide - margin; ++x) pixel(x, y);
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

// ctss-x

/// A straight edge that all rays pass at a right angle is a line in closed form. A corner of a pixel that
/// reaches past it by less than hits do is not seen.
TEST(ConesAndLines, AWallsEdgeIsExact) {
    double worst = 0.0, worst_corner = 0.0;
    int edges = 0;
    std::mt19937 random(kSeed);
    std::printf("seed %u\n", kSeed);
    std::uniform_real_distribution<> turn(5.0, 40.0), offset(-0.5, 0.5);
    for (int i = 0; i < 12; ++i) {
        const Edge edge = edgeAt(turn(random) + 90.0 * (i % 4), offset(random));
        const double reach = 0.5 * (std::abs(edge.n.x) + std::abs(edge.n.y));
        const double corner = boxShare(edge.n, reach - kHardX);
        const MethodResult seen = wallPicture(edge).made("ctss-x");
        forPixels([&](int x, int y) {
            const double exact = boxShare(edge, x, y), off = std::abs(redOf(seen, x, y) - exact);
            const bool hidden = 1.0 - exact <= corner;
            edges += exact > 1e-9 && exact < 1.0 - 1e-9;
            double& most = hidden ? worst_corner : worst;
            most = std::max(most, off);
            EXPECT_LE(off, hidden ? corner + kRounding : kRounding) << x << "," << y;
        });
    }
    std::printf("%d edge pixels off by at most %.1e; corners not seen %.4f\n", edges, worst, worst_corner);
    EXPECT_GT(edges, 200);
}

/// Two faces that lean apart from the view meet in an edge; the field is the greater one of their distances,
/// one of them shrunk. Its outline is a line in closed form.
TEST(ConesAndLines, TheOutlineOfAnIntersectionIsExact) {
    double worst = 0.0, worst_corner = 0.0;
    int edges = 0;
    std::mt19937 random(kSeed);
    std::printf("seed %u\n", kSeed);
    std::uniform_real_distribution<> turn(5.0, 40.0), offset(-0.5, 0.5), lean(20.0, 70.0), shrink(0.3, 1.0);
    for (int i = 0; i < 12; ++i) {
        const Edge edge = edgeAt(turn(random) + 90.0 * (i % 4), offset(random));
        FieldPicture picture = flatPicture(kSide, kSide);
        sdf::Tree& tree = picture.field->tree;
        const auto face = [&](double degrees) {
            const double angle = glm::radians(degrees);
            return tree.add(Kind::kPlane, {std::cos(angle), 0, std::sin(angle), 0});
        };
        const double front = lean(random), back = -lean(random), factor = shrink(random);
        const auto shrunk = tree.add(Kind::kScaleValue, {factor}, {face(i % 2 ? front : back)});
        // A slab of it: else it would reach past the eye.
        const auto box = tree.add(Kind::kBox, {100, 100, 8});
        onEdge(tree, tree.add(Kind::kIntersection, {}, {face(i % 2 ? back : front), shrunk, box}), edge);
        tree.root = static_cast<std::uint32_t>(tree.nodes.size() - 1);
        picture.field->materials[0] = unlitWhite();
        // A hit floats before the front face by kHardX of a value, and so beyond the edge on the film.
        const double floats = kHardX / ((i % 2 ? factor : 1.0) * std::cos(glm::radians(front)));
        const double reach = 0.5 * (std::abs(edge.n.x) + std::abs(edge.n.y));
        const double corner = boxShare(edge.n, reach - floats);
        const MethodResult seen = picture.made("ctss-x");
        forPixels([&](int x, int y) {
            const double exact = boxShare(edge, x, y), apart = std::abs(redOf(seen, x, y) - exact);
            const bool hidden = 1.0 - exact <= corner;
            edges += exact > 1e-9 && exact < 1.0 - 1e-9;
            double& most = hidden ? worst_corner : worst;
            most = std::max(most, apart);
            EXPECT_LE(apart, hidden ? corner + kRounding : kRounding) << x << "," << y << " of picture " << i;
        });
    }
    std::printf("%d edge pixels off by at most %.1e; corners not seen %.4f\n", edges, worst, worst_corner);
    EXPECT_GT(edges, 200);
}

/// Rays that begin within a solid meet nothing where they are said to hit.
TEST(ConesAndLines, RaysThatBeginWithinASolidAreNamedAllTheSame) {
    for (const double lean : {20.0, 45.0, 70.0}) {
        FieldPicture picture = flatPicture(kSide, kSide);
        sdf::Tree& tree = picture.field->tree;
        const double angle = glm::radians(lean);
        const auto face = [&](double side) {
            return tree.add(Kind::kPlane, {std::cos(angle), 0, side * std::sin(angle), 0});
        };
        const auto front = face(1.0), back = tree.add(Kind::kScaleValue, {0.5}, {face(-1.0)});
        onEdge(tree, tree.add(Kind::kIntersection, {}, {front, back}), edgeAt(31.0, 0.137));
        tree.root = static_cast<std::uint32_t>(tree.nodes.size() - 1);
        picture.field->materials[0] = unlitWhite();
        const MethodResult seen = picture.made("ctss-x");
        forPixels([&](int x, int y) {
            EXPECT_GE(redOf(seen, x, y), 0.0) << x << "," << y;
            EXPECT_LE(redOf(seen, x, y), 1.0) << x << "," << y;
        });
    }
}

/// A ridge towards the eye, its sides lit apart. Planes are where the surface is: to the rounding of its
/// distance, of 60.
TEST(ConesAndLines, ACreaseIsWhereItsPlanesMeet) {
    const Edge edge = edgeAt(31.0, 0.137);
    FieldPicture picture = flatPicture(kSide, kSide);
    sdf::Tree& tree = picture.field->tree;
    const auto box = tree.add(Kind::kBox, {60, 200, 60});
    const auto turned = tree.add(Kind::kRotate, {0, 1, 0, 45}, {box});
    const double ridge = std::sqrt(0.5) * 60.0;
    onEdge(tree, tree.add(Kind::kTranslate, {0, 0, -ridge}, {turned}), edge);
    tree.root = static_cast<std::uint32_t>(tree.nodes.size() - 1);
    picture.field->materials[0].color = glm::dvec3(1.0);
    sdf::SurfaceLight light;
    light.direction_world = glm::normalize(glm::dvec3(edge.n.x, -edge.n.y, -2.0));
    light.shadows = false;
    picture.field->lights = {light};
    const MethodResult seen = picture.made("ctss-x"), none = picture.made("none");
    double low = HUGE_VAL, high = 0.0;
    forPixels([&](int x, int y) {
        low = std::min(low, redOf(none, x, y)), high = std::max(high, redOf(none, x, y));
    });
    ASSERT_GT(high - low, 0.1);
    double worst = 0.0, worst_none = 0.0;
    int edges = 0;
    forPixels([&](int x, int y) {
        const double share = boxShare(edge, x, y);  // the inner side faces the light
        edges += share > 1e-9 && share < 1.0 - 1e-9;
        worst = std::max(worst, std::abs((redOf(seen, x, y) - low) / (high - low) - share));
        worst_none = std::max(worst_none, std::abs((redOf(none, x, y) - low) / (high - low) - share));
    });
    // The longest chord of a pixel times how far the line may lie off; a corner beyond it by less than a hit
    // floats may be named wrongly, and takes nothing.
    const double off = std::sqrt(2.0) * kHardX * std::sqrt(0.5);
    std::printf("%d edge pixels off by at most %.4f of the step (bound %.4f; none %.2f)\n", edges, worst, off,
                worst_none);
    EXPECT_GT(edges, 20);
    EXPECT_GT(worst_none, 0.4);
    EXPECT_LE(worst, off);
}

/// Mean over all places of a wire within a pixel: what it covers of the picture is its width times its
/// length.
TEST(ConesAndLines, WiresThinnerThanAPixelKeepTheirEnergy) {
    for (const double width : {0.05, 0.2, 0.6}) {
        double sum = 0.0, worst = 0.0;
        constexpr int kShifts = 8;
        for (int shift = 0; shift < kShifts; ++shift) {
            const Edge edge = edgeAt(11.0, (shift + 0.5) / kShifts);
            FieldPicture picture = flatPicture(kSide, kSide);
            sdf::Tree& tree = picture.field->tree;
            onEdge(tree, tree.add(Kind::kBox, {width, 100, 2}), edge);
            tree.root = static_cast<std::uint32_t>(tree.nodes.size() - 1);
            picture.field->materials[0] = unlitWhite();
            const MethodResult seen = picture.made("ctss-x");
            double covered = 0.0, exact = 0.0;
            const Edge left{edge.n, edge.c + 0.5 * width}, right{edge.n, edge.c - 0.5 * width};
            forPixels([&](int x, int y) {
                const double share = boxShare(right, x, y) - boxShare(left, x, y);
                covered += redOf(seen, x, y), exact += share;
                worst = std::max(worst, std::abs(redOf(seen, x, y) - share));
            });
            sum += covered / exact / kShifts;
        }
        std::printf("%.2f px: %.4f of its coverage, a pixel off by at most %.4f\n", width, sum, worst);
        EXPECT_NEAR(sum, 1.0, 0.05) << width;
    }
}

/// A wall over a floor and light from aslant: the shadow's border is the wall's edge, moved.
TEST(ConesAndLines, AShadowsBorderIsSearched) {
    const Edge edge = edgeAt(11.0, -7.3);
    FieldPicture picture = flatPicture(kSide, kSide);
    sdf::Tree& tree = picture.field->tree;
    const auto box = tree.add(Kind::kBox, {100, 100, 1});
    // Beyond the edge: the picture's right; its underside at z = 3.
    const auto wall = onEdge(tree, tree.add(Kind::kTranslate, {50, 0, 0}, {box}), edge, 3.5);
    const auto floor = tree.add(Kind::kPlane, {0, 0, 1, 0});
    tree.root = tree.add(Kind::kUnion, {}, {wall, floor});
    picture.field->materials[0].color = glm::dvec3(1.0);
    sdf::SurfaceLight light;
    const double slope = 2.0;  // px along the floor for each of height
    light.direction_world = glm::normalize(glm::dvec3(-slope * edge.n.x, slope * edge.n.y, -1.0));
    picture.field->lights = {light};
    picture.field->ambient = glm::dvec3(0.1);
    // The light comes from beyond the edge: it passes the upper one, at z = 4, last.
    const Edge shadow{edge.n, edge.c + slope * 4.0};
    const MethodResult seen = picture.made("ctss-x"), none = picture.made("none"),
                       truth = picture.made("ssaa:16");
    double lit = 0.0, dark = HUGE_VAL;
    const auto onFloor = [&](int x, int y) { return edge.at({x + 0.5, y + 0.5}) < -1.0; };
    forPixels([&](int x, int y) {
        if (!onFloor(x, y)) return;
        lit = std::max(lit, redOf(none, x, y)), dark = std::min(dark, redOf(none, x, y));
    });
    ASSERT_GT(lit, 1.5 * dark);
    double worst = 0.0, sum = 0.0, sum_none = 0.0, beside = 0.0;
    int edges = 0;
    forPixels([&](int x, int y) {
        if (!onFloor(x, y)) return;
        const double share = boxShare(shadow, x, y);
        edges += share > 1e-9 && share < 1.0 - 1e-9;
        const auto off = [&](const MethodResult& r) {
            return std::abs((redOf(r, x, y) - dark) / (lit - dark) - share);
        };
        worst = std::max(worst, off(seen)), sum += off(seen) * off(seen);
        sum_none += off(none) * off(none);
        beside += std::pow((redOf(seen, x, y) - redOf(truth, x, y)) / (lit - dark), 2);
    });
    const auto rms = [&](double squares) { return std::sqrt(squares / edges); };
    std::printf("%d border pixels off by at most %.4f, rms %.4f (none %.4f); off ssaa:16 by rms %.4f\n",
                edges, worst, rms(sum), rms(sum_none), rms(beside));
    EXPECT_GT(edges, 20);
    EXPECT_GT(rms(sum_none), 0.2);
    // Hits float over the floor by up to kHardX, and light's rays end as far from the wall: each moves the
    // border by that times the slope, along a chord of at most sqrt(2).
    EXPECT_LE(worst, std::sqrt(2.0) * slope * 2.0 * kHardX);
    // That moves the border of all methods alike; a column of 16 is what ssaa:16 itself is off by.
    EXPECT_LE(rms(beside), 1.0 / 16.0);
}

/// Squares along the pixels' axes, seen from above: shares of both colours are products of overlaps.
TEST(ConesAndLines, CheckersAreAveraged) {
    constexpr double kSquare = 2.3;
    FieldPicture picture = flatPicture(kSide, kSide);
    picture.field->tree.add(Kind::kPlane, {0, 0, 1, 0});
    picture.field->materials[0] = unlitWhite();
    picture.field->materials[0].pattern = sdf::SurfaceMaterial::Pattern::kChecker;
    picture.field->materials[0].pattern_size = kSquare;
    const MethodResult seen = picture.made("ctss-x");
    // Mean of +1 and -1 by squares over an interval of length 1, by lengths.
    const auto sign = [&](double from) {
        double sum = 0.0;
        for (double x = from; x < from + 1.0;) {
            const double cell = std::floor(x / kSquare), end = std::min((cell + 1.0) * kSquare, from + 1.0);
            sum += (static_cast<long>(cell) & 1 ? -1.0 : 1.0) * (end - x);
            x = end > x ? end : std::nextafter(x, HUGE_VAL);
        }
        return sum;
    };
    double worst_same = 0.0, worst_other = 0.0;
    int mixed = 0;
    forPixels(
        [&](int x, int y) {
            const double product = sign(x - 0.5 * kSide) * sign(0.5 * kSide - y - 1.0);
            mixed += std::abs(product) < 0.999;
            worst_same = std::max(worst_same, std::abs(redOf(seen, x, y) - 0.5 * (1.0 + product)));
            worst_other = std::max(worst_other, std::abs(redOf(seen, x, y) - 0.5 * (1.0 - product)));
        },
        1);
    std::printf("%d pixels of both colours, off by at most %.2e\n", mixed, std::min(worst_same, worst_other));
    EXPECT_GT(mixed, 250);
    // Places up to kSide / 2 away, some ten borders. Which colour comes first is the pattern's own.
    EXPECT_LE(std::min(worst_same, worst_other), 10.0 * 10.0 * 0x1p-52 * kSide);
}

}  // namespace
}  // namespace edgewise::test
