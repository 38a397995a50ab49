// Seconds of the Vulkan stages beside the CPU's, after a first run that compiles the shaders.
#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <memory>
#include <string>

#include "pipeline/gather.h"
#include "pipeline/load_gltf.h"
#include "pipeline/project.h"
#include "pipeline/resolve_camera.h"
#include "pipeline/scene_catalog.h"
#include "pipeline/vulkan/gather.h"

namespace edgewise::bench {
namespace {

constexpr int kFilmPx = 1024;

struct OnScreen {
    ScreenScene screen;
    CellGrid grid{Window{-4, -4, kFilmPx + 4, kFilmPx + 4}};

    explicit OnScreen(const std::string& name) {
        const Scene scene = loadGltf(findScene(name));
        CameraOptions options;
        options.size = glm::ivec2(kFilmPx);
        Film film;
        const ResolvedCamera camera = resolveCamera(scene, options, film);
        ScreenPieces pieces;
        screen = project(scene, camera, film, pieces);
    }
};

const vulkan::Device& device() {
    static const vulkan::Device one;
    return one;
}

void benchCpuGather(benchmark::State& state, const std::string& name) {
    const OnScreen scene(name);
    for (auto _ : state) benchmark::DoNotOptimize(gather(scene.screen, scene.grid).ids.data());
    state.counters["triangles"] = static_cast<double>(scene.screen.triangles.size());
}

void benchGather(benchmark::State& state, const std::string& name, vulkan::GatherForm form) {
    const OnScreen scene(name);
    vulkan::Gather stage(device(), form);
    vulkan::PassGraph graph(device());
    const vulkan::Buffer triangles = vulkan::bufferOf(device(), "triangles", scene.screen.triangles);
    const vulkan::DeviceLists lists =
        stage.addTo(graph, graph.input("triangles", triangles), scene.screen.triangles.size(), scene.grid);
    graph.run({lists.ids});
    for (auto _ : state) graph.run({lists.ids});
    for (const vulkan::PassTime& time : graph.times()) state.counters[time.name] = 1e3 * time.seconds;
    state.counters["ids"] = static_cast<double>(entriesOf(graph, lists.offsets, scene.grid.size()));
}

int registerAll() {
    using vulkan::GatherForm;
    const auto add = [](const std::string& name, auto&& body) {
        benchmark::RegisterBenchmark(name.c_str(), body)
            ->Unit(benchmark::kMillisecond)
            ->MeasureProcessCPUTime()
            ->UseRealTime();
    };
    for (const std::string& scene : std::vector<std::string>{"torus-20k", "torus-200k", "random-20k"}) {
        add("vulkan/gather/cpu/" + scene, [=](benchmark::State& s) { benchCpuGather(s, scene); });
        for (const auto& [name, form] :
             {std::pair("boxes", GatherForm::kBoxes), std::pair("instanced", GatherForm::kInstancedBoxes),
              std::pair("thickened", GatherForm::kThickened)})
            add(fmt::format("vulkan/gather/{}/{}", name, scene),
                [=, form = form](benchmark::State& s) { benchGather(s, scene, form); });
    }
    return 0;
}

const int kRegistered = registerAll();

}  // namespace
}  // namespace edgewise::bench
