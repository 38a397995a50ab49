// Chubarau et al. 2023, Table 1: five scenes, two sizes, times and their ratios.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "paper_figures/figure_plot.h"

namespace edgewise::figures {

inline constexpr std::array<const char*, 4> kTableMethods{"none", "ssaa:2", "ctss", "ctss-r"};

/// One scene at one size.
struct ConeTableRow {
    std::string scene;
    int width = 0, height = 0;
    std::array<double, 4> seconds{};  ///< medians, by method
    std::array<double, 4> paper{};    ///< the paper's ratios, by method
    double ratio(std::size_t method) const { return seconds[method] / seconds[0]; }
};

/// What the paper measured itself, as seconds and as ratios, under the names of our scenes.
std::vector<ConeTableRow> paperTable();

/// The mean over rows, as the paper's last column has it.
double meanRatio(const std::vector<ConeTableRow>& rows, std::size_t method);
double meanPaper(const std::vector<ConeTableRow>& rows, std::size_t method);

FigurePlot coneTablePlot(const std::vector<ConeTableRow>& rows);
std::string coneTableCsv(const std::vector<ConeTableRow>& rows);

}  // namespace edgewise::figures
