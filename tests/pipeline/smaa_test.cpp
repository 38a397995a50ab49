// SMAA's passes, and what it makes of pictures.
#include "pipeline/methods/smaa.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "pipeline/decode_image.h"
#include "pipeline/methods/smaa_textures.h"
#include "pipeline/srgb.h"
#include "tests/pipeline/post_pictures.h"
#include "tests/pipeline/shipped_picture.h"

namespace edgewise {
namespace {

constexpr SmaaSettings kStraightOnly{
    .threshold = 0.1f, .search_steps = 8, .diagonal_steps = 0, .corner_rounding = 1.0f};

/// Linear colour of an 8-bit code.
glm::dvec3 grey(int code) {
    return glm::dvec3(decodeSrgb(code / 255.0));
}

TEST(SmaaEdges, AreWhereTheEncodedContrastReachesTheThreshold) {
    Progress progress;
    const auto edgeOf = [&](int code, float threshold) {
        const ImageBuffer image =
            test::makePicture(8, 3, [&](int x, int) { return grey(x < 4 ? 100 : code); });
        return findEdges(image, {.threshold = threshold}, progress).at(4, 1);
    };
    EXPECT_EQ(edgeOf(125, 0.1f), 0);  // 25/255 < 0.1 < 26/255
    EXPECT_EQ(edgeOf(126, 0.1f), kLeftEdge);
    EXPECT_EQ(edgeOf(126, 0.15f), 0);
    EXPECT_EQ(edgeOf(113, 0.05f), kLeftEdge);
    EXPECT_EQ(edgeOf(74, 0.1f), kLeftEdge);
}

TEST(SmaaEdges, AMuchStrongerEdgeNearbyMasks) {
    Progress progress;
    const auto edges = [&](int third) {
        const int codes[] = {0, 0, 60, 60 + third, 60 + third};
        return findEdges(test::makePicture(5, 3, [&](int x, int) { return grey(codes[x]); }), {}, progress);
    };
    EXPECT_EQ(edges(29).at(3, 1), 0);  // 29 is less than half of 60
    EXPECT_EQ(edges(31).at(3, 1), kLeftEdge);
    EXPECT_EQ(edges(29).at(2, 1), kLeftEdge);
}

TEST(SmaaEdges, OfColorSeeWhatLumaDoesNot) {
    Progress progress;
    const ImageBuffer image = test::makePicture(
        6, 3, [](int x, int) { return glm::dvec3(0.2, 0.2, decodeSrgb(x < 3 ? 0.2 : 0.8)); });
    EXPECT_EQ(findEdges(image, {}, progress).at(3, 1), 0);
    EXPECT_EQ(findEdges(image, {.color_edges = true}, progress).at(3, 1), kLeftEdge);
}

TEST(SmaaEdges, OfColorAreMaskedByThePixelBeyondItself) {
    Progress progress;
    const auto isEdge = [&](std::array<int, 3> codes, bool color, bool columns) {
        const ImageBuffer image =
            test::makePicture(5, 5, [&](int x, int y) { return grey(codes[std::min(columns ? x : y, 2)]); });
        const std::uint8_t edges = findEdges(image, {.color_edges = color}, progress).at(2, 2);
        return edges == (columns ? kLeftEdge : kTopEdge);
    };
    for (const bool columns : {false, true}) {
        // 62, twice the step, is more than the 60 of the step beyond, and less than the 91 of both.
        EXPECT_TRUE(isEdge({0, 60, 91}, false, columns));
        EXPECT_FALSE(isEdge({0, 60, 91}, true, columns));
        // 58 is less than the 60 beyond, and more than the 31 that are left of it.
        EXPECT_FALSE(isEdge({60, 0, 29}, false, columns));
        EXPECT_TRUE(isEdge({60, 0, 29}, true, columns));
    }
}

/// The same end of a line, pixel by pixel.
int walk(const SmaaEdges& edges, int x, int y, int step) {
    const auto crossed = [&](int at) { return (edges.at(at, y) | edges.at(at, y - 1)) & kLeftEdge; };
    int distance = 0;
    for (; distance < 2 * kStraightOnly.search_steps; ++distance, x += step)
        if (crossed(step < 0 ? x : x + 1) || !(edges.at(x + step, y) & kTopEdge)) break;
    return distance;
}

TEST(SmaaWeights, DistancesAreThoseOfAWalkAlongTheLine) {
    Progress progress;
    std::mt19937 random(7);
    int long_lines = 0;
    for (int picture = 0; picture < 300; ++picture) {
        SmaaEdges edges(40, 5);
        for (int y = 0; y < 5; ++y)
            for (int x = 12; x < 26; ++x)
                edges.texel(x, y) =
                    static_cast<std::uint8_t>((random() % 8 ? kTopEdge : 0) | (random() % 6 ? 0 : kLeftEdge));
        const SmaaWeights weights = weighEdges(edges, kStraightOnly, progress);
        for (int x = 12; x < 26; ++x) {
            if (!(edges.at(x, 2) & kTopEdge)) continue;
            const int left = walk(edges, x, 2, -1), right = walk(edges, x, 2, 1);
            const auto crossing = [&](int at) {
                return 3 * (edges.at(at, 2) & kLeftEdge) + (edges.at(at, 1) & kLeftEdge);
            };
            const glm::vec2 area = smaaAreas().orthogonal(crossing(x - left), crossing(x + right + 1),
                                                          std::sqrt(float(left)), std::sqrt(float(right)));
            EXPECT_EQ(weights.at(x, 2).x, std::floor(area.x + 0.5f)) << left << ' ' << right;
            EXPECT_EQ(weights.at(x, 2).y, std::floor(area.y + 0.5f)) << left << ' ' << right;
            long_lines += left + right > 6;
        }
    }
    EXPECT_GT(long_lines, 50);
}

/// A stair of `steps` steps with all four edges that may cross its ends; bits 2 and 1 of either crossing as
/// in the table. It rises to the upper right, or falls to the lower right; its first top edge is at (8, 16).
SmaaEdges stair(int steps, bool rises, int crossing_left, int crossing_right) {
    SmaaEdges edges(32, 32);
    const auto add = [&](int x, int y, std::uint8_t edge) { edges.texel(x, y) |= edge; };
    const int up = rises ? -1 : 1, last_x = 8 + steps - 1, last_y = 16 + up * (steps - 1);
    for (int i = 0; i < steps; ++i) add(8 + i, 16 + up * i, kTopEdge);
    for (int i = 1; i < steps; ++i) add(8 + i, 16 + (rises ? -i : i - 1), kLeftEdge);
    if (crossing_left & 1) add(8, rises ? 16 : 15, kLeftEdge);
    if (crossing_left & 2) add(7, 16, kTopEdge);
    if (crossing_right & 1) add(last_x + 1, rises ? last_y - 1 : last_y, kLeftEdge);
    if (crossing_right & 2) add(last_x + 1, last_y, kTopEdge);
    return edges;
}

TEST(SmaaWeights, AStairHasTheAreasOfItsDiagonal) {
    Progress progress;
    int weighed = 0;
    for (const bool rises : {false, true})
        for (int steps = 4; steps < 8; ++steps)
            for (int crossings = 0; crossings < 16; ++crossings) {
                const int left = crossings % kDiagonalCrossings, right = crossings / kDiagonalCrossings;
                const SmaaWeights weights =
                    weighEdges(stair(steps, rises, left, right), {.diagonal_steps = 9}, progress);
                for (int i = 0; i < steps; ++i) {
                    const glm::u8vec4 found = weights.at(8 + i, rises ? 16 - i : 16 + i);
                    const SmaaArea area = smaaAreas().diagonalTexel(kDiagonalSize * left + i,
                                                                    kDiagonalSize * right + steps - 1 - i);
                    if (area == SmaaArea(0)) continue;
                    // Under a falling diagonal lies what is over a rising one.
                    EXPECT_EQ(found.x, rises ? area.x : area.y) << rises << steps << ' ' << crossings;
                    EXPECT_EQ(found.y, rises ? area.y : area.x) << rises << steps << ' ' << crossings;
                    EXPECT_EQ(found.z + found.w, 0);
                    ++weighed;
                }
            }
    EXPECT_GT(weighed, 600);
}

TEST(SmaaWeights, ColumnsAreRowsTransposed) {
    Progress progress;
    std::mt19937 random(8);
    SmaaEdges rows(30, 30), columns(30, 30);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 30; ++x) {
            const bool line = random() % 2, crossing = random() % 5 == 0;
            rows.texel(x, y) = static_cast<std::uint8_t>((line ? kTopEdge : 0) | (crossing ? kLeftEdge : 0));
            columns.texel(y, x) =
                static_cast<std::uint8_t>((line ? kLeftEdge : 0) | (crossing ? kTopEdge : 0));
        }
    SmaaSettings settings = kStraightOnly;
    settings.corner_rounding = 0.25f;
    const SmaaWeights a = weighEdges(rows, settings, progress), b = weighEdges(columns, settings, progress);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 30; ++x) {
            const glm::u8vec4 t = b.at(y, x);
            EXPECT_EQ(a.at(x, y), glm::u8vec4(t.z, t.w, t.x, t.y));
        }
}

