// The colours of a plot's series, in turn.
#pragma once

#include <array>

namespace edgewise {

inline constexpr std::array kPlotColors{"#1b6ca8", "#c8553d", "#3a7d44", "#7d4e9e", "#b08900", "#4a4a4a",
                                        "#17909c", "#d1498b", "#7a9a01", "#8b5a2b", "#5f7fd1", "#e07b39"};

}  // namespace edgewise
