#include "paper_figures/performance_measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "data/generate/random_triangles.h"
#include "data/generate/tori.h"
#include "paper_figures/compared_scene.h"
#include "pipeline/atomic_file.h"
#include "pipeline/compare/worker_process.h"
#include "pipeline/error.h"

namespace edgewise::figures {
namespace {

constexpr const char* kReference = "nsaa,device=cpu";

using Picture = ComparedPicture;

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
        const Picture picture{scene.name, scene.width, scene.height, scene.filter, scene.radius};
        Labelled labelled(progress_, scene.title);
        SceneTimes times{scene, figures::compareOn(picture, kReference, methodsFor(scene.filter),
                                                   schedule(true), labelled)};
        noteFailures(scene.title, times.comparison.rows);
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
