#include "sdf/mesh_crossings.h"

#include <cmath>
#include <limits>

#include "sdf/edge_roots.h"
#include "sdf/evaluate.h"

namespace edgewise::sdf {
namespace {

/// Of an edge: where the root is looked for no more.
constexpr double kRootWidth = 1e-13;

}  // namespace

void BrickCrossings::readValues(const Lattice& lattice, const Brick& brick) {
    turned_.reset();
    LanePoints points;
    double values[kPointLanes];
    for (int begin = 0; begin < kCorners; begin += kPointLanes) {
        for (int lane = 0; lane < kPointLanes; ++lane) {
            const int n = std::min(begin + lane, kCorners - 1);
            const glm::dvec3 p =
                lattice.corner(brick.unitsOf(glm::ivec3(n % kSide, n / kSide % kSide, n / (kSide * kSide))));
            for (int axis = 0; axis < 3; ++axis) points.axis[axis][lane] = p[axis];
        }
        laneValues(brick.tape, points, values);
        for (int lane = 0; lane < kPointLanes && begin + lane < kCorners; ++lane)
            values_[begin + lane] = values[lane];
    }
}

void BrickCrossings::findCrossings(const Lattice& lattice, const Brick& brick, const TapeAt& tape) {
    crossings_.clear();
    for (auto& axis : at_) axis.fill(-1);
    struct Edge {
        glm::ivec3 corner;
        int axis;
    };
    std::array<Edge, kPointLanes> edges;
    int waiting = 0;
    LanePoints points{};
    std::array<RootBracket, kPointLanes> roots;
    const auto solve = [&] {
        for (int lane = 0; lane < kPointLanes; ++lane) {
            const Edge& e = edges[std::min(lane, waiting - 1)];
            const glm::dvec3 p = lattice.corner(brick.unitsOf(e.corner));
            for (int axis = 0; axis < 3; ++axis) points.axis[axis][lane] = p[axis];
            if (lane >= waiting) {
                roots[lane].done = true;
                continue;
            }
            glm::ivec3 end = e.corner;
            ++end[e.axis];
            roots[lane] = RootBracket::between(
                p[e.axis], lattice.coordinate(e.axis, brick.unitsOf(end)[e.axis]), value(e.corner),
                value(end), kRootWidth * lattice.step / (1 << brick.level));
        }
        double values[kPointLanes];
        for (int step = 0; step < kMostRootSteps; ++step) {
            bool all_done = true;
            for (int lane = 0; lane < waiting; ++lane) {
                if (roots[lane].done) continue;
                all_done = false;
                points.axis[edges[lane].axis][lane] = roots[lane].guess();
            }
            if (all_done) break;
            laneValues(brick.tape, points, values);
            for (int lane = 0; lane < waiting; ++lane)
                if (!roots[lane].done)
                    roots[lane].take(points.axis[edges[lane].axis][lane], values[lane],
                                     value(edges[lane].corner) < 0.0);
        }
        for (int lane = 0; lane < waiting; ++lane) {
            const Edge& e = edges[lane];
            glm::dvec3 p = lattice.corner(brick.unitsOf(e.corner));
            p[e.axis] = roots[lane].root;
            addCrossing(tape, e.corner, e.axis, p, false);
        }
        waiting = 0;
    };
    for (int z = 0; z < kSide; ++z)
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x)
                for (int axis = 0; axis < 3; ++axis) {
                    const glm::ivec3 corner(x, y, z);
                    if (corner[axis] == kBrickCells) continue;
                    glm::ivec3 end = corner;
                    ++end[axis];
                    if ((value(corner) < 0.0) == (value(end) < 0.0)) continue;
                    if (turned_[indexOf(corner)] || turned_[indexOf(end)]) {
                        const glm::dvec3 middle = 0.5 * (lattice.corner(brick.unitsOf(corner)) +
                                                         lattice.corner(brick.unitsOf(end)));
                        addCrossing(tape, corner, axis, middle, true);
                        continue;
                    }
                    edges[waiting++] = {corner, axis};
                    if (waiting == kPointLanes) solve();
                }
    if (waiting > 0) solve();
}

void BrickCrossings::addCrossing(const TapeAt& tape, const glm::ivec3& corner, int axis, const glm::dvec3& p,
                                 bool made) {
    const glm::dvec3 gradient = gradientAt(tape(p), p).gradient;
    const double length = glm::length(gradient);
    glm::dvec3 normal(0.0);
    normal[axis] = value(corner) < 0.0 ? 1.0 : -1.0;
    if (length > 0.0 && std::isfinite(length)) normal = gradient / length;
    add(corner, axis, {p, normal, made});
}

void BrickCrossings::set(std::span<const double> values) {
    turned_.reset();
    std::copy_n(values.begin(), kCorners, values_.begin());
    crossings_.clear();
    for (auto& axis : at_) axis.fill(-1);
}

void BrickCrossings::add(const glm::ivec3& corner, int axis, const Crossing& crossing) {
    at_[axis][indexOf(corner)] = static_cast<int>(crossings_.size());
    crossings_.push_back(crossing);
}

void BrickCrossings::turn(const glm::ivec3& c) {
    double& value = values_[indexOf(c)];
    value = value < 0.0 ? -value : -std::max(value, std::numeric_limits<double>::min());
    turned_.set(indexOf(c));
}

bool BrickCrossings::open(const Lattice& lattice, const Brick& brick) const {
    for (int n = 0; n < kCorners; ++n) {
        const glm::ivec3 at = brick.unitsOf(glm::ivec3(n % kSide, n / kSide % kSide, n / (kSide * kSide)));
        const glm::ivec3 last = lattice.units();
        const bool end =
            at.x == 0 || at.y == 0 || at.z == 0 || at.x == last.x || at.y == last.y || at.z == last.z;
        if (end && values_[n] < 0.0) return true;
    }
    return false;
}

bool BrickCrossings::crosses(const glm::ivec3& cell) const {
    int inside = 0;
    for (int c = 0; c < kCellCorners; ++c) inside += value(cell + cornerOffset(c)) < 0.0;
    return inside != 0 && inside != kCellCorners;
}

}  // namespace edgewise::sdf
