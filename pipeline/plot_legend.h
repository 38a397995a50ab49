// Room for the names beside a plot.
#pragma once

#include <cstddef>

namespace edgewise {

/// Of a name in 12 px sans-serif, in px, and some to spare: DejaVu Sans takes 6.8 px a letter of
/// `nsaa:device=vulkan`. A name of wide letters alone is longer.
constexpr double nameWidth(std::size_t letters) {
    return 8.0 * static_cast<double>(letters);
}

}  // namespace edgewise
