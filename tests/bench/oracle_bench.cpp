// Seconds of the oracle's visible map and areas of 1000 triangles: the promise is 5 s or less, kernels apart.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <random>

#include "analytic/exact/visible_faces.h"
#include "pipeline/judge/stiff_scene.h"

namespace edgewise::bench {
namespace {

constexpr int kSidePx = 64;
constexpr int kTriangles = 1000;

/// Piercing triangles at random, `layers` deep on average.
ScreenScene overlapping(double layers) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> at(0, kSidePx), turn(0, 2 * std::numbers::pi), depth(0, 1);
    // Of three random points of a circle the triangle's area is 3/(2 pi) R^2 on average.
    const double radius = std::sqrt(layers * kSidePx * kSidePx / kTriangles * 2 * std::numbers::pi / 3);
    judge::StiffSceneBuilder builder({0, 0});
    for (int k = 0; k < kTriangles; ++k) {
        const glm::dvec2 centre{at(random), at(random)};
        std::array<glm::dvec3, 3> corners;
        for (glm::dvec3& p : corners) {
            const double angle = turn(random);
            p = {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle), depth(random)};
        }
        builder.add(corners);
    }
    return builder.scene();
}

/// A height field of 500 squares in two triangles each, its corners moved at random.
ScreenScene mesh() {
    constexpr int kColumns = 25, kRows = 20;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> move(-0.3, 0.3), depth(0, 1);
    std::array<std::array<glm::dvec3, kColumns + 1>, kRows + 1> p;
    for (int j = 0; j <= kRows; ++j)
        for (int i = 0; i <= kColumns; ++i)
            p[j][i] = {(i + move(random)) * kSidePx / kColumns, (j + move(random)) * kSidePx / kRows,
                       depth(random)};
    judge::StiffSceneBuilder builder({0, 0});
    for (int j = 0; j < kRows; ++j)
        for (int i = 0; i < kColumns; ++i) {
            builder.add({p[j][i], p[j][i + 1], p[j + 1][i + 1]});
            builder.add({p[j][i], p[j + 1][i + 1], p[j + 1][i]});
        }
    return builder.scene();
}

void envelopeAndAreas(benchmark::State& state, const ScreenScene& scene) {
    std::size_t faces = 0, corners = 0;
    for (auto _ : state) {
        exact::Rational sum = 0;
        faces = corners = 0;
        for (const exact::Face& face :
             exact::visibleFaces(scene, {-kSidePx, -kSidePx, 2 * kSidePx, 2 * kSidePx})) {
            sum += exact::area(face);
            ++faces;
            for (const auto& cycle : face.cycles) corners += cycle.size();
        }
        benchmark::DoNotOptimize(sum);
    }
    state.counters["triangles"] = static_cast<double>(scene.triangles.size());
    state.counters["faces"] = static_cast<double>(faces);
    state.counters["corners"] = static_cast<double>(corners);
}

int registerAll() {
    const auto add = [](const std::string& name, const ScreenScene& scene) {
        benchmark::RegisterBenchmark(("oracle/" + name).c_str(),
                                     [=](benchmark::State& state) { envelopeAndAreas(state, scene); })
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    };
    add("mesh", mesh());
    for (const int layers : {1, 4, 16}) add("overlapping-" + std::to_string(layers), overlapping(layers));
    return 0;
}

const int kRegistered = registerAll();

}  // namespace
}  // namespace edgewise::bench
