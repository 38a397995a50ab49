#include "paper_figures/performance_measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "data/generate/random_triangles.h"
#include "data/generate/tori.h"
#include "pipeline/atomic_file.h"
#include "pipeline/compare/judge_row.h"
#include "pipeline/compare/schedule.h"
#include "pipeline/compare/worker_process.h"
#include "pipeline/error.h"
#include "pipeline/scene_catalog.h"
#include "pipeline/version.h"

namespace edgewise::figures {
namespace {

constexpr const char* kReference = "nsaa,device=cpu";
/// For everything but the image, MiB: the program's default.
constexpr double kUsualMemory = 1024.0;
constexpr double kBytesPerPixel = sizeof(glm::dvec4) + sizeof(float);

/// Of the runs inside: their stages have the name of what is measured.
class Labelled : public Progress {
  public:
    Labelled(Progress& outer, std::string label) : outer_(outer), label_(std::move(label)) {}
    void stage(std::string_view, std::size_t total) override { outer_.stage(label_, total); }
    void advance(std::size_t done) override { outer_.advance(done); }
    bool cancelled() override { return outer_.cancelled(); }

  private:
    Progress& outer_;
    std::string label_;
};

struct Picture {
    std::string scene;  ///< a name or a file
    int width, height;
    std::string filter;
    double radius;
};

std::vector<std::string> workerArguments(const Picture& picture, const std::string& method) {
    const double image_mib = kBytesPerPixel * picture.width * picture.height / 0x1p20;
    return {"compare-worker",
            picture.scene,
            fmt::format("--size={}x{}", picture.width, picture.height),
            "--filter=" + picture.filter,
            fmt::format("--radius={}", picture.radius),
            "--device=cpu",
            fmt::format("--memory={:.0f}", std::ceil(kUsualMemory + image_mib)),
            "--method=" + method};
}

class Measurement {
  public:
    Measurement(const PerformanceEffort& effort, const std::filesystem::path& scratch, Progress& progress)
        : effort_(effort), scratch_(scratch), progress_(progress) {}

    Performance run() {
        found_.runs = effort_.runs;
        found_.machine = compare::thisMachine();
        progress_.stage("memory and arithmetic", 0);
        found_.rates = measureMachine(effort_.triad_doubles, effort_.runs);
        for (const PerformanceScene& scene : effort_.scenes) guarded(scene.title, [&] { compareOn(scene); });
        growWithTriangles();
        growWithResolution();
        return std::move(found_);
    }

  private:
    /// What a scene or a method lacks is told, and the rest goes on.
    template <class Work>
    void guarded(const std::string& what, const Work& work) {
        try {
            work();
        } catch (const compare::WorkerFailure& failure) {
            note(what + ": " + failure.what());
        } catch (const InputError& error) {
            note(what + ": " + error.what());
        }
        if (progress_.cancelled()) throw Interrupted();
    }

    void note(const std::string& text) {
        if (std::ranges::find(found_.notes, text) == found_.notes.end()) found_.notes.push_back(text);
    }

    compare::ScheduleOptions schedule(bool pictures) const {
        return {effort_.runs, effort_.budget_seconds, scratch_, pictures};
    }

    /// Those of this build that take the filter, or whose own box it is.
    std::vector<std::string> methodsFor(const std::string& filter) {
        std::vector<std::string> methods;
        for (const std::string& method : effort_.methods)
            guarded(method, [&] {
                if (takesFilter(parseMethod(method)) || filter == "box") methods.push_back(method);
            });
        return methods;
    }

    void compareOn(const PerformanceScene& scene) {
        findScene(scene.name);
        const Picture picture{scene.name, scene.width, scene.height, scene.filter, scene.radius};
        const Prefilter filter = makePrefilter(scene.filter, scene.radius, {});
        SceneTimes times{scene, {scene.name, kReference, "", version(), found_.machine, {}}};
        std::vector<compare::Contender> contenders;
        for (const std::string& method : methodsFor(scene.filter)) {
            contenders.push_back({method, workerArguments(picture, method)});
            times.comparison.rows.push_back(compare::rowOf(parseMethod(method), filter));
        }
        std::vector<compare::Row>& rows = times.comparison.rows;
        Labelled labelled(progress_, scene.title);
        compare::Row own;
        const compare::ReferencePicture reference =
            compare::referenceOf({kReference, workerArguments(picture, kReference)}, scratch_, own, labelled);
        compare::runByTurns(
            contenders, schedule(true), rows,
            [&](std::size_t i, const ImageBuffer& image) { compare::judgeRow(rows[i], image, reference); },
            [](std::size_t) {}, labelled);
        noteFailures(scene.title, rows);
        found_.scenes.push_back(std::move(times));
    }

