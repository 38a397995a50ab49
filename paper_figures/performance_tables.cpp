#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "paper_figures/performance.h"
#include "paper_figures/stage_ideals.h"
#include "pipeline/compare/comparison_tables.h"
#include "pipeline/json_text.h"
#include "pipeline/version.h"

namespace edgewise::figures {
namespace {

using Json = nlohmann::ordered_json;

Json orNull(const std::optional<double>& value) {
    return value ? Json(*value) : Json();
}

std::string orEmpty(const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : "";
}

Json barJson(const Bar& bar) {
    return {{"peer", bar.peer},
            {"seconds", orNull(bar.seconds)},
            {"ratio", orNull(bar.ratio)},
            {"met", bar.ratio ? Json(bar.met()) : Json()}};
}

Json barsJson(const Performance& found) {
    Json bars = Json::array();
    for (const BarRow& row : barRows(found))
        bars.push_back({{"scene", row.times->scene.title},
                        {"nsaa_seconds", orNull(row.nsaa_seconds)},
                        {"at_most", barJson(row.at_most)},
                        {"aim", barJson(row.aim)},
                        {"remark", row.times->scene.remark}});
    return bars;
}

Json sceneJson(const SceneTimes& times, const MachineRates& rates) {
    Json rows = Json::array(), distances = Json::array(), units = Json::array();
    for (const compare::Row& row : times.comparison.rows) rows.push_back(compare::rowJson(row));
    if (const compare::Row* nsaa = rowOf(times, "nsaa"); nsaa && !nsaa->seconds.empty()) {
        for (const StageDistance& d : stageDistances(*nsaa, rates))
            distances.push_back({{"stage", d.stage},
                                 {"seconds", d.seconds},
                                 {"bytes", d.bytes},
                                 {"flops", d.flops},
                                 {"ideal_seconds", d.ideal_seconds},
                                 {"distance", d.distance()}});
        for (const UnitCost& unit : unitCosts(*nsaa))
            units.push_back({{"stage", unit.stage},
                             {"count", unit.count},
                             {"number", unit.number},
                             {"nanoseconds", unit.nanoseconds}});
    }
    return {{"title", times.scene.title},
            {"scene", times.scene.name},
            {"reference", times.comparison.reference},
            {"rows", rows},
            {"units", units},
            {"ideals", distances}};
}

Json fitJson(const std::optional<PowerFit>& fit) {
    if (!fit) return nullptr;
    return {{"exponent", fit->exponent},
            {"standard_error", orNull(fit->standard_error)},
            {"local", {fit->least_local, fit->most_local}}};
}

Json growthJson(const GrowthSeries& series) {
    Json points = Json::array(), fits = Json::object();
    for (const GrowthPoint& point : series.points)
        points.push_back({{"x", point.x}, {"row", compare::rowJson(point.row)}});
    for (const std::string& stage : shownStages(series))
        fits[stage] = fitJson(fitPower(growthPoints(series, stage)));
    return {{"family", series.family},
            {"method", series.method},
            {"by", series.by_triangles ? "triangles" : "pixels a side"},
            {"points", points},
            {"fits", fits}};
}

}  // namespace

std::string performanceJson(const Performance& found) {
    Json json{{"figure", "performance"},
              {"version", version()},
              {"quick", found.quick},
              {"runs", found.runs},
              {"machine", compare::machineJson(found.machine)},
              {"bytes_per_second", found.rates.bytes_per_second},
              {"flops_per_second", found.rates.flops_per_second},
              {"instruction_set", found.rates.instruction_set},
              {"bars", barsJson(found)},
              {"scenes", Json::array()},
              {"growth", Json::array()},
              {"notes", found.notes}};
    for (const SceneTimes& times : found.scenes) json["scenes"].push_back(sceneJson(times, found.rates));
    for (const GrowthSeries& series : found.growth) json["growth"].push_back(growthJson(series));
    return jsonText(json, 2) + "\n";
}

std::string performanceCsv(const Performance& found) {
    std::string out = "scene," + compare::csvColumns() + "\n";
    for (const SceneTimes& times : found.scenes)
        for (const compare::Row& row : times.comparison.rows)
            out += compare::csvText(times.scene.title) + "," + compare::csvFields(row) + "\n";
    return out;
}

std::string barsCsv(const Performance& found) {
    std::string out =
        "scene,nsaa_seconds,at_most,at_most_seconds,at_most_ratio,at_most_met,aim,aim_seconds,aim_ratio,"
        "aim_met\n";
    const auto fields = [](const Bar& bar) {
        return fmt::format(",{},{},{},{}", bar.peer, orEmpty(bar.seconds), orEmpty(bar.ratio),
                           !bar.ratio  ? ""
                           : bar.met() ? "yes"
                                       : "no");
    };
    for (const BarRow& row : barRows(found))
        out += compare::csvText(row.times->scene.title) + "," + orEmpty(row.nsaa_seconds) +
               fields(row.at_most) + fields(row.aim) + "\n";
    return out;
}

std::string growthCsv(const Performance& found) {
    std::string out = "family,method,by,stage,x,seconds,exponent,standard_error,least_local,most_local\n";
    for (const GrowthSeries& series : found.growth)
        for (const std::string& stage : shownStages(series)) {
            const auto points = growthPoints(series, stage);
            const auto fit = fitPower(points);
            for (const glm::dvec2& p : points)
                out +=
                    fmt::format("{},{},{},{},{},{}{}\n", series.family, compare::csvText(series.method),
                                series.by_triangles ? "triangles" : "pixels a side", stage, p.x, p.y,
                                fit ? fmt::format(",{},{},{},{}", fit->exponent, orEmpty(fit->standard_error),
                                                  fit->least_local, fit->most_local)
                                    : ",,,,");
        }
    return out;
}

std::string stagesCsv(const Performance& found) {
    std::string out = "scene,stage,seconds,bytes,flops,ideal_seconds,distance\n";
    for (const SceneTimes& times : found.scenes) {
        const compare::Row* nsaa = rowOf(times, "nsaa");
        if (!nsaa) continue;
        for (const StageDistance& d : stageDistances(*nsaa, found.rates))
            out += fmt::format("{},{},{},{},{},{},{}\n", compare::csvText(times.scene.title), d.stage,
                               d.seconds, d.bytes, d.flops, d.ideal_seconds, d.distance());
    }
    return out;
}

std::string barsLatex(const Performance& found) {
    std::string out =
        "\\begin{tabular}{lrlrrlrr}\n\\hline\nscene & nsaa, ms & bar & ms & ratio & aim & ms & ratio "
        "\\\\\n\\hline\n";
    const auto milliseconds = [](const std::optional<double>& seconds) {
        return seconds ? fmt::format("{:.1f}", 1e3 * *seconds) : "";
    };
    const auto fields = [&](const Bar& bar) {
        return fmt::format(" & {} & {} & {}", compare::latexText(bar.peer), milliseconds(bar.seconds),
                           bar.ratio ? fmt::format("{:.2f}", *bar.ratio) : "");
    };
    for (const BarRow& row : barRows(found))
        out += compare::latexText(row.times->scene.title) + " & " + milliseconds(row.nsaa_seconds) +
               fields(row.at_most) + fields(row.aim) + " \\\\\n";
    return out + "\\hline\n\\end{tabular}\n";
}

}  // namespace edgewise::figures