TEST(SmaaBlend, AHalfMixesTwoPixelsInTheAskedSpace) {
    Progress progress;
    for (const bool gamma : {false, true}) {
        ImageBuffer image = test::makePicture(1, 3, [](int, int y) { return glm::dvec3(y > 0); });
        SmaaWeights weights(1, 3);
        weights.texel(0, 1) = {51, 102, 0, 0};
        blendNeighbours(weights, {.gamma_blend = gamma}, image, progress);
        const auto expected = [&](double share) { return gamma ? decodeSrgb(share) : share; };
        EXPECT_DOUBLE_EQ(image.rgba[1].r, expected(1.0 - 51 / 255.0));
        EXPECT_DOUBLE_EQ(image.rgba[0].r, expected(102 / 255.0));
        EXPECT_EQ(image.rgba[0].a, 1.0);
    }
}

TEST(Smaa, LeavesFlatPicturesAndStraightEdgesAlone) {
    for (const char* method : {"smaa:preset=low", "smaa", "smaa:preset=ultra,edges=color,blend=gamma"}) {
        const ImageBuffer flat =
            test::makePicture(20, 15, [](int, int) { return glm::dvec3(0.3, 7.0, 1e-3); });
        EXPECT_EQ(test::filtered(flat, method).rgba, flat.rgba);
        const ImageBuffer edge = test::makePicture(20, 15, [](int, int y) { return glm::dvec3(y < 7); });
        EXPECT_EQ(test::filtered(edge, method).rgba, edge.rgba);
    }
}

