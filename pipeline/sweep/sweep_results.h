// All jobs of a folder together: what is the same for `edgewise sweep` and `edgewise merge`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/sweep/job_record.h"

namespace edgewise::sweep {

struct SweepResults {
    std::vector<JobRecord> jobs;  ///< by scene, camera, size, filter, radius, sigma, hash
    /// In words: rows of one job, method and device whose errors differ. Errors are the same everywhere.
    std::vector<std::string> disagreements;
};

/// In any order; each job once.
SweepResults resultsOf(std::vector<JobRecord> jobs);

/// What a reader calls a job: "torus-20k, camera front, 640x480, box R 0.5".
std::string titleOf(const JobRecord& job);
/// "host (1a2b3c4d): processor, N threads".
std::string titleOf(const compare::Machine& machine);

/// {machines: {name: {...}}, disagreements, rows}: a row is compare's, with scene, camera, version,
/// reference, job and machine. No word of when, where or in which order.
std::string resultsJson(const SweepResults& results);
/// One line a row: scene, camera, machine and job before compare's columns.
std::string resultsCsv(const SweepResults& results);
/// A tabular with a part for each job and machine.
std::string resultsLatex(const SweepResults& results);

/// Writes results.json, results.csv, table.tex and report.html.
void writeResults(const std::filesystem::path& folder, const SweepResults& results);

}  // namespace edgewise::sweep
