#include "pipeline/methods/smaa_textures.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>

namespace edgewise {
namespace {

constexpr double kHalf = 0.5;
constexpr double kSmoothingEnds = 32.0;  // px: lines of this length and longer keep the area of their U
constexpr int kDiagonalSamples = 30;     // a side of a pixel

/// Areas below and above y = 0 under the segment from a to b, for x in [x0, x0 + 1]. Up is positive.
glm::dvec2 areaUnder(glm::dvec2 a, glm::dvec2 b, double x0) {
    const glm::dvec2 d = b - a;
    const double x1 = x0 + 1.0;
    if (x1 <= a.x || x0 >= b.x) return glm::dvec2(0.0);
    const double y0 = a.y + d.y * (x0 - a.x) / d.x, y1 = a.y + d.y * (x1 - a.x) / d.x;
    const bool one_side = std::signbit(y0) == std::signbit(y1) || y0 == 0.0 || y1 == 0.0;
    if (one_side) {
        const double mean = (y0 + y1) / 2.0;
        return mean < 0.0 ? glm::dvec2(-mean, 0.0) : glm::dvec2(0.0, mean);
    }
    // Two triangles; the one beyond the segment's end on the axis is none.
    const double root = -a.y * d.x / d.y + a.x;
    const double before = root > a.x ? y0 * (root - x0) / 2.0 : 0.0;
    const double after = root < b.x ? y1 * (x1 - root) / 2.0 : 0.0;
    return {std::max(-before, 0.0) + std::max(-after, 0.0), std::max(before, 0.0) + std::max(after, 0.0)};
}

/// Short U patterns are blurred more than their area says.
glm::dvec2 smoothed(double length, const glm::dvec2& area) {
    const double keep = std::min(length / kSmoothingEnds, 1.0);
    return glm::mix(glm::sqrt(area * 2.0) * 0.5, area, keep);
}

/// Where the silhouette meets an end: below the line for 3, above it for 1; 0 where nothing pulls it off the
/// line, as when edges cross on both sides.
double pull(int crossing) {
    if (crossing == 3) return -kHalf;
    return crossing == 1 ? kHalf : 0.0;
}

/// A line whose ends pull to both sides is a Z. An end crossed on both sides goes along with it, away from
/// the other end's.
glm::dvec2 zArea(double pull_left, double pull_right, double length, double x0) {
    return areaUnder({0.0, pull_left}, {length, pull_right}, x0);
}

glm::dvec2 uArea(double pull_both, double length, double x0) {
    const double middle = length / 2.0;
    return smoothed(length, areaUnder({0.0, pull_both}, {middle, 0.0}, x0)) +
           smoothed(length, areaUnder({middle, 0.0}, {length, pull_both}, x0));
}

/// Only the half at the crossed end is off the line.
glm::dvec2 lArea(double pull_left, double pull_right, double length, int left, int right) {
    const double middle = length / 2.0;
    if (pull_left != 0.0)
        return left <= right ? areaUnder({0.0, pull_left}, {middle, 0.0}, left) : glm::dvec2(0.0);
    return left >= right ? areaUnder({middle, 0.0}, {length, pull_right}, left) : glm::dvec2(0.0);
}

/// Share of the pixel at `corner` on the right of the infinite line from a to b. The samples lie on its
/// border too, so that a line through its corners leaves less than half on either side: that is how the
/// texture was published. Of a point all is on the right.
double shareRightOf(glm::dvec2 a, glm::dvec2 b, glm::dvec2 corner) {
    if (a == b) return 1.0;
    const glm::dvec2 middle = (a + b) / 2.0;
    const double nx = b.y - a.y, ny = a.x - b.x;
    int right = 0;
    for (int i = 0; i < kDiagonalSamples; ++i)
        for (int j = 0; j < kDiagonalSamples; ++j) {
            const glm::dvec2 p = corner + glm::dvec2(i, j) / double(kDiagonalSamples - 1);
            right += nx * (p.x - middle.x) + ny * (p.y - middle.y) > 0.0;
        }
    return right / double(kDiagonalSamples * kDiagonalSamples);
}

/// Two silhouettes' points at one end, relative to it.
struct DiagonalEnd {
    glm::dvec2 first, second;
};

constexpr glm::dvec2 kOrigin{0.0, 0.0}, kRight{1.0, 0.0}, kUpRight{1.0, 1.0};

/// An open end may go on either way; both edges there are as good as none. What the other end is decides
/// which of the two silhouettes pairs with which.
DiagonalEnd diagonalStart(int crossing, int other) {
    if (crossing == 1) return {kRight, kRight};
    if (crossing == 2) return {kUpRight, kUpRight};
    if (crossing == 3) return {kUpRight, kRight};
    return other == 0 ? DiagonalEnd{kUpRight, kRight} : DiagonalEnd{kOrigin, kRight};
}
DiagonalEnd diagonalStop(int crossing, int other) {
    if (crossing == 1) return {kUpRight, kUpRight};
    if (crossing == 2) return {kRight, kRight};
    if (crossing == 3) return {kUpRight, kRight};
    return other == 0 ? DiagonalEnd{kUpRight, kRight} : DiagonalEnd{kOrigin, kRight};
}

glm::dvec2 diagonalPair(glm::dvec2 a, glm::dvec2 b, int left) {
    const glm::dvec2 step(left, left);
    return {1.0 - shareRightOf(a, b, kRight + step), shareRightOf(a, b, kUpRight + step)};
}

SmaaArea cutOff(const glm::dvec2& area) {
    return SmaaArea(255.0 * area);
}

}  // namespace

glm::dvec2 orthogonalArea(int crossing_left, int crossing_right, int left, int right) {
    const double length = left + right + 1;
    double from = pull(crossing_left), to = pull(crossing_right);
    if ((from == 0.0 && to == 0.0) || crossing_left == 2 || crossing_right == 2) return glm::dvec2(0.0);
    if (crossing_left == 4) from = -to;
    if (crossing_right == 4) to = -from;
    if (from == 0.0 || to == 0.0) return lArea(from, to, length, left, right);
    return from == to ? uArea(from, length, left) : zArea(from, to, length, left);
}

glm::dvec2 diagonalArea(int crossing_left, int crossing_right, int left, int right) {
    const DiagonalEnd start = diagonalStart(crossing_left, crossing_right);
    const DiagonalEnd stop = diagonalStop(crossing_right, crossing_left);
    const glm::dvec2 length(left + right + 1);
    return (diagonalPair(start.first, stop.first + length, left) +
            diagonalPair(start.second, stop.second + length, left)) /
           2.0;
}

SmaaAreas::SmaaAreas() : orthogonal_(kSide * kSide), diagonal_(kSide * kSide) {
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const int root_left = x % kOrthogonalSize, root_right = y % kOrthogonalSize;
            orthogonal_[index(x, y)] = cutOff(orthogonalArea(x / kOrthogonalSize, y / kOrthogonalSize,
                                                             root_left * root_left, root_right * root_right));
            diagonal_[index(x, y)] = cutOff(
                diagonalArea(x / kDiagonalSize, y / kDiagonalSize, x % kDiagonalSize, y % kDiagonalSize));
        }
}

