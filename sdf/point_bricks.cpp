#include "sdf/point_bricks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>

#include "sdf/edge_roots.h"
#include "sdf/point_slopes.h"
#include "sdf/scene_error.h"
#include "sdf/unit_or.h"

namespace edgewise::sdf {
namespace {

constexpr std::size_t kBricksABatch = 512;
constexpr int kSide = BrickCrossings::kSide, kCorners = BrickCrossings::kCorners;
/// Of the bound, and of the largest coordinate's roundings: what values may change more than it says.
constexpr double kSlack = 1e-3, kRoundings = 64.0;
/// Bricks that are read without a bound: of a cube of 1024 cells a side.
constexpr double kMostBlind = 0x1p21;
/// Of an edge: where a root is looked for no more; and roundings of the largest coordinate.
constexpr double kRootWidth = 1e-13;

glm::ivec3 cornerOf(int n) {
    return {n % kSide, n / kSide % kSide, n / (kSide * kSide)};
}

double largestCoordinate(const Lattice& lattice) {
    const glm::dvec3 far =
        glm::max(glm::abs(lattice.corner({0, 0, 0})), glm::abs(lattice.corner(lattice.units())));
    return std::max({far.x, far.y, far.z});
}

/// Cubes of 2^k bricks that the surface may pass.
struct Node {
    glm::ivec3 first;  ///< in bricks
    double value;      ///< at its centre
};

/// How far values may be apart over a distance.
class Bound {
  public:
    Bound(const PointField& field, const Lattice& lattice)
        : slope_(field.lipschitz() * (1.0 + kSlack)),
          noise_(kRoundings * field.rounding() * field.lipschitz() * largestCoordinate(lattice)) {}
    double over(double distance) const { return slope_ * distance + noise_; }

  private:
    double slope_, noise_;
};

/// Throws SceneError where there are too many to look at.
std::vector<glm::ivec3> everyBrick(const Lattice& lattice) {
    const glm::ivec3 count = lattice.bricks();
    if (double(count.x) * count.y * count.z > kMostBlind)
        throw SceneError("map",
                         "values change faster than its `lipschitz` says, and in as many cells nobody "
                         "can look for its surface without a bound: --resolution 1024 is the most");
    std::vector<glm::ivec3> all;
    for (int z = 0; z < count.z; ++z)
        for (int y = 0; y < count.y; ++y)
            for (int x = 0; x < count.x; ++x) all.push_back({x, y, z});
    return all;
}

}  // namespace

NearBricks bricksNear(const PointField& field, const Lattice& lattice) {
    const Bound bound(field, lattice);
    const glm::ivec3 count = lattice.bricks();
    int size = static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::max({count.x, count.y, count.z}))));
    const double brick = lattice.step * kBrickCells, half_diagonal = 0.5 * std::sqrt(3.0) * brick;
    const auto centreOf = [&](const glm::ivec3& first, int of) {
        return lattice.low_world + brick * (glm::dvec3(first) + 0.5 * of);
    };
    NearBricks near;
    std::vector<Node> nodes{{{0, 0, 0}, 0.0}};
    nodes[0].value = field.values(std::array{centreOf(nodes[0].first, size)})[0];
    for (; size > 1 && near.bound_holds; size /= 2) {
        std::vector<Node> parts;
        std::vector<glm::dvec3> centres;
        for (const Node& node : nodes)
            for (int n = 0; n < 8; ++n) {
                const glm::ivec3 first = node.first + size / 2 * glm::ivec3(n & 1, n >> 1 & 1, n >> 2);
                if (first.x >= count.x || first.y >= count.y || first.z >= count.z) continue;
                parts.push_back({first, node.value});
                centres.push_back(centreOf(first, size / 2));
            }
        const std::vector<double> values = field.values(centres);
        nodes.clear();
        for (std::size_t i = 0; i < parts.size(); ++i) {
            Node node = parts[i];
            near.bound_holds &= std::abs(values[i] - node.value) <= bound.over(0.5 * half_diagonal * size);
            node.value = values[i];
            ++near.nodes;
            if (std::abs(node.value) <= bound.over(0.5 * half_diagonal * size)) {
                nodes.push_back(node);
                continue;
            }
            ++near.pruned;
            for (int axis = 0; axis < 3; ++axis)
                near.open |=
                    node.value < 0.0 && (node.first[axis] == 0 || node.first[axis] + size / 2 >= count[axis]);
        }
    }
    if (!near.bound_holds) return {everyBrick(lattice), near.nodes, 0, false, false};
    for (const Node& node : nodes) near.bricks.push_back(node.first);
    return near;
}

