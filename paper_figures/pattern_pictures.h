// One scene by several methods and filters, side by side: whole pictures, parts of them enlarged, and errors.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "paper_figures/figure.h"
#include "paper_figures/picture_row.h"
#include "pipeline/judge/metrics.h"
#include "pipeline/methods/method.h"

namespace edgewise::figures {

struct PatternMethod {
    std::string method, filter;
    std::optional<double> radius;  ///< of the filter; none: its default
    std::string caption;
};

struct PatternPart {
    std::string name, words;
    PixelBox box;
};

struct PatternPlan {
    std::string scene;
    int width = 0, height = 0;
    PixelBox crop;  ///< what is made; parts that do not lie in it are left out
    std::vector<PatternPart> parts;
    std::vector<PatternMethod> methods;
    int enlarged = 4;
};

struct PatternRow {
    PatternMethod method;
    double radius = 0.0;  ///< px
    ImageBuffer image;
    std::optional<judge::ErrorMetrics>
        of_paper;                               ///< against nsaa, Gaussian of radius 2; none where it is that
    std::optional<judge::ErrorMetrics> of_own;  ///< against nsaa with the same filter; none where it is that
};

struct PatternPictures {
    PatternPlan plan;
    std::vector<PatternRow> rows;  ///< one a method, in the plan's order
    std::vector<PictureRow> pictures;
    const PatternRow& row(const std::string& method, const std::string& filter = "") const;
};

/// Throws Interrupted when cancelled, what methods throw.
PatternPictures makePatternPictures(const PatternPlan& plan, Progress& progress);

std::string patternTable(const PatternPictures& found);
std::string patternCsv(const PatternPictures& found);
/// What shows a method's picture again.
std::string commandOf(const PatternPlan& plan, const PatternMethod& method);

}  // namespace edgewise::figures
