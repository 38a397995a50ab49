#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <memory>
#include <optional>
#include <set>
#include <string>

#include "pipeline/cli/command.h"
#include "pipeline/cli/interrupt.h"
#include "pipeline/cli/report.h"
#include "pipeline/cli/result_folder.h"
#include "pipeline/cli/shard.h"
#include "pipeline/cli/study.h"
#include "pipeline/cli/timing_options.h"
#include "pipeline/cli/worker_flags.h"
#include "pipeline/compare/judge_row.h"
#include "pipeline/error.h"
#include "pipeline/progress_bar.h"
#include "pipeline/sweep/sweep_results.h"

namespace edgewise::cli {
namespace {

struct SweepArguments {
    std::string study, folder;
    std::optional<std::string> shard;
    bool resume = false, quiet = false;
};

/// Says before each stage which job it belongs to.
class JobProgress : public Progress {
  public:
    JobProgress(Progress& all, std::string label) : all_(all), label_(std::move(label)) {}
    void stage(std::string_view name, std::size_t total) override {
        all_.stage(fmt::format("{} {}", label_, name), total);
    }
    void advance(std::size_t done) override { all_.advance(done); }
    bool cancelled() override { return all_.cancelled(); }

  private:
    Progress& all_;
    std::string label_;
};

class Sweep {
  public:
    Sweep(const SweepArguments& arguments, const Study& study, const Shard& shard, const ResultFolder& folder,
          Progress& progress)
        : arguments_(arguments), study_(study), shard_(shard), folder_(folder), progress_(progress) {}

    void run() {
        for (std::size_t i = 0; i < study_.jobs.size(); ++i)
            if (shard_.has(i)) take(study_.jobs[i], fmt::format("{}/{}", i + 1, study_.jobs.size()));
        warnOfStrangers();
        summarize();
    }

    std::string outcome() const {
        return fmt::format("{} jobs made, {} kept, {} failed, of {} (shard {}/{})", made_, kept_, failed_,
                           study_.jobs.size(), shard_.index, shard_.count);
    }
    std::size_t failed() const { return failed_; }

  private:
    void take(const StudyJob& job, const std::string& label) {
        const std::optional<sweep::JobRecord> there = recordOf(job);
        if (arguments_.resume && there) {
            ++kept_;
            return;
        }
        try {
            JobProgress progress(progress_, label);
            const sweep::JobRecord record{job.key, {measure(job, progress)}};
            throwIfInterrupted();  // Ctrl-C ends the workers too, and their rows would say that they failed
            sweep::writeRecord(folder_.path(), there ? joined(record, *there) : record);
            ++made_;
        } catch (const InputError& error) {
            failed(job, error.what());
        } catch (const FailureError& error) {
            failed(job, error.what());
        }
    }

    /// The other machines' rows of a record, or all where this one is to be kept.
    std::optional<sweep::JobRecord> recordOf(const StudyJob& job) const {
        try {
            return sweep::readRecord(sweep::recordPath(folder_.path(), job.hash));
        } catch (const InputError&) {
            return {};
        }
    }

    sweep::JobRecord joined(const sweep::JobRecord& fresh, sweep::JobRecord there) const {
        const std::string here = sweep::machineName(fresh.results.front().machine);
        std::erase_if(there.results,
                      [&](const sweep::Measurement& m) { return sweep::machineName(m.machine) == here; });
        return sweep::joined(fresh, there);
    }

    std::vector<std::string> flagsOf(const StudyJob& job, const std::string& method) const {
        return workerFlags(job.picture, job.filter, study_.making, method);
    }