PointBricks::PointBricks(const PointField& field, const Lattice& lattice, std::function<void()> between)
    : field_(field), lattice_(lattice), between_(std::move(between)) {
    const NearBricks near = bricksNear(field, lattice);
    pause();
    list_.nodes = near.nodes, list_.pruned = near.pruned, list_.open = near.open;
    bound_holds_ = near.bound_holds;
    keepCrossed(near.bricks);
    if (near.bound_holds && !(bound_holds_ && isWhole())) {
        bound_holds_ = list_.open = false;
        keepCrossed(everyBrick(lattice));
    }
    if (!list_.open) findCrossings();
}

void PointBricks::keepCrossed(const std::vector<glm::ivec3>& bricks) {
    const glm::ivec3 count = lattice_.bricks();
    list_.bricks.clear(), values_.clear();
    list_.at.assign(static_cast<std::size_t>(count.x) * count.y * count.z, kNoBrick);
    for (std::size_t begin = 0; begin < bricks.size(); begin += kBricksABatch) {
        const std::size_t batch = std::min(kBricksABatch, bricks.size() - begin);
        std::vector<glm::dvec3> points;
        points.reserve(batch * kCorners);
        for (std::size_t b = begin; b < begin + batch; ++b)
            for (int n = 0; n < kCorners; ++n)
                points.push_back(lattice_.corner(kUnits * (kBrickCells * bricks[b] + cornerOf(n))));
        const std::vector<double> values = field_.values(points);
        pause();
        for (std::size_t b = 0; b < batch; ++b)
            keep(bricks[begin + b], std::span(values).subspan(b * kCorners, kCorners));
    }
}

void PointBricks::keep(const glm::ivec3& place, std::span<const double> values) {
    if (bound_holds_) checkSteps(values);
    const glm::ivec3 last = lattice_.cells;
    bool inside = false, outside = false;
    for (int n = 0; n < kCorners; ++n) {
        (values[n] < 0.0 ? inside : outside) = true;
        const glm::ivec3 at = kBrickCells * place + cornerOf(n);
        if (values[n] < 0.0)
            for (int axis = 0; axis < 3; ++axis) list_.open |= at[axis] == 0 || at[axis] == last[axis];
    }
    if (!inside || !outside) return;
    list_.at[indexOf(place)] = static_cast<std::uint32_t>(list_.bricks.size());
    Brick brick;
    brick.first = place * kBrickCells * kUnits;
    list_.bricks.push_back(std::move(brick));
    values_.insert(values_.end(), values.begin(), values.end());
}

/// Whether the bound holds between neighbours.
void PointBricks::checkSteps(std::span<const double> values) {
    const double most = Bound(field_, lattice_).over(lattice_.step);
    for (int n = 0; n < kCorners; ++n) {
        const glm::ivec3 corner = cornerOf(n);
        for (int axis = 0; axis < 3; ++axis) {
            if (corner[axis] == kBrickCells) continue;
            glm::ivec3 next = corner;
            ++next[axis];
            bound_holds_ &= std::abs(values[BrickCrossings::indexOf(next)] - values[n]) <= most;
        }
    }
}

/// No brick's face has both signs where the brick beyond was left out.
bool PointBricks::isWhole() const {
    const glm::ivec3 count = lattice_.bricks();
    for (std::size_t b = 0; b < list_.bricks.size(); ++b)
        for (int face = 0; face < 6; ++face) {
            const int axis = face / 2, at = face & 1 ? kBrickCells : 0;
            glm::ivec3 beyond = placeOf(b);
            beyond[axis] += face & 1 ? 1 : -1;
            if (beyond[axis] < 0 || beyond[axis] >= count[axis] || brickAt(beyond) != kNoBrick) continue;
            bool inside = false, outside = false;
            for (int n = 0; n < kSide * kSide; ++n) {
                glm::ivec3 corner(0);
                corner[axis] = at, corner[(axis + 1) % 3] = n % kSide, corner[(axis + 2) % 3] = n / kSide;
                const double value =
                    values_[b * kCorners + static_cast<std::size_t>(BrickCrossings::indexOf(corner))];
                (value < 0.0 ? inside : outside) = true;
            }
            if (inside && outside) return false;
        }
    return true;
}

std::uint32_t PointBricks::brickAt(const glm::ivec3& brick) const {
    const glm::ivec3 count = lattice_.bricks();
    if (brick.x >= count.x || brick.y >= count.y || brick.z >= count.z) return kNoBrick;
    return list_.at[indexOf(brick)];
}

