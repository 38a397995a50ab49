#include "pipeline/compare/error_slope.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace edgewise::compare {
namespace {

/// Samples a pixel and the error, as logarithms.
struct LogPoint {
    double samples, error;
};

double samplesOf(const Row& row) {
    const double number = std::stod(row.parameters.at("number"));
    return row.method.starts_with("ssaa") ? number * number : number;
}

ErrorSlope fitted(const std::string& family, const std::vector<LogPoint>& points) {
    LogPoint mean{0.0, 0.0};
    for (const LogPoint& p : points) mean.samples += p.samples, mean.error += p.error;
    const auto n = static_cast<double>(points.size());
    mean.samples /= n, mean.error /= n;
    double along = 0.0, square = 0.0;
    for (const LogPoint& p : points) {
        along += (p.samples - mean.samples) * (p.error - mean.error);
        square += (p.samples - mean.samples) * (p.samples - mean.samples);
    }
    const auto [least, most] = std::ranges::minmax(points, {}, &LogPoint::samples);
    return {family, along / square, std::exp(least.samples), std::exp(most.samples), points.size()};
}

}  // namespace

std::string familyOf(const Row& row) {
    const auto number = row.parameters.find("number");
    if (number == row.parameters.end()) return row.method;
    const std::size_t at = row.method.find(":" + number->second);
    if (at == std::string::npos) return row.method;
    return row.method.substr(0, at) + ":N" + row.method.substr(at + 1 + number->second.size());
}

std::vector<ErrorSlope> errorSlopes(const std::vector<Row>& rows) {
    std::map<std::string, std::vector<LogPoint>> families;
    for (const Row& row : rows)
        if (row.parameters.contains("number") && row.error && row.error->rmse > 0.0)
            families[familyOf(row)].push_back({std::log(samplesOf(row)), std::log(row.error->rmse)});
    std::vector<ErrorSlope> slopes;
    for (const auto& [family, points] : families)
        if (points.size() >= 3) slopes.push_back(fitted(family, points));
    return slopes;
}

}  // namespace edgewise::compare