glm::vec2 SmaaAreas::orthogonal(int crossing_left, int crossing_right, float root_left,
                                float root_right) const {
    const float x = static_cast<float>(kOrthogonalSize * crossing_left) + root_left;
    const float y = static_cast<float>(kOrthogonalSize * crossing_right) + root_right;
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const auto at = [&](int column, int row) {
        return glm::vec2(orthogonal_[index(std::min(column, kSide - 1), std::min(row, kSide - 1))]);
    };
    const float u = x - static_cast<float>(i), v = y - static_cast<float>(j);
    return glm::mix(glm::mix(at(i, j), at(i + 1, j), u), glm::mix(at(i, j + 1), at(i + 1, j + 1), u), v);
}

glm::vec2 SmaaAreas::diagonal(int crossing_left, int crossing_right, int left, int right) const {
    return glm::vec2(
        diagonal_[index(kDiagonalSize * crossing_left + left, kDiagonalSize * crossing_right + right)]);
}

const SmaaAreas& smaaAreas() {
    static const SmaaAreas areas;
    return areas;
}

SmaaSearch::SmaaSearch() {
    struct Four {
        bool far_other, near_other, far_own, near_own;
        explicit Four(int bits)
            : far_other(bits & 1), near_other(bits & 2), far_own(bits & 4), near_own(bits & 8) {}
        int sum() const { return far_other + 3 * near_other + 7 * far_own + 21 * near_own; }
    };
    for (int line_bits = 0; line_bits < 16; ++line_bits)
        for (int crossing_bits = 0; crossing_bits < 16; ++crossing_bits) {
            const Four line(line_bits), crossing(crossing_bits);
            const std::size_t at = index(crossing.sum(), line.sum());
            const bool near_crossed = crossing.near_own || crossing.near_other;
            const bool far_crossed = crossing.far_own || crossing.far_other;
            // A crossing edge is on a pixel's left: to the left it ends the line behind its pixel, to the
            // right in front of it.
            const bool to_near_left = line.near_own, to_near_right = line.near_own && !near_crossed;
            left_[at] =
                static_cast<std::uint8_t>(to_near_left + (to_near_left && line.far_own && !near_crossed));
            right_[at] =
                static_cast<std::uint8_t>(to_near_right + (to_near_right && line.far_own && !far_crossed));
        }
}

}  // namespace edgewise
