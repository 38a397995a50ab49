// SMAA's second pass: the pattern of every edge, and the weights that its silhouette gives.
#include <glm/common.hpp>

#include <cmath>

#include "pipeline/methods/smaa.h"
#include "pipeline/methods/smaa_textures.h"

namespace edgewise {
namespace {

/// Edges as seen along a line: rows of them for top edges, columns for left ones. `line` lies between
/// across - 1 and across, `crossing` between along - 1 and along; both 0 or 1.
struct Along {
    const SmaaEdges& edges;
    bool vertical;

    bool line(int along, int across) const {
        return vertical ? edges.at(across, along) & kLeftEdge : edges.at(along, across) & kTopEdge;
    }
    bool crossing(int along, int across) const {
        return vertical ? edges.at(across, along) & kTopEdge : edges.at(along, across) & kLeftEdge;
    }
};

/// The ends of a line: pixels from this one to the last that belongs to it.
struct Ends {
    int left = 0, right = 0;
};

class Weigher {
  public:
    Weigher(const SmaaEdges& edges, const SmaaSettings& settings) : edges_(edges), settings_(settings) {}

    glm::u8vec4 weigh(int x, int y) const {
        const std::uint8_t own = edges_.at(x, y);
        glm::vec2 top(0.0f), left(0.0f);
        bool found_diagonal = false;
        if (own & kTopEdge) {
            if (settings_.diagonal_steps > 0) top = diagonals(x, y);
            found_diagonal = top.x + top.y > 0.0f;
            if (!found_diagonal) top = straight({edges_, false}, x, y);
        }
        // A diagonal already has what its left edges would add.
        if ((own & kLeftEdge) && !found_diagonal) left = straight({edges_, true}, y, x);
        return glm::u8vec4(glm::min(glm::vec4(top, left), 255.0f) + 0.5f);
    }

  private:
    struct Fetch {
        int crossing, line;  ///< 32nds
        bool goesOn() const { return line > 26 && crossing == 0; }
    };

    /// Both kinds of edges at once, at 1/8 of a pixel beyond the line and 1/4 from `near` to `far`.
    static Fetch fetch(const Along& view, int near, int far, int across) {
        return {21 * view.crossing(near, across) + 7 * view.crossing(far, across) +
                    3 * view.crossing(near, across - 1) + view.crossing(far, across - 1),
                21 * view.line(near, across) + 7 * view.line(far, across) + 3 * view.line(near, across - 1) +
                    view.line(far, across - 1)};
    }

    /// Two pixels a step; the last fetch says how many of its two still belong to the line.
    Ends search(const Along& view, int along, int across) const {
        static const SmaaSearch lengths;
        Ends ends;
        Fetch seen{0, 32};
        int steps = 0;
        for (; steps < settings_.search_steps && seen.goesOn(); ++steps)
            seen = fetch(view, along - 2 * steps, along - 2 * steps - 1, across);
        ends.left = 2 * steps - 3 + lengths.left(seen.crossing, seen.line);
        seen = {0, 32};
        for (steps = 0; steps < settings_.search_steps && seen.goesOn(); ++steps)
            seen = fetch(view, along + 2 * steps + 1, along + 2 * steps + 2, across);
        ends.right = 2 * steps - 2 + lengths.right(seen.crossing, seen.line);
        return ends;
    }

    /// Weights of a horizontal or vertical line through a pixel, of 255.
    glm::vec2 straight(const Along& view, int along, int across) const {
        const Ends ends = search(view, along, across);
        const auto crossing = [&](int at) {
            return 3 * view.crossing(at, across) + view.crossing(at, across - 1);
        };
        const glm::vec2 area = smaaAreas().orthogonal(
            crossing(along - ends.left), crossing(along + ends.right + 1),
            std::sqrt(static_cast<float>(ends.left)), std::sqrt(static_cast<float>(ends.right)));
        return settings_.corner_rounding < 1.0f ? area * corners(view, along, across, ends) : area;
    }

