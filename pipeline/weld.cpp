#include "pipeline/weld.h"

#include <array>
#include <atomic>

#include "pipeline/runs.h"

namespace edgewise {

PointTable::PointTable(ZeroedVector<glm::dvec3> all)
    : ids_(all.size()), slots_(std::bit_ceil(all.size() * 2 + 16)) {
    findFirsts(all);
    const auto first = [&](std::size_t i) { return slots_[ids_[i]] == i + 1; };
    const std::vector<std::size_t> before = countedBefore(all.size(), first);
    points_.resize(before.back()), first_places_.resize(before.back());
    forRuns(all.size(), [&](std::size_t run, std::size_t begin, std::size_t end) {
        std::size_t id = before[run];
        for (std::size_t i = begin; i < end; ++i)
            if (first(i)) points_[id] = all[i] + 0.0, first_places_[id++] = static_cast<std::uint32_t>(i);
    });
    // From places to ids. No two ids have a slot in common.
    forRuns(points_.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t id = begin; id < end; ++id)
            slots_[ids_[first_places_[id]]] = static_cast<std::uint32_t>(id + 1);
    });
    forRuns(all.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ids_[i] = slots_[ids_[i]] - 1;
    });
}

/// Each point's slot into ids_, the first place of its point into the slot.
void PointTable::findFirsts(std::span<const glm::dvec3> all) {
    constexpr std::size_t kAhead =
        16;  // slots are fetched before they are needed: few of them are in a cache
    forRuns(all.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        std::array<std::size_t, kAhead> homes{};
        for (std::size_t i = begin; i < end + kAhead; ++i) {
            std::size_t& slot = homes[i % kAhead];
            if (i >= begin + kAhead)
                ids_[i - kAhead] = placed(all, static_cast<std::uint32_t>(i - kAhead), slot);
            if (i >= end) continue;
            slot = home(all[i]);
            __builtin_prefetch(&slots_[slot], 1);
        }
    });
}

/// The slot of a place whose search begins at `slot`. A slot once taken keeps its point, so that the order in
/// which threads come does not show.
std::uint32_t PointTable::placed(std::span<const glm::dvec3> all, std::uint32_t place, std::size_t slot) {
    for (;; slot = (slot + 1) & (slots_.size() - 1)) {
        std::atomic_ref<std::uint32_t> at(slots_[slot]);
        std::uint32_t held = at.load(std::memory_order_relaxed);
        const bool free = held == 0 && at.compare_exchange_strong(held, place + 1, std::memory_order_relaxed);
        if (!free && all[held - 1] != all[place]) continue;
        while (!free && place + 1 < held &&
               !at.compare_exchange_weak(held, place + 1, std::memory_order_relaxed)) {
        }
        return static_cast<std::uint32_t>(slot);
    }
}

std::uint32_t PointTable::id(const glm::dvec3& p) {
    if (points_.size() * 2 >= slots_.size()) grow();
    std::size_t slot = home(p);
    for (; slots_[slot] != 0; slot = (slot + 1) & (slots_.size() - 1))
        if (points_[slots_[slot] - 1] == p) return slots_[slot] - 1;
    points_.push_back(p + 0.0);
    slots_[slot] = static_cast<std::uint32_t>(points_.size());
    return slots_[slot] - 1;
}

std::size_t PointTable::home(const glm::dvec3& point) const {
    const glm::dvec3 p = point + 0.0;  // -0 becomes +0
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(p[axis])) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return hash & (slots_.size() - 1);
}

void PointTable::grow() {
    slots_ = ZeroedVector<std::uint32_t>(slots_.size() * 2);
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
        std::size_t slot = home(points_[i]);
        while (slots_[slot] != 0) slot = (slot + 1) & (slots_.size() - 1);
        slots_[slot] = i + 1;
    }
}

}  // namespace edgewise
