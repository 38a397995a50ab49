#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "paper_figures/cone_tracing.h"
#include "paper_figures/page_parts.h"
#include "pipeline/compare/comparison_report.h"
#include "pipeline/compare/comparison_tables.h"
#include "pipeline/compare/kinds_tables.h"
#include "pipeline/html_table.h"
#include "pipeline/html_text.h"
#include "pipeline/json_text.h"

namespace edgewise::figures {
namespace {

std::string percent(double share) {
    return numberCell(100.0 * share, "{:.2f}");
}
std::string verdict(const ConeClaim& claim) {
    if (!claim.met()) return "";
    const std::string by = fmt::format("{} by {:.2f}{}{}", *claim.met() ? "met" : "missed",
                                       std::abs(*claim.margin), claim.unit.empty() ? "" : " ", claim.unit);
    return *claim.met() ? by : fmt::format("<span class='bad'>{}</span>", by);
}

std::string claimsTable(const ConeTracing& found) {
    constexpr const char* kWords = "<td style='text-align:left;white-space:normal'>{}</td>";
    std::string rows;
    for (const ConeClaim& claim : claimsOf(found)) {
        rows += "<tr>";
        for (const std::string& words : {escapedHtml(claim.claim), escapedHtml(claim.ours), verdict(claim),
                                         escapedHtml(claim.bar), escapedHtml(claim.paper)})
            rows += fmt::format(fmt::runtime(kWords), words);
        rows += "</tr>\n";
    }
    return cardTable("<th>claim</th><th>here</th><th>aim met</th><th>aim</th><th>paper</th>", rows);
}

std::string timesTable(const ConeTracing& found) {
    std::string rows;
    for (const ConeScene& scene : found.scenes)
        for (const compare::Row& row : scene.timed.empty() ? scene.judged.rows : scene.timed) {
            const std::optional<double> seconds = scene.secondsOf(row.method);
            rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td>", escapedHtml(scene.name()),
                                escapedHtml(row.method), escapedHtml(row.device)) +
                    numberCell(seconds ? std::optional(1e3 * *seconds) : std::nullopt, "{:.0f}") +
                    numberCell(scene.ratioOf(row.method), "{:.2f}") +
                    numberCell(publishedRatio(scene.name(), row.method), "{:.2f}") + "</tr>\n";
        }
    return cardTable(
        "<th>scene</th><th>method</th><th>device</th><th>ms</th><th>times none</th><th>paper: times "
        "none</th>",
        rows);
}

std::string countsTable(const ConeTracing& found) {
    std::string rows;
    for (const ConeScene& scene : found.scenes) {
        rows += fmt::format("<tr><td>{}</td>", escapedHtml(scene.name()));
        double all = static_cast<double>(scene.pixelsOf(EdgeKind::kNone));
        for (const EdgeKind kind : kEdgeKinds) all += static_cast<double>(scene.pixelsOf(kind));
        for (const EdgeKind kind : kEdgeKinds)
            rows += percent(static_cast<double>(scene.pixelsOf(kind)) / std::max(all, 1.0));
        for (const char* count :
             {"pixels_doubtful", "pixels_complex", "pixels_counted", "pixels_of_light_borders"})
            rows += percent(scene.shareOf("ctss-x", count));
        rows += "</tr>\n";
    }
    std::string heads = "<th>% of all pixels</th>";
    for (const EdgeKind kind : kEdgeKinds) heads += fmt::format("<th>{}</th>", judge::nameOf(kind));
    return cardTable(heads +
                         "<th>ctss-x: doubtful</th><th>complex</th><th>of these by count</th><th>lights' "
                         "borders</th>",
                     rows);
}

/// The plots of a scene begin with its name.
std::vector<FigurePlot> plotsOf(const std::vector<FigurePlot>& plots, const std::string& prefix) {
    std::vector<FigurePlot> own;
    std::ranges::copy_if(plots, std::back_inserter(own),
                         [&](const FigurePlot& plot) { return plot.name.starts_with(prefix); });
    return own;
}

std::string scenesHtml(const ConeTracing& found, const std::vector<FigurePlot>& plots) {
    std::string out;
    for (const ConeScene& scene : found.scenes) {
        const std::vector<FigurePlot> own = plotsOf(plots, scene.name() + "-");
        if (own.empty()) continue;
        out += fmt::format("<h2>{}</h2><div style='max-width:800px'>", escapedHtml(scene.name())) +
               plotsHtml({own.data(), 1}) + "</div>\n" + compare::kindsTable(scene.judged) +
               "<details><summary>Each kind of edge against time</summary>\n" +
               plotsHtml({own.data() + 1, own.size() - 1}) + "</details>\n";
    }
    return out;
}

std::string rowsTable(const ConeTracing& found) {
    std::string rows;
    for (const ConeScene& scene : found.scenes)
        for (const compare::Row& row : scene.judged.rows)
            rows +=
                fmt::format("<tr><td>{}</td>{}</tr>\n", escapedHtml(scene.name()), compare::reportCells(row));
    return "<details><summary>All rows</summary>\n" +
           cardTable("<th>scene</th>" + compare::reportHeads(), rows) + "</details>\n";
}

std::string notesHtml(const ConeTracing& found) {
    std::string out;
    for (const std::string& note : found.notes) out += fmt::format("<li>{}</li>\n", escapedHtml(note));
    return out.empty() ? ""
                       : "<h2>What could not be measured</h2><div class='card'><ul>" + out + "</ul></div>\n";
}

std::string sizeOf(const ConeTracing& found) {
    for (const ConeScene& scene : found.scenes)
        for (const compare::Row& row : scene.judged.rows) return fmt::format("{}x{}", row.size.x, row.size.y);
    return "";
}

FigureWords wordsOf(const ConeTracing& found) {
    const compare::Machine machine = compare::thisMachine();
    const std::string reference = found.scenes.empty() ? "" : found.scenes.front().judged.reference;
    return {
        "cone-tracing",
        "Error against run time of methods for SDF scenes, by kinds of edges",
        "After Chubarau et al. 2023, sections 3 to 5, and past them: a row is a process of its own, methods "
        "take turns, times are medians without set-up. Kinds of edges are what rays of a lattice meet, not "
        "what colours look like. Gains are means of dB over the scenes that have the kind; costs are "
        "geometric means over the five scenes that Table 1 has, our atrium in the place of its Sponza. The "
        "aims of costs were set for 1280x720 on one software device by itself." +
            std::string(found.quick ? " Here times are of small pictures, which say little of costs." : ""),
        {{"judged", fmt::format("CPU, {}, box filter, reference {}", sizeOf(found), reference)},
         {"times of the aims", found.timed_on},
         {"runs", fmt::format("{}, by turns, after one that does not count", found.runs)},
         {"machine", fmt::format("{}, {} cores", machine.processor, machine.cores)},
         {"time", fmt::format("{:.0f} s for all", found.seconds)},
         {"seed", "0"}},
        {"edgewise compare SCENE -o DIR --filter box --size WxH --device cpu --method ctss-x --method ..."},
        found.quick};
}

}  // namespace

