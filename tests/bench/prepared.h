// A scene after every stage of nsaa, so that each can be timed alone.
#pragma once

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

inline constexpr int kFilmPx = 1024;

struct Prepared {
    Scene scene;
    Film film;
    ResolvedCamera camera;
    Prefilter filter;
    RenderOptions options;
    Progress progress;
    ScreenPieces pieces;
    ScreenScene screen;
    std::unique_ptr<Shading> shading;
    std::unique_ptr<CellGrid> grid;
    Plan plan;
    IdLists lists;
    VisibilityCounts counts;
    VisibleMap map;
    WeightTiles tiles;

    explicit Prepared(const std::string& name, const std::string& filter_name = "box")
        : scene(loadGltf(findScene(name))), filter(makePrefilter(filter_name, {}, {})) {
        CameraOptions camera_options;
        camera_options.size = glm::ivec2(kFilmPx);
        camera = resolveCamera(scene, camera_options, film);
        screen = project(scene, camera, film, pieces);
        shading = std::make_unique<Shading>(scene, camera, film, screen, pieces);
        plan = makePlan(scene, screen, pieces, *shading, options);
        const int reach = static_cast<int>(filter.radius) + 2;
        grid = std::make_unique<CellGrid>(Window{-reach, -reach, kFilmPx + reach, kFilmPx + reach});
        lists = edgewise::gather(screen, *grid);
        map = visible();
        tiles = segmentTiles();
    }
    Prepared(const Prepared&) = delete;
    Prepared& operator=(const Prepared&) = delete;

    VisibleMap visible() {
        counts = {};
        return edgewise::visibility(screen, *grid, lists, plan.visibility, progress, counts);
    }
    WeightTiles segmentTiles() const {
        return gatherSegments(map, film.crop, glm::dvec2(0.0), filter.radius);
    }
    /// `tile` of the film, by a worker of one thread.
    void weigh(WeightWorker& worker, std::size_t tile, WeightTile& out) const {
        const IdLists& ids = tiles.segments;
        const std::size_t count = ids.offsets[tile + 1] - ids.offsets[tile];
        worker.run(map, std::span(ids.ids).subspan(ids.offsets[tile], count), plan.classes, tiles.boxes[tile],
                   glm::dvec2(0.0), out);
    }
    std::span<const std::uint32_t> inCell(std::size_t cell) const {
        return std::span(lists.ids).subspan(lists.offsets[cell],
                                            lists.offsets[cell + 1] - lists.offsets[cell]);
    }
};

/// How long each of `number` things took, all iterations together.
inline void countNanoseconds(benchmark::State& state, const std::string& thing, double number) {
    state.counters["ns_per_" + thing] = benchmark::Counter(
        number * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters[thing + "s"] = number;
}

template <class Body>
void registerBench(const std::string& name, Body&& body) {
    benchmark::RegisterBenchmark(name.c_str(), std::forward<Body>(body))
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
}

}  // namespace edgewise::bench
