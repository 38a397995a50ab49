#include "pipeline/weld.h"

#include <atomic>

#include "pipeline/runs.h"

namespace edgewise {

PointTable::PointTable(std::vector<glm::dvec3> all)
    : ids_(all.size()), slots_(std::bit_ceil(all.size() * 2 + 16), kFree) {
    findFirsts(all);
    const auto first = [&](std::size_t i) { return slots_[ids_[i]] == i; };
    const std::vector<std::size_t> before = countedBefore(all.size(), first);
    points_.resize(before.back()), first_places_.resize(before.back());
    forRuns(all.size(), [&](std::size_t run, std::size_t begin, std::size_t end) {
        std::size_t id = before[run];
        for (std::size_t i = begin; i < end; ++i)
            if (first(i)) points_[id] = all[i] + 0.0, first_places_[id++] = static_cast<std::uint32_t>(i);
    });
    // From places to ids.
    std::vector<std::uint32_t> slot_of(points_.size());
    forRuns(points_.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t id = begin; id < end; ++id) slot_of[id] = ids_[first_places_[id]];
    });
    forRuns(points_.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t id = begin; id < end; ++id) slots_[slot_of[id]] = static_cast<std::uint32_t>(id);
    });
    forRuns(all.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ids_[i] = slots_[ids_[i]];
    });
}

/// Each point's slot into ids_, the first place of its point into the slot. A slot once taken keeps its
/// point, so that the order in which threads come does not show.
void PointTable::findFirsts(const std::vector<glm::dvec3>& all) {
    forRuns(all.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto place = static_cast<std::uint32_t>(i);
            for (std::size_t slot = home(all[i]);; slot = (slot + 1) & (slots_.size() - 1)) {
                std::atomic_ref<std::uint32_t> at(slots_[slot]);
                std::uint32_t held = at.load(std::memory_order_relaxed);
                if (held == kFree && at.compare_exchange_strong(held, place, std::memory_order_relaxed))
                    held = place;
                if (held != place && all[held] != all[i]) continue;
                while (place < held && !at.compare_exchange_weak(held, place, std::memory_order_relaxed)) {
                }
                ids_[i] = static_cast<std::uint32_t>(slot);
                break;
            }
        }
    });
}

std::uint32_t PointTable::id(const glm::dvec3& p) {
    if (points_.size() * 2 >= slots_.size()) grow();
    std::size_t slot = home(p);
    for (; slots_[slot] != kFree; slot = (slot + 1) & (slots_.size() - 1))
        if (points_[slots_[slot]] == p) return slots_[slot];
    slots_[slot] = static_cast<std::uint32_t>(points_.size());
    points_.push_back(p + 0.0);
    return slots_[slot];
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
    slots_.assign(slots_.size() * 2, kFree);
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
        std::size_t slot = home(points_[i]);
        while (slots_[slot] != kFree) slot = (slot + 1) & (slots_.size() - 1);
        slots_[slot] = i;
    }
}

}  // namespace edgewise
