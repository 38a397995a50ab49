// What every command that times methods against a reference shares.
#pragma once

#include <string>

#include "pipeline/compare/worker_process.h"

namespace edgewise::cli {

inline constexpr const char* kUsualReference = "nsaa,device=cpu";
inline constexpr const char* kUsualFieldReference = "ssaa:16";  ///< of SDF scenes
inline constexpr const char* kUsualRuns = "5";
inline constexpr int kMostRuns = 10000;

/// Timed runs a method, from 1 to kMostRuns. Throws InputError "OPTION: WHY".
int readRuns(const std::string& option, const std::string& text);
/// Seconds a method, above 0. Throws InputError "OPTION: WHY".
double readBudget(const std::string& option, const std::string& text);

/// The worker's words as our own error, of its status; "WHAT: " stands before those that name nothing.
[[noreturn]] void throwAsOurs(const compare::WorkerFailure& failure, const std::string& what);

}  // namespace edgewise::cli
