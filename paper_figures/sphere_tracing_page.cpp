#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "paper_figures/page_parts.h"
#include "paper_figures/sphere_tracing.h"
#include "pipeline/compare/report_page.h"
#include "pipeline/html_table.h"
#include "pipeline/html_text.h"
#include "pipeline/json_text.h"
#include "pipeline/version.h"

namespace edgewise::figures {
namespace {

constexpr HitChange kHitChanges[]{HitChange::kSilhouette, HitChange::kGrazing, HitChange::kNarrow,
                                  HitChange::kAlone};

std::string runsTable(const std::vector<TracedScene>& scenes) {
    std::string rows;
    for (const TracedScene& scene : scenes)
        for (const TraceRun& run : scene.runs) {
            // His comparison is of over-relaxation, or of the shortcut, with classic tracing.
            const bool his = run.setting == "keinert" || run.setting == "convex shortcut";
            rows +=
                fmt::format("<tr><td>{}</td><td>{}</td>", escapedHtml(scene.name), escapedHtml(run.setting)) +
                numberCell(double(run.evaluations) / double(scene.rays), "{:.2f}") +
                numberCell(scene.ratioOf(run), "{:.3f}") + numberCell(1e3 * run.seconds, "{:.0f}") +
                numberCell(scene.runs[0].seconds / run.seconds, "{:.3f}") +
                numberCell(100.0 * double(run.changed) / double(scene.rays), "{:.4f}") +
                numberCell(his ? scene.published : std::nullopt, "{:.2f}") + "</tr>\n";
        }
    return cardTable(
        "<th>scene</th><th>setting</th><th>evaluations a ray</th><th>times fewer</th><th>ms</th><th>times "
        "faster</th><th>other hits, %</th><th>published: times faster</th>",
        rows);
}

std::string meansTable(const SphereTracing& found) {
    std::string rows;
    for (const TraceRun& run : found.scenes.front().runs) {
        double least = INFINITY;
        for (const TracedScene& scene : found.scenes)
            for (const TraceRun& other : scene.runs)
                if (other.setting == run.setting) least = std::min(least, scene.ratioOf(other));
        rows += fmt::format("<tr><td>{}</td><td></td>", escapedHtml(run.setting)) +
                numberCell(geometricMeanRatio(found, run.setting), "{:.3f}") + numberCell(least, "{:.3f}") +
                "</tr>\n";
    }
    return cardTable(
        "<th>setting</th><th></th><th>times fewer evaluations, geometric mean</th><th>least of all "
        "scenes</th>",
        rows);
}

std::string candidatesTable(const SphereTracing& found) {
    std::string rows;
    for (const CandidateCount& c : found.candidates)
        rows += fmt::format(
            "<tr><td>{}</td><td>{} steps</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
            escapedHtml(c.scene), c.steps, c.pixels, c.last.wrong, c.last.holes, c.screen.wrong,
            c.screen.holes);
    return cardTable(
        "<th>scene</th><th></th><th>pixels</th><th>last point: wrong "
        "surface</th><th>holes</th><th>screen-space "
        "candidate: wrong surface</th><th>holes</th>",
        rows);
}

std::string jumpsTable(const SphereTracing& found) {
    std::string rows;
    for (const JumpCount& j : found.jumps)
        rows += fmt::format("<tr><td>{}</td><td></td><td>{}</td>", escapedHtml(j.scene), j.pairs) +
                numberCell(j.median_before, "{:.3g}") + numberCell(j.median_after, "{:.3g}") +
                numberCell(j.median_after > 0.0 ? j.median_before / j.median_after : INFINITY, "{:.1f}") +
                "</tr>\n";
    return cardTable(
        "<th>scene</th><th></th><th>pairs of pixels</th><th>median jump</th><th>after 3 steps</th><th>falls "
        "by</th>",
        rows);
}

std::string pruningTable(const SphereTracing& found) {
    std::string rows;
    for (const PruningCount& p : found.pruning)
        rows += fmt::format("<tr><td>{}</td><td>{}x{}</td>", escapedHtml(p.scene), p.width, p.height) +
                numberCell(p.instructions_whole, "{:.0f}") + numberCell(p.instructions_pruned, "{:.1f}") +
                numberCell(p.seconds_whole, "{:.3f}") + numberCell(p.seconds_pruned, "{:.3f}") +
                numberCell(p.seconds_whole / p.seconds_pruned, "{:.1f}") +
                numberCell(p.build_seconds, "{:.3f}") + fmt::format("<td>{}</td></tr>\n", p.differing);
    return cardTable(
        "<th>scene</th><th>size</th><th>instructions an evaluation</th><th>pruned</th><th>whole, "
        "s</th><th>pruned, "
        "s</th><th>times "
        "faster</th><th>of it pruning, s, all threads</th><th>differing depths</th>",
        rows);
}

std::size_t countOf(const TracedScene& scene, HitChange kind) {
    return static_cast<std::size_t>(
        std::ranges::count_if(scene.changed, [&](const ChangedHit& hit) { return hit.kind == kind; }));
}

/// Of the last setting, which has all that is on by default.
std::string changesTable(const SphereTracing& found) {
    std::string rows;
    for (const TracedScene& scene : found.scenes) {
        rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td>", escapedHtml(scene.name),
                            escapedHtml(scene.runs.back().setting), scene.changed.size());
        for (const HitChange kind : kHitChanges) rows += fmt::format("<td>{}</td>", countOf(scene, kind));
        rows += numberCell(100.0 * double(scene.changed.size()) / double(scene.rays), "{:.4f}") + "</tr>\n";
    }
    return cardTable(
        "<th>scene</th><th></th><th>other "
        "hits</th><th>silhouette</th><th>grazing</th><th>narrow</th><th>alone</th><th>of "
        "all "
        "pixels, %</th>",
        rows);
}

constexpr const char* kChangeWords =
    "<p class='under'>Of the eight pixels around, by classic tracing. Silhouette: one shows the surface that "
    "this "
    "pixel's ray now ends on. Grazing: none does, but the new depth lies between theirs. Narrow: none shows "
    "either surface, so the ray is in a gap, or on a thing, narrower than a pixel. Alone: none of these. "
    "results.json lists every pixel with both depths.</p>\n";

std::string notes(const SphereTracing& found) {
    std::string out;
    for (const std::string& note : found.notes) out += fmt::format("<li>{}</li>\n", escapedHtml(note));
    return out.empty() ? out : "<div class='card'><ul>" + out + "</ul></div>\n";
}

constexpr const char* kWords =
    "<p class='under'>Evaluations of the field a primary ray; those of cones are counted among the tile's "
    "rays. Times are "
    "of tracing alone, unlit, medians, all settings by turns. Other hits: pixels whose ray ends on nothing "
    "where classic "
    "tracing ends on something, or the reverse, or at a depth that differs by more than 64 radii of a pixel. "
    "Published: "
    "Keinert et al. 2014, on a GTX Titan and on scenes of theirs that are not published; ours are of the "
    "same kinds and "
    "are not made to match.</p>\n";

/// [x, y, classic's depth, the last setting's, kind]; null: nothing is hit.
nlohmann::ordered_json changesJson(const TracedScene& scene) {
    using Json = nlohmann::ordered_json;
    const auto depthJson = [](double depth) { return std::isfinite(depth) ? Json(depth) : Json(); };
    Json list = Json::array();
    for (const ChangedHit& hit : scene.changed)
        list.push_back({hit.x, hit.y, depthJson(hit.classic_depth), depthJson(hit.depth), nameOf(hit.kind)});
    return list;
}

}  // namespace

