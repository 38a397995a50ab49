// What nsaa costs beside samplers, how that grows, and where the time goes.
#include "paper_figures/performance.h"

#include <fmt/format.h>

#include "paper_figures/performance_measure.h"
#include "pipeline/scoped_path.h"

namespace edgewise::figures {
namespace {

constexpr const char* kFreeType = "its bar is FreeType's time: edgewise_bench, peer/freetype";

PerformanceScene boxed(const std::string& name, int width, int height, const std::string& remark = "") {
    return {name, name, "box", 0.5, width, height, "rt:4", "rt:1", remark};
}

PerformanceScene smooth(const std::string& name, int side) {
    return {name, name + ", Gaussian R 2", "gaussian", 2.0, side, side, "rt:16", "rt:4", ""};
}

PerformanceEffort fullEffort() {
    PerformanceEffort effort;
    effort.triad_doubles = std::size_t{1} << 23;
    constexpr int kSide = 1024;
    for (const char* name : {"torus-20k", "torus-200k", "torus-1m", "random-2k", "random-20k", "random-200k",
                             "engine", "torus-sequence"})
        effort.scenes.push_back(boxed(name, kSide, name == std::string("torus-sequence") ? 512 : kSide,
                                      name == std::string("torus-sequence") ? "textured" : ""));
    for (const char* name : {"zone-plate", "log-grid"})
        effort.scenes.push_back(boxed(name, kSide, kSide, kFreeType));
    effort.scenes.push_back(smooth("torus-200k", kSide));
    effort.methods = {"nsaa",
                      "rt:1",
                      "rt:4",
                      "rt:16",
                      "none",
                      "ssaa:2",
                      "ssaa:4",
                      "msaa:4",
                      "smaa",
                      "fxaa",
                      "nsaa,device=vulkan",
                      "ssaa:4,device=vulkan"};
    effort.growth_methods = {"nsaa", "rt:4"};
    effort.triangles = {2000, 6320, 20000, 63200, 200000, 632000, 2000000};
    effort.side = kSide;
    effort.sides = {512, 1024, 2048, 4096, 8192};
    effort.resolution_scenes = {"torus-200k", "random-20k"};
    return effort;
}

PerformanceEffort quickEffort() {
    PerformanceEffort effort;
    constexpr int kSide = 128;
    effort.runs = 1;
    effort.triad_doubles = std::size_t{1} << 20;
    effort.scenes = {boxed("random-2k", kSide, kSide), smooth("random-2k", kSide)};
    effort.methods = {"nsaa", "rt:1", "rt:4", "rt:16"};
    effort.growth_methods = {"nsaa"};
    effort.triangles = {250, 1000, 4000};
    effort.side = kSide;
    effort.sides = {32, 64, 128};
    effort.resolution_scenes = {"random-2k"};
    return effort;
}

}  // namespace

std::vector<FigureFile> makePerformance(const FigureInput& input) {
    const ScopedPath scratch = temporaryFolder();
    Performance found =
        measurePerformance(input.quick ? quickEffort() : fullEffort(), scratch.path(), input.progress);
    found.quick = input.quick;
    const auto plots = performancePlots(found);
    std::vector<FigureFile> files{{"report.html", performanceHtml(found, plots)},
                                  {"results.json", performanceJson(found)},
                                  {"results.csv", performanceCsv(found)},
                                  {"bars.csv", barsCsv(found)},
                                  {"growth.csv", growthCsv(found)},
                                  {"stages.csv", stagesCsv(found)},
                                  {"table.tex", barsLatex(found)}};
    appendPlotFiles(plots, files);
    return files;
}

}  // namespace edgewise::figures
