// Shares of a whole, a bar each, as one <svg> that stands by itself.
#pragma once

#include <string>
#include <vector>

namespace edgewise::figures {

struct StackedBar {
    std::string name;
    std::vector<double> parts;  ///< one a part's name, in any unit, not negative
    std::string note;           ///< behind the bar
};

struct StackedBars {
    std::string label;               ///< for those who do not see it
    std::vector<std::string> parts;  ///< their names
    std::vector<StackedBar> bars;
};

/// Every bar as long as every other: percent of its sum.
std::string stackedBarsSvg(const StackedBars& plot);

}  // namespace edgewise::figures
