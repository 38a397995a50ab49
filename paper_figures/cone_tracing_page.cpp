#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "paper_figures/cone_tracing.h"
#include "paper_figures/page_parts.h"
#include "pipeline/compare/report_page.h"
#include "pipeline/html_text.h"
#include "pipeline/version.h"

namespace edgewise::figures {
namespace {

std::string decibels(const Psnr& psnr) {
    return psnr ? number(*psnr, "{:.2f}") : "<td data-value=''></td>";
}
std::string decibelCells(const EdgePsnr& psnr) {
    std::string cells = decibels(psnr.all);
    for (const EdgeKind kind : kEdgeKinds) cells += decibels(psnr.of(kind));
    return cells;
}
std::string percent(double share) {
    return number(100.0 * share, "{:.2f}");
}

std::string claimsTable(const ConeTracing& found) {
    std::string rows;
    for (const ConeClaim& claim : claimsOf(found))
        rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                            escapedHtml(claim.claim), escapedHtml(claim.ours), escapedHtml(claim.paper),
                            escapedHtml(claim.bar),
                            !claim.met   ? ""
                            : *claim.met ? "yes"
                                         : "no");
    return table("<th>claim</th><th>here</th><th>paper</th><th>aim</th><th>met</th>", rows);
}

std::string methodsTable(const ConeTracing& found, const ConeScene& scene) {
    std::string rows;
    for (const ConeRun& run : scene.runs) {
        rows += fmt::format("<tr><td>{}</td><td></td>", escapedHtml(run.method)) +
                number(1e3 * run.seconds, "{:.0f}") +
                number(run.seconds / scene.runs.front().seconds, "{:.2f}") +
                (run.published ? number(*run.published, "{:.2f}") : "<td data-value=''></td>") +
                decibelCells(run.psnr) + "</tr>\n";
    }
    const auto addJudge = [&](const std::string& name, const EdgePsnr& psnr) {
        rows += fmt::format("<tr><td>{}</td><td></td><td></td><td></td><td></td>", name) +
                decibelCells(psnr) + "</tr>\n";
    };
    addJudge(fmt::format("ssaa:{}", found.reference_side), scene.plain_reference);
    addJudge("the reference itself", scene.reference);
    return table(
        "<th>method</th><th></th><th>ms</th><th>times none</th><th>paper: times none</th><th>all edges, "
        "dB</th><th>contour</th><th>internal</th><th>texture</th><th>light</th>",
        rows);
}

std::string countsTable(const ConeTracing& found) {
    std::string rows;
    for (const ConeScene& scene : found.scenes) {
        const double all = static_cast<double>(scene.width) * scene.height;
        const ConeRun& x = scene.run("ctss-x");
        rows += fmt::format("<tr><td>{}</td><td></td>", escapedHtml(scene.name));
        for (const EdgeKind kind : kEdgeKinds) {
            const auto count = scene.pixels.find(kind);
            rows += percent(count == scene.pixels.end() ? 0.0 : static_cast<double>(count->second) / all);
        }
        for (const char* count :
             {"pixels_doubtful", "pixels_complex", "pixels_counted", "pixels_of_light_borders"})
            rows += percent(x.shareOf(count));
        rows += "</tr>\n";
    }
    return table(
        "<th>scene</th><th></th><th>contour, % of all pixels</th><th>internal</th><th>texture</th>"
        "<th>light</th><th>ctss-x: doubtful</th><th>complex</th><th>of these by count</th><th>light's "
        "borders</th>",
        rows);
}

constexpr const char* kWords =
    "<p class='under'>Kinds of edges are what rays of a lattice meet, not what colours look like. "
    "Contour: depth leaps from a sub-sample to the next by more than both tangent planes explain, or a "
    "surface "
    "ends. Internal: the normal turns by more than 15 degrees. Texture: another material or colour of a "
    "pattern. Light: the colour alone differs, by more than 1/32. A pixel is the first of these that it has. "
    "dB: "
    "PSNR over a kind's pixels, linear RGB, peak 1, box filter of a pixel; gains are means of dB over scenes "
    "that have the kind. Times: from the decoded scene to the picture, CPU, methods by turns, medians. The "
    "cost aims were set for the paper's five scenes at 1280x720 on one machine alone.</p>\n";

std::string scenesHtml(const ConeTracing& found) {
    std::string out;
    for (const ConeScene& scene : found.scenes)
        out += fmt::format("<h3>{}</h3><p class='under'>Judged at {}x{}, timed at {}x{}.</p>",
                           escapedHtml(scene.name), scene.width, scene.height, scene.timed_width,
                           scene.timed_height) +
               methodsTable(found, scene);
    return out;
}

std::string referenceWords(const ConeTracing& found) {
    return fmt::format(
        "<p class='under'>Reference: {0} x {0} rays a pixel that end {0} times nearer to surfaces than those "
        "of ssaa:{0}, whose outlines are a sixteenth of a pixel too wide; its own error is against {1} x {1} "
        "on "
        "the picture's middle quarter. Kinds are told by {2} x {2} rays a pixel.</p>\n",
        found.reference_side, found.finer_side, found.facts_side);
}

nlohmann::ordered_json psnrJson(const EdgePsnr& psnr) {
    using Json = nlohmann::ordered_json;
    const auto number_or_null = [](const Psnr& p) { return p ? Json(*p) : Json(); };
    Json json{{"all", number_or_null(psnr.all)}};
    for (const EdgeKind kind : kEdgeKinds) json[judge::nameOf(kind)] = number_or_null(psnr.of(kind));
    return json;
}

}  // namespace

