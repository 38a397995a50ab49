#include "pipeline/sweep/sweep_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "pipeline/atomic_file.h"
#include "pipeline/compare/comparison_tables.h"
#include "pipeline/json_text.h"
#include "pipeline/sweep/sweep_report.h"

namespace edgewise::sweep {
namespace {

using Json = nlohmann::ordered_json;
using compare::Row;

std::string textOf(const Json& value) {
    return value.is_string() ? value.get<std::string>() : "";
}

/// All rows of a job have one filter and one size.
const Row* anyRow(const JobRecord& job) {
    for (const Measurement& m : job.results)
        if (!m.rows.empty()) return &m.rows.front();
    return nullptr;
}

auto orderOf(const JobRecord& job) {
    const Row* row = anyRow(job);
    const Row& r = row ? *row : Row{};
    return std::make_tuple(textOf(job.job.at("scene")), textOf(job.job.at("camera")), r.size.x, r.size.y,
                           r.filter, r.radius, r.sigma.value_or(0.0), job.hash());
}

/// What two machines have to agree on.
std::string errorText(const Row& row) {
    return row.error ? judge::metricsJson(*row.error).dump() : "";
}

void findDisagreements(const JobRecord& job, std::set<std::string>& found) {
    std::map<std::pair<std::string, std::string>, std::pair<std::string, std::string>> first;
    for (const Measurement& m : job.results)
        for (const Row& row : m.rows) {
            if (!row.error) continue;
            const std::string machine = machineName(m.machine);
            const auto [seen, fresh] = first.try_emplace({row.method, row.device}, errorText(row), machine);
            if (!fresh && seen->second.first != errorText(row))
                found.insert(fmt::format("{}: the errors of '{}' on {} differ between the machines {} and {}",
                                         titleOf(job), row.method, row.device, seen->second.second, machine));
        }
}

template <class Use>
void forEachRow(const SweepResults& results, Use&& use) {
    for (const JobRecord& job : results.jobs)
        for (const Measurement& m : job.results)
            for (const Row& row : m.rows) use(job, m, row);
}

}  // namespace

SweepResults resultsOf(std::vector<JobRecord> jobs) {
    std::ranges::sort(jobs, {}, orderOf);
    std::set<std::string> disagreements;
    for (const JobRecord& job : jobs) findDisagreements(job, disagreements);
    return {std::move(jobs), {disagreements.begin(), disagreements.end()}};
}

std::string titleOf(const JobRecord& job) {
    std::string title = textOf(job.job.at("scene"));
    if (const std::string camera = textOf(job.job.at("camera")); !camera.empty())
        title += ", camera " + camera;
    if (const Row* row = anyRow(job)) {
        title += fmt::format(", {}x{}, {} R {}", row->size.x, row->size.y, row->filter, row->radius);
        if (row->sigma) title += fmt::format(" s {:.3g}", *row->sigma);
    }
    return title;
}

std::string titleOf(const compare::Machine& machine) {
    return fmt::format("{} ({}): {}, {} threads", machine.host, machineName(machine), machine.processor,
                       machine.cores);
}

std::string resultsJson(const SweepResults& results) {
    std::map<std::string, Json> machines;
    Json rows = Json::array();
    forEachRow(results, [&](const JobRecord& job, const Measurement& m, const Row& row) {
        const std::string machine = machineName(m.machine);
        machines.try_emplace(machine, compare::machineJson(m.machine));
        Json json{{"scene", job.job.at("scene")},
                  {"camera", job.job.at("camera")},
                  {"reference", job.job.at("reference")},
                  {"version", job.job.at("version")},
                  {"job", job.hash()},
                  {"machine", machine}};
        json.update(compare::rowJson(row));
        rows.push_back(std::move(json));
    });
    return jsonText(Json{{"machines", machines}, {"disagreements", results.disagreements}, {"rows", rows}},
                    2) +
           "\n";
}

std::string resultsCsv(const SweepResults& results) {
    std::string out = "scene,camera,machine,job," + compare::csvColumns() + "\n";
    forEachRow(results, [&](const JobRecord& job, const Measurement& m, const Row& row) {
        out += fmt::format("{},{},{},{},{}\n", compare::csvText(textOf(job.job.at("scene"))),
                           compare::csvText(textOf(job.job.at("camera"))), machineName(m.machine), job.hash(),
                           compare::csvFields(row));
    });
    return out;
}

std::string resultsLatex(const SweepResults& results) {
    std::string out = "\\begin{tabular}{lrrrrrrr}\n\\hline\n" + compare::latexColumns() + " \\\\\n\\hline\n";
    for (const JobRecord& job : results.jobs)
        for (const Measurement& m : job.results) {
            out += fmt::format("\\multicolumn{{8}}{{l}}{{{}; {}}} \\\\\n", compare::latexText(titleOf(job)),
                               compare::latexText(titleOf(m.machine)));
            for (const Row& row : m.rows) out += compare::latexFields(row) + " \\\\\n";
            out += "\\hline\n";
        }
    return out + "\\end{tabular}\n";
}

void writeResults(const std::filesystem::path& folder, const SweepResults& results) {
    writeAtomically(folder / "results.json", resultsJson(results));
    writeAtomically(folder / "results.csv", resultsCsv(results));
    writeAtomically(folder / "table.tex", resultsLatex(results));
    writeAtomically(folder / "report.html", resultsHtml(results));
}

}  // namespace edgewise::sweep