    /// What is left of the weights beside a right angle, whose crossing goes on for a second pixel: the
    /// nearer end counts, or both.
    glm::vec2 corners(const Along& view, int along, int across, const Ends& ends) const {
        const int left = along - ends.left, right = along + ends.right + 1;
        const bool at_left = ends.left <= ends.right, at_right = ends.right <= ends.left;
        const float keep = (1.0f - settings_.corner_rounding) / static_cast<float>(at_left + at_right);
        const auto factor = [&](int row) {
            const int found = (at_left && view.crossing(left, row)) + (at_right && view.crossing(right, row));
            return glm::clamp(1.0f - keep * static_cast<float>(found), 0.0f, 1.0f);
        };
        return {factor(across + 1), factor(across - 2)};
    }

    struct Diagonal {
        int length = 0;
        bool ended = true;       ///< before the steps did
        bool line_ends = false;  ///< the last step still saw a top edge
    };

    bool left(int x, int y) const { return edges_.at(x, y) & kLeftEdge; }
    bool top(int x, int y) const { return edges_.at(x, y) & kTopEdge; }

    /// Steps while both edges of a stair are there; `stair` gives (left, top) of a position.
    template <class Stair>
    Diagonal searchDiagonal(int x, int y, glm::ivec2 direction, const Stair& stair) const {
        Diagonal found;
        for (found.length = -1; found.length < settings_.diagonal_steps - 1;) {
            x += direction.x;
            y += direction.y;
            ++found.length;
            const bool has_left = stair(x, y, false), has_top = stair(x, y, true);
            found.line_ends = has_top;
            if (!(has_left && has_top)) return found;
        }
        found.ended = false;
        return found;
    }

    glm::vec2 diagonals(int x, int y) const { return rising(x, y) + falling(x, y); }

    static glm::vec2 area(const Diagonal& a, const Diagonal& b, int crossing_a, int crossing_b) {
        return smaaAreas().diagonal(a.ended ? crossing_a : 0, b.ended ? crossing_b : 0, a.length, b.length);
    }

    /// From the lower left to the upper right.
    glm::vec2 rising(int x, int y) const {
        const auto stair = [&](int i, int j, bool of_top) { return of_top ? top(i, j) : left(i, j); };
        Diagonal down;
        if (left(x, y)) {
            down = searchDiagonal(x, y, {-1, 1}, stair);
            down.length += down.line_ends;
        }
        const Diagonal up = searchDiagonal(x, y, {1, -1}, stair);
        if (down.length + up.length <= 2) return glm::vec2(0.0f);
        const int l = x - down.length, b = y + down.length, r = x + up.length, t = y - up.length;
        return area(down, up, 2 * top(l - 1, b) + left(l, b), 2 * top(r + 1, t) + left(r + 1, t - 1));
    }

    /// From the upper left to the lower right: a pixel's top edge and the left edge of its right neighbour.
    glm::vec2 falling(int x, int y) const {
        const auto stair = [&](int i, int j, bool of_top) { return of_top ? top(i, j) : left(i + 1, j); };
        const Diagonal up = searchDiagonal(x, y, {-1, -1}, stair);
        Diagonal down;
        if (left(x + 1, y)) {
            down = searchDiagonal(x, y, {1, 1}, stair);
            down.length += down.line_ends;
        }
        if (up.length + down.length <= 2) return glm::vec2(0.0f);
        const int l = x - up.length, t = y - up.length, r = x + down.length, b = y + down.length;
        const glm::vec2 found =
            area(up, down, 2 * top(l - 1, t) + left(l, t - 1), 2 * top(r + 1, b) + left(r + 1, b));
        return {found.y, found.x};
    }

    const SmaaEdges& edges_;
    const SmaaSettings& settings_;
};

}  // namespace

SmaaWeights weighEdges(const SmaaEdges& edges, const SmaaSettings& settings, Progress& progress) {
    SmaaWeights weights(edges.width(), edges.height());
    const Weigher weigher(edges, settings);
    forRows("weights", edges.height(), progress, [&](int y) {
        for (int x = 0; x < edges.width(); ++x)
            if (edges.at(x, y) != 0) weights.texel(x, y) = weigher.weigh(x, y);
    });
    return weights;
}

}  // namespace edgewise
