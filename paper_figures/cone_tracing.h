// What the cone-tracing page measures: Chubarau et al. 2023 and what goes past it, on scenes of our own.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "paper_figures/figure.h"
#include "paper_figures/picture_row.h"
#include "pipeline/judge/edge_kinds.h"

namespace edgewise::figures {

using judge::EdgeKind, judge::kEdgeKinds;

/// dB over the pixels of a mask, linear Rec.709, peak 1; none where it is empty or the error is 0.
using Psnr = std::optional<double>;

struct EdgePsnr {
    Psnr all;  ///< over every edge pixel
    std::map<EdgeKind, Psnr> by_kind;
    Psnr of(EdgeKind kind) const {
        const auto found = by_kind.find(kind);
        return found == by_kind.end() ? Psnr() : found->second;
    }
};

/// Of one method on one scene. `seconds`: the median of turns, without set-up.
struct ConeRun {
    std::string method;
    double seconds = 0.0;
    EdgePsnr psnr;
    std::map<std::string, std::uint64_t> counts;
    std::optional<double> published;  ///< Table 1: the ratio at 1280x720, on a scene of that kind
    /// Of all pixels; ctss-x counts them.
    double shareOf(const std::string& count) const {
        const auto found = counts.find(count), all = counts.find("pixels");
        if (found == counts.end() || all == counts.end() || all->second == 0) return 0.0;
        return static_cast<double>(found->second) / static_cast<double>(all->second);
    }
};

struct ConeScene {
    std::string name;
    bool of_paper = false;  ///< one of the five that Table 1 has
    int width = 0, height = 0, timed_width = 0, timed_height = 0;
    std::map<EdgeKind, std::uint64_t> pixels;  ///< of each kind
    EdgePsnr plain_reference;                  ///< of ssaa:K with as many samples as the reference has
    EdgePsnr reference;  ///< of the reference against a finer one, on the middle quarter of the picture
    std::vector<ConeRun> runs;  ///< the first is none
    const ConeRun& run(const std::string& method) const;
    double ratioOf(const std::string& method) const { return run(method).seconds / runs.front().seconds; }
};

/// A number that the paper states or implies beside ours.
struct ConeClaim {
    std::string claim, ours, paper, bar;
    std::optional<bool> met;  ///< of the bar
};

struct ConeTracing {
    bool quick = false;
    int runs = 1;
    int reference_side = 0, finer_side = 0, facts_side = 0;  ///< samples a pixel along each axis
    double seconds = 0.0;                                    ///< that all of it took
    std::vector<ConeScene> scenes;
    std::vector<PictureRow> pictures;
};

std::vector<ConeClaim> claimsOf(const ConeTracing& found);

std::string coneTracingHtml(const ConeTracing& found);
std::string coneTracingJson(const ConeTracing& found);

}  // namespace edgewise::figures
