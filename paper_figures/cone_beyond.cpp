// ctss-x against CTSS: the same scenes, edges of each kind side by side.
#include <fmt/format.h>

#include <map>
#include <optional>

#include "paper_figures/edge_parts_plot.h"
#include "paper_figures/figure_plot.h"
#include "paper_figures/page_parts.h"
#include "pipeline/html_table.h"
#include "pipeline/html_text.h"

namespace edgewise::figures {
namespace {

struct Effort {
    std::vector<std::string> scenes{"primitives", "random-box", "random-shape", "sparse-shape",
                                    "atrium",     "slabs",      "wires",        "thin"};
    int width = 320, height = 180, reference_side = 16, facts_side = 8;
    glm::ivec2 part{40, 28};
};

const std::vector<std::string> kMethods{"none", "ctss", "ctss-x", "ssaa:2"};

using Psnr = std::optional<double>;

/// kNone: over all edges.
judge::KindError errorOf(const judge::KindErrors& errors, EdgeKind kind) {
    return kind == EdgeKind::kNone ? errors.edges() : errors.of(kind);
}
constexpr EdgeKind kShown[]{EdgeKind::kNone,    EdgeKind::kContour, EdgeKind::kInternal,
                            EdgeKind::kTexture, EdgeKind::kShadow,  EdgeKind::kReflection};

FigurePlot plotOf(const MethodViews& views, const Effort& effort) {
    return {
        views.name,
        fmt::format("{}: the whole by ctss-x, and where each kind of edge is best seen. Errors are {:.0f} "
                    "times as bright; dB: PSNR of the part.",
                    views.name, kErrorGain),
        edgePartsSvg(views, edgeParts(views, effort.part), "ctss-x",
                     {{"none", "none"},
                      {"ctss", "ctss"},
                      {"ctss-x", "ctss-x"},
                      {"reference", "reference"},
                      {"ctss", "error of ctss", true},
                      {"ctss-x", "error of ctss-x", true}})};
}

/// A scene's kinds with each method's error.
struct Found {
    std::string scene;
    std::map<std::string, judge::KindErrors> errors;
    std::map<std::string, double> seconds;
};

std::string gainCell(const Psnr& better, const Psnr& worse) {
    if (!better || !worse) return emptyCell();
    const double gain = *better - *worse;
    return gain < 0.0 ? sortedCell(gain, fmt::format("<span class='bad'>{:+.2f}</span>", gain))
                      : numberCell(gain, "{:+.2f}");
}

std::string kindsTable(const std::vector<Found>& all) {
    std::string rows;
    for (const Found& found : all)
        for (const EdgeKind kind : kShown) {
            const auto psnr = [&](const std::string& method) {
                return errorOf(found.errors.at(method), kind).psnr();
            };
            const std::uint64_t pixels = errorOf(found.errors.at("none"), kind).pixels;
            if (pixels == 0) continue;
            rows += fmt::format("<tr><td>{}</td><td>{}</td>", found.scene,
                                kind == EdgeKind::kNone ? "all edges" : judge::nameOf(kind)) +
                    numberCell(static_cast<double>(pixels), "{:.0f}");
            for (const std::string& method : kMethods) rows += numberCell(psnr(method), "{:.2f}");
            rows +=
                gainCell(psnr("ctss-x"), psnr("ctss")) + gainCell(psnr("ctss-x"), psnr("ssaa:2")) + "</tr>\n";
        }
    std::string heads = "<th>scene</th><th>edges</th><th>pixels</th>";
    for (const std::string& method : kMethods) heads += fmt::format("<th>{}, dB</th>", escapedHtml(method));
    return cardTable(heads + "<th>ctss-x over ctss</th><th>ctss-x over ssaa:2</th>", rows);
}

std::string kindsCsv(const std::vector<Found>& all) {
    std::string out = "scene,method,seconds,edges,pixels,rmse,psnr\n";
    for (const Found& found : all)
        for (const std::string& method : kMethods)
            for (const EdgeKind kind : kShown) {
                const judge::KindError error = errorOf(found.errors.at(method), kind);
                const Psnr psnr = error.psnr();
                out += fmt::format("{},{},{},{},{},{},{}\n", found.scene, method, found.seconds.at(method),
                                   kind == EdgeKind::kNone ? "all" : judge::nameOf(kind), error.pixels,
                                   error.rmse(), psnr ? fmt::format("{}", *psnr) : "");
            }
    return out;
}

Found factsOf(const MethodViews& views) {
    Found found{views.name, {}, {}};
    for (const std::string& method : kMethods)
        found.errors[method] = views.errorsOf(method), found.seconds[method] = views.made.at(method).seconds;
    return found;
}

FigureWords wordsOf(const Effort& effort, bool quick) {
    std::string scenes;
    for (const std::string& scene : effort.scenes) scenes += (scenes.empty() ? "" : ", ") + scene;
    return {"cone-beyond",
            "ctss-x against CTSS",
            "CTSS finds surfaces that cover a part of a pixel's cone: contours. Internal edges, patterns, "
            "borders of shadows and of what is mirrored lie within one hit group (Chubarau et al. 2023, "
            "section 5.2, Figure 10). ctss-x divides pixels by such lines. Where it has less than ctss or "
            "ssaa:2, the table is red.",
            {{"scenes", scenes},
             {"size", fmt::format("{}x{}, box filter, CPU", effort.width, effort.height)},
             {"parts", fmt::format("{}x{} pixels, where a kind is most alone", effort.part.x, effort.part.y)},
             {"reference", fmt::format("ssaa:{}; cone-tracing states its own error", effort.reference_side)},
             {"kinds", fmt::format("by {0} x {0} rays a pixel", effort.facts_side)},
             {"seed", "0"}},
            {fmt::format("edgewise compare SCENE -o DIR --size {}x{} --filter box --device cpu --method none "
                         "--method ctss --method ctss-x --method ssaa:2",
                         effort.width, effort.height)},
            quick};
}

}  // namespace

std::vector<FigureFile> makeConeBeyond(const FigureInput& input) {
    Effort effort;
    if (input.quick) effort = {{"primitives", "slabs"}, 96, 54, 4, 4, {20, 14}};
    input.progress.stage("ctss-x against CTSS", effort.scenes.size());
    std::vector<FigurePlot> plots;
    std::vector<Found> found;
    std::string body;
    for (const std::string& scene : effort.scenes) {
        MethodViews views(scene, effort.width, effort.height, effort.reference_side, effort.facts_side,
                          input.progress);
        for (const std::string& method : kMethods) views.make(method, input.progress);
        plots.push_back(plotOf(views, effort));
        found.push_back(factsOf(views));
        body += fmt::format("<h2>{}</h2><div style='max-width:1240px'>", scene) +
                plotsHtml({&plots.back(), 1}) + "</div>\n";
        input.progress.advance(1);
    }
    std::vector<FigureFile> files{
        {"report.html", figurePage(wordsOf(effort, input.quick),
                                   "<h2>PSNR by kinds of edges</h2>" + kindsTable(found) + body)},
        {"results.csv", kindsCsv(found)}};
    appendPlotFiles(plots, files);
    return files;
}

}  // namespace edgewise::figures