TEST(Smaa, BringsAnEdgeOfSlopeAnEighthNearToItsCoverage) {
    for (const double slope : {0.125, -0.125, 0.9}) {
        const double offset = slope == 0.9 ? 3.3 : 24.3 - 24 * slope;
        const ImageBuffer image = test::sampledHalfPlane(48, offset, slope);
        const double before = test::errorOfHalfPlane(image, offset, slope, 9);
        const double after = test::errorOfHalfPlane(test::filtered(image, "smaa"), offset, slope, 9);
        EXPECT_LT(after, 0.3 * before) << slope;
        RecordProperty("ratio of slope " + std::to_string(slope), std::to_string(after / before));
    }
}

TEST(Smaa, MirroredPicturesGiveMirroredResults) {
    // Of two colours, so that no edge masks another; lines shorter than the search, and off the border.
    const ImageBuffer image = test::makePicture(48, 48, [](int x, int y) {
        const bool inside = y > 10 + 0.21 * x && y < 41 - 0.13 * x && 3 * y > 120 - 9 * x && x < 40;
        return glm::dvec3(inside ? 1.0 : 0.1);
    });
    const ImageBuffer result = test::filtered(image, "smaa:preset=medium");
    EXPECT_GT(test::largestDifference(image, result), 0.1);
    for (const bool columns : {false, true}) {
        const ImageBuffer mirrored = test::filtered(test::flipped(image, columns), "smaa:preset=medium");
        // A weight is cut off to 8 bits, by rounding to either side where it is a whole one; a pixel has two.
        EXPECT_LE(test::largestDifference(test::flipped(mirrored, columns), result), 2.0 / 255.0);
    }
}

TEST(Smaa, RoundsARightAngleLessWithCornerDetection) {
    const ImageBuffer image = test::makePicture(
        24, 24, [](int x, int y) { return glm::dvec3(x >= 8 && x < 16 && y >= 8 && y < 16); });
    const double rounded = test::filtered(image, "smaa:preset=medium").rgba[8 * 24 + 8].r;
    const double kept = test::filtered(image, "smaa:preset=high").rgba[8 * 24 + 8].r;
    EXPECT_LT(rounded, kept);
    EXPECT_LT(kept, 1.0);
}

TEST(Smaa, ACropHasTheBitsOfTheWhole) {
    for (const char* method : {"smaa", "smaa:preset=ultra,blend=gamma", "fxaa", "fxaa:preset=39"}) {
        test::ShippedPicture picture = test::shippedPicture("zone-plate", 100);
        const Prefilter box = makePrefilter("box", {}, {});
        const ImageBuffer whole = test::renderPicture(picture, box, {}, method).image;
        const PixelBox all = picture.film.crop;
        picture.film.crop = {all.x0 + 41, all.y0 + 37, all.x0 + 60, all.y0 + 61};
        const ImageBuffer part = test::renderPicture(picture, box, {}, method).image;
        const ImageBuffer plain = test::renderPicture(picture, box, {}, "none").image;
        EXPECT_EQ(part.box.width(), 19);
        for (int y = part.box.y0; y < part.box.y1; ++y)
            for (int x = part.box.x0; x < part.box.x1; ++x)
                EXPECT_EQ(part.rgba[part.index(x, y)], whole.rgba[whole.index(x, y)]) << x << ' ' << y;
        EXPECT_NE(part.rgba, plain.rgba) << method;
    }
}

}  // namespace
}  // namespace edgewise
