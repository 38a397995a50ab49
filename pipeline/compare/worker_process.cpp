#include "pipeline/compare/worker_process.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>

#include <boost/asio.hpp>
#include <boost/process.hpp>
#include <filesystem>
#include <iostream>

#include "pipeline/error.h"
#include "pipeline/exit_status.h"
#include "pipeline/json_text.h"

namespace edgewise::compare {
namespace {

namespace bp = boost::process;
namespace asio = boost::asio;
using Clock = std::chrono::steady_clock;

/// Between looks at whether the user has had enough.
constexpr std::chrono::milliseconds kPatience{50};

}  // namespace

struct WorkerProcess::State {
    explicit State(const std::vector<std::string>& arguments)
        : from(context),
          child(std::filesystem::read_symlink("/proc/self/exe").string(), bp::args(arguments),
                bp::std_in<to, bp::std_out> from) {}

    asio::io_context context;
    bp::opstream to;
    bp::async_pipe from;
    bp::child child;
    asio::streambuf received;

    /// False where it has not come in time; what has come is kept.
    bool readLine(std::string& line, Clock::time_point until, Progress& progress) {
        bool done = false, ended = false;
        asio::async_read_until(from, received, '\n',
                               [&](const boost::system::error_code& error, std::size_t) {
                                   done = true, ended = static_cast<bool>(error);
                               });
        context.restart();
        while (!done) {
            context.run_for(kPatience);
            if (context.stopped()) context.restart();
            const bool cancelled = !done && progress.cancelled(), late = !done && Clock::now() > until;
            if (cancelled || late) stop();
            if (cancelled) throw Interrupted();
            if (late) return false;
        }
        if (ended) throwHowItEnded();
        std::istream stream(&received);
        std::getline(stream, line);
        return true;
    }

    /// boost::process takes what it has terminated for waited for, and leaves a zombie.
    void end() {
        std::error_code error;
        if (child.running(error)) ::kill(child.id(), SIGKILL);
        child.wait(error);
    }

    void stop() {
        end();
        from.close();
        context.run();  // the read that was under way
    }

    /// Who interrupts a terminal's program interrupts its workers with it.
    [[noreturn]] void throwHowItEnded() {
        child.wait();
        const int how = child.native_exit_code();
        if (WIFSIGNALED(how)) {
            if (WTERMSIG(how) == SIGINT) throw Interrupted();
            throw WorkerFailure(fmt::format("its process was ended by signal {}", WTERMSIG(how)),
                                kFailedStatus);
        }
        if (child.exit_code() == kInterruptedStatus) throw Interrupted();
        throw WorkerFailure(fmt::format("its process ended with status {}", child.exit_code()),
                            child.exit_code());
    }
};

nlohmann::json pathJson(const std::filesystem::path& path) {
    const std::string& bytes = path.native();
    return std::vector<unsigned char>(bytes.begin(), bytes.end());
}

std::filesystem::path pathFrom(const nlohmann::json& json) {
    const auto bytes = json.get<std::vector<unsigned char>>();
    return std::string(bytes.begin(), bytes.end());
}

WorkerProcess::WorkerProcess(const std::vector<std::string>& arguments)
    : state_(std::make_unique<State>(arguments)) {}
WorkerProcess::WorkerProcess(WorkerProcess&&) noexcept = default;

WorkerProcess::~WorkerProcess() {
    if (state_) state_->end();
}

nlohmann::json WorkerProcess::ask(const nlohmann::json& request, std::chrono::duration<double> at_most,
                                  Progress& progress) {
    const auto until = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                          std::min(at_most, std::chrono::duration<double>(1e7)));
    state_->to << jsonText(request) << std::endl;
    std::string line;
    if (!state_->readLine(line, until, progress)) throw WorkerTimeout();
    nlohmann::json reply = nlohmann::json::parse(line);
    if (reply.contains("error")) throw WorkerFailure(reply.at("error"), reply.at("status"));
    return reply;
}

}  // namespace edgewise::compare
