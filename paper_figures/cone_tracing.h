// What the cone-tracing page measures: error against run time of the methods for SDF scenes, by kinds of
// edges, beside what Chubarau et al. 2023 state and what is asked of ours.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "paper_figures/figure.h"
#include "paper_figures/figure_plot.h"
#include "paper_figures/picture_row.h"
#include "pipeline/compare/comparison.h"

namespace edgewise::figures {

using judge::EdgeKind, judge::kEdgeKinds;

/// dB over the pixels of a kind, linear Rec.709, peak 1; none where there are none or the error is 0.
using Psnr = std::optional<double>;

/// A scene by every method, as compare has it.
struct ConeScene {
    compare::Comparison judged;       ///< pictures, by kinds of edges, and times at their size
    std::vector<compare::Row> timed;  ///< at the aims' size and device; empty: `judged` stands for them
    const std::string& name() const { return judged.scene; }
    bool ofPaper() const;  ///< one of the five that Table 1 has

    const compare::Row* row(const std::string& method) const;  ///< of `judged`; null for one that has none
    /// kNone: over all edges.
    judge::KindError errorOf(const std::string& method, EdgeKind kind) const;
    Psnr psnrOf(const std::string& method, EdgeKind kind) const { return errorOf(method, kind).psnr(); }
    /// Median, without set-up, at the aims' size; none where it did not run.
    std::optional<double> secondsOf(const std::string& method) const;
    std::optional<double> ratioOf(const std::string& method, const std::string& to = "none") const;
    /// A count of the method's over all pixels.
    double shareOf(const std::string& method, const std::string& count) const;
    std::uint64_t pixelsOf(EdgeKind kind) const;
};

/// Table 1's ratio at 1280x720 on a scene of that kind.
std::optional<double> publishedRatio(const std::string& scene, const std::string& method);

/// A number that the paper states or implies beside ours, and what is asked of ours.
struct ConeClaim {
    std::string claim, ours, paper, bar;
    std::optional<double> margin;  ///< over what is asked, as much better; below 0: missed by that
    std::string unit;              ///< of the margin
    std::optional<bool> met() const { return margin ? std::optional(*margin >= 0.0) : std::nullopt; }
};

struct ConeTracing {
    bool quick = false;
    int runs = 1;
    std::string timed_on;  ///< in words
    double seconds = 0.0;  ///< that all of it took
    std::vector<ConeScene> scenes;
    std::vector<PictureRow> pictures;
    std::vector<std::string> notes;  ///< what could not be measured, one sentence each
};

std::vector<ConeClaim> claimsOf(const ConeTracing& found);

/// Error against time: over scenes for each kind of edge, then each scene.
std::vector<FigurePlot> coneTracingPlots(const ConeTracing& found);
std::string coneTracingHtml(const ConeTracing& found, const std::vector<FigurePlot>& plots);
std::string coneTracingJson(const ConeTracing& found);
/// A line a scene and method.
std::string coneTracingCsv(const ConeTracing& found);

}  // namespace edgewise::figures
