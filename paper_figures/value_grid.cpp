#include "paper_figures/value_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "paper_figures/drawing.h"
#include "pipeline/plot_legend.h"

namespace edgewise::figures {
namespace {

constexpr double kLeastCellWidth = 82, kCellHeight = 22, kLeastLeft = 150, kTop = 26, kMargin = 10;
constexpr double kGap = 8;           ///< between a row's name and its cells
constexpr double kLeastWidth = 760;  ///< that texts are as large as in other plots
constexpr double kLightText = 0.6;   ///< from this shade on

std::string fillOf(const GridCell& cell) {
    if (cell.alarm) return "#d7263d";
    const double part = std::clamp(cell.shade, 0.0, 1.0);
    const auto mixed = [&](int to) { return std::lround(247.0 + part * (to - 247)); };
    return fmt::format("#{:02x}{:02x}{:02x}", mixed(20), mixed(80), mixed(150));
}

}  // namespace

std::string valueGridSvg(const ValueGrid& grid) {
    const double left = std::max(kLeastLeft, widthOfLongest(grid.rows, 0) + kGap),
                 cell_width = std::max(kLeastCellWidth, widthOfLongest(grid.columns, 0));
    const auto cornerOf = [&](std::size_t row, std::size_t column) {
        return glm::dvec2(left + cell_width * static_cast<double>(column),
                          kTop + kCellHeight * static_cast<double>(row));
    };
    const glm::dvec2 end = cornerOf(grid.rows.size(), grid.columns.size());
    Drawing drawing(std::max(end.x + kMargin, kLeastWidth), end.y + kMargin, grid.label);
    for (std::size_t i = 0; i < grid.columns.size(); ++i)
        drawing.text(cornerOf(0, i) + glm::dvec2(cell_width / 2, -8), grid.columns[i],
                     "text-anchor='middle' font-size='11'");
    for (std::size_t j = 0; j < grid.rows.size(); ++j) {
        drawing.text(cornerOf(j, 0) + glm::dvec2(-kGap, 15), grid.rows[j],
                     "text-anchor='end' font-size='12'");
        for (std::size_t i = 0; i < grid.columns.size(); ++i) {
            const GridCell& cell = grid.cells.at(j * grid.columns.size() + i);
            if (cell.text.empty()) continue;
            drawing.rectangle(cornerOf(j, i), {cell_width - 1, kCellHeight - 1},
                              fmt::format("fill='{}'", fillOf(cell)));
            drawing.text(cornerOf(j, i) + glm::dvec2(cell_width / 2, 15), cell.text,
                         fmt::format("text-anchor='middle' font-size='11' fill='{}'",
                                     cell.alarm || cell.shade > kLightText ? "#fff" : "#222"));
        }
    }
    return drawing.svg();
}

}  // namespace edgewise::figures
