// A process that makes one method's pictures, asked line by line: each method has its own memory.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "pipeline/progress.h"

namespace edgewise::compare {

/// It did not answer in time.
struct WorkerTimeout : std::runtime_error {
    WorkerTimeout() : std::runtime_error("the budget is spent") {}
};

/// It ended, or it said why it cannot go on.
struct WorkerFailure : std::runtime_error {
    WorkerFailure(const std::string& message, int exit_status)
        : std::runtime_error(message), status(exit_status) {}
    int status;  ///< of the contract
};

/// A path as a request has it: by bytes, since JSON's text is UTF-8 and a path need not be.
nlohmann::json pathJson(const std::filesystem::path& path);
std::filesystem::path pathFrom(const nlohmann::json& json);

class WorkerProcess {
  public:
    /// This program with these arguments; its standard error is ours.
    explicit WorkerProcess(const std::vector<std::string>& arguments);
    /// It is ended.
    ~WorkerProcess();
    WorkerProcess(WorkerProcess&&) noexcept;

    /// Sends a line of JSON and waits for one. Throws WorkerTimeout, after which it is ended, WorkerFailure
    /// with the worker's own words, Interrupted when cancelled.
    nlohmann::json ask(const nlohmann::json& request, std::chrono::duration<double> at_most,
                       Progress& progress);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace edgewise::compare
