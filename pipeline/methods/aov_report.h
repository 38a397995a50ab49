// What a method says of its AOVs.
#pragma once

#include <fmt/format.h>

#include "pipeline/aov.h"
#include "pipeline/methods/method.h"

namespace edgewise {

/// A Cryptomatte that lacks something is counted and noted.
inline void reportAovs(const AovPass& aov, MethodResult& result) {
    const std::uint64_t pixels = aov.truncatedPixels();
    if (pixels == 0) return;
    result.counts["cryptomatte_truncated_pixels"] = pixels;
    result.notes.push_back(
        fmt::format("cryptomatte: some pixels hold more than {} names of a layer, of which "
                    "the smallest coverages are left out",
                    kCryptomatteRanks));
}

}  // namespace edgewise
