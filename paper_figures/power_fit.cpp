#include "paper_figures/power_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace edgewise::figures {

double PowerFit::at(double x) const {
    return factor * std::pow(x, exponent);
}

std::optional<PowerFit> fitPower(std::span<const glm::dvec2> points) {
    std::vector<glm::dvec2> logs;
    glm::dvec2 mean(0.0);
    for (const glm::dvec2& p : points) {
        logs.emplace_back(std::log(p.x), std::log(p.y));
        mean += logs.back();
    }
    const auto n = static_cast<double>(logs.size());
    mean /= n;
    double square = 0.0, along = 0.0;
    for (const glm::dvec2& p : logs) {
        square += (p.x - mean.x) * (p.x - mean.x);
        along += (p.x - mean.x) * (p.y - mean.y);
    }
    if (!(square > 0.0)) return {};
    PowerFit fit;
    fit.exponent = along / square;
    fit.factor = std::exp(mean.y - fit.exponent * mean.x);
    double residuals = 0.0;
    fit.least_local = std::numeric_limits<double>::infinity(), fit.most_local = -fit.least_local;
    for (std::size_t i = 0; i < logs.size(); ++i) {
        const double residual = logs[i].y - mean.y - fit.exponent * (logs[i].x - mean.x);
        residuals += residual * residual;
        if (i == 0 || !(logs[i].x > logs[i - 1].x)) continue;
        const double local = (logs[i].y - logs[i - 1].y) / (logs[i].x - logs[i - 1].x);
        fit.least_local = std::min(fit.least_local, local);
        fit.most_local = std::max(fit.most_local, local);
    }
    if (logs.size() > 2) fit.standard_error = std::sqrt(residuals / (n - 2) / square);
    return fit;
}

}  // namespace edgewise::figures
