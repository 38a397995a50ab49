// What visibility does in its cells, each part alone, on one thread; and how their pieces become a map.
#include "analytic/cell_visibility.h"
#include "pipeline/merge_map.h"
#include "tests/bench/prepared.h"

namespace edgewise::bench {
namespace {

/// What a leaf holds by default.
constexpr std::size_t kMostInLeaf = VisibilityOptions{}.max_triangles;

/// `work` on each cell that has triangles, of at most so many; their number is told.
template <class Work>
void benchCells(benchmark::State& state, const std::string& name, std::size_t most, const Work& work) {
    const Prepared prepared(name);
    std::vector<std::size_t> cells;
    for (std::size_t i = 0; i < prepared.grid->size(); ++i)
        if (const std::size_t count = prepared.inCell(i).size(); count > 0 && count <= most)
            cells.push_back(i);
    CellOutput out;
    for (auto _ : state) {
        out = {};
        for (const std::size_t i : cells)
            work(prepared.screen, prepared.grid->cell(i), prepared.inCell(i), out);
        benchmark::DoNotOptimize(out.segments.data());
    }
    countNanoseconds(state, "cell", static_cast<double>(cells.size()));
    state.counters["pieces"] = static_cast<double>(out.segments.size());
    if (out.counts.slabs > 0) countNanoseconds(state, "slab", static_cast<double>(out.counts.slabs));
}

using Ids = std::span<const std::uint32_t>;

void benchSharedEdges(benchmark::State& state, const std::string& name) {
    SharedEdges edges;
    benchCells(state, name, SIZE_MAX, [&](const ScreenScene& scene, const Cell& cell, Ids ids, CellOutput&) {
        edges.collect(scene, cell, ids);
        benchmark::DoNotOptimize(edges.edges().data());
    });
}

/// With the edges that it looks at.
void benchOcclusion(benchmark::State& state, const std::string& name) {
    SharedEdges edges;
    SheetOcclusion occlusion;
    benchCells(state, name, SIZE_MAX, [&](const ScreenScene& scene, const Cell& cell, Ids ids, CellOutput&) {
        edges.collect(scene, cell, ids);
        benchmark::DoNotOptimize(occlusion.hidden(scene, cell, ids, edges).data());
    });
}

/// With the edges that it looks at.
void benchCertificate(benchmark::State& state, const std::string& name) {
    SharedEdges edges;
    SheetCertificate certificate;
    benchCells(state, name, SIZE_MAX,
               [&](const ScreenScene& scene, const Cell& cell, Ids ids, CellOutput& out) {
                   edges.collect(scene, cell, ids);
                   benchmark::DoNotOptimize(certificate.run(scene, cell, cell.min, ids, edges, out));
               });
}

void benchSweep(benchmark::State& state, const std::string& name) {
    SlabSweep sweep;
    benchCells(state, name, kMostInLeaf,
               [&](const ScreenScene& scene, const Cell& cell, Ids ids, CellOutput& out) {
                   sweep.run(scene, cell, cell.min, ids, {}, out);
               });
}

/// All cells' pieces as one output.
void benchMerge(benchmark::State& state, const std::string& name) {
    Prepared prepared(name);
    CellVisibility cells;
    CellOutput made;
    for (std::size_t i = 0; i < prepared.grid->size(); ++i)
        cells.run(prepared.screen, prepared.grid->cell(i), prepared.inCell(i), {}, made);
    for (auto _ : state) {
        state.PauseTiming();
        CellOutput copy = made;
        CellOutput* const outputs[]{&copy};
        state.ResumeTiming();
        benchmark::DoNotOptimize(
            mergeMap(prepared.screen, outputs, prepared.grid->px.y0, prepared.grid->px.y1, prepared.progress)
                .segments.data());
    }
    countNanoseconds(state, "piece", static_cast<double>(made.segments.size()));
}

int registerAll() {
    for (const std::string& scene : std::vector<std::string>{"torus-20k", "random-2k"}) {
        const auto add = [&](const std::string& name, void (*body)(benchmark::State&, const std::string&)) {
            registerBench("cells/" + name + "/" + scene, [=](benchmark::State& s) { body(s, scene); });
        };
        add("shared_edges", benchSharedEdges), add("occlusion", benchOcclusion);
        add("certificate", benchCertificate), add("slab_sweep", benchSweep), add("merge", benchMerge);
    }
    return 0;
}

const int kRegistered = registerAll();

}  // namespace
}  // namespace edgewise::bench
