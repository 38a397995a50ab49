// What the filter study finds, and the forms in which it shows it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "analytic/filter_properties.h"
#include "paper_figures/figure.h"
#include "paper_figures/figure_plot.h"

namespace edgewise::figures {

/// An edge or a grating along one direction: the formulas, and beside them what nsaa makes of a slanted edge.
struct AlongDirection {
    double angle = 0.0;  ///< of the slanted edge's normal, radians; all of this is at that angle
    EdgeEnergy edge;
    double overshoot = 0.0, width_px = 0.0, half_response = 0.0;
    double at_nyquist = 0.0;                 ///< the transform at kNyquist
    double step_residual = 0.0;              ///< max |nsaa's weight - step response|
    double response_residual = 0.0;          ///< max |measured - transform| up to kShownFrequency
    double residual_of_bound = 0.0;          ///< the same, each over responseBound()
    std::vector<double> response, measured;  ///< at kShownFrequency i / kShownSteps
    std::vector<double> step;                ///< at kShownReach (2 i / kShownSteps - 1)
};

inline constexpr double kShownFrequency = 2.0;  ///< cycles/px
inline constexpr double kShownReach = 3.0;      ///< px
inline constexpr int kShownSteps = 400;

/// One pattern under one filter.
struct PatternRow {
    double rms = 0.0, share = 0.0;  ///< of what aliases, as in AliasedPart
};

struct FilterRow {
    Prefilter filter;
    bool paper_radius = false;  ///< Figure 6's, which all filters share; else the contract's default
    AlongDirection axis, diagonal;
    EdgeEnergy mean_edge;
    double negative_area = 0.0, second_moment_px2 = 0.0;
    double anisotropy = 0.0;  ///< max |W^(f, axis) - W^(f, diagonal)| for f <= kNyquist
    std::vector<PatternRow> patterns;
};

struct StudyPicture {
    std::string pattern, name;  ///< name: of a filter, or of a method beside it
    std::string file, aliased_file;
    std::vector<unsigned char> png, aliased_png;
    std::optional<double> rms;  ///< of what aliases
};

struct FilterStudy {
    bool quick = false;
    std::vector<std::string> patterns;
    int per_px = 1;   ///< samples a pixel and axis behind the aliased parts
    int part_px = 0;  ///< side of the parts that are shown and measured
    std::vector<FilterRow> rows;
    std::vector<StudyPicture> pictures;
};

/// "mitchell, R 2"
std::string titleOf(const Prefilter& filter);

/// Every filter has one colour on the whole page, at any radius.
std::string colorOf(const FilterStudy& study, const Prefilter& filter);

std::vector<FigurePlot> filterFigurePlots(const FilterStudy& study);

std::string filterStudyJson(const FilterStudy& study);
std::string filterStudyCsv(const FilterStudy& study);
/// filter, radius, frequency and both directions, formula and measured.
std::string responseCsv(const FilterStudy& study);
std::string stepCsv(const FilterStudy& study);
std::string filterStudyLatex(const FilterStudy& study);

std::string filterStudyHtml(const FilterStudy& study, const std::vector<FigurePlot>& plots);

}  // namespace edgewise::figures
