#include "paper_figures/claims_table.h"

#include <fmt/format.h>

#include "paper_figures/page_parts.h"
#include "pipeline/compare/comparison_tables.h"
#include "pipeline/html_table.h"
#include "pipeline/html_text.h"

namespace edgewise::figures {
namespace {

/// Words have no unit.
std::string withUnit(const std::string& number, const std::string& unit) {
    const bool ends_in_digit = !number.empty() && number.back() >= '0' && number.back() <= '9';
    return ends_in_digit && !unit.empty() ? number + " " + unit : number;
}

std::string words(const std::string& text) {
    return fmt::format("<td style='text-align:left;white-space:normal'>{}</td>", escapedHtml(text));
}

std::string rowOf(const ClaimsOf& of, const FigureClaim& claim) {
    const std::string name = escapedHtml(of.figure->name);
    return fmt::format(
               "<tr><td>{}</td><td>{}</td>",
               of.page.empty() ? name : fmt::format("<a href='{}'>{}</a>", escapedHtml(of.page), name),
               escapedHtml(claim.place)) +
           words(claim.claim) + words(withUnit(claim.paper, claim.unit)) +
           words(withUnit(claim.ours, claim.unit)) + words(claim.why) + "</tr>\n";
}

}  // namespace

std::string claimsHtml(const std::vector<ClaimsOf>& all) {
    std::string rows;
    for (const ClaimsOf& of : all)
        for (const FigureClaim& claim : of.claims) rows += rowOf(of, claim);
    if (rows.empty()) return "";
    return cardTable(
        "<th>figure</th><th>place</th><th style='text-align:left'>claim</th><th "
        "style='text-align:left'>paper says</th><th style='text-align:left'>we measure</th><th "
        "style='text-align:left'>why they differ</th>",
        rows);
}

std::string claimsCsv(const std::vector<ClaimsOf>& all) {
    std::string out = "figure,of,place,claim,paper,ours,unit,why\n";
    for (const ClaimsOf& of : all)
        for (const FigureClaim& claim : of.claims) {
            std::string row;
            for (const std::string& field : {of.figure->name, of.figure->source, claim.place, claim.claim,
                                             claim.paper, claim.ours, claim.unit, claim.why})
                row.append(compare::csvText(field)).append(1, ',');
            row.back() = '\n';
            out += row;
        }
    return out;
}

}  // namespace edgewise::figures
