#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "pipeline/cli/command.h"
#include "pipeline/cli/interrupt.h"
#include "pipeline/cli/report.h"
#include "pipeline/cli/result_folder.h"
#include "pipeline/error.h"
#include "pipeline/sweep/sweep_results.h"

namespace edgewise::cli {
namespace {

namespace fs = std::filesystem;

struct MergeArguments {
    std::vector<std::string> folders;
    std::string output;
    bool quiet = false;
};

class Merge {
  public:
    void read(const std::string& folder) {
        std::error_code error;
        if (!fs::is_directory(folder, error)) return refuse(folder, "no such folder");
        // a shard may have had nothing to do
        if (!fs::is_directory(fs::path(folder) / "jobs", error))
            return refuse(folder, "holds no jobs of a sweep");
        const auto files = sweep::recordFiles(folder);
        for (const fs::path& file : files) {
            throwIfInterrupted();
            try {
                add(sweep::readRecord(file));
            } catch (const InputError& problem) {
                problems_.push_back(problem.what());
            }
        }
    }

    sweep::SweepResults results() {
        if (!problems_.empty()) throw ProblemList(problems_, 2);
        std::vector<sweep::JobRecord> records;
        for (auto& [hash, record] : records_) records.push_back(record);
        return sweep::resultsOf(std::move(records));
    }

  private:
    void refuse(const std::string& what, const std::string& why) {
        problems_.push_back(fmt::format("{}: {}", what, why));
    }

    void add(sweep::JobRecord record) {
        const std::string hash = record.hash();
        const auto [found, fresh] = records_.try_emplace(hash, record);
        // a lone record too, so that its results are in order
        found->second = sweep::joined(fresh ? sweep::JobRecord{record.job, {}} : found->second, record);
    }

    std::map<std::string, sweep::JobRecord> records_;
    std::vector<std::string> problems_;
};

void warnOfOddities(const sweep::SweepResults& results) {
    for (const std::string& text : results.disagreements) spdlog::warn("{}", text);
    for (const sweep::JobRecord& job : results.jobs) {
        std::map<std::string, int> times;
        for (const sweep::Measurement& m : job.results)
            if (++times[sweep::machineName(m.machine)] == 2)
                spdlog::warn("{}: was run more than once on the machine {}; all its rows are kept",
                             sweep::titleOf(job), sweep::machineName(m.machine));
    }
}

/// Jobs that lie there would be in no table, or in it though nobody named them.
void checkOutput(const MergeArguments& arguments) {
    std::error_code error;
    if (sweep::recordFiles(arguments.output).empty()) return;
    const auto same = [&](const std::string& folder) {
        return fs::equivalent(folder, arguments.output, error);
    };
    if (std::ranges::none_of(arguments.folders, same))
        throw InputError("-o", fmt::format("{} holds jobs that are not to be joined; name it among them, or "
                                           "take another folder",
                                           arguments.output));
}

void runMerge(const MergeArguments& arguments) {
    Merge merge;
    for (const std::string& folder : arguments.folders) merge.read(folder);
    const sweep::SweepResults results = merge.results();
    checkOutput(arguments);
    const ResultFolder folder(arguments.output);
    for (const sweep::JobRecord& record : results.jobs) {
        throwIfInterrupted();
        sweep::writeRecord(folder.path(), record);
    }
    sweep::writeResults(folder.path(), results);
    warnOfOddities(results);
    if (!arguments.quiet) fmt::print("{} jobs\n{}\n", results.jobs.size(), (folder / "report.html").string());
}

}  // namespace

void addMerge(CLI::App& program) {
    CLI::App* command = program.add_subcommand("merge", "the folders of a sweep's shards as one");
    auto arguments = std::make_shared<MergeArguments>();
    command->add_option("DIR", arguments->folders, "folders of sweep or merge, in any order")->required();
    command
        ->add_option("-o,--output", arguments->output,
                     "jobs/HASH.json, results.json, results.csv, table.tex, report.html")
        ->type_name("DIR")
        ->required();
    command->add_flag("--quiet", arguments->quiet, "no chatter");
    command->callback([arguments] { runMerge(*arguments); });
}

}  // namespace edgewise::cli
