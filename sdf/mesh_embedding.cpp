#include "sdf/mesh_embedding.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sdf/triangle_tree.h"

namespace edgewise::sdf {
namespace {

using Points = std::span<const glm::dvec3>;

/// One in so many: a tree of these few costs less than one of all.
constexpr std::size_t kFew = 3;

/// Side of d to the plane through a, b, c; 0 where rounding leaves it open: a determinant of differences errs
/// by less than 1e-15 times the sum of its terms' sizes (Shewchuk 1997 has 7.8e-16).
int sideOf(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    const glm::dvec3 p = a - d, q = b - d, r = c - d;
    const double qr = q.x * r.y, rq = r.x * q.y, rp = r.x * p.y, pr = p.x * r.y, pq = p.x * q.y,
                 qp = q.x * p.y;
    const double det = p.z * (qr - rq) + q.z * (rp - pr) + r.z * (pq - qp);
    const double size = std::abs(p.z) * (std::abs(qr) + std::abs(rq)) +
                        std::abs(q.z) * (std::abs(rp) + std::abs(pr)) +
                        std::abs(r.z) * (std::abs(pq) + std::abs(qp));
    const double error = 1e-15 * size + 1e-300;
    return det > error ? 1 : det < -error ? -1 : 0;
}

/// In the plane of two axes.
struct Flat {
    int u, v;
    int sideOf(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) const {
        const double left = (a[u] - c[u]) * (b[v] - c[v]), right = (a[v] - c[v]) * (b[u] - c[u]);
        const double error = 1e-15 * (std::abs(left) + std::abs(right)) + 1e-300;
        return left - right > error ? 1 : left - right < -error ? -1 : 0;
    }
};

Flat flatOf(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 n = glm::abs(glm::cross(b - a, c - a));
    if (n.x >= n.y && n.x >= n.z) return {1, 2};
    return n.y >= n.z ? Flat{2, 0} : Flat{0, 1};
}

/// The sides of a triangle as a line's ends see them agree, or may.
bool agree(int a, int b, int c) {
    return !((a > 0 || b > 0 || c > 0) && (a < 0 || b < 0 || c < 0));
}

/// Whether the segment may meet the triangle, their common vertices (bits of `shared`) and their
/// neighbourhood left out.
bool pierces(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& a, const glm::dvec3& b,
             const glm::dvec3& c) {
    const int at_p = sideOf(a, b, c, p), at_q = sideOf(a, b, c, q);
    if (at_p * at_q > 0) return false;
    if (at_p == 0 && at_q == 0) return false;  // in one plane: asked for apart
    return agree(sideOf(p, q, a, b), sideOf(p, q, b, c), sideOf(p, q, c, a));
}

bool boxesMeet(Points x, const Triangle& a, const Triangle& b) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto low = [&](const Triangle& t) {
            return std::min({x[t[0]][axis], x[t[1]][axis], x[t[2]][axis]});
        };
        const auto high = [&](const Triangle& t) {
            return std::max({x[t[0]][axis], x[t[1]][axis], x[t[2]][axis]});
        };
        if (low(a) > high(b) || low(b) > high(a)) return false;
    }
    return true;
}

/// From an end of the side that is a corner of `b` too, `v` lies the other way than the other end.
bool lineGoesOn(Points x, std::uint32_t p, std::uint32_t q, const Triangle& b, std::uint32_t v) {
    const auto isCorner = [&](std::uint32_t w) { return b[0] == w || b[1] == w || b[2] == w; };
    return (isCorner(p) && glm::dot(x[v] - x[p], x[q] - x[p]) < 0.0) ||
           (isCorner(q) && glm::dot(x[v] - x[q], x[p] - x[q]) < 0.0);
}

/// Some side of `a` has all of `b` beyond it: in the plane, common vertices being on it.
bool sideParts(const Flat& flat, Points x, const Triangle& a, const Triangle& b) {
    const int turn = flat.sideOf(x[a[0]], x[a[1]], x[a[2]]);
    if (turn == 0) return false;
    for (int i = 0; i < 3; ++i) {
        bool beyond = true, strictly = false;
        for (int j = 0; j < 3; ++j) {
            const std::uint32_t v = b[j];
            const bool common = v == a[i] || v == a[(i + 1) % 3];
            const int side = common ? 0 : turn * flat.sideOf(x[a[i]], x[a[(i + 1) % 3]], x[v]);
            // Rounding leaves it open where a vertex lies on the line: no parting, unless it is common, or is
            // seen from a common one the other way than the side.
            beyond &= common || side < 0 || (side == 0 && lineGoesOn(x, a[i], a[(i + 1) % 3], b, v));
            strictly |= side < 0;
        }
        if (beyond && strictly) return true;
    }
    return false;
}

/// Whether triangles meet as seen along an axis, about square to the first.
bool flatMeet(Points x, const Triangle& a, const Triangle& b) {
    const Flat flat = flatOf(x[a[0]], x[a[1]], x[a[2]]);
    return !sideParts(flat, x, a, b) && !sideParts(flat, x, b, a);
}

int commonOf(const Triangle& a, const Triangle& b, int (&in_a)[3], int (&in_b)[3]) {
    int count = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (a[i] == b[j]) in_a[count] = i, in_b[count] = j, ++count;
    return count;
}

