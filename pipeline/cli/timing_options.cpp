#include "pipeline/cli/timing_options.h"

#include <fmt/format.h>

#include "pipeline/cli/parse_values.h"
#include "pipeline/error.h"

namespace edgewise::cli {

int readRuns(const std::string& option, const std::string& text) {
    return static_cast<int>(parseInteger(option, text, 1, kMostRuns));
}

double readBudget(const std::string& option, const std::string& text) {
    const double seconds = parseNumber(option, text);
    if (!(seconds > 0.0)) throw InputError(option, fmt::format("{} is not more than 0", text));
    return seconds;
}

void throwAsOurs(const compare::WorkerFailure& failure, const std::string& what) {
    const std::string words = failure.what();
    const std::size_t colon = words.find(": ");
    const bool split = colon != std::string::npos;
    const std::string subject = split ? words.substr(0, colon) : what,
                      why = split ? words.substr(colon + 2) : words;
    if (failure.status == 2) throw InputError(subject, why);
    throw FailureError(subject, why);
}

}  // namespace edgewise::cli
