// A figure or table: what it is called, and the code that makes its files.
#pragma once

#include <string>
#include <vector>

#include "pipeline/progress.h"

namespace edgewise::figures {

/// A number that a paper states, and ours beside it.
struct FigureClaim {
    std::string place;        ///< in the paper: "section 4.3"
    std::string claim;        ///< what is told
    std::string paper, ours;  ///< numbers, or words where the paper has none; empty: none
    std::string unit;
    std::string why;  ///< they differ
};

struct FigureInput {
    bool quick = false;  ///< a small version in seconds
    Progress& progress;
    std::vector<FigureClaim>& claims;  ///< the figure adds its own
};

struct FigureFile {
    std::string name;  ///< of a file in the figure's folder; the first one is the page that shows the figure
    std::string bytes;
};

struct Figure {
    std::string name;    ///< as typed
    std::string source;  ///< which paper's, or "ours"
    std::string what;    ///< one line
    /// Everything in memory: what fails leaves nothing half-written. The command that shows it again is
    /// "edgewise figure NAME -o DIR". Throws Interrupted when cancelled, FailureError and InputError.
    std::vector<FigureFile> (*make)(const FigureInput& input);
};

/// In the order in which they are listed; a new figure adds one line in registry.cpp.
const std::vector<Figure>& figureRegistry();

std::vector<FigureFile> makeFilterStudy(const FigureInput& input);
std::vector<FigureFile> makePerformance(const FigureInput& input);
std::vector<FigureFile> makeSphereTracing(const FigureInput& input);
std::vector<FigureFile> makeConeTracing(const FigureInput& input);
std::vector<FigureFile> makeConeBeyond(const FigureInput& input);
std::vector<FigureFile> makeNsaaPixel(const FigureInput& input);
std::vector<FigureFile> makeNsaaStages(const FigureInput& input);
std::vector<FigureFile> makeNsaaGather(const FigureInput& input);
std::vector<FigureFile> makeNsaaZonePlate(const FigureInput& input);
std::vector<FigureFile> makeNsaaLogGrid(const FigureInput& input);
std::vector<FigureFile> makeNsaaFilters(const FigureInput& input);
std::vector<FigureFile> makeNsaaTori(const FigureInput& input);
std::vector<FigureFile> makeNsaaTimes(const FigureInput& input);
std::vector<FigureFile> makeSphereDrawn(const FigureInput& input);
std::vector<FigureFile> makeSphereScenes(const FigureInput& input);
std::vector<FigureFile> makeLottes(const FigureInput& input);
std::vector<FigureFile> makeConeDrawn(const FigureInput& input);
std::vector<FigureFile> makeErrorTime(const FigureInput& input);
std::vector<FigureFile> makeSharedGeometry(const FigureInput& input);
std::vector<FigureFile> makeStability(const FigureInput& input);
std::vector<FigureFile> makePlanner(const FigureInput& input);
std::vector<FigureFile> makeConeScenes(const FigureInput& input);
std::vector<FigureFile> makeConeTable(const FigureInput& input);

}  // namespace edgewise::figures
