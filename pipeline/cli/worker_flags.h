// What was typed for a picture, as flags again: a worker makes the same one.
#pragma once

#include <string>
#include <vector>

#include "pipeline/cli/filter_options.h"
#include "pipeline/cli/method_options.h"
#include "pipeline/cli/picture_options.h"

namespace edgewise::cli {

std::vector<std::string> workerFlags(const PictureArguments& picture, const FilterArguments& filter,
                                     const MethodArguments& making, const std::string& method);

}  // namespace edgewise::cli
