#include <fmt/format.h>

#include <algorithm>

#include "paper_figures/page_parts.h"
#include "paper_figures/shared_geometry.h"
#include "pipeline/compare/comparison_report.h"
#include "pipeline/compare/comparison_tables.h"
#include "pipeline/compare/mesh_reference_text.h"
#include "pipeline/compare/pareto_plot.h"
#include "pipeline/html_table.h"
#include "pipeline/html_text.h"

namespace edgewise::figures {
namespace {

using compare::Comparison, compare::Row;

const Row* findRow(const Comparison& scene, const std::string& method) {
    const auto found = std::ranges::find(scene.rows, method, &Row::method);
    return found == scene.rows.end() || !found->error || found->seconds.empty() ? nullptr : &*found;
}

/// "A 1.2, B 3.4": a value a scene.
template <class Value>
std::string overScenes(const SharedGeometry& found, const Value& value) {
    std::string out;
    for (const Comparison& scene : found.scenes) {
        const std::string text = value(scene);
        if (!text.empty()) out += (out.empty() ? "" : "; ") + scene.scene + " " + text;
    }
    return out;
}

std::string timeRatio(const Comparison& scene, const std::string& method) {
    const Row *row = findRow(scene, method), *none = findRow(scene, "none");
    if (!row || !none) return "";
    return fmt::format("{:.2f}",
                       compare::spreadOf(row->seconds).median / compare::spreadOf(none->seconds).median);
}

std::string samplesOf(const Comparison& scene, const std::string& method) {
    const Row* row = findRow(scene, method);
    if (!row) return "";
    const auto samples = samplesFor(row->error->rmse, scene.rows);
    return samples ? fmt::format("{:.1f}", *samples) : "outside of what ssaa was asked";
}

std::string scenesTable(const SharedGeometry& found) {
    std::string rows;
    for (const Comparison& scene : found.scenes) {
        if (!scene.mesh_reference) continue;
        const compare::MeshReference& reference = *scene.mesh_reference;
        const compare::MeshLevel &first = reference.levels.front(), &last = reference.levels.back();
        rows += fmt::format("<tr><td>{}</td>", escapedHtml(scene.scene)) +
                numberCell(static_cast<double>(first.mesh.triangles), "{:.0f}") +
                numberCell(first.mesh.error_px, "{:.3f}") + numberCell(first.mesh.seconds, "{:.1f}") +
                numberCell(reference.silhouette_there_px, "{:.3f}") +
                numberCell(reference.silhouette_back_px, "{:.3f}") +
                numberCell(static_cast<double>(last.mesh.triangles), "{:.0f}") +
                numberCell(last.mesh.error_px, "{:.3f}") +
                numberCell(last.left ? last.left->rmse : 0.0, "{:.2e}") + "</tr>\n";
    }
    return cardTable(
        "<th>scene</th><th>triangles of rows</th><th>off the surface, px</th><th>meshing, "
        "s</th><th>silhouette of "
        "the field to the mesh's, px</th><th>and back</th><th>triangles of the reference</th><th>off the "
        "surface, "
        "px</th><th>the reference's own RMSE</th>",
        rows);
}

std::string rowsTable(const SharedGeometry& found) {
    std::string rows;
    for (const Comparison& scene : found.scenes)
        for (const Row& row : scene.rows)
            rows += fmt::format(
                "<tr><td>{}</td>{}{}{}</tr>\n", escapedHtml(scene.scene), compare::reportCells(row),
                row.reference_error ? numberCell(row.reference_error->rmse, "{:.2e}") : "<td></td>",
                row.antialiasing ? numberCell(row.antialiasing->rmse, "{:.2e}") : "<td></td>");
    return cardTable("<th>scene</th>" + compare::reportHeads() +
                         "<th>the reference's own RMSE</th><th>antialiasing alone, RMSE</th>",
                     rows) +
           "<h2>Definitions</h2><div class='card'>" + compare::reportDefinitions() + "</div>\n";
}

std::string notesHtml(const SharedGeometry& found) {
    std::string out;
    for (const std::string& note : found.notes) out += fmt::format("<li>{}</li>\n", escapedHtml(note));
    return out.empty() ? ""
                       : "<h2>What could not be measured</h2><div class='card'><ul>" + out + "</ul></div>\n";
}

std::string headlinesHtml(const SharedGeometry& found) {
    std::string out;
    for (const Comparison& scene : found.scenes)
        out += "<p style='white-space:pre-line'><b>" + escapedHtml(scene.scene) + "</b><br>" +
               escapedHtml(compare::meshReferenceWords(scene)) + "</p>\n";
    return out;
}

FigureWords wordsOf(const SharedGeometry& found) {
    const compare::Machine machine = compare::thisMachine();
    const Row* row = found.scenes.empty() ? nullptr : &found.scenes.front().rows.front();
    return {
        "shared-geometry",
        "Both families on one geometry",
        "The scenes of that name without their ground and without shadows, so that every edge is one of "
        "geometry; the sponge is turned back to the axes, where its mesh is exact. nsaa, rt and mesh+M make "
        "their pictures of a mesh of the field, by dual contouring, "
        "within "
        "a fifth of a pixel of it where it is closest to the eye, and shade it by the field's own materials; "
        "the others trace the field. The reference is nsaa on ever finer meshes, until what is left "
        "of its own error, by how much the picture moves, is small: the end of what can be told. Meshing is "
        "set-up, "
        "not time. All filters are a pixel's box.",
        {{"reference", found.reference + " on meshes of half the error each"},
         {"size", row ? fmt::format("{} x {}", row->size.x, row->size.y) : "none"},
         {"filter", "box, R 0.5"},
         {"runs", fmt::format("{}, by turns, after one that does not count", found.runs)},
         {"machine", fmt::format("{}, {} cores", machine.processor, machine.cores)},
         {"time", fmt::format("{:.0f} s for all", found.seconds)},
         {"seed", "0"}},
        {"edgewise compare SCENE.sdf.json -o DIR --filter box --size WxH --reference nsaa --method M ..."},
        found.quick};
}

}  // namespace

void addSharedClaims(const SharedGeometry& found, std::vector<FigureClaim>& claims) {
    claims.push_back({"NSAA, section 4.2", "what a reference without samples errs by: RMSE", "",
                      overScenes(found,
                                 [](const Comparison& scene) {
                                     const auto& reference = scene.mesh_reference;
                                     return reference && reference->levels.back().left
                                                ? fmt::format("{:.1e}", reference->levels.back().left->rmse)
                                                : "";
                                 }),
                      "",
                      "the mesh of a field is not the field: what is left of the error by how finer meshes "
                      "move the picture"});
    claims.push_back(
        {"CTSS, section 1", "samples a pixel of SSAA with the same error as CTSS", "4 to 8",
         overScenes(found, [](const Comparison& s) { return samplesOf(s, "ctss"); }), "",
         "RMSE over all pixels of scenes whose creases inside the outline are not CTSS's to mend"});
    claims.push_back({"CTSS, abstract", "time of CTSS over no antialiasing", "1.15 to 1.3",
                      overScenes(found, [](const Comparison& s) { return timeRatio(s, "ctss"); }), "",
                      "one CPU's time of scenes that shade cheaply"});
    claims.push_back({"ours", "samples a pixel of SSAA with the same error as ctss-x", "",
                      overScenes(found, [](const Comparison& s) { return samplesOf(s, "ctss-x"); }), "", ""});
    claims.push_back({"ours", "samples a pixel of SSAA with the same error as nsaa on the rows' mesh", "",
                      overScenes(found, [](const Comparison& s) { return samplesOf(s, "nsaa"); }), "",
                      "nsaa errs by its mesh alone"});
    claims.push_back({"Lottes", "samples a pixel of SSAA with the same error", "",
                      overScenes(found, [](const Comparison& s) { return samplesOf(s, "lottes"); }), "",
                      "one frame; its scheme blurs, and adds grain"});
}

std::vector<FigurePlot> sharedGeometryPlots(const SharedGeometry& found) {
    std::vector<FigurePlot> plots;
    for (const Comparison& scene : found.scenes)
        plots.push_back(
            {"pareto-" + scene.scene,
             fmt::format("{}, {} x {}", scene.scene, scene.rows.front().size.x, scene.rows.front().size.y),
             compare::paretoSvg(scene)});
    return plots;
}

std::string sharedGeometryHtml(const SharedGeometry& found, const std::vector<FigurePlot>& plots) {
    return figurePage(wordsOf(found), plotsHtml(plots) + "<h2>Meshes and silhouettes</h2>" +
                                          scenesTable(found) + "<div class='card'>" + headlinesHtml(found) +
                                          "</div>\n<h2>All rows</h2>" + rowsTable(found) + notesHtml(found));
}

std::string sharedGeometryCsv(const SharedGeometry& found) {
    const auto text = [](const std::optional<compare::PictureDistance>& d) {
        return d ? fmt::format("{}", d->rmse) : "";
    };
    std::string out =
        "scene," + compare::csvColumns() + ",reference_rmse,antialiasing_rmse,triangles,mesh_error_px\n";
    for (const Comparison& scene : found.scenes)
        for (const Row& row : scene.rows)
            out +=
                fmt::format("{},{},{},{},{}\n", compare::csvText(scene.scene), compare::csvFields(row),
                            text(row.reference_error), text(row.antialiasing),
                            row.mesh ? fmt::format("{},{}", row.mesh->triangles, row.mesh->error_px) : ",");
    return out;
}

}  // namespace edgewise::figures
