#include "pipeline/sweep/study_problems.h"

#include <fmt/format.h>

#include <algorithm>

namespace edgewise::sweep {

void StudyProblems::add(int line, const std::string& key, const std::string& why, bool limit) {
    const Problem problem{line, fmt::format("{}: {}", key, why), limit};
    if (std::ranges::find(found_, problem) == found_.end()) found_.push_back(problem);
}

bool StudyProblems::limitsAlone() const {
    return !found_.empty() && std::ranges::all_of(found_, &Problem::limit);
}

std::vector<std::string> StudyProblems::messages() const {
    std::vector<Problem> sorted = found_;
    std::ranges::stable_sort(sorted, {}, &Problem::line);
    std::vector<std::string> messages;
    for (const Problem& problem : sorted)
        messages.push_back(fmt::format("{}:{}: {}", path_, problem.line, problem.text));
    return messages;
}

}  // namespace edgewise::sweep