bool onePlane(Points x, const Triangle& a, const Triangle& b) {
    for (const std::uint32_t v : b)
        if (v != a[0] && v != a[1] && v != a[2] && sideOf(x[a[0]], x[a[1]], x[a[2]], x[v]) != 0) return false;
    return true;
}

/// Two triangles with one common vertex, the corners turned so that it is first.
bool meetBesideCorner(Points x, const Triangle& a, const Triangle& b) {
    if (onePlane(x, a, b) || onePlane(x, b, a)) return true;
    return pierces(x[a[1]], x[a[2]], x[b[0]], x[b[1]], x[b[2]]) ||
           pierces(x[b[1]], x[b[2]], x[a[0]], x[a[1]], x[a[2]]);
}

struct Box3 {
    glm::dvec3 low, high;
};
Box3 boxOf(Points x, const Triangle& t) {
    return {glm::min(x[t[0]], glm::min(x[t[1]], x[t[2]])), glm::max(x[t[0]], glm::max(x[t[1]], x[t[2]]))};
}

/// Which cubes of a grid some triangles' boxes are in: most others are nowhere near.
class Marks {
  public:
    Marks(Points x, std::span<const Triangle> triangles, std::span<const std::uint32_t> some)
        : marked_(kSide * kSide * kSide, false) {
        Box3 all{glm::dvec3(1e300), glm::dvec3(-1e300)};
        for (const std::uint32_t t : some) {
            const Box3 box = boxOf(x, triangles[t]);
            all = {glm::min(all.low, box.low), glm::max(all.high, box.high)};
        }
        low_ = all.low, high_ = all.high;
        scale_ = static_cast<double>(kSide) / glm::max(all.high - all.low, glm::dvec3(1e-300));
        for (const std::uint32_t t : some)
            anyOf(boxOf(x, triangles[t]), [&](std::size_t n) { return marked_[n] = true, false; });
    }
    bool near(const Box3& box) const {
        for (int axis = 0; axis < 3; ++axis)
            if (box.low[axis] > high_[axis] || box.high[axis] < low_[axis]) return false;
        return anyOf(box, [&](std::size_t n) { return bool(marked_[n]); });
    }

  private:
    static constexpr int kSide = 64;
    template <class F>
    bool anyOf(const Box3& box, const F& f) const {
        const double most = kSide - 1;
        const glm::ivec3 first(glm::clamp((box.low - low_) * scale_, 0.0, most)),
            last(glm::clamp((box.high - low_) * scale_, 0.0, most));
        for (int z = first.z; z <= last.z; ++z)
            for (int y = first.y; y <= last.y; ++y)
                for (int i = first.x; i <= last.x; ++i)
                    if (f(static_cast<std::size_t>(i + kSide * (y + kSide * z)))) return true;
        return false;
    }

    glm::dvec3 low_, high_, scale_;
    std::vector<bool> marked_;
};

}  // namespace

bool trianglesMeet(Points x, const Triangle& a, const Triangle& b) {
    // Parted as seen along an axis: parted. Nearly flat parts, whose heights are noise, are told apart so.
    if (!boxesMeet(x, a, b) || !flatMeet(x, a, b) || !flatMeet(x, b, a)) return false;
    int in_a[3], in_b[3];
    const int common = commonOf(a, b, in_a, in_b);
    if (common == 3) return true;
    if (common == 2) return onePlane(x, a, b);
    if (common == 1) {
        const auto turned = [](const Triangle& t, int n) {
            return Triangle{t[n], t[(n + 1) % 3], t[(n + 2) % 3]};
        };
        return meetBesideCorner(x, turned(a, in_a[0]), turned(b, in_b[0]));
    }
    if (onePlane(x, a, b) || onePlane(x, b, a)) return true;
    for (int i = 0; i < 3; ++i)
        if (pierces(x[a[i]], x[a[(i + 1) % 3]], x[b[0]], x[b[1]], x[b[2]]) ||
            pierces(x[b[i]], x[b[(i + 1) % 3]], x[a[0]], x[a[1]], x[a[2]]))
            return true;
    return false;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> meetingPairs(Points x,
                                                                  std::span<const Triangle> triangles,
                                                                  const std::vector<bool>& doubtful) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    std::vector<std::uint32_t> asked;
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        if (doubtful[t]) asked.push_back(t);
    if (asked.empty()) return pairs;
    const auto ask = [&](const TriangleTree& tree, std::uint32_t a) {
        const Box3 box = boxOf(x, triangles[a]);
        tree.forNear(box.low, box.high, [&](std::uint32_t b) {
            if (b == a || (doubtful[a] && doubtful[b] && b < a)) return;
            const auto [first, second] = std::minmax(a, b);
            if (trianglesMeet(x, triangles[first], triangles[second])) pairs.push_back({first, second});
        });
    };
    if (kFew * asked.size() > triangles.size()) {
        const TriangleTree tree(x, triangles);
        for (const std::uint32_t a : asked) ask(tree, a);
    } else {
        const Marks marks(x, triangles, asked);
        const TriangleTree tree(x, triangles, std::move(asked));
        for (std::uint32_t a = 0; a < triangles.size(); ++a)
            if (marks.near(boxOf(x, triangles[a]))) ask(tree, a);
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

}  // namespace edgewise::sdf
