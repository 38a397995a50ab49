#include "pipeline/compare/schedule.h"

#include <fmt/format.h>

#include "pipeline/compare/raw_image.h"
#include "pipeline/compare/worker_process.h"
#include "pipeline/error.h"
#include "pipeline/exit_status.h"
#include "pipeline/methods/mesh_report.h"
#include "pipeline/scoped_path.h"

namespace edgewise::compare {
namespace {

using Json = nlohmann::json;

void takeRun(const Json& reply, Row& row) {
    row.seconds.push_back(reply.at("seconds"));
    row.setup_seconds.push_back(reply.at("setup_seconds"));
    for (const auto& [name, seconds] : reply.at("stages").items()) row.stages[name].push_back(seconds);
}

/// One contender and what is left of its budget.
class Turn {
  public:
    Turn(const Contender& contender, std::size_t index, double budget, Row& row)
        : contender_(contender), index_(index), left_(budget), row_(row) {}

    bool wants(int runs) const { return alive_ && static_cast<int>(row_.seconds.size()) < runs; }

    /// The first run is for warmth: it gives the picture, and counts only where the budget left no other.
    void warmUp(const ScheduleOptions& options, const TakePicture& take, Progress& progress) {
        worker_.emplace(contender_.arguments);
        guarded([&] {
            worker_->ask({{"do", "open"}}, std::chrono::hours(24), progress);
            first_ = ask({{"do", "run"}}, progress);
            takeFacts(first_, row_);
            if (!options.pictures) return;
            ImageBuffer picture;
            {  // the file is gone before the judging, which takes its time
                const ScopedPath file = temporaryFile(options.scratch);
                worker_->ask({{"do", "save"}, {"path", pathJson(file.path())}}, std::chrono::hours(24),
                             progress);
                picture = readRaw(file.path());
            }
            take(index_, picture);
        });
    }

    void run(Progress& progress) {
        guarded([&] {
            const Json reply = ask({{"do", "run"}}, progress);
            takeRun(reply, row_);
            takeFacts(reply, row_);
        });
    }

    /// What an early end leaves.
    void conclude() {
        worker_.reset();
        if (!timeout_) return;
        if (row_.seconds.empty() && !first_.is_null()) takeRun(first_, row_);
        row_.status = row_.seconds.empty() ? RowStatus::kTimeout : RowStatus::kOk;
        row_.why = row_.seconds.empty() ? "its first run did not end within the budget"
                                        : fmt::format("the budget left it {} run{}", row_.seconds.size(),
                                                      row_.seconds.size() == 1 ? "" : "s");
    }

  private:
    Json ask(const Json& request, Progress& progress) {
        const auto start = std::chrono::steady_clock::now();
        const Json reply = worker_->ask(request, std::chrono::duration<double>(left_), progress);
        left_ -= std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        if (left_ <= 0.0) alive_ = false, timeout_ = true;
        return reply;
    }

    template <class Work>
    void guarded(Work&& work) {
        try {
            work();
        } catch (const WorkerTimeout&) {
            alive_ = false, timeout_ = true;
        } catch (const WorkerFailure& failure) {
            if (failure.status == kWrongInputStatus) throw;
            alive_ = false;
            row_.status = RowStatus::kFailed, row_.why = failure.what();
        }
    }

    const Contender& contender_;
    std::size_t index_;
    double left_;
    Row& row_;
    std::optional<WorkerProcess> worker_;
    Json first_;
    bool alive_ = true, timeout_ = false;
};

}  // namespace

void takeFacts(const Json& reply, Row& row) {
    row.device = reply.at("device");
    row.size = {reply.at("size")[0], reply.at("size")[1]};
    row.peak_mib = std::max<double>(row.peak_mib, reply.at("peak_mib"));
    row.counts = reply.at("counts").get<std::map<std::string, std::uint64_t>>();
    row.notes = reply.at("notes");
    row.mesh = meshFromJson(reply.value("mesh", Json()));
    row.plan.clear();
    for (const Json& entry : reply.at("plan"))
        row.plan.push_back({entry.at("stage"), entry.at("runs"), entry.at("why")});
}

void runByTurns(const std::vector<Contender>& contenders, const ScheduleOptions& options,
                std::vector<Row>& rows, const TakePicture& take, const RowChanged& changed,
                Progress& progress) {
    std::vector<Turn> turns;
    turns.reserve(contenders.size());
    std::size_t total = 0;
    for (std::size_t i = 0; i < contenders.size(); ++i) {
        turns.emplace_back(contenders[i], i, options.budget_seconds, rows[i]);
        if (turns[i].wants(options.runs)) total += 1 + static_cast<std::size_t>(options.runs);
    }
    progress.stage("compare", total);
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < turns.size(); ++i) {
        if (!turns[i].wants(options.runs)) continue;
        open.push_back(i);
        turns[i].warmUp(options, take, progress);
        progress.advance(1);
    }
    for (int round = 0; round < options.runs; ++round)
        for (const std::size_t i : open) {
            if (turns[i].wants(options.runs)) turns[i].run(progress), changed(i);
            progress.advance(1);
        }
    for (const std::size_t i : open) turns[i].conclude(), changed(i);
}

