#include "tests/cli/run_program.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace edgewise::test {
namespace {

constexpr int kCannotStart = 127;

void redirect(int descriptor, const std::filesystem::path& path, int flags) {
    const int file = open(path.c_str(), flags, 0600);
    if (file < 0 || dup2(file, descriptor) < 0) _exit(kCannotStart);
}

[[noreturn]] void becomeProgram(std::string program, const Arguments& arguments,
                                const std::filesystem::path& folder, const TemporaryFolder& streams) {
    redirect(STDIN_FILENO, "/dev/null", O_RDONLY);
    redirect(STDOUT_FILENO, streams / "out", O_WRONLY | O_CREAT);
    redirect(STDERR_FILENO, streams / "err", O_WRONLY | O_CREAT);
    std::vector<char*> argv{program.data()};
    std::vector<std::string> copies = arguments;
    for (std::string& argument : copies) argv.push_back(argument.data());
    argv.push_back(nullptr);
    if (chdir(folder.c_str()) == 0) execvp(program.c_str(), argv.data());
    _exit(kCannotStart);
}

ProgramRun run(const std::string& program, const Arguments& arguments, const std::filesystem::path& folder,
               int interrupt_after_ms) {
    const TemporaryFolder streams;
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("fork");
    if (child == 0) {
        setpgid(0, 0);
        becomeProgram(program, arguments, folder, streams);
    }
    if (interrupt_after_ms >= 0) {
        std::this_thread::sleep_for(std::chrono::milliseconds(interrupt_after_ms));
        kill(-child, SIGINT);  // as a terminal does: its workers get it too
    }
    int status = 0;
    waitpid(child, &status, 0);
    ProgramRun result;
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    result.out = readFile(streams / "out");
    result.err = readFile(streams / "err");
    return result;
}

}  // namespace

ProgramRun runProgram(const Arguments& arguments, const std::filesystem::path& folder,
                      int interrupt_after_ms) {
    return run(EDGEWISE_PROGRAM, arguments, folder, interrupt_after_ms);
}

ProgramRun runOther(const std::string& program, const Arguments& arguments,
                    const std::filesystem::path& folder) {
    return run(program, arguments, folder, -1);
}

TemporaryFolder::TemporaryFolder() {
    std::string pattern = std::filesystem::temp_directory_path() / "edgewise_test_XXXXXX";
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("mkdtemp");
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string> TemporaryFolder::names() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
        names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
}

std::string readFile(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

void writeFile(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

std::vector<std::string> lines(const std::string& text) {
    std::vector<std::string> result;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        if (!line.empty()) result.push_back(line);
    return result;
}

}  // namespace edgewise::test