std::size_t PointBricks::indexOf(const glm::ivec3& brick) const {
    const glm::ivec3 count = lattice_.bricks();
    return brick.x +
           static_cast<std::size_t>(count.x) * (brick.y + static_cast<std::size_t>(count.y) * brick.z);
}

/// A brick has the edges from its own corners on, but for those at its upper faces.
void PointBricks::findCrossings() {
    crossed_at_.assign(list_.bricks.size() * kOwned, kNoBrick);
    std::vector<RootBracket> roots;
    std::vector<std::uint8_t> axes;
    std::vector<bool> inside_low;
    const double width =
        std::max(kRootWidth * lattice_.step, field_.rounding() * largestCoordinate(lattice_));
    for (std::size_t b = 0; b < list_.bricks.size(); ++b)
        for (std::size_t n = 0; n < kOwned; ++n) {
            const int cell = static_cast<int>(n / 3), axis = static_cast<int>(n % 3);
            const glm::ivec3 corner(cell % kBrickCells, cell / kBrickCells % kBrickCells,
                                    cell / (kBrickCells * kBrickCells));
            glm::ivec3 end = corner;
            ++end[axis];
            const double *values = &values_[b * kCorners], low = values[BrickCrossings::indexOf(corner)],
                         high = values[BrickCrossings::indexOf(end)];
            if ((low < 0.0) == (high < 0.0)) continue;
            const Brick& brick = list_.bricks[b];
            crossed_at_[b * kOwned + n] = static_cast<std::uint32_t>(crossings_.size());
            crossings_.push_back({lattice_.corner(brick.unitsOf(corner)), glm::dvec3(0.0), false});
            roots.push_back(RootBracket::between(lattice_.coordinate(axis, brick.unitsOf(corner)[axis]),
                                                 lattice_.coordinate(axis, brick.unitsOf(end)[axis]), low,
                                                 high, width));
            axes.push_back(static_cast<std::uint8_t>(axis)), inside_low.push_back(low < 0.0);
        }
    std::vector<std::size_t> open;
    std::vector<glm::dvec3> points;
    for (int step = 0; step < kMostRootSteps; ++step) {
        open.clear(), points.clear();
        for (std::size_t i = 0; i < roots.size(); ++i) {
            if (roots[i].done) continue;
            open.push_back(i);
            points.push_back(crossings_[i].place_world);
            points.back()[axes[i]] = roots[i].guess();
        }
        if (open.empty()) break;
        const std::vector<double> values = field_.values(points);
        pause();
        for (std::size_t k = 0; k < open.size(); ++k)
            roots[open[k]].take(points[k][axes[open[k]]], values[k], inside_low[open[k]]);
    }
    points.clear();
    for (std::size_t i = 0; i < roots.size(); ++i) {
        crossings_[i].place_world[axes[i]] = roots[i].root;
        points.push_back(crossings_[i].place_world);
    }
    const std::vector<glm::dvec3> slopes = slopesAt(field_, points, slopeReach(field_, lattice_));
    for (std::size_t i = 0; i < roots.size(); ++i) {
        glm::dvec3 along(0.0);
        along[axes[i]] = inside_low[i] ? 1.0 : -1.0;
        crossings_[i].normal_world = unitOr(slopes[i], along);
    }
}

std::uint32_t PointBricks::crossingAt(const glm::ivec3& corner, int axis) const {
    const std::uint32_t brick = brickAt(corner / kBrickCells);
    if (brick == kNoBrick) return kNoBrick;
    const glm::ivec3 in = corner % kBrickCells;
    return crossed_at_[brick * kOwned + static_cast<std::size_t>(
                                            axis + 3 * (in.x + kBrickCells * (in.y + kBrickCells * in.z)))];
}

void PointBricks::readValues(std::size_t brick, BrickCrossings& into) const {
    into.set(std::span(values_).subspan(brick * kCorners, kCorners));
}

void PointBricks::read(std::size_t brick, BrickCrossings& into) const {
    readValues(brick, into);
    const glm::ivec3 first = kBrickCells * placeOf(brick);
    for (int n = 0; n < kCorners; ++n) {
        const glm::ivec3 corner = cornerOf(n);
        for (int axis = 0; axis < 3; ++axis) {
            if (corner[axis] == kBrickCells) continue;
            const std::uint32_t at = crossingAt(first + corner, axis);
            if (at != kNoBrick) into.add(corner, axis, crossings_[at]);
        }
    }
}

}  // namespace edgewise::sdf
