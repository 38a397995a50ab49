// Tapes of the cells of an octree over the world, made where and when they pay, for all threads at once.
#pragma once

#include <atomic>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>

#include "sdf/tape.h"

namespace edgewise::sdf {

/// A whole tape shorter than this is left as it is: on primary rays shortening 18 instructions costs 13 % of
/// the time, 42 gain 19 %.
inline constexpr std::size_t kShortTape = 32;

struct PruneCounts {
    std::uint64_t tapes = 0;         ///< made
    std::uint64_t instructions = 0;  ///< run to make them, as if for one at a time
    std::uint64_t kept = 0;          ///< that they have
    double seconds = 0.0;
    PruneCounts& operator+=(const PruneCounts& other);
};

/// A cube, and a tape with the whole one's bits at each of its points.
struct TapeCell {
    struct Parts;
    glm::dvec3 centre_world{0.0};
    double half = 0.0;  ///< of its side
    TapeView tape;
    const TapeCell* around = nullptr;
    std::uint32_t index = 0;
    std::uint8_t level = 0,
                 without_gain = 0;  ///< levels since a tape was last much shorter than the one around
    mutable std::atomic<const Parts*> parts{nullptr};
    mutable std::atomic<std::uint32_t> passes{0};  ///< over its tape
    mutable std::atomic<bool> being_cut{false};

    bool holds(const glm::dvec3& p) const;
};

/// A cell is cut in eight once its tape has been run about as often as making theirs costs, so that at most
/// about as much time goes into tapes as into running them; twice as often for each level that has not
/// helped. One that is many rays wide is cut at once: its neighbours in the picture will ask there too.
class CellTapes {
  public:
    /// Refers to the tape. Outside the cube, and without `prune`, the whole tape is used.
    CellTapes(const Tape& whole, const glm::dvec3& centre_world, double half, bool prune);
    ~CellTapes();
    CellTapes(const CellTapes&) = delete;
    CellTapes& operator=(const CellTapes&) = delete;

    /// The smallest cell at the point. `near`: one that may hold it, or be close.
    const TapeCell& at(const glm::dvec3& p_world, const TapeCell* near = nullptr) const;
    /// The same for a ray or cone of that radius there: wide cells are cut at once. What is made is added to
    /// the counts.
    const TapeCell& at(const glm::dvec3& p_world, const TapeCell* near, double radius,
                       PruneCounts& counts) const;
    /// Tells that a cell's tape has been run so often more.
    void ran(const TapeCell& cell, std::uint32_t passes, PruneCounts& counts) const;
    void ran(const TapeCell& cell, std::uint32_t passes) const;

    /// All that was made.
    PruneCounts counts() const;
    const Tape& whole() const { return whole_; }

  private:
    void cut(const TapeCell& cell, PruneCounts& counts) const;

    const Tape& whole_;
    TapeCell everywhere_, root_;
    mutable std::atomic<std::uint32_t> cells_{2};
    mutable std::atomic<std::uint64_t> made_{0}, run_{0}, kept_{0}, nanoseconds_{0};
};

}  // namespace edgewise::sdf
