// A study's meaning: the jobs that it asks for.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pipeline/cli/filter_options.h"
#include "pipeline/cli/method_options.h"
#include "pipeline/cli/picture_options.h"
#include "pipeline/compare/schedule.h"
#include "pipeline/progress.h"

namespace edgewise::cli {

/// A (scene, camera, size, filter) and its methods, which take turns and share the reference. Methods with a
/// box of their own belong to the job of box R 0.5, and make one where the study has none.
struct StudyJob {
    PictureArguments picture;
    FilterArguments filter;
    std::vector<std::string> methods;
    std::string reference;
    nlohmann::ordered_json key;  ///< all that its rows depend on but the machine
    std::string hash;            ///< of the key
};

struct Study {
    MethodArguments making;
    compare::ScheduleOptions schedule;
    std::vector<StudyJob> jobs;  ///< by scene, camera, size, filter, as the study lists them
};

/// Reads the file and every scene. Throws ProblemList with all that is wrong, and warns of what scenes use
/// and edgewise ignores.
Study readStudy(const std::string& path, Progress& progress);

}  // namespace edgewise::cli
