#include "pipeline/judge/projection_witness.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "analytic/exact/rational.h"

namespace edgewise::judge {
namespace {

using exact::Real;
using WorldTriangle = std::array<glm::vec3, 3>;
constexpr double kU = 0x1p-53, kU2 = kU * kU;

// Roundings of the product's double-double, in units of kU2 (shaders/shared/double_double.glsl).
constexpr double kSum = 3, kProduct = 7, kScaled = 3, kQuotient = 64;
constexpr double kEyeSum = 3 * kSum;                         ///< a coordinate: three products join one
constexpr double kDistanceSum = kScaled + 3 * kSum;          ///< a term of a point's distance to a plane
constexpr double kWay = kSum + kQuotient + kSum + kProduct;  ///< t (b - a)

/// Clipped this far from the middle of the screen: the guard band, less the room for a debug offset.
constexpr double kClipBandPx = kGuardBandPx - 4096.0;

/// A point of eye space, how far doubles may have moved it an axis, how far double-double, and whether a
/// plane made it.
struct SolidPoint {
    std::array<Real, 3> p;
    std::array<double, 3> error{}, fine{};
    bool made = false;
};

struct ScreenPoint {
    Real x, y;
    double bound;  ///< px
};

double size(const Real& x) {
    return std::abs(static_cast<double>(x));
}

/// Inside is a . p + b >= 0.
struct Plane {
    std::array<Real, 3> a;
    Real b;
    int roundings;  ///< of the coefficients, in double
    Real at(const SolidPoint& q) const { return a[0] * q.p[0] + a[1] * q.p[1] + a[2] * q.p[2] + b; }
    /// How far off the product may see a point from the plane.
    double doubt(const SolidPoint& q) const {
        double sum = 0.0;
        for (std::size_t k = 0; k < 3; ++k) sum += size(a[k]) * size(q.p[k]);
        return roundings * kU * sum;
    }
    /// ... had it the plane's own coefficients.
    double fine(const SolidPoint& q) const {
        double sum = kDistanceSum * kU2 * size(b);
        for (std::size_t k = 0; k < 3; ++k)
            sum += size(a[k]) * (kDistanceSum * kU2 * size(q.p[k]) + q.fine[k]);
        return sum;
    }
};

class Lens {
  public:
    Lens(const ResolvedCamera& camera, const Film& film)
        : matrix_(camera.camera_from_world),
          scale_(Real(0.5) * film.height / tan(Real(camera.camera.yfov) / 2)),
          middle_(glm::dvec2(film.width, film.height) * 0.5 - film.shift_px) {
        planes_.push_back({{0, 0, -1}, -Real(camera.camera.znear), 0});
        for (const int sign : {1, -1}) {
            planes_.push_back({{sign * scale_, 0, -(kClipBandPx + Real(sign * middle_.x))}, 0, 3});
            planes_.push_back({{0, -sign * scale_, -(kClipBandPx + Real(sign * middle_.y))}, 0, 3});
        }
    }

    /// In double: ((m x + m y) + (m z + m)), three roundings of each product at most.
    SolidPoint toEye(const glm::vec3& p) const {
        SolidPoint out;
        for (int row = 0; row < 3; ++row) {
            out.p[row] = matrix_[3][row];
            double sizes = std::abs(matrix_[3][row]);
            for (int k = 0; k < 3; ++k) {
                out.p[row] += Real(matrix_[k][row]) * Real(p[k]);
                sizes += std::abs(matrix_[k][row] * p[k]);
            }
            out.error[row] = 3 * kU * sizes, out.fine[row] = kEyeSum * kU2 * sizes;
        }
        return out;
    }

    /// x = middle + scale x / w, w = -z.
    ScreenPoint toScreen(const SolidPoint& q) const {
        const Real w = -q.p[2], x = scale_ * q.p[0] / w, y = -scale_ * q.p[1] / w;
        const double nearest_w = static_cast<double>(w) - q.error[2];
        const double per_w = static_cast<double>(scale_) / nearest_w, s = static_cast<double>(scale_);
        const auto off = [&](const Real& at, double error) {
            return 0.5 * kGridPx + per_w * (error + size(at) / s * q.error[2]) + kU * (4 * size(at) + 2);
        };
        const double bound = std::hypot(off(x, q.error[0]), off(y, q.error[1]));
        return {x + middle_.x, y + middle_.y, nearest_w > 0.0 ? bound : INFINITY};
    }

    const std::vector<Plane>& planes() const { return planes_; }