    void noteFailures(const std::string& where, const std::vector<compare::Row>& rows) {
        for (const compare::Row& row : rows)
            if (!row.why.empty()) note(fmt::format("{}, {}: {}", where, row.method, row.why));
    }

    /// Its points take turns.
    void grow(GrowthSeries series, const std::vector<Picture>& pictures) {
        const std::string title = fmt::format("{} of {}", series.method, series.family);
        guarded(title, [&] {
            std::vector<compare::Contender> contenders;
            std::vector<compare::Row> rows;
            for (const Picture& picture : pictures) {
                contenders.push_back({series.method, workerArguments(picture, series.method)});
                rows.push_back(compare::rowOf(parseMethod(series.method), makePrefilter("box", 0.5, {})));
            }
            Labelled labelled(progress_, title);
            compare::runByTurns(
                contenders, schedule(false), rows, [](std::size_t, const ImageBuffer&) {}, [](std::size_t) {},
                labelled);
            noteFailures(title, rows);
            for (std::size_t i = 0; i < rows.size(); ++i)
                if (rows[i].seconds.empty())
                    series.points[i].x = 0.0;
                else
                    series.points[i].row = std::move(rows[i]);
            std::erase_if(series.points, [](const GrowthPoint& point) { return point.x == 0.0; });
            found_.growth.push_back(std::move(series));
        });
    }

    std::string keep(const std::string& name, const std::string& bytes) const {
        const std::filesystem::path file = scratch_ / name;
        writeAtomically(file, bytes);
        return file.string();
    }

    /// The named scenes' own recipes. A torus has about as many quads around as in torus-200k, 2.5 times
    /// those of its tube.
    void growWithTriangles() {
        std::vector<Picture> tori, random;
        std::vector<GrowthPoint> on_tori, on_random;
        for (const std::uint32_t triangles : effort_.triangles) {
            const auto tube = static_cast<std::uint32_t>(std::lround(std::sqrt(triangles / 2 / 2.5)));
            const std::uint32_t around = triangles / 2 / tube;
            const auto add = [&](auto& pictures, auto& points, const std::string& name, const auto& file,
                                 std::uint32_t count) {
                progress_.stage("scene " + name, 0);
                pictures.push_back({keep(name + ".glb", file.glb()), effort_.side, effort_.side, "box", 0.5});
                points.push_back({static_cast<double>(count), {}});
                if (progress_.cancelled()) throw Interrupted();
            };
            add(tori, on_tori, fmt::format("torus-{}", triangles), scenes::makeTorus(around, tube),
                2 * around * tube);
            add(random, on_random, fmt::format("random-{}", triangles),
                scenes::makeRandomTriangles(triangles), triangles);
        }
        for (const std::string& method : effort_.growth_methods) {
            grow({"torus", method, true, on_tori}, tori);
            grow({"random", method, true, on_random}, random);
        }
    }

    void growWithResolution() {
        for (const std::string& scene : effort_.resolution_scenes)
            for (const std::string& method : effort_.growth_methods) {
                std::vector<Picture> pictures;
                std::vector<GrowthPoint> points;
                for (const int side : effort_.sides) {
                    pictures.push_back({scene, side, side, "box", 0.5});
                    points.push_back({static_cast<double>(side), {}});
                }
                grow({scene, method, false, points}, pictures);
            }
    }

    const PerformanceEffort& effort_;
    const std::filesystem::path& scratch_;
    Progress& progress_;
    Performance found_;
};

}  // namespace

Performance measurePerformance(const PerformanceEffort& effort, const std::filesystem::path& scratch,
                               Progress& progress) {
    return Measurement(effort, scratch, progress).run();
}

}  // namespace edgewise::figures
