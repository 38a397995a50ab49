// How the program speaks: errors and warnings as single lines on standard error, exit statuses.
#pragma once

#include <functional>
#include <string_view>

namespace edgewise::cli {

/// "edgewise: error: MESSAGE", in one line whatever the message holds.
void printError(std::string_view message);

/// "edgewise: warning: MESSAGE" for every spdlog warning from now on.
void logToStandardError();

/// Runs `work`, prints what it throws, and gives the exit status of the contract: 0, 1, 2 or 130.
int runAndReport(const std::function<void()>& work);

}  // namespace edgewise::cli