  private:
    glm::dmat4 matrix_;
    Real scale_;
    glm::dvec2 middle_;
    std::vector<Plane> planes_;
};

/// Where the plane cuts a -> b. The product knows the ends in double-double, whatever it does with them
/// elsewhere, and goes from the nearer one. What moves the cut along the edge: the plane's coefficients, and
/// the ends' distances, as t = h_a / (h_a - h_b) passes them on. Then it is rounded.
SolidPoint cut(const Plane& plane, const SolidPoint& a, const SolidPoint& b) {
    const Real h_a = plane.at(a), fall = h_a - plane.at(b), t = h_a / fall;
    SolidPoint out;
    out.made = true;
    for (std::size_t k = 0; k < 3; ++k) out.p[k] = a.p[k] + t * (b.p[k] - a.p[k]);
    const double moved = plane.doubt(out) / size(fall), of_b = static_cast<double>(t), of_a = size(1 - t);
    const double fine_moved = (of_a * plane.fine(a) + of_b * plane.fine(b)) / size(fall);
    for (std::size_t k = 0; k < 3; ++k) {
        const double length = size(b.p[k] - a.p[k]);
        out.fine[k] = length * (fine_moved + kWay * kU2 * std::min(of_a, of_b)) +
                      kSum * kU2 * size(out.p[k]) + of_a * a.fine[k] + of_b * b.fine[k];
        out.error[k] = length * moved + kU * size(out.p[k]) + out.fine[k];
    }
    if (plane.roundings == 0) out.fine[2] = out.error[2] = 0.0;  // the near plane's own
    return out;
}

/// What the camera sees of a polygon, or of a segment.
struct Clipped {
    std::vector<SolidPoint> points;
    bool doubtful = false;  ///< rounding may have seen a point on the other side of a plane
    bool cut = false;
};

Clipped clip(std::vector<SolidPoint> points, const std::vector<Plane>& planes, bool closed) {
    Clipped out{std::move(points)};
    for (const Plane& plane : planes) {
        const std::vector<SolidPoint> old = std::exchange(out.points, {});
        for (std::size_t i = 0; i < old.size(); ++i) {
            const SolidPoint &here = old[i], &next = old[(i + 1) % old.size()];
            const bool inside = plane.at(here) >= 0;
            out.doubtful |= !here.made && size(plane.at(here)) <= plane.doubt(here) + plane.fine(here);
            if (inside) out.points.push_back(here);
            if ((!closed && i + 1 == old.size()) || inside == (plane.at(next) >= 0)) continue;
            out.points.push_back(cut(plane, here, next));
            out.cut = true;
        }
    }
    return out;
}

Real distance(const ScreenPoint& a, const glm::dvec2& b) {
    const Real dx = a.x - b.x, dy = a.y - b.y;
    return sqrt(dx * dx + dy * dy);
}

/// From a point to a segment of the grid.
Real distance(const ScreenPoint& p, glm::dvec2 a, glm::dvec2 b) {
    const Real ex = Real(b.x) - a.x, ey = Real(b.y) - a.y, dx = p.x - a.x, dy = p.y - a.y;
    const Real t = (dx * ex + dy * ey) / (ex * ex + ey * ey);
    if (t <= 0) return distance(p, a);
    if (t >= 1) return distance(p, b);
    return abs(dx * ey - dy * ex) / sqrt(ex * ex + ey * ey);
}

using GridEdge = std::array<double, 4>;

/// The edges of an owner's pieces that no other of its pieces has.
std::vector<GridEdge> boundary(std::span<const ScreenTriangle> pieces) {
    std::map<GridEdge, int> count;
    for (const ScreenTriangle& t : pieces)
        for (std::size_t k = 0; k < 3; ++k) {
            glm::dvec2 a = t.p_px[k], b = t.p_px[(k + 1) % 3];
            if (std::tie(b.x, b.y) < std::tie(a.x, a.y)) std::swap(a, b);
            ++count[{a.x, a.y, b.x, b.y}];
        }
    std::vector<GridEdge> out;
    for (const auto& [edge, times] : count)
        if (times == 1) out.push_back(edge);
    return out;
}

Real areaOf(std::span<const ScreenTriangle> pieces) {
    Real twice = 0;
    for (const ScreenTriangle& t : pieces) {
        const glm::dvec2 u = t.p_px[1] - t.p_px[0], v = t.p_px[2] - t.p_px[0];
        twice += Real(u.x) * v.y - Real(u.y) * v.x;
    }
    return twice / 2;
}

class Judge {
  public:
    Judge(const std::vector<WorldTriangle>& world, const ResolvedCamera& camera, const Film& film,
          const ScreenScene& screen, const ScreenPieces& pieces)
        : world_(world), lens_(camera, film), screen_(screen), pieces_(pieces) {}

    ProjectionErrors run() {
        for (Owner owner = 0; owner < world_.size(); ++owner) judgeTriangle(owner);
        for (Owner first = 0; first < world_.size(); ++first)
            for (Owner second = first + 1; second < world_.size(); ++second) judgePair(first, second);
        return errors_;
    }

  private:
    void judgeTriangle(Owner owner) {
        const auto pieces = pieces_.of(owner, screen_);
        std::vector<SolidPoint> eye;
        for (const glm::vec3& p : world_[owner]) eye.push_back(lens_.toEye(p));
        const Clipped polygon = clip(eye, lens_.planes(), true);
        std::vector<ScreenPoint> exact;
        for (const SolidPoint& p : polygon.points) exact.push_back(lens_.toScreen(p)), errors_.made += p.made;
        if (polygon.doubtful && (exact.size() < 3 || pieces.empty())) return void(++errors_.undecided);
        judgeArea(exact, pieces);
        if (exact.empty() || pieces.empty()) return;
        for (const ScreenTriangle& t : pieces)
            for (const glm::dvec2& p : t.p_px) judgeVertex(p, exact);
        for (const ScreenPoint& p : exact) judgeCorner(p, pieces);
    }

