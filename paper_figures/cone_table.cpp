#include "paper_figures/cone_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "paper_figures/cone_view.h"
#include "paper_figures/page_parts.h"
#include "paper_figures/value_grid.h"
#include "pipeline/compare/comparison.h"
#include "pipeline/html_table.h"
#include "pipeline/methods/stopwatch.h"

namespace edgewise::figures {
namespace {

constexpr std::array<const char*, 4> kPaperNames{"No AA", "4x SS", "CTSS", "CTSS-R"};

/// The paper's milliseconds at 1280x720 and 2560x1440; its Sponza is beside our atrium.
struct PaperScene {
    const char* name;
    std::array<std::array<double, 4>, 2> milliseconds;
};
constexpr std::array<PaperScene, 5> kPaper{
    {{"primitives", {{{4.67, 20.82, 6.08, 5.15}, {17.1, 66.25, 20.38, 17.98}}}},
     {"random-box", {{{7.07, 29.47, 9.72, 9.12}, {25.14, 103.5, 34.78, 32.41}}}},
     {"random-shape", {{{14.59, 61.16, 19.21, 17.92}, {47.58, 192.2, 59.73, 57.24}}}},
     {"atrium", {{{6.62, 28.38, 9.04, 6.96}, {25.82, 106.42, 31.96, 27.78}}}},
     {"sparse-shape", {{{8.67, 36.82, 11.08, 10.02}, {23.67, 96.82, 31.08, 28.02}}}}}};

struct Effort {
    std::size_t scenes = kPaper.size();
    std::array<glm::ivec2, 2> sizes{{{1280, 720}, {2560, 1440}}};
    int runs = 3;
    double budget_seconds = 60.0;  ///< a row's counted turns: none begins past it but the first
};

/// By turns, after one that does not count.
ConeTableRow measureRow(const PaperScene& scene, std::size_t size, const Effort& effort, Progress& progress) {
    const ConeView view(scene.name, effort.sizes[size].x, effort.sizes[size].y);
    ConeTableRow row{scene.name, view.film.width, view.film.height, {}, {}};
    std::array<std::vector<double>, 4> seconds;
    double spent = 0.0;
    for (int run = -1; run < effort.runs && spent < effort.budget_seconds; ++run)
        for (std::size_t m = 0; m < kTableMethods.size(); ++m) {
            if (run < 0 && m > 0) continue;  // the scene and the threads are warm
            Stopwatch watch;
            const MethodResult made = view.made(kTableMethods[m], progress);
            if (run < 0) continue;
            seconds[m].push_back(watch.lap() - made.setup_seconds);
            spent += seconds[m].back();
        }
    for (std::size_t m = 0; m < kTableMethods.size(); ++m) {
        row.seconds[m] = compare::spreadOf(seconds[m]).median;
        row.paper[m] = scene.milliseconds[size][m] / scene.milliseconds[size][0];
    }
    return row;
}

std::string rowsTable(const std::vector<ConeTableRow>& rows) {
    std::string heads = "<th>scene</th><th>size</th>", body;
    for (const char* name : kPaperNames)
        heads += fmt::format("<th>{0}, ms</th><th>ratio</th><th>the paper's</th>", name);
    for (const ConeTableRow& row : rows) {
        body += fmt::format("<tr><td>{}</td><td>{}x{}</td>", row.scene, row.width, row.height);
        for (std::size_t m = 0; m < kTableMethods.size(); ++m)
            body += numberCell(1e3 * row.seconds[m], "{:.1f}") + numberCell(row.ratio(m), "{:.2f}") +
                    numberCell(row.paper[m], "{:.2f}");
        body += "</tr>\n";
    }
    body += "<tr><td><b>mean</b></td><td></td>";
    for (std::size_t m = 0; m < kTableMethods.size(); ++m)
        body +=
            emptyCell() + numberCell(meanRatio(rows, m), "{:.2f}") + numberCell(meanPaper(rows, m), "{:.2f}");
    return cardTable(heads, body + "</tr>\n");
}

void addClaims(const std::vector<ConeTableRow>& rows, std::vector<FigureClaim>& claims) {
    for (std::size_t m = 1; m < kTableMethods.size(); ++m)
        claims.push_back(
            {"Table 1", fmt::format("{}: mean ratio of times to no antialiasing, both sizes", kPaperNames[m]),
             fmt::format("{:.2f}", meanPaper(rows, m)), fmt::format("{:.2f}", meanRatio(rows, m)), "",
             "scenes of ours of the same kinds, on a CPU whose rays go by tiles and pruned fields, which "
             "makes the rest of a frame cheaper"});
}

}  // namespace

std::vector<ConeTableRow> paperTable() {
    std::vector<ConeTableRow> rows;
    for (const PaperScene& scene : kPaper)
        for (std::size_t size = 0; size < 2; ++size) {
            ConeTableRow row{scene.name, Effort().sizes[size].x, Effort().sizes[size].y, {}, {}};
            for (std::size_t m = 0; m < kTableMethods.size(); ++m) {
                row.seconds[m] = 1e-3 * scene.milliseconds[size][m];
                row.paper[m] = scene.milliseconds[size][m] / scene.milliseconds[size][0];
            }
            rows.push_back(row);
        }
    return rows;
}

double meanRatio(const std::vector<ConeTableRow>& rows, std::size_t method) {
    double sum = 0.0;
    for (const ConeTableRow& row : rows) sum += row.ratio(method);
    return sum / static_cast<double>(rows.size());
}

double meanPaper(const std::vector<ConeTableRow>& rows, std::size_t method) {
    double sum = 0.0;
    for (const ConeTableRow& row : rows) sum += row.paper[method];
    return sum / static_cast<double>(rows.size());
}

FigurePlot coneTablePlot(const std::vector<ConeTableRow>& rows) {
    ValueGrid grid{"Ratios of times", {}, {}, {}};
    for (std::size_t m = 1; m < kTableMethods.size(); ++m)
        grid.columns.insert(grid.columns.end(), {kPaperNames[m], "the paper's"});
    const auto cell = [](double ratio) {
        return GridCell{fmt::format("{:.2f}", ratio), std::log2(ratio) / 3.0, false};
    };
    for (const ConeTableRow& row : rows) {
        grid.rows.push_back(fmt::format("{}, {}x{}", row.scene, row.width, row.height));
        for (std::size_t m = 1; m < kTableMethods.size(); ++m)
            grid.cells.insert(grid.cells.end(), {cell(row.ratio(m)), cell(row.paper[m])});
    }
    grid.rows.push_back("mean");
    for (std::size_t m = 1; m < kTableMethods.size(); ++m)
        grid.cells.insert(grid.cells.end(), {cell(meanRatio(rows, m)), cell(meanPaper(rows, m))});
    return {"ratios",
            "Times over those without antialiasing, ours and the paper's on scenes of the same kind.",
            valueGridSvg(grid)};
}

std::string coneTableCsv(const std::vector<ConeTableRow>& rows) {
    std::string out = "scene,width,height,method,seconds,ratio,paper_ratio\n";
    for (const ConeTableRow& row : rows)
        for (std::size_t m = 0; m < kTableMethods.size(); ++m)
            out += fmt::format("{},{},{},{},{},{},{}\n", row.scene, row.width, row.height, kTableMethods[m],
                               row.seconds[m], row.ratio(m), row.paper[m]);
    return out;
}

std::vector<FigureFile> makeConeTable(const FigureInput& input) {
    Effort effort;
    if (input.quick) effort = {2, {{{64, 36}, {128, 72}}}, 1};
    input.progress.stage("Table 1", effort.scenes * effort.sizes.size());
    std::vector<ConeTableRow> rows;
    for (std::size_t i = 0; i < effort.scenes; ++i)
        for (std::size_t size = 0; size < effort.sizes.size(); ++size) {
            rows.push_back(measureRow(kPaper[i], size, effort, input.progress));
            input.progress.advance(1);
        }
    addClaims(rows, input.claims);
    const std::vector<FigurePlot> plots{coneTablePlot(rows)};
    const compare::Machine machine = compare::thisMachine();
    const FigureWords words{
        "cone-table",
        "Cone tracing: Table 1",
        fmt::format(
            "After Chubarau et al. 2023, Table 1: scenes of the same kinds, our atrium in the place of their "
            "Sponza, on a CPU instead of a GeForce RTX 3090. Times are whole pictures without set-up, "
            "shading "
            "included. 4x SS is ssaa:2.{}",
            input.quick ? " Small sizes stand for the paper's here." : ""),
        {{"sizes", fmt::format("{}x{} and {}x{}", effort.sizes[0].x, effort.sizes[0].y, effort.sizes[1].x,
                               effort.sizes[1].y)},
         {"runs", fmt::format("{} by turns, fewer where they take {:.0f} s; medians", effort.runs,
                              effort.budget_seconds)},
         {"machine", fmt::format("{}, {} cores", machine.processor, machine.cores)},
         {"seed", "0"}},
        {"edgewise render SCENE --size 2560x1440 --method ctss --filter box --device cpu -o OUT.png --stats "
         "FILE.json"},
        input.quick};
    std::vector<FigureFile> files{{"report.html", figurePage(words, plotsHtml(plots) + rowsTable(rows))},
                                  {"results.csv", coneTableCsv(rows)}};
    appendPlotFiles(plots, files);
    return files;
}

}  // namespace edgewise::figures
