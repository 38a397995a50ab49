// Runs the built edgewise program as a user would.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace edgewise::test {

struct ProgramRun {
    int status = -1;  ///< exit status; 128 + N when signal N ended it
    std::string out, err;
};

using Arguments = std::vector<std::string>;

/// Runs it to its end in `folder`, standard input closed; SIGINT is sent after `interrupt_after_ms`, unless
/// negative.
ProgramRun runProgram(const Arguments& arguments, const std::filesystem::path& folder = ".",
                      int interrupt_after_ms = -1);

/// Another program, found by PATH; status 127 where there is none.
ProgramRun runOther(const std::string& program, const Arguments& arguments,
                    const std::filesystem::path& folder);

/// A fresh folder that goes away with this value.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    /// Names of what lies in it, sorted, hidden files too.
    std::vector<std::string> names() const;

  private:
    std::filesystem::path path_;
};

std::string readFile(const std::filesystem::path& path);
void writeFile(const std::filesystem::path& path, const std::string& text);

/// Every non-empty line of `text`.
std::vector<std::string> lines(const std::string& text);

}  // namespace edgewise::test