    /// A vertex of a piece stands for the nearest exact one.
    void judgeVertex(const glm::dvec2& p, const std::vector<ScreenPoint>& exact) {
        const ScreenPoint* nearest = nullptr;
        Real best = 0;
        for (const ScreenPoint& q : exact)
            if (const Real d = distance(q, p); !nearest || d < best) nearest = &q, best = d;
        record(static_cast<double>(best), nearest->bound);
    }

    /// An exact corner lies on the pieces' outline (pieces without area are dropped, with their vertices).
    void judgeCorner(const ScreenPoint& corner, std::span<const ScreenTriangle> pieces) {
        Real best = distance(corner, pieces[0].p_px[0]);
        for (const ScreenTriangle& t : pieces)
            for (std::size_t k = 0; k < 3; ++k)
                best = std::min(best, distance(corner, t.p_px[k], t.p_px[(k + 1) % 3]));
        record(static_cast<double>(best), corner.bound);
    }

    void record(double error, double bound) {
        if (!(bound < kGuardBandPx)) return void(++errors_.undecided);
        ++errors_.vertices;
        if (error > errors_.max_px) errors_.max_px = error, errors_.bound_px = bound;
        errors_.worst_of_bound = std::max(errors_.worst_of_bound, error / bound);
    }

    /// Moving vertices by their bounds sweeps at most an edge's length times its ends' larger bound, and a
    /// square at each corner.
    void judgeArea(const std::vector<ScreenPoint>& exact, std::span<const ScreenTriangle> pieces) {
        Real twice = 0, room = 0;
        for (std::size_t i = 0; i < exact.size(); ++i) {
            const ScreenPoint &a = exact[i], &b = exact[(i + 1) % exact.size()];
            if (!(std::max(a.bound, b.bound) < kGuardBandPx)) return;
            twice += a.x * b.y - a.y * b.x;
            const Real length = sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
            const double moved = std::max(a.bound, b.bound);
            room += (length + 4 * moved) * moved;
        }
        errors_.lost_areas += abs(abs(twice) / 2 - areaOf(pieces)) > room;
    }

    void judgePair(Owner first, Owner second) {
        std::vector<glm::vec3> shared;
        for (const glm::vec3& p : world_[first])
            if (std::ranges::find(world_[second], p) != world_[second].end()) shared.push_back(p);
        if (shared.size() != 2) return;
        const auto one = pieces_.of(first, screen_), other = pieces_.of(second, screen_);
        if (one.empty() || other.empty()) return;
        const Clipped edge = clip({lens_.toEye(shared[0]), lens_.toEye(shared[1])}, lens_.planes(), false);
        if (!edge.cut || edge.doubtful || edge.points.size() != 2) return;
        const ScreenPoint a = lens_.toScreen(edge.points[0]), b = lens_.toScreen(edge.points[1]);
        const Real dx = b.x - a.x, dy = b.y - a.y;
        if (sqrt(dx * dx + dy * dy) <= 2 * (a.bound + b.bound)) return;  // may be one point of the grid
        ++errors_.shared_edges;
        errors_.cracks += !haveEdge(one, other, a, b);
    }

    /// Whether both outlines have one edge, bit for bit, and it is the exact one.
    static bool haveEdge(std::span<const ScreenTriangle> one, std::span<const ScreenTriangle> other,
                         const ScreenPoint& a, const ScreenPoint& b) {
        const auto edges = boundary(other);
        return std::ranges::any_of(boundary(one), [&](const GridEdge& e) {
            const glm::dvec2 from(e[0], e[1]), to(e[2], e[3]);
            const bool there = distance(a, from) <= a.bound && distance(b, to) <= b.bound;
            const bool back = distance(b, from) <= b.bound && distance(a, to) <= a.bound;
            return (there || back) && std::ranges::find(edges, e) != edges.end();
        });
    }

    const std::vector<WorldTriangle>& world_;
    Lens lens_;
    const ScreenScene& screen_;
    const ScreenPieces& pieces_;
    ProjectionErrors errors_;
};

}  // namespace

void ProjectionErrors::add(const ProjectionErrors& other) {
    vertices += other.vertices, made += other.made, undecided += other.undecided;
    if (other.max_px > max_px) max_px = other.max_px, bound_px = other.bound_px;
    worst_of_bound = std::max(worst_of_bound, other.worst_of_bound);
    shared_edges += other.shared_edges, cracks += other.cracks, lost_areas += other.lost_areas;
}

ProjectionErrors judgeProjection(const std::vector<WorldTriangle>& world, const ResolvedCamera& camera,
                                 const Film& film, const ScreenScene& screen, const ScreenPieces& pieces) {
    return Judge(world, camera, film, screen, pieces).run();
}

}  // namespace edgewise::judge
