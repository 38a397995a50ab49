#include <algorithm>

#include "paper_figures/performance.h"

namespace edgewise::figures {
namespace {

std::optional<double> medianOf(const SceneTimes& times, const std::string& method) {
    const compare::Row* row = rowOf(times, method);
    if (!row || row->seconds.empty()) return {};
    return compare::spreadOf(row->seconds).median;
}

Bar barOf(const SceneTimes& times, const std::string& peer, std::optional<double> nsaa) {
    Bar bar{peer, medianOf(times, peer), {}};
    if (nsaa && bar.seconds) bar.ratio = *nsaa / *bar.seconds;
    return bar;
}

}  // namespace

const compare::Row* rowOf(const SceneTimes& times, const std::string& method) {
    const auto& rows = times.comparison.rows;
    const auto found = std::ranges::find(rows, method, &compare::Row::method);
    return found == rows.end() ? nullptr : &*found;
}

std::vector<BarRow> barRows(const Performance& performance) {
    std::vector<BarRow> rows;
    for (const SceneTimes& times : performance.scenes) {
        const std::optional<double> nsaa = medianOf(times, "nsaa");
        rows.push_back(
            {&times, nsaa, barOf(times, times.scene.at_most, nsaa), barOf(times, times.scene.aim, nsaa)});
    }
    return rows;
}

const std::vector<std::string>& nsaaStages() {
    static const std::vector<std::string> stages{"project",    "plan",    "gather",
                                                 "visibility", "weights", "blend"};
    return stages;
}

std::vector<std::string> shownStages(const GrowthSeries& series) {
    std::vector<std::string> stages{"total"};
    if (series.method == "nsaa") stages.insert(stages.end(), nsaaStages().begin(), nsaaStages().end());
    return stages;
}

std::vector<glm::dvec2> growthPoints(const GrowthSeries& series, const std::string& stage) {
    std::vector<glm::dvec2> points;
    for (const GrowthPoint& point : series.points) {
        const compare::Row& row = point.row;
        const auto found = row.stages.find(stage);
        const double seconds = stage == "total"            ? compare::spreadOf(row.seconds).median
                               : found == row.stages.end() ? 0.0
                                                           : compare::spreadOf(found->second).median;
        if (seconds > 0.0) points.emplace_back(point.x, seconds);
    }
    return points;
}

}  // namespace edgewise::figures