namespace {

/// A K of 16 is judged by 24: no sample of the one is at a place of the other.
constexpr double kFiner = 1.5;
/// A quarter of the rows, in strips.
constexpr int kStrips = 4, kShare = 4;

/// A worker that has made a reference.
class ReferenceWorker {
  public:
    ReferenceWorker(const Contender& contender, const std::filesystem::path& scratch, Progress& progress)
        : scratch_(scratch), progress_(progress), worker_(contender.arguments) {
        ask({{"do", "open"}});
    }
    Json ask(const Json& request) { return worker_.ask(request, std::chrono::hours(24 * 365), progress_); }
    /// Of the last run or check.
    ImageBuffer picture() {
        const ScopedPath file = temporaryFile(scratch_);
        ask({{"do", "save"}, {"path", pathJson(file.path())}});
        return readRaw(file.path());
    }

  private:
    const std::filesystem::path& scratch_;
    Progress& progress_;
    WorkerProcess worker_;
};

template <class Class>
std::vector<Class> classesOf(const Json& reply) {
    std::vector<Class> classes;
    for (const char digit : reply.at("classes").get<std::string>())
        classes.push_back(static_cast<Class>(digit - '0'));
    return classes;
}

/// Of ssaa:K; none of other methods.
std::optional<std::string> finerMethod(const std::string& typed) {
    const MethodSpec method = parseMethod(typed);
    if (method.name != "ssaa" || !method.number || !method.composed.empty()) return std::nullopt;
    std::string finer = fmt::format("ssaa:{}", std::lround(std::ceil(kFiner * *method.number)));
    for (const auto& [name, value] : method.parameters) finer += fmt::format(",{}={}", name, value);
    return finer;
}

std::vector<PixelBox> strips(const PixelBox& whole) {
    const int count = std::min(kStrips, whole.height());
    std::vector<PixelBox> strips;
    for (int i = 0; i < count; ++i) {
        const int begin = whole.y0 + i * whole.height() / count,
                  room = whole.y0 + (i + 1) * whole.height() / count - begin,
                  height = std::max(1, room / kShare), y0 = begin + (room - height) / 2;
        strips.push_back({whole.x0, y0, whole.x1, y0 + height});
    }
    return strips;
}

std::optional<ReferenceError> ownError(const Contender& contender, const ReferencePicture& reference,
                                       ReferenceWorker& worker) {
    const std::optional<std::string> finer = finerMethod(contender.method);
    if (!finer) return std::nullopt;
    ReferenceError error{*finer, {}};
    for (const PixelBox& strip : strips(reference.picture.box)) {
        worker.ask({{"do", "check"}, {"method", *finer}, {"rows", {strip.y0, strip.y1}}});
        error.kinds += judge::errorsByKind(worker.picture(), reference.picture, reference.kinds);
    }
    return error;
}

}  // namespace

ReferencePicture referenceOf(const Contender& contender, const std::filesystem::path& scratch, Row& row,
                             Progress& progress, const ReferenceWishes& wishes) {
    ReferenceWorker worker(contender, scratch, progress);
    takeFacts(worker.ask({{"do", "run"}}), row);
    ReferencePicture reference{worker.picture(), {}, {}, {}};
    if (parseMethod(contender.method).name == "nsaa")
        reference.edges = classesOf<EdgeClass>(worker.ask({{"do", "edges"}}));
    if (wishes.kinds) reference.kinds = classesOf<judge::EdgeKind>(worker.ask({{"do", "kinds"}}));
    if (wishes.own_error && !reference.kinds.empty())
        reference.error = ownError(contender, reference, worker);
    return reference;
}

}  // namespace edgewise::compare
