// A job of a sweep and its results, a file each: DIR/jobs/HASH.json.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pipeline/compare/comparison.h"

namespace edgewise::sweep {

/// One machine's rows of a job.
struct Measurement {
    compare::Machine machine;
    std::vector<compare::Row> rows;
};

struct JobRecord {
    nlohmann::ordered_json
        job;  ///< all that its rows depend on but the machine: what its name is the hash of
    std::vector<Measurement> results;  ///< sorted; a job that two machines ran has two

    std::string hash() const;
};

/// The first 8 digits of the hash of host, processor and cores: times with other names are not comparable.
std::string machineName(const compare::Machine& machine);

std::string recordText(const JobRecord& record);
/// Throws InputError "WHERE: WHY" for what recordText() has not written.
JobRecord recordFromText(const std::string& text, const std::string& where);

/// The results of both, equal ones once, in an order of their own. The jobs are the same.
JobRecord joined(const JobRecord& a, const JobRecord& b);

std::filesystem::path recordPath(const std::filesystem::path& folder, const std::string& hash);
/// Throws InputError for one that is not there, is no record, or is another job's.
JobRecord readRecord(const std::filesystem::path& path);
/// Whole or not at all.
void writeRecord(const std::filesystem::path& folder, const JobRecord& record);

/// The records' files in folder/jobs, sorted by name.
std::vector<std::filesystem::path> recordFiles(const std::filesystem::path& folder);

}  // namespace edgewise::sweep
