#include "pipeline/cli/report.h"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/Error.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <new>
#include <string>
#include <system_error>

#include "pipeline/cli/interrupt.h"
#include "pipeline/error.h"
#include "pipeline/exit_status.h"

namespace edgewise::cli {
namespace {

/// Control characters (a file name may hold them) would break the line.
std::string oneLine(std::string_view text) {
    std::string line;
    for (const char c : text) {
        if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f)
            line += c;
        else
            line += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    }
    return line;
}

int fail(std::string_view message, int status) {
    printError(message);
    return status;
}

}  // namespace

void printError(std::string_view message) {
    std::fputs(fmt::format("edgewise: error: {}\n", oneLine(message)).c_str(), stderr);
}

void logToStandardError() {
    auto logger =
        std::make_shared<spdlog::logger>("edgewise", std::make_shared<spdlog::sinks::stderr_sink_st>());
    logger->set_pattern("%n: %l: %v");
    spdlog::set_default_logger(std::move(logger));
}

int runAndReport(const std::function<void()>& work) {
    try {
        work();
        if (std::fflush(stdout) != 0) throw FailureError("standard output", "cannot be written");
        return 0;
    } catch (const CLI::ParseError& error) {
        return fail(fmt::format("command line: {}", error.what()), kWrongInputStatus);
    } catch (const ProblemList& problems) {
        for (const std::string& message : problems.messages) printError(message);
        return problems.status;
    } catch (const InputError& error) {
        return fail(error.what(), kWrongInputStatus);
    } catch (const Interrupted&) {
        return kInterruptedStatus;
    } catch (const FailureError& error) {
        return fail(error.what(), kFailedStatus);
    } catch (const std::bad_alloc&) {
        return fail("memory: not enough for this picture", kFailedStatus);
    } catch (const std::filesystem::filesystem_error& error) {
        return fail(fmt::format("{}: {}", error.path1().string(), error.code().message()), kFailedStatus);
    } catch (const std::system_error& error) {  // fmt::print on a full disk; files go through atomic_file
        return fail(fmt::format("standard output: {}", error.code().message()), kFailedStatus);
    } catch (const std::exception& error) {
        return fail(fmt::format("internal: {}", error.what()), kFailedStatus);
    }
}

}  // namespace edgewise::cli
