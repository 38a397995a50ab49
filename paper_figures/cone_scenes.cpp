// Cone-traced supersampling, Figures 1, 5 and 10, laid out as there, on scenes of ours.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "paper_figures/edge_parts_plot.h"
#include "paper_figures/figure_plot.h"
#include "paper_figures/page_parts.h"
#include "pipeline/html_table.h"

namespace edgewise::figures {
namespace {

constexpr double kPartWidth = PanelGrid().width, kPartHeight = PanelGrid().height, kGap = PanelGrid::kGap,
                 kWords = PanelGrid::kWords;

struct Effort {
    int width = 640, height = 360, reference_side = 8, facts_side = 4;
    glm::ivec2 part{40, 28};
};

const std::vector<std::string> kLimitMethods{"none", "ssaa:2", "ctss", "ctss-r", "ctss-x"};

MethodViews viewsOf(const std::string& scene, const Effort& effort, Progress& progress) {
    return {scene, effort.width, effort.height, effort.reference_side, effort.facts_side, progress};
}

double rmseOf(const MethodViews& views, const std::string& method, EdgeKind kind) {
    return views.errorsOf(method).of(kind).rmse();
}

constexpr double kSeen = 0.1;  ///< a difference in linear RGB that eyes find in an enlarged part

/// The contours where a sample a pixel errs visibly; the rest counts as nothing.
std::vector<EdgeKind> visibleContours(const MethodViews& views) {
    std::vector<EdgeKind> kinds = views.kinds;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        const glm::dvec3 d(views.of("none").rgba[i] - views.of("reference").rgba[i]);
        if (glm::length(d) < kSeen || kinds[i] != EdgeKind::kContour) kinds[i] = EdgeKind::kNone;
    }
    return kinds;
}

/// Figure 1.
FigurePlot firstPlot(const MethodViews& views, const Effort& effort) {
    constexpr double kWhole = 620;
    Drawing drawing(kWhole + 3 * (kPartWidth + kGap) + 20, 380, "One scene without and with antialiasing");
    const std::vector<EdgeKind> kinds = visibleContours(views);
    std::vector<PixelBox> boxes;
    for (int i = 0; i < 2; ++i)
        boxes.push_back(partOfKind(kinds, views.view.film, EdgeKind::kContour, effort.part, boxes));
    drawWhole(views, "ctss", {{10, 12}, {kWhole, kWhole * effort.height / effort.width}},
              {{boxes[0], "#d7263d"}, {boxes[1], "#e0a100"}}, drawing);
    int column = 0;
    for (const auto& [method, name] : {std::pair("none", "no AA"), {"ssaa:2", "4x SSAA"}, {"ctss", "CTSS"}}) {
        for (int row = 0; row < 2; ++row)
            PanelGrid{kWhole + 24, 12}
                .at(column, row)
                .draw(partOf(views.of(method), boxes[static_cast<std::size_t>(row)]), name,
                      row == 0 ? "#d7263d" : "#e0a100", drawing);
        drawing.text(PanelGrid{kWhole + 24, 12}.at(column, 2).corner + glm::dvec2(kPartWidth / 2, 16),
                     fmt::format("{:.0f} ms, {:.2f} of no AA", 1e3 * views.made.at(method).seconds,
                                 views.made.at(method).seconds / views.made.at("none").seconds),
                     "text-anchor='middle' font-size='11'");
        ++column;
    }
    return {"figure-1",
            "Figure 1. Left: the whole scene by ctss. Right: two parts, enlarged, with the time that each "
            "picture "
            "took.",
            drawing.svg()};
}

/// Figure 5.
FigurePlot weightsPlot(const MethodViews& views, const PixelBox& box) {
    Drawing drawing(3 * (kPartWidth + kGap) + 30, 2 * (kPartHeight + kWords) + 30, "Weights of samples");
    const auto part = [&](const char* method, const char* words, int column, int row) {
        PanelGrid{10, 20}.at(column, row).draw(partOf(views.of(method), box), words, "#777", drawing);
    };
    part("none", "(a) no antialiasing", 0, 0);
    part("ctss:weights=uniform", "(b) U, 1 pixel", 1, 0);
    part("ctss", "(c) W, 1 pixel", 2, 0);
    part("reference", "what there is", 0, 1);
    part("ctss:weights=uniform,coverage=5", "(d) U, 5 pixels", 1, 1);
    part("ctss:coverage=5", "(e) W, 5 pixels", 2, 1);
    return {"figure-5",
            "Figure 5. U: samples weigh alike, and the outline is extruded with its steps. W: by what each "
            "is seen "
            "to cover. 5 pixels: cones that wide.",
            drawing.svg()};
}

/// Beyond Figure 5: masks and backtracing, which the paper shows in words.
FigurePlot settingsPlot(const MethodViews& views, const PixelBox& box) {
    Drawing drawing(4 * (kPartWidth + kGap) + 30, 2 * (kPartHeight + kWords) + 30, "Masks and backtracing");
    int column = 0;
    for (const auto& [method, words] : {std::pair("ctss:weights=uniform", "uniform"),
                                        {"ctss", "6x6, backtraced"},
                                        {"ctss:mask=4x8", "4x8, backtraced"},
                                        {"ctss:backtrace=off", "6x6, not backtraced"}}) {
        const ImageBuffer part = partOf(views.of(method), box);
        PanelGrid{10, 20}.at(column, 0).draw(part, words, "#777", drawing);
        PanelGrid{10, 20}.at(column, 1).draw(
            difference(part, partOf(views.of("reference"), box), kErrorGain),
            fmt::format("RMSE {:.4f} on contours", rmseOf(views, method, EdgeKind::kContour)), "#777",
            drawing);
        ++column;
    }
    return {
        "settings",
        fmt::format(
            "The same part by weights, masks and backtracing; below, errors {:.0f} times as large. RMSE: of "
            "all contours of the picture.",
            kErrorGain),
        drawing.svg()};
}

/// Figure 10.
FigurePlot limitsPlot(const MethodViews& views, const Effort& effort) {
    return {"figure-10",
            "Figure 10. Red: contours, which CTSS mends. Blue: internal edges, green: textures, yellow: "
            "shadows, violet: highlights and what is mirrored, which it does not.",
            edgePartsSvg(
                views, edgeParts(views, effort.part), "ctss",
                {{"none", "no AA"}, {"ctss", "CTSS"}, {"ctss-x", "ctss-x"}, {"reference", "reference"}})};
}

/// Each over the whole width, as large as drawn.
std::string alone(const std::vector<FigurePlot>& plots) {
    std::string out;
    for (const FigurePlot& plot : plots)
        out += "<div style='max-width:1160px'>" + plotsHtml({&plot, 1}) + "</div>\n";
    return out;
}

std::string kindsTable(const MethodViews& views) {
    std::string rows;
    for (const EdgeKind kind : kEdgeKinds) {
        rows += fmt::format("<tr><td>{}</td>", judge::nameOf(kind)) +
                numberCell(static_cast<double>(views.pixelsOf(kind)), "{:.0f}");
        for (const std::string& method : kLimitMethods)
            rows += numberCell(rmseOf(views, method, kind), "{:.4f}");
        rows += "</tr>\n";
    }
    std::string heads = "<th>edges</th><th>pixels</th>";
    for (const std::string& method : kLimitMethods) heads += "<th>RMSE of " + method + "</th>";
    return cardTable(heads, rows);
}

std::string kindsCsv(const MethodViews& views) {
    std::string out = "edges,pixels,method,rmse\n";
    for (const EdgeKind kind : kEdgeKinds)
        for (const std::string& method : kLimitMethods)
            out += fmt::format("{},{},{},{}\n", judge::nameOf(kind), views.pixelsOf(kind), method,
                               rmseOf(views, method, kind));
    return out;
}

void addClaims(const MethodViews& first, const MethodViews& limits, std::vector<FigureClaim>& claims) {
    const auto ratio = [&](const char* method) {
        return fmt::format("{:.2f}", first.made.at(method).seconds / first.made.at("none").seconds);
    };
    const char* why = "one run of a scene of ours on a CPU; the figure cone-table has medians";
    claims.push_back({"Figure 1", "time of CTSS over no antialiasing", "1.3", ratio("ctss"), "", why});
    claims.push_back({"Figure 1", "time of 4xSSAA over no antialiasing", "4", ratio("ssaa:2"), "", why});
    const auto left = [&](EdgeKind kind) {
        const double of = rmseOf(limits, "none", kind);
        return of == 0.0 ? std::string("none") : fmt::format("{:.2f}", rmseOf(limits, "ctss", kind) / of);
    };
    claims.push_back({"Figure 10", "error that CTSS leaves of no antialiasing's, external edges", "mended",
                      left(EdgeKind::kContour), "", "the paper shows pictures alone"});
    claims.push_back(
        {"Figure 10", "the same, internal edges, textures, shadows", "not antialiased",
         left(EdgeKind::kInternal) + ", " + left(EdgeKind::kTexture) + ", " + left(EdgeKind::kShadow), "",
         "the paper shows pictures alone; below 1 where an edge of another kind shares the pixel"});
}

}  // namespace

