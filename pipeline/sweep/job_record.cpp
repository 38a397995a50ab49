#include "pipeline/sweep/job_record.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/atomic_file.h"
#include "pipeline/compare/comparison_tables.h"
#include "pipeline/error.h"
#include "pipeline/read_file.h"
#include "pipeline/sweep/content_hash.h"

namespace edgewise::sweep {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr const char* kFormat = "edgewise sweep job 1";

Json measurementJson(const Measurement& measurement) {
    Json rows = Json::array();
    for (const compare::Row& row : measurement.rows) rows.push_back(Json::parse(compare::rowToText(row)));
    return {{"machine", compare::machineJson(measurement.machine)}, {"rows", rows}};
}

Measurement measurementFrom(const Json& json) {
    const Json& machine = json.at("machine");
    Measurement measurement{
        {machine.at("host"), machine.at("processor"), machine.at("cores"), machine.at("memory_mib")}, {}};
    for (const Json& row : json.at("rows")) measurement.rows.push_back(compare::rowFromText(row.dump()));
    return measurement;
}

/// Where it stands among others, and whether it equals one.
std::pair<std::string, std::string> orderOf(const Measurement& measurement) {
    return {machineName(measurement.machine), measurementJson(measurement).dump()};
}

bool isRecordName(const fs::path& path) {
    const std::string stem = path.stem().string();
    return path.extension() == ".json" && stem.size() == 32 &&
           stem.find_first_not_of("0123456789abcdef") == std::string::npos;
}

}  // namespace

std::string JobRecord::hash() const {
    return contentHash(job.dump());
}

std::string machineName(const compare::Machine& machine) {
    return contentHash(fmt::format("{}\n{}\n{}", machine.host, machine.processor, machine.cores))
        .substr(0, 8);
}

std::string recordText(const JobRecord& record) {
    Json results = Json::array();
    for (const Measurement& measurement : record.results) results.push_back(measurementJson(measurement));
    return Json{{"format", kFormat}, {"job", record.job}, {"results", results}}.dump(1) + "\n";
}

JobRecord recordFromText(const std::string& text, const std::string& where) {
    try {
        const Json json = Json::parse(text);
        if (json.at("format") != kFormat) throw InputError(where, "is no job of a sweep, by its format");
        JobRecord record{json.at("job"), {}};
        for (const char* key : {"scene", "camera", "version", "reference"})
            record.job.at(key).get_ref<const std::string&>();
        for (const Json& result : json.at("results")) record.results.push_back(measurementFrom(result));
        return record;
    } catch (const nlohmann::json::exception& error) {
        throw InputError(where, fmt::format("is no job of a sweep: {}", error.what()));
    } catch (const FailureError& error) {  // of a row
        throw InputError(where, fmt::format("is no job of a sweep: {}", error.what()));
    }
}

JobRecord joined(const JobRecord& a, const JobRecord& b) {
    JobRecord record = a;
    record.results.insert(record.results.end(), b.results.begin(), b.results.end());
    std::ranges::sort(record.results, {}, orderOf);
    const auto again = std::ranges::unique(record.results, {}, orderOf);
    record.results.erase(again.begin(), again.end());
    return record;
}

fs::path recordPath(const fs::path& folder, const std::string& hash) {
    return folder / "jobs" / (hash + ".json");
}

JobRecord readRecord(const fs::path& path) {
    JobRecord record = recordFromText(readText(path), path.string());
    if (record.hash() != path.stem())
        throw InputError(path.string(), fmt::format("holds the job {}, not that of its name", record.hash()));
    return record;
}

void writeRecord(const fs::path& folder, const JobRecord& record) {
    const fs::path path = recordPath(folder, record.hash());
    std::error_code error;
    fs::create_directory(path.parent_path(), error);
    if (error) throw FailureError(path.parent_path().string(), error.message());
    writeAtomically(path, recordText(record));
}

std::vector<fs::path> recordFiles(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator each(folder / "jobs", error), end; !error && each != end;
         each.increment(error))
        if (isRecordName(each->path())) files.push_back(each->path());
    if (error && fs::exists(folder / "jobs")) throw FailureError((folder / "jobs").string(), error.message());
    std::ranges::sort(files);
    return files;
}

}  // namespace edgewise::sweep