const char* nameOf(HitChange kind) {
    switch (kind) {
        case HitChange::kSilhouette:
            return "silhouette";
        case HitChange::kGrazing:
            return "grazing";
        case HitChange::kNarrow:
            return "narrow";
        default:
            return "alone";
    }
}

double geometricMeanRatio(const SphereTracing& found, const std::string& setting) {
    double sum = 0.0;
    int count = 0;
    for (const TracedScene& scene : found.scenes)
        for (const TraceRun& run : scene.runs)
            if (run.setting == setting) sum += std::log(scene.ratioOf(run)), ++count;
    return count == 0 ? 0.0 : std::exp(sum / count);
}

std::string sphereTracingHtml(const SphereTracing& found) {
    return fmt::format(
               "<!doctype html><html lang='en'><head><meta charset='utf-8'><meta name='viewport' "
               "content='width=device-width'><title>Sphere tracing</title><link rel='icon' "
               "href='data:,'><style>{}{}</style>"
               "</head><body><main><h1>Sphere tracing</h1><p>edgewise {}, <code>edgewise figure "
               "sphere-tracing{} -o "
               "DIR</code>, CPU, {} run{}, {:.0f} s in all</p>\n",
               compare::kReportStyle, kPageStyle, escapedHtml(version()), found.quick ? " --quick" : "",
               found.runs, found.runs == 1 ? "" : "s", found.seconds) +
           "<h2>Relaxation and cones: all scenes</h2>" + meansTable(found) + "<h2>Scene by scene</h2>" +
           runsTable(found.scenes) + kWords + "<h2>Other hits, pixel by pixel</h2>" + changesTable(found) +
           kChangeWords + "<h2>The convex shortcut</h2>" + runsTable(found.convex) +
           "<h2>Out of steps: which point is the hit</h2>" + candidatesTable(found) +
           "<h2>Discontinuity reduction</h2>" + jumpsTable(found) + "<h2>Pruning</h2>" + pruningTable(found) +
           pictureRowsHtml(found.pictures) + notes(found) + "</main>\n<script>" + compare::kSortScript +
           "</script></body></html>\n";
}

