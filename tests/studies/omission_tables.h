// What was measured, as Markdown.
#pragma once

#include "tests/studies/omission_runs.h"

namespace edgewise::study {

/// How the numbers came to be: filter, size, threads, runs.
std::string describeStudy(const StudyOptions& options);

/// scene | omission | median seconds with and without | saved | noise | largest difference
std::string omissionTable(const std::vector<SceneCosts>& scenes, const StudyOptions& options);

/// scene | each stage's share, beside what the paper says | work and memory
std::string stageTable(const std::vector<SceneCosts>& scenes);

}  // namespace edgewise::study
