#include "paper_figures/nsaa_patterns.h"

#include <fmt/format.h>

#include <cmath>

#include "paper_figures/figure_plot.h"
#include "paper_figures/line_plot.h"
#include "paper_figures/page_parts.h"
#include "pipeline/load_scene.h"
#include "pipeline/plot_colors.h"
#include "pipeline/scene_catalog.h"

namespace edgewise::figures {
namespace {

constexpr int kSide = 1024;  ///< px, the paper's

double rmseOf(const std::optional<judge::ErrorMetrics>& error) {
    return error ? error->rmse : 0.0;
}

/// Errors of the samplers by their samples a pixel.
FigurePlot errorPlot(const PatternPictures& found) {
    struct Sampler {
        const char* method;
        double samples;
    };
    constexpr Sampler kMsaa[]{{"none", 1}, {"msaa:2", 2}, {"msaa:4", 4}, {"msaa:8", 8}, {"msaa:16", 16}};
    LinePlot plot{"Error by samples a pixel",
                  {0.9, 40.0, 0.0, "samples a pixel", true},
                  {1e-3, 1.0, 0.0, "RMSE, linear RGB", true},
                  {},
                  {}};
    const auto add = [&](const char* name, std::size_t color, bool own) {
        PlotCurve msaa{fmt::format("msaa, {}", name), kPlotColors[color], own, false, {}, {}};
        for (const Sampler& s : kMsaa) {
            const PatternRow& row = found.row(s.method);
            msaa.line.emplace_back(s.samples, rmseOf(own ? row.of_own : row.of_paper));
        }
        msaa.dots = msaa.line;
        plot.curves.push_back(msaa);
        const PatternRow &csaa = found.row("csaa:32"), &smaa = found.row("smaa");
        plot.curves.push_back({fmt::format("csaa:32, {}", name),
                               kPlotColors[color + 2],
                               false,
                               own,
                               {},
                               {{32.0, rmseOf(own ? csaa.of_own : csaa.of_paper)}}});
        plot.curves.push_back({fmt::format("smaa, {}", name),
                               kPlotColors[color + 4],
                               false,
                               own,
                               {},
                               {{1.0, rmseOf(own ? smaa.of_own : smaa.of_paper)}}});
    };
    add("Gaussian", 0, false);
    add("own box", 1, true);
    return {
        "errors",
        "Against nsaa with the paper's Gaussian, and against nsaa with the box that the sampler stands for: "
        "the second one is sampling's error alone.",
        linePlotSvg(plot)};
}

/// How much the rings of a rim still differ: the deviation of luminance between two radii, near an axis and
/// near a diagonal. What samples miss of one place they show of another, so aliasing does not enter it.
struct RimContrast {
    double axis = 0.0, diagonal = 0.0;
};
RimContrast rimContrastOf(const ImageBuffer& image) {
    constexpr double kInner = 440.0, kOuter = 500.0, kSector = 0.1;  ///< px, px, radians
    double sums[2]{}, squares[2]{}, counts[2]{};
    for (int y = image.box.y0; y < image.box.y1; ++y)
        for (int x = image.box.x0; x < image.box.x1; ++x) {
            const double dx = std::abs(x + 0.5 - 0.5 * kSide), dy = std::abs(y + 0.5 - 0.5 * kSide);
            const double r = std::hypot(dx, dy), angle = std::atan2(std::min(dx, dy), std::max(dx, dy));
            if (r < kInner || r > kOuter) continue;
            const int sector = angle < kSector ? 0 : angle > 0.25 * M_PI - kSector ? 1 : -1;
            if (sector < 0) continue;
            const double value = image.rgba[image.index(x, y)].g;  // the pattern is grey
            sums[sector] += value, squares[sector] += value * value, counts[sector] += 1.0;
        }
    const auto deviation = [&](int i) {
        const double mean = sums[i] / counts[i];
        return std::sqrt(std::max(0.0, squares[i] / counts[i] - mean * mean));
    };
    return {deviation(0), deviation(1)};
}

void addAnisotropy(const PatternPictures& found, std::vector<FigureClaim>& claims) {
    for (const char* filter : {"gaussian", "box"}) {
        const RimContrast rim = rimContrastOf(found.row("nsaa", filter).image);
        claims.push_back(
            {"section 4.1",
             fmt::format("contrast of the rim on the diagonal over that on an axis, nsaa, {}", filter),
             filter == std::string("gaussian") ? "no anisotropy (1)" : "",
             fmt::format("{:.4f} ({:.4f} over {:.4f})", rim.diagonal / rim.axis, rim.diagonal, rim.axis), "",
             filter == std::string("gaussian")
                 ? ""
                 : "beside it: a square's response depends on the direction; the paper has no such row"});
    }
}

struct PatternFigure {
    const char *name, *title, *number, *caption;
};

std::vector<FigureFile> patternFigure(const PatternFigure& figure, PatternPlan plan,
                                      const FigureInput& input) {
    plan.methods = paperMethods();
    const PatternPictures found = makePatternPictures(plan, input.progress);
    const std::vector<FigurePlot> plots{errorPlot(found)};
    const std::size_t triangles = loadScene(findScene(plan.scene)).triangle_count;
    input.claims.push_back({figure.number, "triangles of the pattern", "up to 20000",
                            fmt::format("{}", triangles), "",
                            "the pattern's recipe is not published, ours is in data/MANIFEST.md"});
    for (const char* method : {"msaa:16", "csaa:32", "smaa"})
        input.claims.push_back(
            {figure.number, fmt::format("{} diverges from nsaa, {}", method, plan.scene),
             "visible undersampling",
             fmt::format("RMSE {:.4f} (own box: {:.4f})", rmseOf(found.row(method).of_paper),
                         rmseOf(found.row(method).of_own)),
             "", "the paper shows pictures and gives no number"});
    if (plan.scene == "zone-plate" && !input.quick) addAnisotropy(found, input.claims);
    FigureWords words{figure.name,
                      figure.title,
                      figure.caption,
                      {{"size", fmt::format("{}x{}, of which {}x{} here", plan.width, plan.height,
                                            plan.crop.width(), plan.crop.height())},
                       {"nsaa's filter", "gaussian, R 2, sigma R/3 (not published: ours)"},
                       {"samplers' filter", "their own box of a pixel"},
                       {"device", "cpu"},
                       {"seed", "none: no method of these draws lots"}},
                      {},
                      input.quick};
    for (const PatternMethod& method : plan.methods) words.commands.push_back(commandOf(plan, method));
    std::vector<FigureFile> files{
        {"report.html", figurePage(words, pictureRowsHtml(found.pictures) + "<h2>Errors</h2>" +
                                              patternTable(found) + plotsHtml(plots))},
        {"results.csv", patternCsv(found)}};
    appendPlotFiles(plots, files);
    appendPictureFiles(found.pictures, files);
    return files;
}

}  // namespace

PatternPlan zonePlatePlan(bool quick) {
    return {"zone-plate",
            kSide,
            kSide,
            quick ? PixelBox{830, 190, 926, 318} : PixelBox{0, 0, kSide, kSide},
            {{"rim", "The rim between axis and diagonal", {838, 248, 902, 312}},
             {"diagonal", "The rim on the diagonal", {830, 130, 894, 194}}},
            {},
            4};
}

PatternPlan logGridPlan(bool quick) {
    return {"log-grid",
            kSide,
            kSide,
            quick ? PixelBox{832, 832, 960, 960} : PixelBox{0, 0, kSide, kSide},
            {{"fine", "The finest cells", {880, 880, 944, 944}},
             {"narrow", "Narrow cells", {944, 480, 1008, 544}}},
            {},
            4};
}

std::vector<PatternMethod> paperMethods() {
    return {{"none", "", {}, "none: a sample a pixel"},
            {"msaa:2", "", {}, "msaa:2"},
            {"msaa:4", "", {}, "msaa:4"},
            {"msaa:8", "", {}, "msaa:8"},
            {"msaa:16", "", {}, "msaa:16"},
            {"csaa:32", "", {}, "csaa:32"},
            {"smaa", "", {}, "smaa"},
            {"nsaa", "gaussian", 2.0, "nsaa, gaussian R 2"},
            {"nsaa", "box", 0.5, "nsaa, box of a pixel"}};
}

std::vector<FigureFile> makeNsaaZonePlate(const FigureInput& input) {
    return patternFigure({"nsaa-4", "The zone plate", "Figure 4",
                          "After NSAA's Figure 4: concentric rings, ever narrower towards the rim. What "
                          "samplers show between the "
                          "rings is not there. The paper colours the pattern by a texture, as ours; 125 "
                          "rings is our number. Its "
                          "patterns are named after the standards' (MSAA 1 to 4); 16 samples are ours. "
                          "CSAA's 24 positions were "
                          "never published: ours are documented and replaceable."},
                         zonePlatePlan(input.quick), input);
}

std::vector<FigureFile> makeNsaaLogGrid(const FigureInput& input) {
    return patternFigure(
        {"nsaa-5", "The log grid", "Figure 5",
         "After NSAA's Figure 5: black and white cells between lines at logarithms, for straight "
         "edges. Methods are those of Figure 4."},
        logGridPlan(input.quick), input);
}

}  // namespace edgewise::figures
