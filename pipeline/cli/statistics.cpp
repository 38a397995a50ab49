#include "pipeline/cli/statistics.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "pipeline/json_text.h"
#include "pipeline/methods/mesh_report.h"

namespace edgewise::cli {
namespace {

double peakMib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;  // Linux counts in KiB
}

}  // namespace

std::string statisticsJson(const MethodResult& result) {
    nlohmann::ordered_json json;
    json["device"] = result.device;
    json["stages"] = nlohmann::ordered_json::object();
    for (const StageTime& stage : result.stages) json["stages"][stage.name] = stage.seconds;
    json["setup_seconds"] = result.setup_seconds;
    json["counts"] = nlohmann::ordered_json::object();
    for (const auto& [name, count] : result.counts) json["counts"][name] = count;
    json["peak_mib"] = peakMib();
    json["plan"] = nlohmann::ordered_json::array();
    for (const PlanEntry& entry : result.plan)
        json["plan"].push_back({{"stage", entry.stage}, {"runs", entry.runs}, {"why", entry.why}});
    if (result.mesh) json["mesh"] = meshJson(result.mesh);
    json["notes"] = result.notes;
    return jsonText(json, 2) + "\n";
}

std::string planInWords(const std::vector<PlanEntry>& plan) {
    std::string text;
    for (const PlanEntry& entry : plan)
        text += fmt::format("{:<12} {:<10} {}\n", entry.stage, entry.runs ? "runs" : "left out", entry.why);
    return text;
}

}  // namespace edgewise::cli
