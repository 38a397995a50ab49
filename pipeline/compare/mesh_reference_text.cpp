#include "pipeline/compare/mesh_reference_text.h"

#include <fmt/format.h>

#include "pipeline/html_text.h"

namespace edgewise::compare {
namespace {

std::string shown(const std::optional<PictureDistance>& distance, const std::string& without) {
    return distance ? fmt::format("{:.2e}", distance->rmse) : without;
}

std::string headWords(const Comparison& c) {
    const MeshReference& reference = *c.mesh_reference;
    const MeshLevel& last = reference.levels.back();
    return fmt::format(
        "The reference {} is made of {} meshes of the scene, the last of {} triangles within {:.3g} px of "
        "the "
        "surface. The last one moved it by RMSE {}, which leaves it {} off; {:.0e} was asked for{}. "
        "Silhouettes of the "
        "field and of the first mesh, within {:.3g} px of the surface, are {:.3f} and {:.3f} px apart at "
        "most, "
        "{:.3f} px on average.",
        c.reference, reference.levels.size(), last.mesh.triangles, last.mesh.error_px,
        shown(last.moved, "nothing, being alone"), shown(last.left, "nobody knows how far"), reference.stated,
        reference.reached() ? "" : ", which is not reached", reference.levels.front().mesh.error_px,
        reference.silhouette_there_px, reference.silhouette_back_px, reference.silhouette_mean_px);
}

std::string htmlRow(const Row& row) {
    return fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                       escapedHtml(row.method), row.mesh ? "mesh" : "field",
                       row.error ? fmt::format("{:.2e}", row.error->rmse) : "",
                       shown(row.reference_error, ""), shown(row.antialiasing, "&ndash;"));
}

}  // namespace

std::string meshReferenceWords(const Comparison& c) {
    if (!c.mesh_reference) return "";
    std::string out = headWords(c) + "\n";
    for (const Row& row : c.rows)
        if (row.error)
            out += fmt::format(
                "{:<24} RMSE {:.2e}, the reference's own {}{}\n", row.method, row.error->rmse,
                shown(row.reference_error, "?"),
                row.antialiasing ? fmt::format(", {:.2e} of it antialiasing", row.antialiasing->rmse) : "");
    return out;
}

std::string meshReferenceHtml(const Comparison& c) {
    if (!c.mesh_reference) return "";
    std::string out = fmt::format(
        "</div>\n<h2>Shared geometry</h2><div class='card scroll'><p>{}</p><table><thead><tr><th>method</th>"
        "<th>of the</th><th>RMSE</th><th>the reference's own</th><th>antialiasing alone</th></tr></thead>"
        "<tbody>\n",
        escapedHtml(headWords(c)));
    for (const Row& row : c.rows) out += htmlRow(row);
    return out +
           "</tbody></table><p>The reference's own: what is left of its error, by how much the last mesh "
           "moved it, by the row's "
           "filter; differences of that size between rows mean nothing. Antialiasing alone: of "
           "methods on the reference's first mesh, against exact antialiasing of that mesh; the rest of "
           "their "
           "error is the mesh's.</p>";
}

}  // namespace edgewise::compare
