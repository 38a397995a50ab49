// Curves over linear or logarithmic axes, as one <svg> that stands by itself.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace edgewise::figures {

struct PlotCurve {
    std::string name, color;
    bool dashed = false, hollow = false;
    std::vector<glm::dvec2> line;  ///< by ascending x; what is below the plot runs along its floor
    std::vector<glm::dvec2> dots;  ///< left out where they lie outside
};

struct PlotAxis {
    double low, high, step;  ///< a label each step
    std::string title;
    bool logarithmic = false;  ///< labels at 1, 2, 5 times powers of ten; low > 0, `step` counts for nothing
};

struct PlotMark {
    double x;
    std::string label;
};

struct LinePlot {
    std::string label;  ///< for those who do not see it
    PlotAxis x, y;
    std::vector<PlotMark> marks;  ///< vertical lines
    std::vector<PlotCurve> curves;
};

/// A curve and its line of the legend are one <g data-series='NAME'>, so that a page can hide them.
std::string linePlotSvg(const LinePlot& plot);

}  // namespace edgewise::figures
