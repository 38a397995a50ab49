// The camera's way to the grid against 50 digits, over more scenes than the study's oracle has time for.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/judge/camera_cases.h"
#include "pipeline/judge/camera_scene.h"

namespace edgewise::judge {
namespace {

void expectKept(const ProjectionErrors& p, const std::string& where) {
    EXPECT_LE(p.worst_of_bound, 1.0) << where << ": " << p.max_px << " px";
    EXPECT_EQ(p.cracks, 0u) << where;
    EXPECT_EQ(p.lost_areas, 0u) << where;
}

TEST(ProjectionWitness, EveryCameraCaseStaysWithinItsBound) {
    const Prefilter filter = makePrefilter("tent", {}, {});
    for (const StabilityCase& one : cameraCases()) {
        ProjectionErrors all;
        for (const double difficulty : one.difficulties)
            for (std::uint64_t seed = 1; seed <= 16; ++seed) {
                const ProjectionErrors p = one.make(difficulty, filter, seed).projection.value();
                expectKept(p, fmt::format("{} at {:g}, seed {}", one.name, difficulty, seed));
                all.add(p);
            }
        fmt::print(
            "{}: {} vertices, {} made, {} shared clipped edges, {:.2f} of the bound, worst {:.1e} px\n",
            one.name, all.vertices, all.made, all.shared_edges, all.worst_of_bound, all.max_px);
        EXPECT_GT(all.made, 1000u) << one.name;
        EXPECT_GT(all.shared_edges, 100u) << one.name;
    }
}

/// An edge from far behind the eye to far before it, that passes closely above it: what cancels where it
/// meets the near plane leaves double-double too few digits for a step of the grid. The bound says so.
TEST(ProjectionWitness, KnowsWhatDoubleDoubleLosesBetweenTwoFarEnds) {
    ProjectionErrors all;
    for (int exponent = 0; exponent < 24; ++exponent) {
        const float size = std::ldexp(12345.0f, exponent), above = 1e-13f;  // the products below are exact
        CameraView view;
        view.znear = 1e-13;
        const glm::vec3 behind(-5 * size, 4 * above, 17 * size), before(6 * 5 * size, -above, -6 * 17 * size);
        const glm::vec3 third = view.toWorld(view.seenAt({3.0, 5.0}, 2.0));
        const ProjectionErrors p = throughCamera({{behind, before, third}}, view).projection.value();
        expectKept(p, fmt::format("ends of 12345 2^{}", exponent));
        EXPECT_GE(p.made, 2u);
        all.add(p);
    }
    fmt::print("worst {:.1e} px, {:.1e} promised, {:.2f} of the bound\n", all.max_px, all.bound_px,
               all.worst_of_bound);
    EXPECT_GT(all.max_px, 10 * kGridPx);  // or the bound's part is not needed
    EXPECT_EQ(all.undecided, 0u);
}

}  // namespace
}  // namespace edgewise::judge
