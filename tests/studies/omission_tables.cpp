#include "tests/studies/omission_tables.h"

#include <fmt/format.h>

namespace edgewise::study {
namespace {

double percent(double part, double whole) {
    return 100.0 * part / whole;
}

std::string stageRow(const SceneCosts& costs) {
    double sum = 0.0;
    for (const auto& stage : costs.stages) sum += stage.second;
    const auto share = [&](const char* name) { return percent(costs.stageSeconds(name), sum); };
    return fmt::format(
        "| {} | {:.4f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | **{:.1f}** | **{:.1f}** | "
        "{:.2f} | {} | {} | "
        "{:.0f} |\n",
        costs.scene, costs.total.median(), share("project"), share("plan"), share("gather"),
        share("visibility"), share("weights"), share("blend"), share("visibility") + share("weights"),
        share("project") + share("gather") + share("blend"), costs.nanosecondsPerTerm(),
        costs.counts.at("segments"), costs.counts.at("terms"), costs.peak_mib);
}

std::string omissionRow(const SceneCosts& costs, const OmissionCost& cost, double limit_seconds) {
    const std::string name = cost.fires ? cost.name : "(" + cost.name + ")";
    const double with = cost.with.median(), noise = percent(cost.with.interquartile(), with);
    if (cost.over_limit)
        return fmt::format("| {} | {} | {:.4f} | > {:.0f} | > {:.1f} | {:.1f} | |\n", costs.scene, name, with,
                           limit_seconds, 100.0 - percent(with, limit_seconds), noise);
    return fmt::format("| {} | {} | {:.4f} | {:.4f} | {:.1f} | {:.1f} | {:.1e} |\n", costs.scene, name, with,
                       cost.without.median(), cost.savedPercent(), noise, cost.difference);
}

}  // namespace

std::string describeStudy(const StudyOptions& options) {
    return fmt::format(
        "{} R={}, {}x{} px, {} threads, median of {} interleaved runs of either kind after a warm-up\n\n",
        options.filter.name, options.filter.radius, options.width, options.height,
        options.threads > 0 ? std::to_string(options.threads) : "all", options.runs);
}

std::string omissionTable(const std::vector<SceneCosts>& scenes, const StudyOptions& options) {
    std::string text =
        "`with`: the planner's omission; `without`: --no-skip. `noise`: interquartile range of the default "
        "runs, of "
        "their median. An omission in brackets has no occasion on that scene.\n\n"
        "| scene | omission | s with | s without | saved % | noise % | largest difference |\n"
        "| --- | --- | --- | --- | --- | --- | --- |\n";
    for (const SceneCosts& costs : scenes)
        for (const OmissionCost& cost : costs.omissions)
            text += omissionRow(costs, cost, options.limit_seconds);
    return text + "\n";
}

std::string stageTable(const std::vector<SceneCosts>& scenes) {
    std::string text =
        "Stages in % of their sum. The NSAA paper says of its GPU implementation: exact visibility and "
        "analytic "
        "prefiltering (here `visibility` and `weights`) take more than 90 % of the time, the sections based "
        "on "
        "rasterization (here `project`, `gather` and `blend`) less than 5 %. `ns/term`: seconds of the "
        "weights stage times threads, "
        "by (segment, sample) terms.\n\n"
        "| scene | s | project | plan | gather | visibility | weights | blend | visibility + weights | "
        "project + gather + blend | ns/term | "
        "segments | terms | peak MiB |\n"
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
    for (const SceneCosts& costs : scenes) text += stageRow(costs);
    return text + "\n";
}

}  // namespace edgewise::study
