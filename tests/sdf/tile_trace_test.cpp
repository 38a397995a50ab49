#include "sdf/tile_trace.h"

#include <gtest/gtest.h>

#include <bit>

#include "trace_scenes.h"

namespace edgewise::sdf {
namespace {

RayGrid gridOf(const TraceScene& scene, int size, bool perspective = true) {
    const glm::dvec3 along = glm::normalize(scene.target - scene.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(along, glm::dvec3(0, 1, 0)));
    const double side = (perspective ? 0.828 : 4.0) / size;
    RayGrid grid;
    grid.perspective = perspective;
    grid.eye_world = scene.eye, grid.axis_world = along;
    grid.right_world = right * side, grid.down_world = -glm::cross(right, along) * side;
    grid.corner_world = -0.5 * size * (grid.right_world + grid.down_world);
    grid.corner_world += perspective ? along : scene.eye;
    grid.t_min = 0.01, grid.t_max = scene.far;
    return grid;
}

std::vector<TraceHit> traced(const Tape& tape, const RayGrid& grid, int size, const TraceSettings& settings,
                             TileCounts& counts) {
    std::vector<TraceHit> hits(static_cast<std::size_t>(size) * size);
    const TileTracer tracer(tape, grid, settings, 1.0);
    for (int y = 0; y < size; y += 64)
        for (int x = 0; x < size; x += 64) {
            std::vector<TileRay> rays;
            for (int j = y; j < std::min(y + 64, size); ++j)
                for (int i = x; i < std::min(x + 64, size); ++i) {
                    const glm::dvec2 p(i + 0.5, j + 0.5);
                    rays.push_back({grid.ray(p), p, static_cast<std::uint32_t>(j * size + i)});
                }
            tracer.trace(x, y, rays, hits, counts);
        }
    return hits;
}

bool sameBits(const std::vector<TraceHit>& a, const std::vector<TraceHit>& b) {
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i].end != b[i].end ||
            std::bit_cast<std::uint64_t>(a[i].t) != std::bit_cast<std::uint64_t>(b[i].t) ||
            std::bit_cast<std::uint64_t>(a[i].value) != std::bit_cast<std::uint64_t>(b[i].value))
            return false;
    return true;
}

TEST(Beam, ItsBallsHoldAllItsRays) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    for (const bool perspective : {true, false}) {
        const RayGrid grid = gridOf(traceScenes()[1], 100, perspective);
        for (int i = 0; i < 2000; ++i) {
            const glm::dvec2 low(90 * part(random), 90 * part(random)),
                high = low + glm::dvec2(0.01 + 60 * part(random), 0.01 + 60 * part(random));
            const double a = 10 * part(random), b = a + 3 * part(random);
            const Ball ball = grid.beam(low, high).around(a, b);
            const FieldRay ray = grid.ray(low + (high - low) * glm::dvec2(part(random), part(random)));
            const double t = a + (b - a) * part(random);
            EXPECT_LE(glm::length(ray.origin_world + ray.direction_world * t - ball.centre_world),
                      ball.radius);
        }
    }
}

TEST(Beam, WhatABallLeavesFreeIsWithinIt) {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    int free = 0;
    for (const bool perspective : {true, false}) {
        const RayGrid grid = gridOf(traceScenes()[1], 100, perspective);
        for (int i = 0; i < 4000; ++i) {
            const glm::dvec2 low(90 * part(random), 90 * part(random)),
                high = low + glm::dvec2(20 * part(random));
            const Beam beam = grid.beam(low, high);
            const double t = 8 * part(random), radius = 3 * part(random), reach = beam.freeAround(t, radius);
            if (reach < 0.0) continue;
            ++free;
            const FieldRay ray =
                grid.ray(low + (high - low) * glm::dvec2(part(random) < 0.5, part(random) < 0.5));
            for (const double s : {t - reach, t + reach})
                EXPECT_LE(glm::length(ray.origin_world + ray.direction_world * s - beam.at(t)),
                          radius * (1 + 1e-12) + 1e-12);
        }
    }
    EXPECT_GT(free, 2000);
}

TEST(TileTrace, PruningChangesNoBitConesNoSurface) {
    double product = 1.0;
    int scenes = 0;
    std::uint64_t pruned_tapes = 0, empty = 0;
    for (const TraceScene& scene : traceScenes()) {
        const Tape tape = lower(scene.tree);
        const int size = 96;
        const RayGrid grid = gridOf(scene, size);
        TraceSettings settings, classic;
        TileCounts pruned, whole, plain;
        const auto a = traced(tape, grid, size, settings, pruned);
        settings.prune = false;
        const auto b = traced(tape, grid, size, settings, whole);
        classic.prune = classic.prepass = false, classic.relaxation = Relaxation::kNone;
        const auto c = traced(tape, grid, size, classic, plain);
        EXPECT_TRUE(sameBits(a, b)) << scene.name;
        int different = 0;
        for (std::size_t i = 0; i < a.size(); ++i) different += a[i].hit() != c[i].hit();
        EXPECT_LE(different, size * size / 1000) << scene.name;
        EXPECT_EQ(pruned.rays, a.size());
        const double fewer = static_cast<double>(plain.evaluations) /
                             static_cast<double>(pruned.evaluations + pruned.cone_evaluations);
        std::printf(
            "%-12s %.2f times fewer evaluations, cones counted; %zu instructions, %.1f an evaluation; %d "
            "pixels differ\n",
            scene.name.c_str(), fewer, tape.size(),
            double(pruned.instructions) / double(pruned.evaluations + pruned.cone_evaluations), different);
        product *= fewer, ++scenes;
        pruned_tapes += pruned.prune.tapes, empty += pruned.empty_tiles;
    }
    std::printf("geometric mean %.2f\n", std::pow(product, 1.0 / scenes));
    EXPECT_GT(std::pow(product, 1.0 / scenes), 2.5);
    EXPECT_GT(pruned_tapes, 100u);
    EXPECT_GT(empty, 10u);
}

TEST(TileTrace, ParallelRaysToo) {
    const TraceScene scene = traceScenes()[6];
    const Tape tape = lower(scene.tree);
    const RayGrid grid = gridOf(scene, 70, false);
    TraceSettings settings, classic;
    TileCounts counts;
    const auto a = traced(tape, grid, 70, settings, counts);
    settings.prune = false;
    EXPECT_TRUE(sameBits(a, traced(tape, grid, 70, settings, counts)));
    classic.prune = classic.prepass = false, classic.relaxation = Relaxation::kNone;
    const auto c = traced(tape, grid, 70, classic, counts);
    int hits = 0, different = 0;
    for (std::size_t i = 0; i < a.size(); ++i) hits += a[i].hit(), different += a[i].hit() != c[i].hit();
    EXPECT_GT(hits, 500);
    EXPECT_LE(different, 5);
}

}  // namespace
}  // namespace edgewise::sdf
