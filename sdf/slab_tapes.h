// A tile's tapes: one a slab of depth, shortened from the tile around it when it is first asked for.
#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>

#include "sdf/beam.h"
#include "sdf/tape.h"

namespace edgewise::sdf {

/// Depth cut into slabs, each level's in halves of the last one's: in equal parts for parallel rays, in equal
/// ratios for others. Slabs are about as long as a tile of the level is wide.
class Slabs {
  public:
    /// `top`: the beam of a tile of level 0.
    Slabs(const Beam& top, double t_min, double t_max);
    int indexOf(double t, int level) const;
    double begin(int index, int level) const;

  private:
    bool ratios_;
    double first_, length_;  ///< ratios: the first slab ends there; the logarithm of the ratio
};

struct PruneCounts {
    std::uint64_t tapes = 0;         ///< made
    std::uint64_t instructions = 0;  ///< run to make them
    std::uint64_t kept = 0;          ///< that they have
    double seconds = 0.0;
    PruneCounts& operator+=(const PruneCounts& other);
};

class SlabTapes {
  public:
    /// Level 0; `prune`: else the whole tape is every slab's.
    SlabTapes(const Tape& whole, const Slabs& slabs, const Beam& beam, bool prune);
    /// Of a tile within the parent's, a level below; both outlive it.
    SlabTapes(SlabTapes& parent, const Beam& beam);

    int indexOf(double t) const { return prune_ ? slabs_.indexOf(t, level_) : 0; }
    /// The same bits as the whole tape's at all points of the tile's rays in the slab. With few points to
    /// ask, one of a tile around serves as well.
    const Tape& of(int index, std::size_t points, PruneCounts& counts);

  private:
    const Tape& make(int index, const Tape& from, PruneCounts& counts);

    const Tape& whole_;
    const Slabs& slabs_;
    SlabTapes* parent_ = nullptr;
    Beam beam_;
    int level_ = 0;
    bool prune_;
    std::unordered_map<int, std::unique_ptr<const Tape>> tapes_;
};

}  // namespace edgewise::sdf
