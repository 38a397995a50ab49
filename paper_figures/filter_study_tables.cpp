#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "paper_figures/filter_study.h"
#include "pipeline/json_text.h"
#include "pipeline/version.h"

namespace edgewise::figures {
namespace {

using Json = nlohmann::ordered_json;

Json edgeJson(const EdgeEnergy& e) {
    return {{"blur_px", e.blur}, {"aliasing_px", e.aliasing}, {"aliasing_share", e.share}};
}

Json alongJson(const AlongDirection& a) {
    return {{"angle", a.angle},
            {"edge", edgeJson(a.edge)},
            {"overshoot", a.overshoot},
            {"edge_width_px", a.width_px},
            {"half_response", a.half_response},
            {"at_nyquist", a.at_nyquist},
            {"step_residual", a.step_residual},
            {"response_residual", a.response_residual},
            {"response_residual_of_bound", a.residual_of_bound}};
}

Json rowJson(const FilterStudy& study, const FilterRow& row) {
    Json patterns = Json::object();
    for (std::size_t i = 0; i < row.patterns.size(); ++i)
        patterns[study.patterns[i]] = {{"aliased_rms", row.patterns[i].rms},
                                       {"aliased_share", row.patterns[i].share}};
    return {{"filter",
             {{"name", row.filter.name},
              {"radius", row.filter.radius},
              {"sigma", row.filter.sigma ? Json(*row.filter.sigma) : Json()}}},
            {"edge", edgeJson(row.mean_edge)},
            {"axis", alongJson(row.axis)},
            {"diagonal", alongJson(row.diagonal)},
            {"negative_area", row.negative_area},
            {"second_moment_px2", row.second_moment_px2},
            {"anisotropy", row.anisotropy},
            {"patterns", patterns}};
}

/// As CSV has names with commas.
std::string quoted(const std::string& name) {
    return name.find(',') == std::string::npos ? name : "\"" + name + "\"";
}

}  // namespace

std::string filterStudyJson(const FilterStudy& study) {
    Json json{{"figure", "filter-study"},       {"version", version()},     {"quick", study.quick},
              {"samples_per_px", study.per_px}, {"part_px", study.part_px}, {"rows", Json::array()}};
    for (const FilterRow& row : study.rows) json["rows"].push_back(rowJson(study, row));
    return jsonText(json, 2) + "\n";
}

std::string filterStudyCsv(const FilterStudy& study) {
    std::string out =
        "filter,radius,sigma,edge_blur_px,edge_aliasing_px,edge_aliasing_share,width_axis_px,width_diagonal_"
        "px,"
        "half_response_axis,half_response_diagonal,at_nyquist_axis,at_nyquist_diagonal,overshoot_axis,"
        "overshoot_diagonal,negative_area,second_moment_px2,anisotropy,step_residual,response_residual,"
        "response_residual_of_bound";
    for (const std::string& pattern : study.patterns)
        out += fmt::format(",{0}_aliased_rms,{0}_aliased_share", pattern);
    out += "\n";
    for (const FilterRow& r : study.rows) {
        const AlongDirection &a = r.axis, &d = r.diagonal;
        out += fmt::format(
            "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", quoted(r.filter.name),
            r.filter.radius, r.filter.sigma ? fmt::format("{}", *r.filter.sigma) : "", r.mean_edge.blur,
            r.mean_edge.aliasing, r.mean_edge.share, a.width_px, d.width_px, a.half_response, d.half_response,
            a.at_nyquist, d.at_nyquist, a.overshoot, d.overshoot, r.negative_area, r.second_moment_px2,
            r.anisotropy, std::max(a.step_residual, d.step_residual),
            std::max(a.response_residual, d.response_residual),
            std::max(a.residual_of_bound, d.residual_of_bound));
        for (const PatternRow& p : r.patterns) out += fmt::format(",{},{}", p.rms, p.share);
        out += "\n";
    }
    return out;
}

std::string responseCsv(const FilterStudy& study) {
    std::string out = "filter,radius,frequency,axis,axis_measured,diagonal,diagonal_measured\n";
    for (const FilterRow& r : study.rows)
        for (int i = 0; i <= kShownSteps; ++i)
            out += fmt::format("{},{},{},{},{},{},{}\n", quoted(r.filter.name), r.filter.radius,
                               kShownFrequency * i / kShownSteps, r.axis.response[i], r.axis.measured[i],
                               r.diagonal.response[i], r.diagonal.measured[i]);
    return out;
}

std::string stepCsv(const FilterStudy& study) {
    std::string out = "filter,radius,distance_px,axis,diagonal\n";
    for (const FilterRow& r : study.rows)
        for (int i = 0; i <= kShownSteps; ++i)
            out += fmt::format("{},{},{},{},{}\n", quoted(r.filter.name), r.filter.radius,
                               kShownReach * (2.0 * i / kShownSteps - 1), r.axis.step[i], r.diagonal.step[i]);
    return out;
}

std::string filterStudyLatex(const FilterStudy& study) {
    std::string out =
        "\\begin{tabular}{lrrrrrrr}\n\\hline\n"
        "filter & $R$ & aliasing, \\% & blur, $10^{-3}$ px & width, px & MTF50 & overshoot, \\% & anisotropy "
        "\\\\\n\\hline\n";
    for (const FilterRow& r : study.rows)
        out += fmt::format("{} & {:g} & {:.3g} & {:.2f} & {:.2f} & {:.3f} & {:.2f} & {:.3f} \\\\\n",
                           r.filter.name, r.filter.radius, 100 * r.mean_edge.share, 1000 * r.mean_edge.blur,
                           r.axis.width_px, r.axis.half_response, 100 * r.axis.overshoot, r.anisotropy);
    return out + "\\hline\n\\end{tabular}\n";
}

}  // namespace edgewise::figures
