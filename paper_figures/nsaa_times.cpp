// NSAA, section 4.3: shares of time, and memory.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "paper_figures/compared_scene.h"
#include "paper_figures/conservative_area.h"
#include "paper_figures/figure_plot.h"
#include "paper_figures/page_parts.h"
#include "paper_figures/stacked_bars.h"
#include "pipeline/compare/worker_process.h"
#include "pipeline/error.h"
#include "pipeline/html_table.h"
#include "pipeline/html_text.h"
#include "pipeline/load_scene.h"
#include "pipeline/project.h"
#include "pipeline/resolve_camera.h"
#include "pipeline/scene_catalog.h"
#include "pipeline/scoped_path.h"

namespace edgewise::figures {
namespace {

constexpr double kRadius = 2.0;
/// Of an entry of the paper's buffers: an id and a weight, 32 bits each.
constexpr double kBytesPerEntry = 8.0;
/// The paper's own visibility.
constexpr const char* kByEdges = "cpu by edges";

struct TimedScene {
    const char* name;
    int width, height;
};
constexpr TimedScene kScenes[]{
    {"zone-plate", 1024, 1024}, {"log-grid", 1024, 1024}, {"torus-sequence", 1024, 512}};

/// What the paper sums up its stages to.
enum class Kind { kAnalytic, kRaster, kOther };
Kind kindOf(const std::string& stage) {
    if (stage == "visibility" || stage == "weights") return Kind::kAnalytic;
    return stage == "gather" || stage == "shade" || stage == "blend" ? Kind::kRaster : Kind::kOther;
}

struct TimedRow {
    std::string scene, variant;
    compare::Row row;
    double buffers_mib = 0.0;  ///< that the paper's two buffers would take
    double seconds = 0.0;
    std::map<std::string, double> stages;  ///< medians
    double share(Kind kind) const {
        double sum = 0.0, all = 0.0;
        for (const auto& [name, value] : stages) all += value, sum += kindOf(name) == kind ? value : 0.0;
        return all > 0.0 ? sum / all : 0.0;
    }
};

std::vector<std::string> arguments(const TimedScene& scene, int shrink, const std::string& method, bool all) {
    std::vector<std::string> out{"compare-worker",
                                 scene.name,
                                 fmt::format("--size={}x{}", scene.width / shrink, scene.height / shrink),
                                 "--filter=gaussian",
                                 fmt::format("--radius={}", kRadius),
                                 "--device=cpu",
                                 "--method=" + method};
    if (all) out.push_back("--no-skip=all");
    return out;
}

double buffersMib(const TimedScene& scene, int shrink) {
    const Scene loaded = loadScene(findScene(scene.name));
    Film film;
    CameraOptions options;
    options.size = {scene.width / shrink, scene.height / shrink};
    const ResolvedCamera camera = resolveCamera(loaded, options, film);
    GatherCounts counts;
    for (const ScreenTriangle& t : project(loaded, camera, film).triangles)
        counts += gatherCounts(t.p_px, kRadius, film.crop);
    return kBytesPerEntry * double(counts.clipped) / 0x1p20;
}

std::vector<TimedRow> timed(const TimedScene& scene, int shrink, int runs,
                            const std::filesystem::path& scratch, Progress& progress) {
    struct Variant {
        const char *words, *method;
        bool all;
    };
    constexpr Variant kVariants[]{{"cpu", "nsaa,device=cpu", false},
                                  {kByEdges, "nsaa:visibility=awj13,device=cpu", false},
                                  {"cpu, nothing left out", "nsaa,device=cpu", true},
                                  {"vulkan", "nsaa,device=vulkan", false}};
    std::vector<compare::Contender> contenders;
    std::vector<compare::Row> rows;
    for (const Variant& variant : kVariants) {
        // a software device compiles its shaders, and visibility without omissions takes seconds
        if (shrink > 1 && contenders.size() == 2) break;
        contenders.push_back({variant.method, arguments(scene, shrink, variant.method, variant.all)});
        rows.push_back(compare::rowOf(parseMethod(variant.method), makePrefilter("gaussian", kRadius, {})));
    }
    Labelled labelled(progress, scene.name);
    compare::runByTurns(
        contenders, {runs, std::numeric_limits<double>::infinity(), scratch, false}, rows,
        [](std::size_t, const ImageBuffer&) {}, [](std::size_t) {}, labelled);
    std::vector<TimedRow> out;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        TimedRow row{scene.name, kVariants[i].words, rows[i], 0.0, compare::spreadOf(rows[i].seconds).median,
                     {}};
        for (const auto& [name, values] : rows[i].stages) row.stages[name] = compare::spreadOf(values).median;
        row.buffers_mib = buffersMib(scene, shrink);
        out.push_back(std::move(row));
    }
    return out;
}

std::string rowsTable(const std::vector<TimedRow>& rows) {
    std::string out;
    for (const TimedRow& r : rows) {
        out += fmt::format("<tr><td>{}</td><td>{}</td>", r.scene, escapedHtml(r.variant));
        if (r.stages.empty())
            out += fmt::format("<td colspan='7'>{}</td></tr>\n", escapedHtml(r.row.why));
        else
            out += numberCell(1e3 * r.seconds, "{:.0f}") + numberCell(1.0 / r.seconds, "{:.2f}") +
                   numberCell(100 * r.share(Kind::kAnalytic), "{:.1f}") +
                   numberCell(100 * r.share(Kind::kRaster), "{:.1f}") +
                   numberCell(100 * r.share(Kind::kOther), "{:.1f}") + numberCell(r.row.peak_mib, "{:.0f}") +
                   numberCell(r.buffers_mib, "{:.1f}") + "</tr>\n";
    }
    return cardTable(
        "<th>scene</th><th>on</th><th>ms</th><th>frames a second</th><th>visibility and prefilter, %</th>"
        "<th>gather, shade, blend, %</th><th>projection and plan, %</th><th>peak of the process, MiB</th>"
        "<th>the paper's id and weight buffers, MiB</th>",
        out);
}

std::string rowsCsv(const std::vector<TimedRow>& rows) {
    std::string out = "scene,on,seconds,analytic_share,raster_share,other_share,peak_mib,buffers_mib\n";
    for (const TimedRow& r : rows)
        out += fmt::format("{},\"{}\",{},{},{},{},{},{}\n", r.scene, r.variant, r.seconds,
                           r.share(Kind::kAnalytic), r.share(Kind::kRaster), r.share(Kind::kOther),
                           r.row.peak_mib, r.buffers_mib);
    return out;
}

FigurePlot barsOf(const std::vector<TimedRow>& rows) {
    StackedBars plot{"Shares of nsaa's time", {"analytic", "raster", "other"}, {}};
    for (const TimedRow& r : rows)
        if (!r.stages.empty())
            plot.bars.push_back({fmt::format("{}, {}", r.scene, r.variant.substr(0, r.variant.find(','))) +
                                     (r.variant.find(',') == std::string::npos ? "" : " *"),
                                 {r.share(Kind::kAnalytic), r.share(Kind::kRaster), r.share(Kind::kOther)},
                                 fmt::format("{:.0f} ms", 1e3 * r.seconds)});
    return {"shares",
            "Analytic: visibility and prefilter. Raster: gather, shade, blend. Other: projection and plan. "
            "*: with "
            "--no-skip all.",
            stackedBarsSvg(plot)};
}

std::string range(const std::vector<TimedRow>& rows, const char* format, double (*value)(const TimedRow&),
                  const std::string& variant = "cpu") {
    double low = INFINITY, high = -INFINITY;
    for (const TimedRow& r : rows)
        if (r.variant == variant) low = std::min(low, value(r)), high = std::max(high, value(r));
    return fmt::format(fmt::runtime(format), low) + " to " + fmt::format(fmt::runtime(format), high);
}

void addClaims(const std::vector<TimedRow>& rows, std::vector<FigureClaim>& claims) {
    const std::string place = "section 4.3";
    claims.push_back(
        {place, "share of exact visibility and analytic prefiltering", "> 90",
         range(rows, "{:.1f}", [](const TimedRow& r) { return 100 * r.share(Kind::kAnalytic); }), "%",
         "CPU, not a GeForce 680: shading is not free here, and visibility by cells costs less than "
         "edge against edge"});
    claims.push_back(
        {place, "the same with the paper's visibility, edge by edge", "> 90",
         range(
             rows, "{:.1f}", [](const TimedRow& r) { return 100 * r.share(Kind::kAnalytic); }, kByEdges),
         "%", "edges are cut by those of their cells of 16 px, not by all of the scene's"});
    claims.push_back({place, "share of the rasterization-based stages", "< 5",
                      range(rows, "{:.1f}", [](const TimedRow& r) { return 100 * r.share(Kind::kRaster); }),
                      "%",
                      "there by the GPU's rasterizer; here gather, shade and blend are computed in double"});
    claims.push_back(
        {place, "memory for ids and weights of all primitive fragments", "in the 100 MB range",
         range(rows, "{:.1f}", [](const TimedRow& r) { return r.buffers_mib; }), "MiB",
         "what 8 bytes an entry would take for the samples that the paper's rasterization gathers, of "
         "1024x1024 px; edgewise keeps weights a tile at a time"});
    claims.push_back({place, "frames a second, 20k triangles", "near-interactive",
                      range(rows, "{:.2f}", [](const TimedRow& r) { return 1.0 / r.seconds; }), "1/s",
                      "CPU in double precision, on this machine"});
}

}  // namespace

