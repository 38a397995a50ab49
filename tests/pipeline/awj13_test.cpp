// nsaa:visibility=awj13: the same picture, bit for bit, within the published method's limits; beyond them it
// says so.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>

#include "pipeline/error.h"
#include "tests/pipeline/shipped_picture.h"
#include "tests/pipeline/test_scene.h"

namespace edgewise {
namespace {

constexpr const char* kAwj13 = "nsaa:visibility=awj13,device=cpu";

bool hasNote(const MethodResult& result, const std::string& text) {
    return std::ranges::any_of(result.notes,
                               [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

double farthestApart(const ImageBuffer& one, const ImageBuffer& two) {
    double most = 0.0;
    for (std::size_t i = 0; i < one.rgba.size(); ++i) {
        const glm::dvec4 apart = glm::abs(one.rgba[i] - two.rgba[i]);
        most = std::max({most, apart.x, apart.y, apart.z, apart.w});
    }
    return most;
}

TEST(Awj13, GivesTheSweepsPictureOfMeshesThatDoNotPierce) {
    const Prefilter filter = makePrefilter("gaussian", {}, {});
    for (const char* name : {"log-grid", "zone-plate", "torus-sequence"}) {
        const test::ShippedPicture picture = test::shippedPicture(name, 96);
        const MethodResult swept = test::renderPicture(picture, filter, test::onBlue(), "nsaa:device=cpu"),
                           by_edges = test::renderPicture(picture, filter, test::onBlue(), kAwj13);
        // The sweep's slivers of rounding are thinner than a step of the grid.
        EXPECT_LE(farthestApart(by_edges.image, swept.image), kGridPx) << name;
        EXPECT_EQ(by_edges.counts.at("open_boundaries"), 0u) << name;
        EXPECT_EQ(by_edges.counts.at("cells_certified"), 0u) << name;
        EXPECT_GT(by_edges.counts.at("segments"), 30u) << name;
    }
}

MethodResult render(const Scene& scene, const RenderOptions& options, const char* method) {
    const ResolvedCamera camera = test::makePerspective();
    const Film film = test::makeFilm(16, 16);
    const Prefilter filter = makePrefilter("box", {}, {});
    Progress progress;
    return runMethod(parseMethod(method), {scene, camera, film, filter, options, progress});
}

/// Two triangles in the form of a cross, seen from where both are seen on both sides of the other.
Scene crossedTriangles() {
    return test::makeScene(
        {test::makeGeometry({{glm::vec3(-1, -1, -3), glm::vec3(1, -1, -2), glm::vec3(0, 1, -2.5)},
                             {glm::vec3(-1, -1, -2), glm::vec3(1, -1, -3), glm::vec3(0, 1, -2.5)}})});
}

TEST(Awj13, TellsOfBoundariesThatStayOpen) {
    const MethodResult result = render(crossedTriangles(), {}, kAwj13);
    EXPECT_GT(result.counts.at("open_boundaries"), 0u);
    EXPECT_TRUE(hasNote(result, "boundaries of owners open"));
    EXPECT_FALSE(hasNote(render(crossedTriangles(), {}, "nsaa:device=cpu"), "open"));
}

TEST(Awj13, RefusesWhatIsSeenThrough) {
    Scene scene = crossedTriangles();
    scene.materials[0].base_color = {1.0, 1.0, 1.0, 0.5};
    scene.materials[0].alpha_mode = AlphaMode::kBlend;
    try {
        render(scene, {}, kAwj13);
        FAIL() << "nothing was refused";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "visibility=awj13: knows opaque triangles only, and the scene has others");
    }
}

TEST(Awj13, RunsOnTheCpuAndSaysSo) {
    RenderOptions options;
    options.device = DeviceChoice::kVulkan;
    const MethodResult result = render(crossedTriangles(), options, "nsaa:visibility=awj13");
    EXPECT_EQ(result.device, "cpu");
    EXPECT_TRUE(hasNote(result, "ran on the CPU: it has no Vulkan form here"));
}

}  // namespace
}  // namespace edgewise
