// Room for the names in and beside a plot.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

namespace edgewise {

/// Of a name in 12 px sans-serif, in px, and some to spare: DejaVu Sans takes 6.8 px a letter of
/// `nsaa:device=vulkan`. A name of wide letters alone is longer.
constexpr double nameWidth(std::size_t letters) {
    return 8.0 * static_cast<double>(letters);
}

/// For the longest of names, `name` being the member or function of an item that gives its own; at least for
/// one of `least` letters.
template <class Items, class Name = std::identity>
double widthOfLongest(const Items& items, std::size_t least, Name name = {}) {
    for (const auto& item : items) least = std::max(least, std::invoke(name, item).size());
    return nameWidth(least);
}

}  // namespace edgewise
