#include "paper_figures/cone_tracing_measure.h"

#include <fmt/format.h>

#include <algorithm>

#include "paper_figures/compared_scene.h"
#include "paper_figures/cone_table.h"
#include "paper_figures/cone_tracing_pictures.h"
#include "pipeline/compare/worker_process.h"
#include "pipeline/error.h"
#include "pipeline/methods/stopwatch.h"
#include "pipeline/scoped_path.h"

namespace edgewise::figures {
namespace {

/// What is shown of every scene, then what only the claims ask for.
const std::vector<std::string> kMethods{"none",
                                        "ssaa:2",
                                        "ssaa:3",
                                        "ctss",
                                        "ctss-r",
                                        "ctss+ssaa:2",
                                        "ctss-x",
                                        "fxaa",
                                        "smaa",
                                        "lottes",
                                        kPixelAreaCone,
                                        "ctss-r:coverage=2",
                                        "ctss:weights=uniform",
                                        "ctss:mask=4x8",
                                        "ctss:backtrace=off"};
/// Whose times the aims speak of.
const std::vector<std::string> kTimedMethods{"none",   "ssaa:2",      "ssaa:3", "ctss",
                                             "ctss-r", "ctss+ssaa:2", "ctss-x", "ctss:backtrace=off"};

class Measurement {
  public:
    Measurement(const ConeTracingEffort& effort, Progress& progress)
        : effort_(effort),
          progress_(progress),
          schedule_{effort.runs, effort.budget_seconds, scratch_.path()} {}

    ConeTracing run() {
        Stopwatch watch;
        found_.quick = effort_.quick, found_.runs = effort_.runs;
        for (const std::string& name : effort_.scenes) guarded(name, [&] { measure(name); });
        found_.timed_on = effort_.timed_size.x == 0
                              ? fmt::format("CPU, {}x{}", effort_.size.x, effort_.size.y)
                              : fmt::format("Vulkan, {}x{}", effort_.timed_size.x, effort_.timed_size.y);
        found_.pictures = coneTracingPictures(effort_, progress_);
        found_.seconds = watch.lap();
        return std::move(found_);
    }

  private:
    /// What a scene lacks is told, and the rest goes on.
    template <class Work>
    void guarded(const std::string& name, const Work& work) {
        try {
            work();
        } catch (const compare::WorkerFailure& failure) {
            found_.notes.push_back(name + ": " + failure.what());
        } catch (const InputError& error) {
            found_.notes.push_back(name + ": " + error.what());
        }
        if (progress_.cancelled()) throw Interrupted();
    }

    void measure(const std::string& name) {
        Labelled labelled(progress_, name);
        const std::string reference = fmt::format("ssaa:{}", effort_.reference_side);
        ConeScene scene{compareOn({name, effort_.size.x, effort_.size.y}, reference, kMethods, schedule_,
                                  labelled, {true, true}),
                        {}};
        note(name, scene.judged.rows);
        if (effort_.timed_size.x > 0) {
            ComparedPicture picture{name, effort_.timed_size.x, effort_.timed_size.y};
            picture.device = "vulkan";
            scene.timed = timesOn(picture, kTimedMethods, schedule_, labelled);
            note(name + " on Vulkan", scene.timed);
        }
        found_.scenes.push_back(std::move(scene));
    }
    void note(const std::string& where, const std::vector<compare::Row>& rows) {
        for (const compare::Row& row : rows)
            if (!row.why.empty())
                found_.notes.push_back(fmt::format("{}, {}: {}", where, row.method, row.why));
    }

    const ConeTracingEffort& effort_;
    Progress& progress_;
    const ScopedPath scratch_ = temporaryFolder();
    compare::ScheduleOptions schedule_;
    ConeTracing found_;
};

const compare::Row* find(const std::vector<compare::Row>& rows, const std::string& method) {
    const auto found = std::ranges::find(rows, method, &compare::Row::method);
    return found == rows.end() ? nullptr : &*found;
}

std::optional<double> secondsIn(const compare::Row* row) {
    if (!row || row->seconds.empty()) return std::nullopt;
    return compare::spreadOf(row->seconds).median;
}

}  // namespace

bool ConeScene::ofPaper() const {
    return publishedRatio(name(), "none").has_value();
}

const compare::Row* ConeScene::row(const std::string& method) const {
    return find(judged.rows, method);
}

judge::KindError ConeScene::errorOf(const std::string& method, EdgeKind kind) const {
    const compare::Row* own = row(method);
    if (!own || !own->kinds) return {};
    return kind == EdgeKind::kNone ? own->kinds->edges() : own->kinds->of(kind);
}

std::optional<double> ConeScene::secondsOf(const std::string& method) const {
    return timed.empty() ? secondsIn(row(method)) : secondsIn(find(timed, method));
}

std::optional<double> ConeScene::ratioOf(const std::string& method, const std::string& to) const {
    const std::optional<double> own = secondsOf(method), other = secondsOf(to);
    return own && other ? std::optional(*own / *other) : std::nullopt;
}

double ConeScene::shareOf(const std::string& method, const std::string& count) const {
    const compare::Row* own = row(method);
    if (!own) return 0.0;
    const auto found = own->counts.find(count), all = own->counts.find("pixels");
    if (found == own->counts.end() || all == own->counts.end() || all->second == 0) return 0.0;
    return static_cast<double>(found->second) / static_cast<double>(all->second);
}

std::uint64_t ConeScene::pixelsOf(EdgeKind kind) const {
    for (const compare::Row& row : judged.rows)
        if (row.kinds) return row.kinds->of(kind).pixels;
    return 0;
}

std::optional<double> publishedRatio(const std::string& scene, const std::string& method) {
    constexpr int kWidth = 1280;
    for (const ConeTableRow& row : paperTable())
        for (std::size_t m = 0; m < kTableMethods.size(); ++m)
            if (row.scene == scene && row.width == kWidth && kTableMethods[m] == method) return row.paper[m];
    return std::nullopt;
}

ConeTracing measureConeTracing(const ConeTracingEffort& effort, Progress& progress) {
    return Measurement(effort, progress).run();
}

}  // namespace edgewise::figures
