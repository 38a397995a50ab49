// SMAA's two tables, computed from the geometry they stand for.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace edgewise {

/// A line of edges, seen from one of its pixels, and the silhouette it stands for. What crosses an end of the
/// line is 0: nothing; 1: an edge on the far side of the line; 3: one on the pixel's own side; 4: both;
/// 2 does not occur.
inline constexpr int kOrthogonalCrossings = 5;
inline constexpr int kOrthogonalSize = 16;  ///< distances 0, 1, 4, ..., 225 px: their roots are stored
/// For diagonals 0 to 3: bits for either of the two edges that may go on.
inline constexpr int kDiagonalCrossings = 4;
inline constexpr int kDiagonalSize = 20;  ///< distances 0 to 19 px

/// x: how much of the pixel across the edge is mixed into the pixel itself; y: how much of the pixel itself
/// into the one across. In 8 bits, cut off, not rounded, as the published texture holds them.
using SmaaArea = glm::u8vec2;

class SmaaAreas {
  public:
    SmaaAreas();

    /// Between whole roots of distances linear, in [0, 255].
    glm::vec2 orthogonal(int crossing_left, int crossing_right, float root_left, float root_right) const;

    glm::vec2 diagonal(int crossing_left, int crossing_right, int left, int right) const;

    const SmaaArea& orthogonalTexel(int x, int y) const { return orthogonal_[index(x, y)]; }
    const SmaaArea& diagonalTexel(int x, int y) const { return diagonal_[index(x, y)]; }

    static constexpr int kSide = kOrthogonalCrossings * kOrthogonalSize;  ///< of either half; 80

  private:
    static std::size_t index(int x, int y) { return static_cast<std::size_t>(y) * kSide + x; }

    std::vector<SmaaArea> orthogonal_, diagonal_;
};
static_assert(SmaaAreas::kSide == kDiagonalCrossings * kDiagonalSize);

/// Made once a process.
const SmaaAreas& smaaAreas();

/// Areas below and above the edge line under the silhouette of a pattern without subpixel offset, in px^2,
/// for the pixel that lies `left` px from the left end and `right` px from the right end of its line.
///
///     crossings 3, 0, left 1, right 2:        |  pixel  |
///                                 ------------+---------+-------------------   the line of edges
///                               |  .  - ' x   |
///                               '
/// From the middle of a crossing edge the silhouette runs straight to the middle of the line, or, where the
/// other end is crossed on the other side, to the middle of the edge there.
glm::dvec2 orthogonalArea(int crossing_left, int crossing_right, int left, int right);

/// The same for a diagonal, by 30 x 30 samples a pixel as published: the mean of two silhouettes where an end
/// leaves open which one it is.
glm::dvec2 diagonalArea(int crossing_left, int crossing_right, int left, int right);

/// How many of the two pixels that one bilinear fetch sees the line still covers, 0 to 2. A fetch at 3/4 of
/// the nearer pixel and 7/8 of the own row holds 21, 7, 3 and 1 32nds of (near, own), (far, own), (near,
/// other), (far, other): its sum says which of the four edges are there. This is the search texture, by the
/// fetch's 32nds of edges across the line and along it.
class SmaaSearch {
  public:
    static constexpr int kSums = 33;

    SmaaSearch();

    int left(int crossing_sum, int line_sum) const { return left_[index(crossing_sum, line_sum)]; }
    int right(int crossing_sum, int line_sum) const { return right_[index(crossing_sum, line_sum)]; }

  private:
    static std::size_t index(int crossing_sum, int line_sum) {
        return static_cast<std::size_t>(line_sum) * kSums + crossing_sum;
    }

    std::array<std::uint8_t, kSums * kSums> left_{}, right_{};
};

}  // namespace edgewise
