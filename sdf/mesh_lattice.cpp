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

/// Which part of its parent a brick of a level is that holds the place.
int partOf(const glm::ivec3& unit, int level) {
    const glm::ivec3 half = unit / (kBrickCells * (kUnits >> level));
    return (half.x & 1) | (half.y & 1) << 1 | (half.z & 1) << 2;
}

class Octree {
  public:
    Octree(const Tape& tape, const Lattice& lattice, bool bound_holds, BrickList& found)
        : tape_(tape),
          lattice_(lattice),
          bound_holds_(bound_holds),
          found_(found),
          bricks_(lattice.bricks()) {}

    void run() {
        found_.at.assign(static_cast<std::size_t>(bricks_.x) * bricks_.y * bricks_.z, kNoBrick);
        const int longest = std::max({bricks_.x, bricks_.y, bricks_.z});
        visit({0, 0, 0}, static_cast<int>(std::bit_ceil(static_cast<unsigned>(longest))), tape_);
    }

    void divide(std::uint32_t index) {
        const glm::ivec3 first = found_.bricks[index].first;
        const int level = found_.bricks[index].level + 1, side = kBrickCells * (kUnits >> level);
        const TapeView tape = found_.bricks[index].tape;
        const double half = 0.5 * lattice_.step * side / kUnits;
        const Eighths eighths = cut(tape, first, side, half,
                                    [&](const glm::ivec3& part) { return lattice_.corner(part) + half; });
        const auto parts = static_cast<std::uint32_t>(found_.parts.size());
        std::uint32_t& entry = entryOf(first, level - 1);
        entry = kDividedBit | parts;
        found_.parts.emplace_back();
        found_.bricks[index].divided = true;
        for (int part = 0; part < kPointLanes; ++part) {
            ++found_.nodes;
            found_.parts[parts][part] = kNoBrick;
            if (free(tape, eighths.centreOf(part), half, eighths.values[part])) {
                ++found_.pruned;
                continue;
            }
            found_.parts[parts][part] = keep(eighths.firsts[part], level, eighths.tapeOf(part, tape));
        }
    }

  private:
    /// The eight parts of a node: values at their centres, and their tapes.
    struct Eighths {
        std::array<glm::ivec3, kPointLanes> firsts;
        LanePoints centres;
        double values[kPointLanes];
        PickLists shorter;
        bool shortened = false;

        glm::dvec3 centreOf(int part) const {
            return {centres.axis[0][part], centres.axis[1][part], centres.axis[2][part]};
        }
        /// Refers to this one's picks.
        TapeView tapeOf(int part, const TapeView& around) const {
            TapeView own = around;
            const auto picks = shorter.of(part);
            if (shortened && picks.size() < around.size()) own.picks = picks.data(), own.count = picks.size();
            return own;
        }
    };

    /// `side`: of a part, in the units of `first`; `half`: of its side, in world units.
    template <class CentreOf>
    Eighths cut(const TapeView& tape, const glm::ivec3& first, int side, double half,
                const CentreOf& centre_of) const {
        Eighths out;
        for (int part = 0; part < kPointLanes; ++part) {
            out.firsts[part] = first + side * glm::ivec3(part & 1, part >> 1 & 1, part >> 2 & 1);
            const glm::dvec3 centre = centre_of(out.firsts[part]);
            for (int axis = 0; axis < 3; ++axis) out.centres.axis[axis][part] = centre[axis];
        }
        laneValues(tape, out.centres, out.values);
        out.shortened = bound_holds_ && tape.size() >= kShort;
        if (out.shortened)
            pruneEight(tape, tape_.positions, tape_.values, out.centres,
                       (half + kBrickMargin * lattice_.step) * std::sqrt(3.0), out.shorter);
        return out;
    }

    glm::dvec3 centreOf(const glm::ivec3& first, int size) const {
        return lattice_.low_world +
               lattice_.step * kBrickCells * (glm::dvec3(first) + 0.5 * static_cast<double>(size));
    }
    double halfOf(int size) const { return 0.5 * lattice_.step * kBrickCells * size; }
    bool outside(const glm::ivec3& first) const {
        return first.x >= bricks_.x || first.y >= bricks_.y || first.z >= bricks_.z;
    }

    /// The surface does not pass the node; or its value there, for the sign.
    bool free(const TapeView& tape, const glm::dvec3& centre, double half, double value) const {
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
        const Eighths eighths = cut(tape, first, half_size, halfOf(half_size),
                                    [&](const glm::ivec3& part) { return centreOf(part, half_size); });
        for (int part = 0; part < kPointLanes; ++part) {
            if (outside(eighths.firsts[part])) continue;
            ++found_.nodes;
            if (free(tape, eighths.centreOf(part), halfOf(half_size), eighths.values[part])) {
                ++found_.pruned;
                found_.open |= !(eighths.values[part] > 0.0) && atTheEnd(eighths.firsts[part], half_size);
                continue;
            }
            visit(eighths.firsts[part], half_size, eighths.tapeOf(part, tape));
        }
    }

    void add(const glm::ivec3& first, const TapeView& tape) {
        const std::size_t at = first.x + static_cast<std::size_t>(bricks_.x) *
                                             (first.y + static_cast<std::size_t>(bricks_.y) * first.z);
        found_.at[at] = keep(first * kBrickCells * kUnits, 0, tape);
    }

    std::uint32_t keep(const glm::ivec3& first, int level, const TapeView& tape) {
        Brick brick;
        brick.first = first, brick.level = level;
        brick.tape = tape;
        if (tape.picks) {
            brick.picks = std::make_unique_for_overwrite<Pick[]>(tape.count);
            std::copy_n(tape.picks, tape.count, brick.picks.get());
            brick.tape.picks = brick.picks.get();
        }
        found_.bricks.push_back(std::move(brick));
        return static_cast<std::uint32_t>(found_.bricks.size() - 1);
    }

    /// Where a brick is written down.
    std::uint32_t& entryOf(const glm::ivec3& first, int level) {
        const glm::ivec3 brick = first / (kBrickCells * kUnits);
        std::uint32_t* entry =
            &found_.at[brick.x + static_cast<std::size_t>(bricks_.x) *
                                     (brick.y + static_cast<std::size_t>(bricks_.y) * brick.z)];
        for (int n = 1; n <= level; ++n) entry = &found_.parts[*entry & ~kDividedBit][partOf(first, n)];
        return *entry;
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

BrickList::Leaf BrickList::leafAt(const Lattice& lattice, const glm::ivec3& unit) const {
    const glm::ivec3 count = lattice.bricks();
    for (int axis = 0; axis < 3; ++axis)
        if (unit[axis] < 0 || unit[axis] >= count[axis] * kBrickCells * kUnits) return {kNoBrick, 0};
    const glm::ivec3 brick = unit / (kBrickCells * kUnits);
    std::uint32_t entry = at[brick.x + static_cast<std::size_t>(count.x) *
                                           (brick.y + static_cast<std::size_t>(count.y) * brick.z)];
    int level = 0;
    while (entry != kNoBrick && (entry & kDividedBit)) {
        ++level;
        entry = parts[entry & ~kDividedBit][partOf(unit, level)];
    }
    return {entry, level};
}

void divideBrick(const Tape& tape, const Lattice& lattice, bool bound_holds, std::uint32_t brick,
                 BrickList& list) {
    Octree(tape, lattice, bound_holds, list).divide(brick);
}

BrickList findBricks(const Tape& tape, const Lattice& lattice, bool bound_holds) {
    BrickList found;
    Octree(tape, lattice, bound_holds, found).run();
    return found;
}

}  // namespace edgewise::sdf
