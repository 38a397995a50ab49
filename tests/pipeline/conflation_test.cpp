// Two triangles that share an edge hide all that lies behind them; flat triangles may be cut in parts unseen.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/pipeline/nsaa_stages.h"
#include "tests/pipeline/shipped_picture.h"
#include "tests/pipeline/test_scene.h"
#include "tests/witness/dice.h"
#include "tests/witness/kernels.h"

namespace edgewise {
namespace {

constexpr int kFilmPx = 12;
constexpr int kPictures = 150;
constexpr double kBright = 0x1p40;

/// A red and a green triangle, far larger than the film, whose common edge runs through `p` of the film at
/// `angle`.
Scene twoTriangles(glm::dvec2 p_px, double angle, double depth) {
    const double scale = 2.0 * depth / kFilmPx;
    const glm::dvec2 p(scale * (p_px.x - kFilmPx / 2.0), scale * (kFilmPx / 2.0 - p_px.y));
    const glm::dvec2 along = 10.0 * depth * witness::unitVector(angle), across(-along.y, along.x);
    const auto corner = [&](glm::dvec2 v) { return glm::vec3(v.x, v.y, -depth); };
    const glm::vec3 a = corner(p - along), b = corner(p + along);
    Geometry geometry = test::makeGeometry({{a, b, corner(p + across)}, {b, a, corner(p - across)}});
    for (int k = 0; k < 6; ++k) geometry.color.push_back({k < 3 ? 1.0 : 0.0, k < 3 ? 0.0 : 1.0, 0.0, 1.0});
    return test::makeScene({geometry});
}

/// The most that compositing coverage would let through, "over" by "over": (1 - w) (1 - (1 - w)).
double conflated(const glm::dvec4& color) {
    return std::max(0.0, color.r * color.g);
}

class Conflation : public testing::TestWithParam<Prefilter> {};

TEST_P(Conflation, NothingComesThroughASharedEdge) {
    const Prefilter filter = makePrefilter(GetParam().name, {}, {});
    constexpr std::uint64_t kSeed = 20;
    witness::Dice dice(kSeed);
    RenderOptions options;
    options.background = {0, 0, kBright};
    std::size_t mixed = 0, steep = 0, flat = 0;
    double through_nsaa = 0.0, through_ssaa = 0.0, through_over = 0.0;
    for (int i = 0; i < kPictures; ++i) {
        const double angle =
            i % 5 == 0 ? M_PI_2 * dice.integer(0, 3) + dice.coin() * dice.magnitude(-12, -2) : dice.angle();
        const glm::dvec2 p = i % 3 == 0
                                 ? glm::dvec2(dice.integer(4, 8), dice.integer(4, 8)) + 0.5 * dice.coin()
                                 : dice.around(glm::dvec2(kFilmPx / 2.0), 2.0);
        const Scene scene = twoTriangles(p, angle, dice.magnitude(-0.5, 2));
        const ResolvedCamera camera = test::makePerspective();
        const Film film = test::makeFilm(kFilmPx, kFilmPx);
        Progress progress;
        const MethodInput input{scene, camera, film, filter, options, progress};
        const MethodResult nsaa = runMethod(parseMethod("nsaa"), input),
                           ssaa = runMethod(parseMethod("ssaa:4"), input);
        EXPECT_EQ(nsaa.counts.at("label_conflicts"), 0u);
        for (std::size_t k = 0; k < nsaa.image.rgba.size(); ++k) {
            const glm::dvec4& c = nsaa.image.rgba[k];
            EXPECT_EQ(c.b, 0.0) << "seed " << kSeed << " picture " << i << " pixel " << k;
            EXPECT_EQ(c.a, 1.0);
            EXPECT_EQ(ssaa.image.rgba[k].b, 0.0) << "seed " << kSeed << " picture " << i << " pixel " << k;
            through_over = std::max(through_over, conflated(c));
            mixed += c.r != 0.0 && c.g != 0.0;
            through_nsaa = std::max(through_nsaa, std::abs(c.b) / kBright);
            through_ssaa = std::max(through_ssaa, std::abs(ssaa.image.rgba[k].b) / kBright);
        }
        steep += std::abs(std::cos(angle)) < 1e-3, flat += std::abs(std::sin(angle)) < 1e-3;
    }
    EXPECT_GT(mixed, 10u * kPictures);
    EXPECT_GT(steep, 3u);
    EXPECT_GT(flat, 3u);
    EXPECT_GT(through_over, 0.24);  // an edge through a pixel's middle was there: 1/4 would come through
    fmt::print(
        "{:<20} seed {}: {} pixels with both colours, {} vertical and {} horizontal edges; largest share of "
        "the "
        "background let through: nsaa {}, ssaa:4 {}, coverages composited {:.3f}\n",
        filter.name, kSeed, mixed, steep, flat, through_nsaa, through_ssaa, through_over);
}

/// Every name of the contract.
std::vector<Prefilter> everyFilter() {
    std::vector<Prefilter> filters = witness::allPrefilters();
    filters.push_back(makePrefilter("bc:0.25,0.5", {}, {}));
    return filters;
}

INSTANTIATE_TEST_SUITE_P(All, Conflation, testing::ValuesIn(everyFilter()),
                         [](const auto& one) { return test::nameOf(one.param); });

// Splitting. Every triangle lies in a plane of one z of its own: a point inside it is coplanar with it
// exactly in the file, and stays inside after the rounding of the screen.

struct FlatTriangle {
    test::Corners corners;
    glm::dvec4 color;
};

std::vector<FlatTriangle> flatTriangles(std::uint64_t seed, int count) {
    witness::Dice dice(seed);
    std::vector<FlatTriangle> triangles;
    while (static_cast<int>(triangles.size()) < count) {
        const auto z = static_cast<float>(-1.0 - dice.integer(0, 255) / 256.0);
        FlatTriangle t{{}, {dice.uniform(0, 1), dice.uniform(0, 1), dice.uniform(0, 1), 1}};
        for (glm::vec3& p : t.corners)
            p = {static_cast<float>(dice.integer(-512, 512)) / 256,
                 static_cast<float>(dice.integer(-512, 512)) / 256, z};
        const glm::vec2 u = t.corners[1] - t.corners[0], v = t.corners[2] - t.corners[0];
        if (std::abs(u.x * v.y - u.y * v.x) > 0.125f) triangles.push_back(t);
    }
    return triangles;
}

/// One geometry a triangle, so that its parts follow each other in index order; in one part or three.
Scene sceneOf(const std::vector<FlatTriangle>& triangles, bool split) {
    std::vector<Geometry> geometry;
    for (const auto& [corners, color] : triangles) {
        const auto& [a, b, c] = corners;
        const glm::vec3 inside = 0.5f * a + 0.25f * b + 0.25f * c;
        geometry.push_back(split ? test::makeGeometry({{a, b, inside}, {b, c, inside}, {c, a, inside}})
                                 : test::makeGeometry({corners}));
        geometry.back().color.assign(geometry.back().position_file.size(), color);
    }
    return test::makeScene(std::move(geometry));
}

TEST(Splitting, FlatTrianglesInPartsLookTheSame) {
    constexpr std::uint64_t kSeed = 8;
    const Scene whole = sceneOf(flatTriangles(kSeed, 120), false),
                parts = sceneOf(flatTriangles(kSeed, 120), true);
    const ResolvedCamera camera = test::makePerspective();
    const Film film = test::makeFilm(48, 48);
    RenderOptions options = test::onBlue();
    options.no_skip = {"cancel"};  // else the parts are one owner before they are integrated
    Progress progress;
    double worst = 0.0, worst_of_bound = 0.0;
    for (const Prefilter& kernel : witness::allPrefilters()) {
        const Prefilter filter = makePrefilter(kernel.name, {}, {});
        const MethodInput a{whole, camera, film, filter, options, progress},
            b{parts, camera, film, filter, options, progress};
        const MethodResult one = runMethod(parseMethod("nsaa"), a), three = runMethod(parseMethod("nsaa"), b);
        EXPECT_GT(three.counts.at("segments"), one.counts.at("segments"));
        test::NsaaStages one_stages(a), three_stages(b);
        for (int y = 0; y < film.height; ++y)
            for (int x = 0; x < film.width; ++x) {
                const glm::dvec4 d =
                    one.image.rgba[one.image.index(x, y)] - three.image.rgba[one.image.index(x, y)];
                const double difference =
                    std::max({std::abs(d.r), std::abs(d.g), std::abs(d.b), std::abs(d.a)});
                if (difference == 0.0) continue;
                const double bound =
                    one_stages.pixel(x, y).colorError() + three_stages.pixel(x, y).colorError();
                EXPECT_LE(difference, bound)
                    << kernel.name << " seed " << kSeed << " pixel " << x << ", " << y;
                worst = std::max(worst, difference),
                worst_of_bound = std::max(worst_of_bound, difference / bound);
            }
    }
    fmt::print("seed {}: worst {:.1e}, {:.2f} of its bound\n", kSeed, worst, worst_of_bound);
}

}  // namespace
}  // namespace edgewise
