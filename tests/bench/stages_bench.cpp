// Seconds of one stage of nsaa, the stages before it done once: gather, visibility, weights.
#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "pipeline/gather.h"
#include "pipeline/load_gltf.h"
#include "pipeline/plan.h"
#include "pipeline/project.h"
#include "pipeline/resolve_camera.h"
#include "pipeline/scene_catalog.h"

namespace edgewise::bench {
namespace {

constexpr int kFilmPx = 1024;

/// A scene after every stage, for one filter.
struct Prepared {
    Scene scene;
    Film film;
    ResolvedCamera camera;
    Prefilter filter;
    RenderOptions options;
    Progress progress;
    ScreenPieces pieces;
    ScreenScene screen;
    std::unique_ptr<CellGrid> grid;
    Plan plan;
    IdLists lists;
    VisibleMap map;
    WeightTiles tiles;

    Prepared(const std::string& name, const std::string& filter_name)
        : scene(loadGltf(findScene(name))), filter(makePrefilter(filter_name, {}, {})) {
        CameraOptions camera_options;
        camera_options.size = glm::ivec2(kFilmPx);
        camera = resolveCamera(scene, camera_options, film);
        screen = project(scene, camera, film, pieces);
        plan = makePlan(scene, screen, pieces, Shading(scene, camera, film, screen, pieces), options);
        const int reach = static_cast<int>(filter.radius) + 2;
        grid = std::make_unique<CellGrid>(Window{-reach, -reach, kFilmPx + reach, kFilmPx + reach});
        lists = edgewise::gather(screen, *grid);
        map = visible();
        tiles = gatherSegments(map, film.crop, glm::dvec2(0.0), filter.radius);
    }

    VisibleMap visible() {
        VisibilityCounts counts;
        return edgewise::visibility(screen, *grid, lists, plan.visibility, progress, counts);
    }
};

void benchGather(benchmark::State& state, const std::string& scene) {
    Prepared prepared(scene, "box");
    for (auto _ : state)
        benchmark::DoNotOptimize(edgewise::gather(prepared.screen, *prepared.grid).ids.data());
    state.counters["pairs"] = static_cast<double>(prepared.lists.ids.size());
}

void benchVisibility(benchmark::State& state, const std::string& scene) {
    Prepared prepared(scene, "box");
    for (auto _ : state) benchmark::DoNotOptimize(prepared.visible().segments.data());
    state.counters["segments"] = static_cast<double>(prepared.map.segments.size());
}

/// On one thread.
void benchWeights(benchmark::State& state, const std::string& scene, const std::string& filter) {
    Prepared prepared(scene, filter);
    WeightWorker worker(prepared.filter, prepared.plan.weights);
    WeightTile out;
    const IdLists& lists = prepared.tiles.segments;
    for (auto _ : state)
        for (std::size_t t = 0; t < prepared.tiles.boxes.size(); ++t) {
            const std::size_t count = lists.offsets[t + 1] - lists.offsets[t];
            worker.run(prepared.map, std::span(lists.ids).subspan(lists.offsets[t], count),
                       prepared.plan.classes, prepared.tiles.boxes[t], glm::dvec2(0.0), out);
            benchmark::DoNotOptimize(out.entries.data());
        }
    const auto terms = static_cast<double>(worker.terms());
    state.counters["ns_per_term"] =
        benchmark::Counter(terms * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    state.counters["terms"] = terms / static_cast<double>(state.iterations());
}

int registerAll() {
    for (const std::string& scene : std::vector<std::string>{"torus-20k", "random-2k"}) {
        const auto add = [&](const std::string& name, auto&& body) {
            benchmark::RegisterBenchmark((name + "/" + scene).c_str(), body)
                ->Unit(benchmark::kMillisecond)
                ->UseRealTime();
        };
        add("gather", [=](benchmark::State& state) { benchGather(state, scene); });
        add("visibility", [=](benchmark::State& state) { benchVisibility(state, scene); });
        for (const std::string& filter : std::vector<std::string>{"box", "gaussian"})
            add("weights/" + filter, [=](benchmark::State& state) { benchWeights(state, scene, filter); });
    }
    return 0;
}

const int kRegistered = registerAll();

}  // namespace
}  // namespace edgewise::bench
