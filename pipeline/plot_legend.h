// Room for the names beside a plot.
#pragma once

#include <cstddef>

namespace edgewise {

/// Of a name in 12 px sans-serif, in px. Sans-serifs differ: the widest usual one takes 7.3 px a letter in
/// the mean of methods' names.
constexpr double nameWidth(std::size_t letters) {
    return 8.0 * static_cast<double>(letters);
}

}  // namespace edgewise
