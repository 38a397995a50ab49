// SMAA's tables against the silhouettes that they stand for.
#include "pipeline/methods/smaa_textures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace edgewise {
namespace {

/// Heights of a silhouette at the left end, in the middle and at the right end of its line.
struct Silhouette {
    int crossing_left, crossing_right;
    std::array<double, 2> end;
};

/// Every pattern, drawn by hand; both ends on one side are a U.
constexpr std::array<Silhouette, 16> kSilhouettes{{
    {0, 0, {0, 0}},
    {3, 0, {-.5, 0}},
    {0, 3, {0, -.5}},
    {3, 3, {-.5, -.5}},
    {1, 0, {.5, 0}},
    {4, 0, {0, 0}},
    {1, 3, {.5, -.5}},
    {4, 3, {.5, -.5}},
    {0, 1, {0, .5}},
    {3, 1, {-.5, .5}},
    {0, 4, {0, 0}},
    {3, 4, {-.5, .5}},
    {1, 1, {.5, .5}},
    {4, 1, {-.5, .5}},
    {1, 4, {.5, -.5}},
    {4, 4, {0, 0}},
}};

constexpr int kSlices = 1000;
/// Of the sum of slices: a slice that the axis cuts is off by less than its height times its width.
constexpr double kSliceError = 1.0 / (kSlices * double(kSlices));

/// Below and above the axis, of one half of the silhouette and inside [x, x + 1].
glm::dvec2 areaOfHalf(const Silhouette& shape, int half, double length, double x) {
    glm::dvec2 area(0.0);
    for (int i = 0; i < kSlices; ++i) {
        const double at = x + (i + 0.5) / kSlices;
        const double part = 1.0 - 2.0 * at / length;  // 1 at the left end, -1 at the right
        if ((half == 0) != (part > 0.0)) continue;
        const double height = shape.end[half] * std::abs(part);
        area += glm::dvec2(std::max(-height, 0.0), std::max(height, 0.0)) / double(kSlices);
    }
    return area;
}

TEST(SmaaAreas, OrthogonalPatternsMatchTheirSilhouettes) {
    int off_axis = 0;
    for (const Silhouette& shape : kSilhouettes)
        for (int left = 0; left < 40; ++left)
            for (int right = 0; right < 40; right += 1 + right / 8) {
                const double length = left + right + 1;
                const bool is_u = shape.end[0] * shape.end[1] > 0.0;
                glm::dvec2 expected(0.0);
                for (const int half : {0, 1}) {
                    const glm::dvec2 area = areaOfHalf(shape, half, length, left);
                    const double blur = is_u ? std::max(1.0 - length / 32.0, 0.0) : 0.0;
                    for (int side = 0; side < 2; ++side)
                        expected[side] += (1 - blur) * area[side] + blur * std::sqrt(2 * area[side]) / 2;
                }
                const glm::dvec2 found =
                    orthogonalArea(shape.crossing_left, shape.crossing_right, left, right);
                // A root makes more of an error where the area is small.
                const double tolerance =
                    is_u ? std::sqrt(kSliceError) : 2 * kSliceError + 1.0 / kSlices / length;
                EXPECT_NEAR(found.x, expected.x, tolerance)
                    << shape.crossing_left << shape.crossing_right << ' ' << left << ' ' << right;
                EXPECT_NEAR(found.y, expected.y, tolerance)
                    << shape.crossing_left << shape.crossing_right << ' ' << left << ' ' << right;
                off_axis += expected.x + expected.y > 0.01;
            }
    EXPECT_GT(off_axis, 1000);
}

TEST(SmaaAreas, TexelsHoldTheAreasOfSquaredDistancesCutOff) {
    const SmaaAreas& areas = smaaAreas();
    for (const Silhouette& shape : kSilhouettes)
        for (int left = 0; left < kOrthogonalSize; ++left)
            for (int right = 0; right < kOrthogonalSize; ++right) {
                const glm::dvec2 area = 255.0 * orthogonalArea(shape.crossing_left, shape.crossing_right,
                                                               left * left, right * right);
                const SmaaArea texel = areas.orthogonalTexel(kOrthogonalSize * shape.crossing_left + left,
                                                             kOrthogonalSize * shape.crossing_right + right);
                EXPECT_EQ(texel.x, std::floor(area.x));
                EXPECT_EQ(texel.y, std::floor(area.y));
            }
    // No pattern has an end of 2.
    for (int i = 0; i < SmaaAreas::kSide; ++i)
        EXPECT_EQ(areas.orthogonalTexel(2 * kOrthogonalSize + 3, i), SmaaArea(0));
}

TEST(SmaaAreas, BetweenTexelsIsLinear) {
    const SmaaAreas& areas = smaaAreas();
    const glm::vec2 a = areas.orthogonal(3, 1, 2.0f, 3.0f), b = areas.orthogonal(3, 1, 3.0f, 3.0f);
    EXPECT_EQ(a, glm::vec2(areas.orthogonalTexel(3 * 16 + 2, 16 + 3)));
    EXPECT_NEAR(areas.orthogonal(3, 1, 2.25f, 3.0f).x, 0.75f * a.x + 0.25f * b.x, 1e-4f);
}

using Polygon = std::vector<glm::dvec2>;

/// Area of the unit square at `corner` on the right of the line from a to b: clipped, then the shoelace.
double clippedArea(glm::dvec2 a, glm::dvec2 b, glm::dvec2 corner) {
    const Polygon square{corner, corner + glm::dvec2(1, 0), corner + glm::dvec2(1, 1),
                         corner + glm::dvec2(0, 1)};
    const auto side = [&](glm::dvec2 p) { return (b.y - a.y) * (p.x - a.x) - (b.x - a.x) * (p.y - a.y); };
    Polygon inside;
    for (std::size_t i = 0; i < square.size(); ++i) {
        const glm::dvec2 p = square[i], q = square[(i + 1) % square.size()];
        if (side(p) >= 0.0) inside.push_back(p);
        if (side(p) * side(q) < 0.0) inside.push_back(p + (q - p) * (side(p) / (side(p) - side(q))));
    }
    double twice = 0.0;
    for (std::size_t i = 0; i < inside.size(); ++i) {
        const glm::dvec2 p = inside[i], q = inside[(i + 1) % inside.size()];
        twice += p.x * q.y - p.y * q.x;
    }
    return twice / 2.0;
}

struct Diagonal {
    int crossing_left, crossing_right;
    std::array<glm::dvec2, 2> start, stop;
};

TEST(SmaaAreas, DiagonalPatternsMatchTheirSilhouettes) {
    const glm::dvec2 o(0, 0), r(1, 0), u(1, 1);
    const std::array<Diagonal, 16> diagonals{{
        {0, 0, {u, r}, {u, r}},
        {1, 0, {r, r}, {o, r}},
        {0, 2, {o, r}, {r, r}},
        {1, 2, {r, r}, {r, r}},
        {2, 0, {u, u}, {o, r}},
        {3, 0, {u, r}, {o, r}},
        {2, 2, {u, u}, {r, r}},
        {3, 2, {u, r}, {r, r}},
        {0, 1, {o, r}, {u, u}},
        {1, 1, {r, r}, {u, u}},
        {0, 3, {o, r}, {u, r}},
        {1, 3, {r, r}, {u, r}},
        {2, 1, {u, u}, {u, u}},
        {3, 1, {u, r}, {u, u}},
        {2, 3, {u, u}, {u, r}},
        {3, 3, {u, r}, {u, r}},
    }};
    // Samples 1/29 apart, half of a row of them on either border: a line of any slope is off by less than
    // what one row and one column hold.
    constexpr double kTolerance = 2.0 / 30.0;
    double worst = 0.0;
    for (const Diagonal& d : diagonals)
        for (int left = 0; left < kDiagonalSize; ++left)
            for (int right = 0; right < kDiagonalSize; ++right) {
                glm::dvec2 expected(0.0);
                for (int i = 0; i < 2; ++i) {
                    const glm::dvec2 stop = d.stop[i] + glm::dvec2(left + right + 1);
                    expected.x += (1.0 - clippedArea(d.start[i], stop, glm::dvec2(1 + left, left))) / 2;
                    expected.y += clippedArea(d.start[i], stop, glm::dvec2(1 + left, 1 + left)) / 2;
                }
                const glm::dvec2 found = diagonalArea(d.crossing_left, d.crossing_right, left, right);
                worst = std::max({worst, std::abs(found.x - expected.x), std::abs(found.y - expected.y)});
                const SmaaArea texel = smaaAreas().diagonalTexel(kDiagonalSize * d.crossing_left + left,
                                                                 kDiagonalSize * d.crossing_right + right);
                EXPECT_EQ(texel.x, std::floor(255.0 * found.x));
                EXPECT_EQ(texel.y, std::floor(255.0 * found.y));
            }
    EXPECT_LE(worst, kTolerance);
    RecordProperty("worst_difference", std::to_string(worst));
}

TEST(SmaaSearch, SaysHowFarTheLineGoesOn) {
    const SmaaSearch search;
    // Weights of a fetch between four texels, in 32nds; 1 is the far pixel of the other row.
    const auto fetch = [](int bits) {
        double sum = 0.0;
        for (const int near : {0, 1})
            for (const int own : {0, 1})
                if (bits >> (2 * own + near) & 1) sum += (near ? 0.75 : 0.25) * (own ? 0.875 : 0.125);
        return static_cast<int>(std::lround(32.0 * sum));
    };
    int reached[3] = {};
    for (int line = 0; line < 16; ++line)
        for (int crossing = 0; crossing < 16; ++crossing) {
            const auto on_line = [&](int near) { return (line >> (2 + near) & 1) != 0; };
            const auto crossed = [&](int near) { return (crossing >> near & 5) != 0; };
            // Pixel by pixel: to the left a pixel belongs to the line, then its left side may end it.
            int left = 0, right = 0;
            if (on_line(1)) left = !crossed(1) && on_line(0) ? 2 : 1;
            if (on_line(1) && !crossed(1)) right = !crossed(0) && on_line(0) ? 2 : 1;
            EXPECT_EQ(search.left(fetch(crossing), fetch(line)), left) << line << ' ' << crossing;
            EXPECT_EQ(search.right(fetch(crossing), fetch(line)), right) << line << ' ' << crossing;
            ++reached[left];
        }
    for (const int count : reached) EXPECT_GT(count, 0);
}

/// CRC-32 of IEEE 802.3, bit by bit.
std::uint32_t crc32(const std::vector<std::uint8_t>& bytes) {
    std::uint32_t crc = ~0u;
    for (const std::uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0u);
    }
    return ~crc;
}

