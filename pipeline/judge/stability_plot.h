// A log-log plot of errors against a condition, with the bound that was promised, as SVG.
#pragma once

#include <string>
#include <vector>

namespace edgewise::judge {

struct PlotPoint {
    double x, error, bound;
};

struct PlotSeries {
    std::string name, color;
    std::vector<PlotPoint> points;  ///< by ascending x
};

/// Decades from `low` to `high`.
struct PlotAxis {
    int low, high;
};

/// The decades that all points span; errors of 0 do not count: they lie on the floor.
PlotAxis xAxisOf(const std::vector<PlotSeries>& series);
PlotAxis errorAxisOf(const std::vector<PlotSeries>& series);

struct PlotFrame {
    std::string x_title, y_title, label;  ///< plain text; the label is for those who do not see the plot
    PlotAxis x, y;
};

/// One <svg>: a line with dots a series, its bound dashed in the same colour, hollow dots for errors of 0.
std::string plotSvg(const PlotFrame& frame, const std::vector<PlotSeries>& series);

}  // namespace edgewise::judge
