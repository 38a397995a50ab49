#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "paper_figures/page_parts.h"
#include "paper_figures/planner.h"
#include "paper_figures/value_grid.h"
#include "pipeline/compare/comparison_tables.h"
#include "pipeline/html_table.h"
#include "pipeline/html_text.h"

namespace edgewise::figures {
namespace {

std::size_t placeOf(std::vector<std::string>& names, const std::string& name) {
    const auto found = std::ranges::find(names, name);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    names.push_back(name);
    return names.size() - 1;
}

/// Nothing where the plan makes no use of it; pale at 1, dark at eight times.
GridCell cellOf(const Saving& saving) {
    if (!saving.used || !saving.ratio) return {};
    return {fmt::format("{}{:.2f}", saving.at_least ? "> " : "", *saving.ratio),
            std::log2(*saving.ratio) / 3.0, false};
}

FigurePlot savingsPlot(const std::vector<Saving>& savings, bool field) {
    ValueGrid grid{field ? "What tracing saves" : "What nsaa saves", {}, {}, {}};
    for (const Saving& saving : savings)
        if (saving.field == field) placeOf(grid.rows, saving.scene), placeOf(grid.columns, saving.name);
    grid.cells.resize(grid.rows.size() * grid.columns.size());
    for (const Saving& saving : savings)
        if (saving.field == field)
            grid.cells[placeOf(grid.rows, saving.scene) * grid.columns.size() +
                       placeOf(grid.columns, saving.name)] = cellOf(saving);
    return {field ? "savings-sdf" : "savings-triangles",
            field ? "SDF scenes, sphere: the whole time without the cone prepass, without pruned tapes, "
                    "without the "
                    "convex shortcut, over the time as planned. Empty: the plan has no use for it here."
                  : "Triangles, nsaa: the whole time with what is left out forced to run, over the time as "
                    "planned. "
                    "Empty: the plan leaves nothing of the kind out.",
            valueGridSvg(grid)};
}

std::string milliseconds(double seconds) {
    return numberCell(1e3 * seconds, "{:.3g}");
}

std::string savingsTable(const std::vector<Saving>& savings) {
    std::string rows;
    for (const Saving& s : savings) {
        rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td>", escapedHtml(s.scene),
                            escapedHtml(s.name), s.used ? "yes" : "no") +
                numberCell(s.ratio, s.at_least ? "&gt; {:.2f}" : "{:.2f}");
        rows += s.stage.empty() ? "<td></td>" + emptyCell() + emptyCell()
                                : "<td>" + s.stage + "</td>" + milliseconds(s.stage_without) +
                                      milliseconds(s.stage_planned);
        rows +=
            fmt::format("<td style='white-space:normal;text-align:left'>{}</td></tr>\n", escapedHtml(s.why));
    }
    return cardTable(
        "<th>scene</th><th>saving</th><th>in use</th><th>time without, in the plan's</th><th>stage that "
        "gains most</th>"
        "<th>ms without</th><th>ms</th><th>the plan says</th>",
        rows);
}

std::string notesHtml(const Planner& found) {
    std::string out;
    for (const std::string& note : found.notes) out += fmt::format("<li>{}</li>\n", escapedHtml(note));
    return out.empty() ? ""
                       : "<h2>What could not be measured</h2><div class='card'><ul>" + out + "</ul></div>\n";
}

std::string sizeOf(const Planner& found, bool field) {
    for (const PlannerScene& scene : found.scenes)
        if (scene.field == field)
            return fmt::format("{} x {}, {}, R {}", scene.planned.size.x, scene.planned.size.y,
                               scene.planned.filter, scene.planned.radius);
    return "none";
}

}  // namespace

std::vector<FigurePlot> plannerPlots(const Planner& found) {
    const std::vector<Saving> savings = savingsOf(found);
    std::vector<FigurePlot> plots;
    for (const bool field : {false, true})
        if (std::ranges::any_of(savings, [&](const Saving& s) { return s.field == field; }))
            plots.push_back(savingsPlot(savings, field));
    return plots;
}

std::string plannerHtml(const Planner& found, const std::vector<FigurePlot>& plots) {
    const compare::Machine machine = compare::thisMachine();
    const FigureWords words{
        "planner",
        "What the plan leaves out",
        "A plan looks at a scene and leaves out what it does not need. Here each of these is forced to run, "
        "alone "
        "and all together, and the times are compared with those of the plan. The picture has the same bits "
        "either "
        "way. Where the plan makes no use of a saving, forcing changes nothing, and a ratio tells the noise.",
        {{"triangles", sizeOf(found, false)},
         {"SDF scenes", sizeOf(found, true)},
         {"runs", fmt::format("{}, by turns, after one that does not count; at most {:.0f} s each",
                              found.runs, found.budget_seconds)},
         {"machine", fmt::format("{}, {} cores", machine.processor, machine.cores)},
         {"seed", "0"}},
        {"edgewise render SCENE -o OUT.exr --no-skip NAME --explain --stats FILE.json",
         "edgewise render SCENE -o OUT.exr --method sphere:prune=off --explain --stats FILE.json"},
        found.quick};
    return figurePage(
        words, plotsHtml(plots) + "<h2>One by one</h2>" + savingsTable(savingsOf(found)) + notesHtml(found));
}

std::string plannerCsv(const Planner& found) {
    std::string out = "scene,saving,in_use,ratio,at_least,stage,stage_seconds_without,stage_seconds,why\n";
    for (const Saving& s : savingsOf(found))
        out += fmt::format("{},{},{},{},{},{},{},{},{}\n", compare::csvText(s.scene), s.name, s.used,
                           s.ratio ? fmt::format("{}", *s.ratio) : "", s.at_least, s.stage, s.stage_without,
                           s.stage_planned, compare::csvText(s.why));
    return out;
}

}  // namespace edgewise::figures