std::string coneTracingHtml(const ConeTracing& found, const std::vector<FigurePlot>& plots) {
    return figurePage(
        wordsOf(found),
        "<h2>What the paper says, and what is asked of ours</h2>" + claimsTable(found) +
            "<h2>ctss-x beside other methods</h2>" + plotsHtml(plotsOf(plots, "over-")) +
            "<h2>Error against time over all scenes</h2>" + plotsHtml(plotsOf(plots, "means-")) +
            scenesHtml(found, plots) + "<h2>Pixels with edges</h2>" + countsTable(found) + "<h2>Times</h2>" +
            timesTable(found) + rowsTable(found) + pictureRowsHtml(found.pictures) + notesHtml(found) +
            "<h2>Definitions</h2><div class='card'>" + compare::reportDefinitions() + "<dl>" +
            judge::edgeKindDefinitions() + "</dl></div>\n");
}

std::string coneTracingJson(const ConeTracing& found) {
    using Json = nlohmann::ordered_json;
    Json scenes = Json::array(), claims = Json::array();
    for (const ConeScene& scene : found.scenes) {
        Json rows = Json::array(), timed = Json::array(), pixels = Json::object();
        for (const compare::Row& row : scene.judged.rows) rows.push_back(compare::rowJson(row));
        for (const compare::Row& row : scene.timed) timed.push_back(compare::rowJson(row));
        pixels[judge::nameOf(EdgeKind::kNone)] = scene.pixelsOf(EdgeKind::kNone);
        for (const EdgeKind kind : kEdgeKinds) pixels[judge::nameOf(kind)] = scene.pixelsOf(kind);
        scenes.push_back({{"scene", scene.name()},
                          {"reference", scene.judged.reference},
                          {"reference_error", compare::referenceErrorJson(scene.judged.reference_error)},
                          {"pixels", pixels},
                          {"rows", rows},
                          {"timed", timed}});
    }
    for (const ConeClaim& claim : claimsOf(found))
        claims.push_back({{"claim", claim.claim},
                          {"here", claim.ours},
                          {"paper", claim.paper},
                          {"aim", claim.bar},
                          {"margin", claim.margin ? Json(*claim.margin) : Json()},
                          {"met", claim.met() ? Json(*claim.met()) : Json()}});
    return jsonText(Json{{"seconds", found.seconds},
                         {"runs", found.runs},
                         {"timed_on", found.timed_on},
                         {"claims", claims},
                         {"scenes", scenes},
                         {"notes", found.notes}},
                    2) +
           "\n";
}

std::string coneTracingCsv(const ConeTracing& found) {
    std::string out = "scene,timed_for," + compare::csvColumns() + "\n";
    for (const ConeScene& scene : found.scenes) {
        const std::string name = compare::csvText(scene.name());
        for (const compare::Row& row : scene.judged.rows)
            out += name + ",errors," + compare::csvFields(row) + "\n";
        for (const compare::Row& row : scene.timed) out += name + ",aims," + compare::csvFields(row) + "\n";
    }
    return out;
}

}  // namespace edgewise::figures
