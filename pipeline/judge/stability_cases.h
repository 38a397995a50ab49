// The stiff and extreme cases of the stability study, each swept over its difficulty.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analytic/prefilter.h"
#include "analytic/screen_triangle.h"
#include "pipeline/judge/projection_witness.h"

namespace edgewise::judge {

/// One scene, and the pixel at which it is hard.
struct StiffScene {
    ScreenScene scene;
    glm::ivec2 pixel{0};
    std::optional<ProjectionErrors> projection;  ///< of scenes that a camera made
};

/// A family of scenes over one number. `make` is the same for the same difficulty, filter and seed on every
/// machine.
struct StabilityCase {
    std::string name;
    std::string what;       ///< one line: what is hard about it
    std::string condition;  ///< what the difficulty is, with its unit
    std::vector<double> difficulties;
    std::function<StiffScene(double difficulty, const Prefilter& filter, std::uint64_t seed)> make;
    /// Cases that are about the filter itself sweep it, none where it cannot be so; otherwise the study's
    /// filter is taken as it is.
    std::function<std::optional<Prefilter>(double difficulty, const Prefilter& filter)> filter = {};
};

const std::vector<StabilityCase>& stabilityCases();

}  // namespace edgewise::judge