std::string coneTracingHtml(const ConeTracing& found) {
    return fmt::format(
               "<!doctype html><html lang='en'><head><meta charset='utf-8'><meta name='viewport' "
               "content='width=device-width'><title>Cone tracing</title><link rel='icon' "
               "href='data:,'><style>{}{}</style>"
               "</head><body><main><h1>Cone-traced supersampling</h1><p>edgewise {}, <code>edgewise figure "
               "cone-tracing{} -o "
               "DIR</code>, CPU, {} run{}, {:.0f} s in all</p>\n",
               compare::kReportStyle, kPageStyle, escapedHtml(version()), found.quick ? " --quick" : "",
               found.runs, found.runs == 1 ? "" : "s", found.seconds) +
           "<h2>What the paper says, and what is asked of ours</h2>" + claimsTable(found) + kWords +
           referenceWords(found) + "<h2>Scene by scene</h2>" + scenesHtml(found) +
           "<h2>Pixels with edges</h2>" + countsTable(found) + pictureRowsHtml(found.pictures) +
           "</main>\n<script>" + compare::kSortScript + "</script></body></html>\n";
}

std::string coneTracingJson(const ConeTracing& found) {
    using Json = nlohmann::ordered_json;
    Json scenes = Json::array(), claims = Json::array();
    for (const ConeScene& scene : found.scenes) {
        Json runs = Json::array(), pixels = Json::object();
        for (const ConeRun& run : scene.runs)
            runs.push_back({{"method", run.method},
                            {"seconds", run.seconds},
                            {"ratio", run.seconds / scene.runs.front().seconds},
                            {"published", run.published ? Json(*run.published) : Json()},
                            {"psnr", psnrJson(run.psnr)},
                            {"counts", run.counts}});
        for (const auto& [kind, count] : scene.pixels) pixels[judge::nameOf(kind)] = count;
        scenes.push_back({{"scene", scene.name},
                          {"size", {scene.width, scene.height}},
                          {"timed_size", {scene.timed_width, scene.timed_height}},
                          {"pixels", pixels},
                          {"plain_reference_psnr", psnrJson(scene.plain_reference)},
                          {"reference_psnr", psnrJson(scene.reference)},
                          {"runs", runs}});
    }
    for (const ConeClaim& claim : claimsOf(found))
        claims.push_back({{"claim", claim.claim},
                          {"here", claim.ours},
                          {"paper", claim.paper},
                          {"aim", claim.bar},
                          {"met", claim.met ? Json(*claim.met) : Json()}});
    return Json{{"seconds", found.seconds},
                {"runs", found.runs},
                {"reference_side", found.reference_side},
                {"finer_side", found.finer_side},
                {"facts_side", found.facts_side},
                {"claims", claims},
                {"scenes", scenes}}
               .dump(2) +
           "\n";
}

}  // namespace edgewise::figures
