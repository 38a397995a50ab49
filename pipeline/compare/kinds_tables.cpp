#include "pipeline/compare/kinds_tables.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/html_table.h"
#include "pipeline/html_text.h"

namespace edgewise::compare {
namespace {

using judge::EdgeKind, judge::KindError, judge::KindErrors;

struct Column {
    std::string name;  ///< of a heading
    std::string key;   ///< of a CSV column
    KindError error;
    std::optional<EdgeKind> kind = {};  ///< none: all edges together
};

/// All edges, each kind, and the rest.
std::vector<Column> columnsOf(const KindErrors& kinds) {
    std::vector<Column> columns{{"all edges", "edges", kinds.edges()}};
    for (const EdgeKind kind : judge::kEdgeKinds)
        columns.push_back({judge::nameOf(kind), judge::nameOf(kind), kinds.of(kind), kind});
    columns.push_back({"no edge", "no_edge", kinds.of(EdgeKind::kNone), EdgeKind::kNone});
    return columns;
}

struct Line {
    std::string name;
    const KindErrors* kinds;
};

/// Methods, then the reference.
std::vector<Line> linesOf(const Comparison& c) {
    std::vector<Line> lines;
    for (const Row& row : c.rows)
        if (row.kinds) lines.push_back({row.method, &*row.kinds});
    if (c.reference_error)
        lines.push_back({fmt::format("{} itself, by {}", c.reference, c.reference_error->judge),
                         &c.reference_error->kinds});
    return lines;
}

std::string cell(const KindError& error) {
    const std::optional<double> psnr = error.psnr();
    if (error.pixels == 0) return emptyCell();
    return psnr ? numberCell(*psnr, "{:.2f}") : sortedCell(1e9, "no error");
}

std::string textOf(const KindError& error) {
    if (error.pixels == 0) return "-";
    const std::optional<double> psnr = error.psnr();
    return psnr ? fmt::format("{:.2f}", *psnr) : "exact";
}

/// In the colours of the picture of kinds.
std::string headOf(const Column& column) {
    const std::string swatch =
        column.kind ? fmt::format("<i style='display:inline-block;width:9px;height:9px;background:{}'></i> ",
                                  judge::colorOf(*column.kind))
                    : "";
    return fmt::format("<th>{}{}<br>{} pixels</th>", swatch, column.name, column.error.pixels);
}

std::string ownErrorHtml(const Comparison& c) {
    if (!c.reference_error) return "<p>The reference's own error is not known.</p>";
    return fmt::format(
        "<p>The last line is the reference's own error: {} on {} pixels, a quarter of the rows. What a "
        "method reaches near it tells of both.</p>",
        escapedHtml(c.reference_error->judge),
        c.reference_error->kinds.edges().pixels + c.reference_error->kinds.of(EdgeKind::kNone).pixels);
}

}  // namespace

nlohmann::ordered_json kindsJson(const std::optional<KindErrors>& kinds) {
    return kinds ? judge::kindErrorsJson(*kinds) : nlohmann::ordered_json();
}

nlohmann::ordered_json referenceErrorJson(const std::optional<ReferenceError>& error) {
    if (!error) return nullptr;
    return {{"judge", error->judge}, {"kinds", judge::kindErrorsJson(error->kinds)}};
}

std::string kindsCsvColumns() {
    std::string out;
    for (const Column& column : columnsOf({}))
        out += fmt::format("{0}{1}_pixels,{1}_rmse,{1}_psnr", out.empty() ? "" : ",", column.key);
    return out;
}

std::string kindsCsvFields(const std::optional<KindErrors>& kinds) {
    std::string out;
    bool first = true;
    for (const Column& column : columnsOf(kinds.value_or(KindErrors()))) {
        out += first ? "" : ",";
        first = false;
        const KindError& e = column.error;
        const std::optional<double> psnr = e.psnr();
        out += kinds ? fmt::format("{},{},{}", e.pixels, e.pixels > 0 ? fmt::format("{}", e.rmse()) : "",
                                   psnr ? fmt::format("{}", *psnr) : "")
                     : ",,";
    }
    return out;
}

bool tellsKinds(const Comparison& comparison) {
    return std::ranges::any_of(comparison.rows, [](const Row& row) { return row.kinds.has_value(); });
}

std::string kindsTable(const Comparison& c) {
    if (!tellsKinds(c)) return "";
    const std::vector<Line> lines = linesOf(c);
    std::string heads = "<th>dB of PSNR</th>", rows;
    for (const Column& column : columnsOf(*lines.front().kinds)) heads += headOf(column);
    for (const Line& line : lines) {
        rows += fmt::format("<tr><td>{}</td>", escapedHtml(line.name));
        for (const Column& column : columnsOf(*line.kinds)) rows += cell(column.error);
        rows += "</tr>\n";
    }
    return cardTable(heads, rows, "", ownErrorHtml(c));
}

std::string kindsText(const Comparison& c) {
    if (!tellsKinds(c)) return "";
    const std::vector<Line> lines = linesOf(c);
    std::size_t widest = 0;
    for (const Line& line : lines) widest = std::max(widest, line.name.size());
    std::string out = fmt::format("{:<{}}", "dB of PSNR", widest),
                pixels = fmt::format("{:<{}}", "pixels", widest);
    for (const Column& column : columnsOf(*lines.front().kinds))
        out += fmt::format("{:>12}", column.name), pixels += fmt::format("{:>12}", column.error.pixels);
    out += "\n" + pixels + "\n";
    for (const Line& line : lines) {
        out += fmt::format("{:<{}}", line.name, widest);
        for (const Column& column : columnsOf(*line.kinds))
            out += fmt::format("{:>12}", textOf(column.error));
        out += "\n";
    }
    return out;
}

}  // namespace edgewise::compare
