// What is wrong with a study, all of it.
#pragma once

#include <string>
#include <vector>

namespace edgewise::sweep {

class StudyProblems {
  public:
    explicit StudyProblems(std::string path) : path_(std::move(path)) {}

    /// The same one again is no other. `limit`: the machine's, not the study's.
    void add(int line, const std::string& key, const std::string& why, bool limit = false);
    bool empty() const { return found_.empty(); }
    /// Every one is a limit of the machine.
    bool limitsAlone() const;
    /// "FILE:LINE: KEY: WHY" in the order of the lines.
    std::vector<std::string> messages() const;

  private:
    struct Problem {
        int line;
        std::string text;
        bool limit;
        bool operator==(const Problem&) const = default;
    };
    std::string path_;
    std::vector<Problem> found_;
};

}  // namespace edgewise::sweep