std::vector<FigureFile> makeConeScenes(const FigureInput& input) {
    Effort effort;
    if (input.quick) effort = {128, 72, 4, 2, {20, 14}};
    input.progress.stage("Figures 1, 5 and 10", 3);
    MethodViews first = viewsOf(input.quick ? "primitives" : "atrium", effort, input.progress);
    for (const char* method : {"none", "ssaa:2", "ctss"}) first.make(method, input.progress);
    input.progress.advance(1);
    MethodViews limits = viewsOf("primitives", effort, input.progress);
    for (const std::string& method : kLimitMethods) limits.make(method, input.progress);
    input.progress.advance(1);
    for (const char* method : {"ctss:weights=uniform", "ctss:weights=uniform,coverage=5", "ctss:coverage=5",
                               "ctss:mask=4x8", "ctss:backtrace=off"})
        limits.make(method, input.progress);
    const PixelBox box = partOfKind(limits.kinds, limits.view.film, EdgeKind::kContour, effort.part, {});
    input.progress.advance(1);
    addClaims(first, limits, input.claims);
    const std::vector<FigurePlot> plots{firstPlot(first, effort), weightsPlot(limits, box),
                                        settingsPlot(limits, box), limitsPlot(limits, effort)};
    const FigureWords words{
        "cone-scenes",
        "Cone tracing: Figures 1, 5 and 10",
        "After Chubarau et al. 2023, on scenes of ours, for theirs are not published: an interior in the "
        "place of "
        "their Sponza, and one of every shape. Parts are chosen by what lies between a pixel's samples: "
        "depths "
        "that leap, surfaces that turn, patterns, light.",
        {{"scenes", input.quick ? "primitives" : "atrium, primitives"},
         {"size", fmt::format("{}x{}", effort.width, effort.height)},
         {"parts", fmt::format("{}x{} pixels", effort.part.x, effort.part.y)},
         {"reference", fmt::format("{0} x {0} samples a pixel, box filter", effort.reference_side)},
         {"seed", "0"}},
        {fmt::format(
            "edgewise render primitives --size {}x{} --method ctss:weights=uniform,coverage=5 --filter box "
            "--device cpu -o uniform_5.png",
            effort.width, effort.height)},
        input.quick};
    std::vector<FigureFile> files{
        {"report.html", figurePage(words, alone(plots) + "<h2>By kinds of edges</h2>" + kindsTable(limits))},
        {"results.csv", kindsCsv(limits)}};
    appendPlotFiles(plots, files);
    return files;
}

}  // namespace edgewise::figures