std::string sphereTracingJson(const SphereTracing& found) {
    using Json = nlohmann::ordered_json;
    const auto scenesJson = [](const std::vector<TracedScene>& scenes) {
        Json list = Json::array();
        for (const TracedScene& scene : scenes) {
            Json runs = Json::array();
            for (const TraceRun& run : scene.runs)
                runs.push_back({{"setting", run.setting},
                                {"seconds", run.seconds},
                                {"evaluations", run.evaluations},
                                {"iterations", run.iterations},
                                {"other_hits", run.changed}});
            list.push_back({{"scene", scene.name},
                            {"size", {scene.width, scene.height}},
                            {"rays", scene.rays},
                            {"published", scene.published ? Json(*scene.published) : Json()},
                            {"runs", runs},
                            {"other_hits", changesJson(scene)}});
        }
        return list;
    };
    Json json{{"seconds", found.seconds},
              {"scenes", scenesJson(found.scenes)},
              {"convex", scenesJson(found.convex)}};
    for (const CandidateCount& c : found.candidates)
        json["candidates"].push_back({{"scene", c.scene},
                                      {"steps", c.steps},
                                      {"pixels", c.pixels},
                                      {"last", {{"wrong", c.last.wrong}, {"holes", c.last.holes}}},
                                      {"screen", {{"wrong", c.screen.wrong}, {"holes", c.screen.holes}}}});
    for (const JumpCount& j : found.jumps)
        json["jumps"].push_back({{"scene", j.scene},
                                 {"pairs", j.pairs},
                                 {"median_before", j.median_before},
                                 {"median_after", j.median_after}});
    for (const PruningCount& p : found.pruning)
        json["pruning"].push_back({{"scene", p.scene},
                                   {"size", {p.width, p.height}},
                                   {"seconds_whole", p.seconds_whole},
                                   {"seconds_pruned", p.seconds_pruned},
                                   {"prune_seconds", p.build_seconds},
                                   {"instructions_whole", p.instructions_whole},
                                   {"instructions_pruned", p.instructions_pruned},
                                   {"differing", p.differing}});
    return jsonText(json, 2) + "\n";
}

}  // namespace edgewise::figures
