// The flat patterns of the NSAA paper by FreeType and by nsaa, box filter, by turns: medians, and the ratio
// of nsaa's to FreeType's. FreeType has one thread, nsaa all and one. Loading and outlines are not timed; the
// largest difference of the two pictures shows that they are the same.
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <map>

#include "pipeline/methods/stopwatch.h"
#include "tests/bench/freetype_peer.h"
#include "tests/bench/prepared.h"

namespace edgewise::bench {
namespace {

/// Triangles in turn that are a ring or a cell.
struct Pattern {
    const char* scene;
    std::size_t shape_triangles;
};
constexpr Pattern kPatterns[]{{"zone-plate", 160}, {"log-grid", 2}};

double median(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
}

class Turns {
  public:
    explicit Turns(const Pattern& pattern) : scene_(pattern.scene) {
        scene_.options.device = DeviceChoice::kCpu;
        std::vector<glm::dvec3> colors(scene_.scene.triangle_count);
        for (const ScreenTriangle& t : scene_.screen.triangles)
            colors[t.owner] =
                scene_.shading->atPoint(t.owner, (t.p_px[0] + t.p_px[1] + t.p_px[2]) / 3.0).color;
        const auto shapes = flatShapes(scene_.screen, colors, pattern.shape_triangles);
        per_shape_ = std::make_unique<FreeTypePeer>(shapes, kFilmPx);
        per_triangle_ = std::make_unique<FreeTypePeer>(flatShapes(scene_.screen, colors, 1), kFilmPx);
        per_color_ = std::make_unique<FreeTypePeer>(onePerColor(shapes), kFilmPx);
    }

    void run() {
        timed("freetype_shapes", [&] { per_shape_->draw(); });
        timed("nsaa", [&] { render(); });
        timed("freetype_triangles", [&] { per_triangle_->draw(); });
        timed("freetype_colors", [&] { per_color_->draw(); });
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        timed("nsaa_one_thread", [&] { render(); });
    }

    void report(benchmark::State& state) const {
        for (const auto& [name, seconds] : seconds_) state.counters[name + "_ms"] = 1e3 * median(seconds);
        for (const auto& [name, seconds] : stages_) state.counters["stage_" + name] = 1e3 * median(seconds);
        for (const char* nsaa : {"nsaa", "nsaa_one_thread"})
            state.counters[std::string(nsaa) + "_over_shapes"] =
                median(seconds_.at(nsaa)) / median(seconds_.at("freetype_shapes"));
        state.counters["largest_difference"] =
            std::max({difference(*per_shape_), difference(*per_triangle_), difference(*per_color_)});
    }

  private:
    template <class Work>
    void timed(const std::string& name, const Work& work) {
        Stopwatch watch;
        work();
        seconds_[name].push_back(watch.lap());
    }

    void render() {
        made_ = runMethod(parseMethod("nsaa"), {scene_.scene, scene_.camera, scene_.film, scene_.filter,
                                                scene_.options, scene_.progress});
        if (tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism) > 1)
            for (const StageTime& stage : made_.stages) stages_[stage.name].push_back(stage.seconds);
    }

    double difference(const FreeTypePeer& peer) const {
        double most = 0.0;
        for (std::size_t i = 0; i < made_.image.rgba.size(); ++i)
            for (int c = 0; c < 3; ++c)
                most = std::max(most, std::abs(made_.image.rgba[i][c] - peer.picture()[i][c]));
        return most;
    }

    Prepared scene_;
    std::unique_ptr<FreeTypePeer> per_shape_, per_triangle_, per_color_;
    MethodResult made_;
    std::map<std::string, std::vector<double>> seconds_, stages_;
};

void benchPeer(benchmark::State& state, const Pattern& pattern) {
    Turns turns(pattern);
    for (auto _ : state) turns.run();
    turns.report(state);
}

int registerAll() {
    for (const Pattern& pattern : kPatterns)
        benchmark::RegisterBenchmark((std::string("peer/freetype/") + pattern.scene).c_str(),
                                     [=](benchmark::State& state) { benchPeer(state, pattern); })
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime()
            ->Iterations(7);
    return 0;
}

const int kRegistered = registerAll();

}  // namespace
}  // namespace edgewise::bench