    sweep::Measurement measure(const StudyJob& job, Progress& progress) const {
        std::vector<compare::Contender> contenders;
        sweep::Measurement measurement{compare::thisMachine(), {}};
        const Prefilter filter = readFilter(job.filter);
        for (const std::string& method : job.methods) {
            contenders.push_back({method, flagsOf(job, method)});
            measurement.rows.push_back(compare::rowOf(parseMethod(method), filter));
        }
        compare::ScheduleOptions options = study_.schedule;
        options.scratch = folder_.path();
        try {
            compare::Row reference;
            const compare::ReferencePicture truth = compare::referenceOf(
                {job.reference, flagsOf(job, job.reference)}, options.scratch, reference, progress);
            for (compare::Row& row : measurement.rows) row.size = reference.size;
            compare::runByTurns(
                contenders, options, measurement.rows,
                [&](std::size_t i, const ImageBuffer& picture) {
                    compare::judgeRow(measurement.rows[i], picture, truth);
                },
                [](std::size_t) {}, progress);
        } catch (const compare::WorkerFailure& failure) {
            throwIfInterrupted();
            throwAsOurs(failure, "sweep");
        }
        return measurement;
    }

    void failed(const StudyJob& job, const std::string& why) {
        ++failed_;
        wipeProgressLine();
        printError(fmt::format("job {}: {} {}: {}", job.hash, job.key.at("scene").get<std::string>(),
                               job.filter.name, why));
    }

    void warnOfStrangers() const {
        std::set<std::string> ours;
        for (const StudyJob& job : study_.jobs) ours.insert(job.hash);
        std::size_t strangers = 0;
        for (const auto& file : sweep::recordFiles(folder_.path())) strangers += !ours.contains(file.stem());
        if (strangers > 0)
            spdlog::warn("{}: {} jobs of another study, scene or version are in the tables too",
                         folder_.path().string(), strangers);
    }

    /// Other shards may write here too: whoever ends last has seen all jobs.
    void summarize() const {
        std::filesystem::create_directory(folder_ / "jobs");  // there even where this shard has none
        for (auto files = sweep::recordFiles(folder_.path());;) {
            std::vector<sweep::JobRecord> records;
            for (const auto& file : files) {
                throwIfInterrupted();
                try {
                    records.push_back(sweep::readRecord(file));
                } catch (const InputError& error) {
                    spdlog::warn("left out: {}", error.what());
                }
            }
            const sweep::SweepResults results = sweep::resultsOf(std::move(records));
            sweep::writeResults(folder_.path(), results);
            const auto now = sweep::recordFiles(folder_.path());
            if (now == files) {
                for (const std::string& text : results.disagreements) spdlog::warn("{}", text);
                return;
            }
            files = now;
        }
    }

    const SweepArguments& arguments_;
    const Study& study_;
    Shard shard_;
    const ResultFolder& folder_;
    Progress& progress_;
    std::size_t made_ = 0, kept_ = 0, failed_ = 0;
};

void runSweep(const SweepArguments& arguments) {
    const Shard shard = readShard(arguments.shard);
    ProgressBar progress(!arguments.quiet && isatty(STDERR_FILENO), interruptFlag());
    const Study study = readStudy(arguments.study, progress);
    const ResultFolder folder(arguments.folder);
    Sweep sweep(arguments, study, shard, folder, progress);
    sweep.run();
    wipeProgressLine();
    throwIfInterrupted();
    if (!arguments.quiet) fmt::print("{}\n{}\n", sweep.outcome(), (folder / "report.html").string());
    if (sweep.failed() > 0)
        throw FailureError("sweep", fmt::format("{} jobs failed; --resume tries them again", sweep.failed()));
}

}  // namespace

void addSweep(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("sweep", "error against run time for many scenes, methods, filters and sizes");
    auto arguments = std::make_shared<SweepArguments>();
    command->add_option("STUDY", arguments->study, "a TOML file: what to vary; README.md has its keys")
        ->required();
    command
        ->add_option("-o,--output", arguments->folder,
                     "jobs/HASH.json, and of all of them results.json, results.csv, table.tex, report.html")
        ->type_name("DIR")
        ->required();
    command
        ->add_option(
            "--shard", arguments->shard,
            "every n-th job from the i-th on [from SLURM_ARRAY_TASK_ID or OMPI_COMM_WORLD_RANK, or all]")
        ->type_name("i/n");
    command->add_flag("--resume", arguments->resume, "keep the jobs that DIR has");
    command->add_flag("--quiet", arguments->quiet, "no progress bar, no chatter");
    command->callback([arguments] { runSweep(*arguments); });
}

}  // namespace edgewise::cli
