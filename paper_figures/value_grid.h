// Values of two names, a shaded rectangle each, as one <svg> that stands by itself.
#pragma once

#include <string>
#include <vector>

namespace edgewise::figures {

struct GridCell {
    std::string text;    ///< empty: nothing is there
    double shade = 0.0;  ///< 0 pale, 1 dark
    bool alarm = false;  ///< red
};

struct ValueGrid {
    std::string label;  ///< for those who do not see it
    std::vector<std::string> rows, columns;
    std::vector<GridCell> cells;  ///< row by row
};

std::string valueGridSvg(const ValueGrid& grid);

}  // namespace edgewise::figures