std::vector<FigureFile> makeNsaaTimes(const FigureInput& input) {
    const ScopedPath scratch = temporaryFolder();
    const int runs = input.quick ? 1 : 5, shrink = input.quick ? 8 : 1;
    std::vector<TimedRow> rows;
    for (const TimedScene& scene : kScenes) {
        const auto more = timed(scene, shrink, runs, scratch.path(), input.progress);
        rows.insert(rows.end(), more.begin(), more.end());
    }
    addClaims(rows, input.claims);
    const std::vector<FigurePlot> plots{barsOf(rows)};
    const compare::Machine machine = compare::thisMachine();
    FigureWords words{
        "nsaa-times",
        "Shares of time, and memory",
        "After NSAA's section 4.3, which has one sentence on a GeForce 680: more than 90 % of the time "
        "goes to visibility and prefiltering, less than 5 % to rasterization, and memory is around "
        "100 MB. Each row is a process of its own; times are medians without set-up. A plan leaves out "
        "what a scene does not need; \"nothing left out\" is --no-skip all, \"by edges\" is "
        "visibility=awj13, "
        "the paper's own way to what is visible.",
        {{"filter", "gaussian, R 2, sigma R/3"},
         {"runs", fmt::format("{}, by turns, after one that does not count", runs)},
         {"size", shrink == 1 ? "1024x1024, torus-sequence 1024x512" : "an eighth along each axis"},
         {"machine", fmt::format("{}, {} cores", machine.processor, machine.cores)},
         {"seed", "none"}},
        {"edgewise compare zone-plate -o DIR --size 1024x1024 --filter gaussian --method "
         "nsaa,device=cpu --method nsaa,device=vulkan"},
        input.quick};
    std::vector<FigureFile> files{{"report.html", figurePage(words, rowsTable(rows) + plotsHtml(plots))},
                                  {"results.csv", rowsCsv(rows)}};
    appendPlotFiles(plots, files);
    return files;
}

}  // namespace edgewise::figures
