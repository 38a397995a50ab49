// How a cost grows: the exponent of a power law through measured points.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>

namespace edgewise::figures {

/// y = factor x^exponent by least squares of log y over log x.
struct PowerFit {
    double exponent = 0.0, factor = 0.0;
    std::optional<double> standard_error;  ///< of the exponent, from the residuals; of three points or more
    double least_local = 0.0, most_local = 0.0;  ///< exponents between neighbouring points

    double at(double x) const;
};

/// Points by ascending x, all above 0. None for fewer than two of different x.
std::optional<PowerFit> fitPower(std::span<const glm::dvec2> points);

}  // namespace edgewise::figures
