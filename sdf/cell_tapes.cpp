#include "sdf/cell_tapes.h"

#include <array>
#include <chrono>
#include <cmath>

#include "sdf/prune.h"

namespace edgewise::sdf {
namespace {

/// A cell's tape shorter than this is not shortened further.
constexpr std::size_t kShortCellTape = 16;
/// Eight tapes cost about four passes over the one around; lanes are seldom full.
constexpr std::uint32_t kCostInPasses = 12;
/// Measured on spheres-1000 at 512x512 and 1024x1024: 16 costs 3 % more, 8 costs 9 % more.
constexpr double kWideInRadii = 32.0;
/// Cells of these levels may hold all of a scene: they are cut although it does not help yet.
constexpr int kOuterLevels = 7;
/// Wide cells are cut down to this level, and where that has helped lately.
constexpr int kMostWideLevels = 14, kMostWideWithoutGain = 2;
constexpr int kMostLevels = 40, kMostWithoutGain = 10;
/// Of all picks: 128 MiB.
constexpr std::uint64_t kMostKept = std::uint64_t(32) << 20;
constexpr double kGain = 0.75;

bool within(const glm::dvec3& p, const glm::dvec3& centre, double half) {
    return std::abs(p.x - centre.x) <= half && std::abs(p.y - centre.y) <= half &&
           std::abs(p.z - centre.z) <= half;
}
int partOf(const glm::dvec3& p, const glm::dvec3& centre) {
    return (p.x >= centre.x) | (p.y >= centre.y) << 1 | (p.z >= centre.z) << 2;
}
glm::dvec3 centreOf(const TapeCell& cell, int part) {
    const double quarter = 0.5 * cell.half;
    return cell.centre_world + quarter * glm::dvec3(part & 1 ? 1 : -1, part & 2 ? 1 : -1, part & 4 ? 1 : -1);
}

}  // namespace

struct TapeCell::Parts {
    std::array<TapeCell, kPointLanes> cell;
    std::unique_ptr<Pick[]> picks;
    ~Parts() {
        for (const TapeCell& c : cell) delete c.parts.load(std::memory_order_relaxed);
    }
};

bool TapeCell::holds(const glm::dvec3& p) const {
    return within(p, centre_world, half);
}

PruneCounts& PruneCounts::operator+=(const PruneCounts& other) {
    tapes += other.tapes, instructions += other.instructions, kept += other.kept;
    seconds += other.seconds;
    return *this;
}

CellTapes::CellTapes(const Tape& whole, const glm::dvec3& centre, double half, bool prune) : whole_(whole) {
    everywhere_.tape = root_.tape = whole;
    everywhere_.being_cut = true;
    root_.index = 1, root_.centre_world = centre,
    root_.half = prune && whole.size() >= kShortTape ? half : -1.0;
}

CellTapes::~CellTapes() {
    delete root_.parts.load(std::memory_order_relaxed);
}

const TapeCell& CellTapes::at(const glm::dvec3& p, const TapeCell* near) const {
    if (!near) near = &root_;
    while (near && !near->holds(p)) near = near->around;
    if (!near && !root_.holds(p)) return everywhere_;
    if (!near) near = &root_;
    while (const TapeCell::Parts* parts = near->parts.load(std::memory_order_acquire))
        near = &parts->cell[static_cast<std::size_t>(partOf(p, near->centre_world))];
    return *near;
}

const TapeCell& CellTapes::at(const glm::dvec3& p, const TapeCell* near, double radius,
                              PruneCounts& counts) const {
    const TapeCell* cell = &at(p, near);
    while (cell->half > kWideInRadii * radius && cell->level < kMostWideLevels &&
           cell->without_gain <= kMostWideWithoutGain) {
        if (cell->being_cut.exchange(true)) break;
        cut(*cell, counts);
        const TapeCell* inner = &at(p, cell);
        if (inner == cell) break;
        cell = inner;
    }
    return *cell;
}

void CellTapes::ran(const TapeCell& cell, std::uint32_t passes, PruneCounts& counts) const {
    if (cell.being_cut.load(std::memory_order_relaxed)) return;
    const std::uint32_t all = cell.passes.fetch_add(passes, std::memory_order_relaxed) + passes;
    if (all < kCostInPasses << cell.without_gain) return;
    if (!cell.being_cut.exchange(true)) cut(cell, counts);
}

void CellTapes::ran(const TapeCell& cell, std::uint32_t passes) const {
    PruneCounts counts;
    ran(cell, passes, counts);
}

void CellTapes::cut(const TapeCell& cell, PruneCounts& counts) const {
    if (cell.tape.size() < kShortCellTape || cell.level >= kMostLevels ||
        cell.without_gain >= kMostWithoutGain)
        return;
    if (kept_.load(std::memory_order_relaxed) > kMostKept) return;
    const auto start = std::chrono::steady_clock::now();
    thread_local PickLists shorter;
    LanePoints centres;
    for (int part = 0; part < kPointLanes; ++part) {
        const glm::dvec3 centre = centreOf(cell, part);
        for (int axis = 0; axis < 3; ++axis) centres.axis[axis][part] = centre[axis];
    }
    const double size = std::abs(cell.centre_world.x) + std::abs(cell.centre_world.y) +
                        std::abs(cell.centre_world.z) + cell.half;
    const double radius = 0.5 * cell.half * std::sqrt(3.0) + 1e-12 * size;
    pruneEight(cell.tape, whole_.positions, whole_.values, centres, radius, shorter);

    auto parts = std::make_unique<TapeCell::Parts>();
    std::size_t kept = 0;
    for (int part = 0; part < kPointLanes; ++part) {
        const std::size_t length = shorter.of(part).size();
        kept += length < cell.tape.size() ? length : 0;
    }
    parts->picks = std::make_unique_for_overwrite<Pick[]>(kept);
    Pick* next = parts->picks.get();
    const std::uint32_t first = cells_.fetch_add(kPointLanes, std::memory_order_relaxed);
    for (int part = 0; part < kPointLanes; ++part) {
        TapeCell& inner = parts->cell[part];
        inner.centre_world = centreOf(cell, part), inner.half = 0.5 * cell.half;
        inner.around = &cell, inner.index = first + static_cast<std::uint32_t>(part);
        inner.level = static_cast<std::uint8_t>(cell.level + 1);
        inner.tape = cell.tape;
        const std::span<const Pick> picks = shorter.of(part);
        const std::size_t length = picks.size();
        if (length < cell.tape.size()) {
            inner.tape.picks = next, inner.tape.count = length;
            next = std::copy(picks.begin(), picks.end(), next);
        }
        const bool gains = static_cast<double>(length) < kGain * static_cast<double>(cell.tape.size());
        const bool far_out = inner.level < kOuterLevels;
        inner.without_gain = gains || far_out ? 0 : static_cast<std::uint8_t>(cell.without_gain + 1);
        inner.being_cut = length < kShortCellTape;
    }
    cell.parts.store(parts.release(), std::memory_order_release);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    PruneCounts made{kPointLanes, kPointLanes * cell.tape.size(), kept, took.count()};
    counts += made;
    made_ += made.tapes, run_ += made.instructions, kept_ += made.kept;
    nanoseconds_ += static_cast<std::uint64_t>(took.count() * 1e9);
}

PruneCounts CellTapes::counts() const {
    return {made_, run_, kept_, 1e-9 * static_cast<double>(nanoseconds_)};
}

}  // namespace edgewise::sdf
