// A study as its author wrote it: TOML, every value with its line. What the values mean is asked elsewhere.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/sweep/study_problems.h"

namespace edgewise::sweep {

/// A value as a flag would take it: "0.5", "1,2,3".
struct Entry {
    std::string text;
    int line = 0;
};

/// "gaussian" or {name = "gaussian", radius = 1.5, sigma = 0.5}.
struct FilterEntry {
    Entry name;
    std::optional<Entry> radius, sigma;
};

/// "front", 0 or {name = "above", eye = [0, 5, 0], target = [0, 0, 0], fovy = 45}.
struct CameraEntry {
    std::string label;
    int line = 0;
    std::optional<std::string> camera, eye, target, fovy;
};

struct StudyFile {
    std::map<std::string, int> keys;                  ///< the lines of those that are there
    std::map<std::string, std::vector<Entry>> lists;  ///< scenes, methods, radii, sigmas, sizes, no_skip
    std::vector<FilterEntry> filters;
    std::vector<CameraEntry> cameras;
    std::map<std::string, Entry> options;  ///< runs, budget, reference, device, ...

    const std::vector<Entry>& list(const std::string& key) const;
    std::optional<std::string> option(const std::string& key) const;
    int lineOf(const std::string& key) const;  ///< 1 for one that is not there
};

/// Unknown and missing keys, wrong types and empty lists go to `problems`; what they leave is given. Throws
/// InputError "FILE: WHY" for what cannot be read, "FILE:LINE: WHY" for what is no TOML.
StudyFile readStudyFile(const std::string& path, StudyProblems& problems);

}  // namespace edgewise::sweep
