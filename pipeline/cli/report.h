// How the program speaks: errors and warnings as single lines on standard error, exit statuses.
#pragma once

#include <exception>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace edgewise::cli {

/// What is wrong, all of it: a line each, and the exit status of the contract.
struct ProblemList : std::exception {
    ProblemList(std::vector<std::string> lines, int exit_status)
        : messages(std::move(lines)), status(exit_status) {}
    const char* what() const noexcept override { return messages.empty() ? "" : messages.front().c_str(); }
    std::vector<std::string> messages;
    int status;
};

/// "edgewise: error: MESSAGE", in one line whatever the message holds.
void printError(std::string_view message);

/// "edgewise: warning: MESSAGE" for every spdlog warning from now on.
void logToStandardError();

/// Runs `work`, prints what it throws, and gives the exit status of the contract: 0, 1, 2 or 130.
int runAndReport(const std::function<void()>& work);

}  // namespace edgewise::cli
