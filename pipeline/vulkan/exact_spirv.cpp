#include "pipeline/vulkan/exact_spirv.h"

#include <algorithm>
#include <array>
#include <set>

namespace edgewise::vulkan {
namespace {

// Numbers of the SPIR-V specification.
constexpr std::size_t kHeaderWords = 5;
constexpr std::uint32_t kOpDecorate = 71, kOpTypeVoid = 19, kOpTypeForwardPointer = 39;
constexpr std::uint32_t kNoContraction = 42;
/// FNegate, FAdd, FSub, FMul, FDiv, FRem, FMod, VectorTimesScalar, Dot.
constexpr std::array<std::uint32_t, 9> kArithmetic = {127, 129, 131, 133, 136, 140, 141, 142, 148};

bool isArithmetic(std::uint32_t op) {
    return std::ranges::find(kArithmetic, op) != kArithmetic.end();
}

/// Decorations stand before the first type.
bool opensAnnotations(std::uint32_t op) {
    return (op >= kOpDecorate && op <= kOpDecorate + 3) || (op >= kOpTypeVoid && op <= kOpTypeForwardPointer);
}

}  // namespace

std::vector<std::uint32_t> withExactArithmetic(std::span<const std::uint32_t> module) {
    std::size_t insert_at = 0;
    std::set<std::uint32_t> marked, results;
    for (std::size_t at = kHeaderWords; at < module.size(); at += module[at] >> 16) {
        const std::uint32_t op = module[at] & 0xffffu;
        if (insert_at == 0 && opensAnnotations(op)) insert_at = at;
        if (op == kOpDecorate && module[at + 2] == kNoContraction) marked.insert(module[at + 1]);
        if (isArithmetic(op)) results.insert(module[at + 2]);
    }
    std::vector<std::uint32_t> exact(module.begin(), module.end());
    std::vector<std::uint32_t> decorations;
    for (const std::uint32_t result : results)
        if (!marked.contains(result))
            decorations.insert(decorations.end(), {(3u << 16) | kOpDecorate, result, kNoContraction});
    exact.insert(exact.begin() + static_cast<std::ptrdiff_t>(insert_at), decorations.begin(),
                 decorations.end());
    return exact;
}

}  // namespace edgewise::vulkan
