// Seconds of one stage, the stages before it done once. On all threads but weights and blend, which have one.
#include "pipeline/blend.h"
#include "pipeline/shade_groups.h"
#include "pipeline/write_image.h"
#include "tests/bench/prepared.h"

namespace edgewise::bench {
namespace {

void benchLoad(benchmark::State& state, const std::string& name) {
    const std::filesystem::path file = findScene(name);
    double triangles = 0;
    for (auto _ : state) triangles = static_cast<double>(loadGltf(file).triangle_count);
    countNanoseconds(state, "triangle", triangles);
}

void benchProject(benchmark::State& state, const std::string& name) {
    Prepared prepared(name);
    for (auto _ : state) {
        ScreenPieces pieces;
        benchmark::DoNotOptimize(
            project(prepared.scene, prepared.camera, prepared.film, pieces).triangles.data());
    }
    countNanoseconds(state, "triangle", static_cast<double>(prepared.scene.triangle_count));
}

/// With the shading that it asks for constant colours.
void benchPlan(benchmark::State& state, const std::string& name) {
    Prepared p(name);
    for (auto _ : state) {
        const Shading shading(p.scene, p.camera, p.film, p.screen, p.pieces);
        benchmark::DoNotOptimize(makePlan(p.scene, p.screen, p.pieces, shading, p.options).entries.data());
    }
    countNanoseconds(state, "triangle", static_cast<double>(p.scene.triangle_count));
}

void benchGather(benchmark::State& state, const std::string& name) {
    Prepared prepared(name);
    for (auto _ : state)
        benchmark::DoNotOptimize(edgewise::gather(prepared.screen, *prepared.grid).ids.data());
    countNanoseconds(state, "pair", static_cast<double>(prepared.lists.ids.size()));
}

void benchVisibility(benchmark::State& state, const std::string& name) {
    Prepared prepared(name);
    for (auto _ : state) benchmark::DoNotOptimize(prepared.visible().segments.data());
    countNanoseconds(state, "segment", static_cast<double>(prepared.map.segments.size()));
}

void benchSegmentTiles(benchmark::State& state, const std::string& name) {
    const Prepared prepared(name);
    for (auto _ : state) benchmark::DoNotOptimize(prepared.segmentTiles().segments.ids.data());
    countNanoseconds(state, "segment", static_cast<double>(prepared.map.segments.size()));
}

void benchWeights(benchmark::State& state, const std::string& name, const std::string& filter) {
    const Prepared prepared(name, filter);
    WeightWorker worker(prepared.filter, prepared.plan.weights);
    WeightTile out;
    for (auto _ : state)
        for (std::size_t t = 0; t < prepared.tiles.boxes.size(); ++t) {
            prepared.weigh(worker, t, out);
            benchmark::DoNotOptimize(out.entries.data());
        }
    countNanoseconds(state, "term",
                     static_cast<double>(worker.terms()) / static_cast<double>(state.iterations()));
}

/// Every tile's weights are there; scenes of the benches have no see-through layers.
struct Weighed : Prepared {
    std::vector<WeightTile> weights;
    ImageBuffer image{film.crop};
    double pairs = 0;

    Weighed(const std::string& name, const std::string& filter_name) : Prepared(name, filter_name) {
        WeightWorker worker(filter, plan.weights);
        weights.resize(tiles.boxes.size());
        for (std::size_t t = 0; t < weights.size(); ++t) {
            weigh(worker, t, weights[t]);
            pairs += static_cast<double>(weights[t].entries.size());
        }
    }
    void blendAll() {
        for (const WeightTile& tile : weights) {
            shadeTile(tile);
            blend(
                tile, [&](std::size_t e) -> const Shade& { return shades[e]; }, image);
        }
    }

  private:
    Shading::Groups groups;
    std::vector<Shade> shades;

    void shadeTile(const WeightTile& tile) {
        groups.begin(tile.entries.size());
        shades.assign(tile.entries.size(), {options.background, 0.0});
        forEachEntry(tile, glm::dvec2(0.0), [&](std::size_t e, glm::dvec2 sample) {
            const Owner owner = tile.entries[e].owner;
            if (owner == kBackground) return;
            const bool constant = !plan.constant.empty() && plan.constant[owner];
            shades[e] = constant ? *plan.constant[owner] : Shade{};
            if (!constant) groups.add(owner, sample, static_cast<std::uint32_t>(e));
        });
        groups.finish(*shading, shades);
    }
};

void benchBlend(benchmark::State& state, const std::string& name, const std::string& filter) {
    Weighed weighed(name, filter);
    for (auto _ : state) {
        weighed.blendAll();
        benchmark::DoNotOptimize(weighed.image.rgba.data());
    }
    countNanoseconds(state, "pair", weighed.pairs);
}

void benchWrite(benchmark::State& state, const std::string& name, ImageFormat format) {
    Weighed weighed(name, "box");
    weighed.blendAll();
    WriteOptions options;
    options.width = options.height = kFilmPx;
    for (auto _ : state) benchmark::DoNotOptimize(encodeImage(weighed.image, format, options).data());
    countNanoseconds(state, "pixel", static_cast<double>(kFilmPx) * kFilmPx);
}

int registerAll() {
    for (const std::string& scene : std::vector<std::string>{"torus-20k", "random-2k"}) {
        const auto add = [&](const std::string& name, void (*body)(benchmark::State&, const std::string&)) {
            registerBench(name + "/" + scene, [=](benchmark::State& state) { body(state, scene); });
        };
        add("load_gltf", benchLoad), add("project", benchProject), add("plan", benchPlan);
        add("gather", benchGather), add("visibility", benchVisibility), add("tiles", benchSegmentTiles);
        for (const std::string& filter : std::vector<std::string>{"box", "gaussian"}) {
            registerBench("weights/" + filter + "/" + scene,
                          [=](benchmark::State& state) { benchWeights(state, scene, filter); });
            registerBench("blend/" + filter + "/" + scene,
                          [=](benchmark::State& state) { benchBlend(state, scene, filter); });
        }
        registerBench("write_image/exr/" + scene,
                      [=](benchmark::State& state) { benchWrite(state, scene, ImageFormat::kExr); });
        registerBench("write_image/png/" + scene,
                      [=](benchmark::State& state) { benchWrite(state, scene, ImageFormat::kPng); });
    }
    return 0;
}

const int kRegistered = registerAll();

}  // namespace
}  // namespace edgewise::bench
