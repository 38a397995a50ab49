#include "analytic/layer_stacks.h"

#include <algorithm>
#include <utility>

namespace edgewise {
namespace {

std::uint64_t hashOf(std::span<const Owner> layers) {
    std::uint64_t h = layers.size();
    for (const Owner layer : layers) {
        h = (h ^ layer) * 0x9e3779b97f4a7c15ull;
        h ^= h >> 29;
    }
    return h;
}

}  // namespace

Owner LayerStacks::owner(std::span<const Owner> layers) {
    if (layers.size() == 1) return layers.front();
    const std::uint64_t hash = hashOf(layers);
    const auto [begin, end] = by_hash_.equal_range(hash);
    for (auto known = begin; known != end; ++known)
        if (std::ranges::equal(this->layers(known->second), layers)) return known->second;
    const auto fresh = static_cast<Owner>(kFirstStack + size());
    layers_.insert(layers_.end(), layers.begin(), layers.end());
    first_.push_back(static_cast<std::uint32_t>(layers_.size()));
    by_hash_.emplace(hash, fresh);
    return fresh;
}

LayerStacks LayerStacks::joined(std::span<const LayerStacks* const> parts,
                                std::vector<std::vector<Owner>>& names) {
    std::vector<std::pair<std::size_t, Owner>> all;
    names.assign(parts.size(), {});
    for (std::size_t p = 0; p < parts.size(); ++p) {
        names[p].resize(parts[p]->size());
        for (std::size_t i = 0; i < parts[p]->size(); ++i)
            all.emplace_back(p, static_cast<Owner>(kFirstStack + i));
    }
    std::ranges::sort(all, [&](const auto& a, const auto& b) {
        return std::ranges::lexicographical_compare(parts[a.first]->layers(a.second),
                                                    parts[b.first]->layers(b.second));
    });
    LayerStacks table;
    for (const auto& [p, stack] : all) names[p][stack - kFirstStack] = table.owner(parts[p]->layers(stack));
    return table;
}

}  // namespace edgewise
