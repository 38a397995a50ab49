#include "pipeline/compare/error_slope.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace edgewise::compare {
namespace {

/// Samples a pixel and the error, as logarithms.
struct LogPoint {
    double samples, error;
};

/// None for methods that take no number.
std::optional<int> numberOf(const Row& row) {
    const auto number = row.parameters.find("number");
    if (number == row.parameters.end() || !number->is_number_integer()) return std::nullopt;
    return number->get<int>();
}

double samplesOf(const Row& row) {
    const double number = numberOf(row).value();
    return row.method.starts_with("ssaa") ? number * number : number;
}

using LogPoints = std::vector<LogPoint>;

constexpr std::size_t kFewestRows = 3;

/// None for too few points.
std::optional<double> fitted(const LogPoints& points) {
    if (points.size() < kFewestRows) return {};
    LogPoint mean{0.0, 0.0};
    for (const LogPoint& p : points) mean.samples += p.samples, mean.error += p.error;
    const auto n = static_cast<double>(points.size());
    mean.samples /= n, mean.error /= n;
    double along = 0.0, square = 0.0;
    for (const LogPoint& p : points) {
        along += (p.samples - mean.samples) * (p.error - mean.error);
        square += (p.samples - mean.samples) * (p.samples - mean.samples);
    }
    return along / square;
}

/// A family's errors over all pixels, over the edge pixels, and over those with few edges.
struct Family {
    LogPoints all, edges, few_edges;

    void add(const Row& row) {
        const auto point = [&](LogPoints& points, const std::optional<double>& error) {
            if (error && *error > 0.0) points.push_back({std::log(samplesOf(row)), std::log(*error)});
        };
        point(all, row.error->rmse);
        point(edges, row.error->edge_rmse);
        if (row.few_edges) point(few_edges, row.few_edges->rmse);
    }
};

}  // namespace

std::string familyOf(const Row& row) {
    const std::optional<int> number = numberOf(row);
    if (!number) return row.method;
    const std::string typed = fmt::format(":{}", *number);
    const std::size_t at = row.method.find(typed);
    if (at == std::string::npos) return row.method;
    return row.method.substr(0, at) + ":N" + row.method.substr(at + typed.size());
}

std::vector<ErrorSlope> errorSlopes(const std::vector<Row>& rows) {
    std::map<std::string, Family> families;
    for (const Row& row : rows)
        if (numberOf(row) && row.error) families[familyOf(row)].add(row);
    std::vector<ErrorSlope> slopes;
    for (const auto& [name, family] : families) {
        const std::optional<double> slope = fitted(family.all);
        if (!slope) continue;
        const auto [least, most] = std::ranges::minmax(family.all, {}, &LogPoint::samples);
        slopes.push_back({name, *slope, fitted(family.edges), fitted(family.few_edges),
                          std::exp(least.samples), std::exp(most.samples), family.all.size()});
    }
    return slopes;
}

}  // namespace edgewise::compare
