// How fast a sampler's error falls with its samples.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/compare/comparison.h"

namespace edgewise::compare {

/// A method's name without its number: ssaa:2 and ssaa:4 are of the family ssaa:N.
std::string familyOf(const Row& row);

struct ErrorSlope {
    std::string family;
    double slope = 0.0;  ///< d log RMSE / d log samples, least squares over the family's rows
    std::optional<double> edge_slope, few_edges_slope;  ///< the same of edge RMSE, of Row::few_edges
    double least = 0.0, most = 0.0;                     ///< samples a pixel; of ssaa:K they are K^2
    std::size_t rows = 0;
};

/// Of every family of three rows or more that have an error above 0.
std::vector<ErrorSlope> errorSlopes(const std::vector<Row>& rows);

}  // namespace edgewise::compare
