#include "sdf/mesh_lattice.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "sdf/evaluate.h"

namespace edgewise::sdf {
namespace {

/// Tapes shorter than this are left as they are.
constexpr std::size_t kShort = 6;
/// Of a cell: how far the lattice reaches beyond the box, by axis. No round numbers.
constexpr double kBeyond[3] = {0.0314159265, 0.0271828183, 0.0141421356};

class Octree {
  public:
    Octree(const Tape& tape, const Lattice& lattice, bool bound_holds, BrickList& found)
        : tape_(tape),
          lattice_(lattice),
          bound_holds_(bound_holds),
          found_(found),
          bricks_(lattice.bricks()) {
        found_.at.assign(static_cast<std::size_t>(bricks_.x) * bricks_.y * bricks_.z, kNoBrick);
    }

    void run() {
        const int longest = std::max({bricks_.x, bricks_.y, bricks_.z});
        visit({0, 0, 0}, static_cast<int>(std::bit_ceil(static_cast<unsigned>(longest))), tape_);
    }

  private:
    glm::dvec3 centreOf(const glm::ivec3& first, int size) const {
        return lattice_.low_world +
               lattice_.step * kBrickCells * (glm::dvec3(first) + 0.5 * static_cast<double>(size));
    }
    double halfOf(int size) const { return 0.5 * lattice_.step * kBrickCells * size; }
    bool outside(const glm::ivec3& first) const {
        return first.x >= bricks_.x || first.y >= bricks_.y || first.z >= bricks_.z;
    }

    /// The surface does not pass the node; or its value there, for the sign.
    bool free(const TapeView& tape, const glm::ivec3& first, int size, double value) const {
        const double half = halfOf(size);
        const glm::dvec3 centre = centreOf(first, size);
        if (bound_holds_) {
            const double scale = std::abs(centre.x) + std::abs(centre.y) + std::abs(centre.z) + half;
            return std::abs(value) >
                   tape_.lipschitz * (half * std::sqrt(3.0) + 1e-12 * scale) * (1.0 + 1e-12);
        }
        Interval box[3];
        for (int axis = 0; axis < 3; ++axis) box[axis] = {centre[axis] - half, centre[axis] + half};
        const Interval values = valuesIn(tape, box);
        return values.low > 0.0 || values.high < 0.0;
    }

    bool atTheEnd(const glm::ivec3& first, int size) const {
        for (int axis = 0; axis < 3; ++axis)
            if (first[axis] == 0 || first[axis] + size >= bricks_[axis]) return true;
        return false;
    }

    /// A node that the surface may pass.
    void visit(const glm::ivec3& first, int size, const TapeView& tape) {
        if (size == 1) return add(first, tape);
        const int half_size = size / 2;
        LanePoints centres;
        std::array<glm::ivec3, kPointLanes> firsts;
        for (int part = 0; part < kPointLanes; ++part) {
            firsts[part] = first + half_size * glm::ivec3(part & 1, part >> 1 & 1, part >> 2 & 1);
            const glm::dvec3 centre = centreOf(firsts[part], half_size);
            for (int axis = 0; axis < 3; ++axis) centres.axis[axis][part] = centre[axis];
        }
        double values[kPointLanes];
        laneValues(tape, centres, values);
        PickLists shorter;
        const bool shorten = bound_holds_ && tape.size() >= kShort;
        if (shorten)
            pruneEight(tape, tape_.positions, tape_.values, centres,
                       (halfOf(half_size) + kBrickMargin * lattice_.step) * std::sqrt(3.0), shorter);
        for (int part = 0; part < kPointLanes; ++part) {
            if (outside(firsts[part])) continue;
            ++found_.nodes;
            if (free(tape, firsts[part], half_size, values[part])) {
                ++found_.pruned;
                found_.open |= !(values[part] > 0.0) && atTheEnd(firsts[part], half_size);
                continue;
            }
            TapeView own = tape;
            if (shorten && shorter.of(part).size() < tape.size())
                own.picks = shorter.of(part).data(), own.count = shorter.of(part).size();
            visit(firsts[part], half_size, own);
        }
    }

    void add(const glm::ivec3& first, const TapeView& tape) {
        Brick brick;
        brick.first = first * kBrickCells;
        brick.tape = tape;
        if (tape.picks) {
            brick.picks = std::make_unique_for_overwrite<Pick[]>(tape.count);
            std::copy_n(tape.picks, tape.count, brick.picks.get());
            brick.tape.picks = brick.picks.get();
        }
        const std::size_t at = first.x + static_cast<std::size_t>(bricks_.x) *
                                             (first.y + static_cast<std::size_t>(bricks_.y) * first.z);
        found_.at[at] = static_cast<std::uint32_t>(found_.bricks.size());
        found_.bricks.push_back(std::move(brick));
    }

    const Tape& tape_;
    const Lattice& lattice_;
    const bool bound_holds_;
    BrickList& found_;
    const glm::ivec3 bricks_;
};

}  // namespace

Lattice latticeOf(const glm::dvec3& low, const glm::dvec3& high, int resolution) {
    const glm::dvec3 size = high - low;
    const double longest = std::max({size.x, size.y, size.z});
    Lattice lattice;
    lattice.step = longest / (resolution - 2.0 * kBeyond[0]);
    for (int axis = 0; axis < 3; ++axis) {
        const double needed = size[axis] / lattice.step + 2.0 * kBeyond[axis];
        const int bricks = std::max(1, static_cast<int>(std::ceil((needed - 1e-6) / kBrickCells)));
        lattice.cells[axis] = bricks * kBrickCells;
        lattice.low_world[axis] =
            low[axis] - (kBeyond[axis] + 0.5 * std::max(0.0, lattice.cells[axis] - needed)) * lattice.step;
    }
    return lattice;
}

BrickList findBricks(const Tape& tape, const Lattice& lattice, bool bound_holds) {
    BrickList found;
    Octree(tape, lattice, bound_holds, found).run();
    return found;
}

}  // namespace edgewise::sdf
