// Runs what the performance page shows: worker processes by turns, as compare does.
#pragma once

#include <filesystem>

#include "paper_figures/performance.h"

namespace edgewise::figures {

struct PerformanceEffort {
    int runs = 5;
    double budget_seconds = 15.0;  ///< a method and scene
    std::size_t triad_doubles = 0;
    std::vector<PerformanceScene> scenes;
    std::vector<std::string> methods;
    std::vector<std::string> growth_methods;
    std::vector<std::uint32_t> triangles;  ///< at `side`^2 px
    int side = 0;
    std::vector<int> sides;  ///< px, of the scenes that follow
    std::vector<std::string> resolution_scenes;
};

/// Methods that this build has not, and rows that failed, are notes. `scratch` holds pictures and scenes for
/// a while. Throws Interrupted when cancelled.
Performance measurePerformance(const PerformanceEffort& effort, const std::filesystem::path& scratch,
                               Progress& progress);

}  // namespace edgewise::figures