TEST(SmaaTextures, Crc32IsTheStandardOne) {
    EXPECT_EQ(crc32({'1', '2', '3', '4', '5', '6', '7', '8', '9'}),
              0xcbf43926u);  // its published check value
}

/// The authors publish both textures as bytes; these are the sums of theirs.
TEST(SmaaTextures, AreasAreThePublishedBytes) {
    // Its first 80 rows have no subpixel offset: two bytes a texel, orthogonal patterns left of diagonal
    // ones.
    std::vector<std::uint8_t> bytes;
    for (int y = 0; y < SmaaAreas::kSide; ++y)
        for (const bool diagonal : {false, true})
            for (int x = 0; x < SmaaAreas::kSide; ++x) {
                const SmaaArea area =
                    diagonal ? smaaAreas().diagonalTexel(x, y) : smaaAreas().orthogonalTexel(x, y);
                bytes.insert(bytes.end(), {area.x, area.y});
            }
    EXPECT_EQ(crc32(bytes), 0x5fbca771u);
}

TEST(SmaaTextures, SearchesAreThePublishedBytes) {
    // 66 x 33 texels cut to 64 x 16: from the left 33 crossing sums for searches to the left, then those for
    // searches to the right; the line's sum falls from 32 in the top row. A pixel counts 127.
    const SmaaSearch search;
    std::vector<std::uint8_t> bytes;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 64; ++x) {
            const int line = SmaaSearch::kSums - 1 - y, crossing = x % SmaaSearch::kSums;
            const int length =
                x < SmaaSearch::kSums ? search.left(crossing, line) : search.right(crossing, line);
            bytes.push_back(static_cast<std::uint8_t>(127 * length));
        }
    EXPECT_EQ(crc32(bytes), 0x77423453u);
}

}  // namespace
}  // namespace edgewise
