// Gather on the device against the CPU's: the same lists, id by id, for every form of rasterization.
#include "pipeline/vulkan/gather.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "pipeline/gather.h"
#include "pipeline/grid_orientation.h"
#include "pipeline/project.h"
#include "pipeline/vulkan/layouts.h"
#include "tests/pipeline/shipped_picture.h"
#include "tests/vulkan/test_device.h"
#include "tests/witness/dice.h"

namespace edgewise::vulkan {
namespace {

std::vector<GatherForm> formsOf(const Device& device) {
    std::vector<GatherForm> forms{GatherForm::kBoxes, GatherForm::kInstancedBoxes};
    if (device.traits().geometry_shader) forms.push_back(GatherForm::kThickened);
    if (device.traits().geometry_shader && device.traits().conservative_rasterization)
        forms.push_back(GatherForm::kOverestimated);
    return forms;
}

class GatherTest : public test::DeviceTest {
  protected:
    /// The device's lists; the second run of the same graph must give them too.
    IdLists onDevice(const ScreenScene& scene, const CellGrid& grid, GatherForm form) {
        const Device& device = test::device();
        Gather stage(device, form);
        PassGraph graph(device);
        const Buffer triangles = bufferOf(device, "triangles", scene.triangles);
        const Resource in = graph.input("triangles", triangles);
        const DeviceLists lists = stage.addTo(graph, in, scene.triangles.size(), grid);
        graph.run({lists.ids});
        graph.run({lists.ids});
        seconds_ = 0.0;
        for (const PassTime& time : graph.times()) {
            seconds_ += time.seconds;
            if (std::getenv("EDGEWISE_TEST_TIMES"))
                fmt::print("  {:20} {:.2f} ms\n", time.name, 1e3 * time.seconds);
        }
        const auto offsets = graph[lists.offsets].read<std::uint32_t>(grid.size() + 1);
        const auto ids = graph[lists.ids].read<std::uint32_t>(offsets.back());
        return {{offsets.begin(), offsets.end()}, {ids.begin(), ids.end()}};
    }

    void expectTheSame(const std::string& name, const ScreenScene& scene, const CellGrid& grid) {
        const IdLists expected = gather(scene, grid);
        for (const GatherForm form : formsOf(test::device())) {
            const IdLists got = onDevice(scene, grid, form);
            EXPECT_EQ(got.offsets, expected.offsets) << name << ", form " << static_cast<int>(form);
            EXPECT_EQ(got.ids, expected.ids) << name << ", form " << static_cast<int>(form);
            fmt::print("{}: {} cells, {} ids, form {}: {:.1f} ms on the device\n", name, grid.size(),
                       got.ids.size(), static_cast<int>(form), 1e3 * seconds_);
        }
    }

    double seconds_ = 0.0;
};

TEST_F(GatherTest, ShippedScenesHaveTheListsOfTheCpu) {
    for (const scenes::Recipe& recipe : edgewise::test::shippedRecipes()) {
        const auto picture = edgewise::test::shippedPicture(recipe, 256);
        ScreenPieces pieces;
        const ScreenScene screen = project(picture.scene, picture.camera, picture.film, pieces);
        const PixelBox& box = picture.film.crop;
        expectTheSame(picture.name, screen, CellGrid(Window{box.x0 - 3, box.y0 - 3, box.x1 + 3, box.y1 + 3}));
    }
}

/// What a rasterizer gets wrong: slivers, points beside borders, triangles far beyond the window, huge ones.
struct HardTriangles {
    explicit HardTriangles(std::uint64_t seed) : dice(seed) {}

    glm::dvec2 onGrid(glm::dvec2 p) const { return glm::round(p / kGridPx) * kGridPx; }

    glm::dvec2 corner() {
        switch (dice.integer(0, 4)) {
            case 0:  // anywhere in the guard band
                ++far;
                return onGrid(dice.around({0.0, 0.0}, kGuardBandPx));
            case 1: {  // at, or a little beside, a corner of a cell
                ++at_corners;
                const glm::dvec2 cell(16 * dice.integer(-1, 20), 16 * dice.integer(-1, 20));
                return onGrid(cell + dice.around({0.0, 0.0}, dice.magnitude(-10, -1)));
            }
            case 2: {  // on a border
                const double at = 16.0 * dice.integer(-1, 20);
                const double along = dice.uniform(-10.0, 300.0);
                return onGrid(dice.coin() ? glm::dvec2(at, along) : glm::dvec2(along, at));
            }
            default:
                return onGrid(dice.around({150.0, 150.0}, 170.0));
        }
    }

    ScreenTriangle triangle() {
        ScreenTriangle t{};
        for (;;) {
            t.p_px = {corner(), corner(), corner()};
            if (dice.integer(0, 3) == 0) {  // a sliver: the third corner all but on the first edge
                const double s = dice.uniform(-0.2, 1.2);
                t.p_px[2] = onGrid(t.p_px[0] + s * (t.p_px[1] - t.p_px[0]) +
                                   dice.around({0.0, 0.0}, dice.magnitude(-9, 0)));
                ++slivers;
            }
            if (dice.integer(0, 3) == 0)  // a small one
                for (int k = 1; k < 3; ++k)
                    t.p_px[k] = onGrid(t.p_px[0] + dice.around({0.0, 0.0}, dice.magnitude(-8, 1)));
            const int side = gridOrientation(t.p_px[0], t.p_px[1], t.p_px[2]);
            if (side < 0) std::swap(t.p_px[1], t.p_px[2]);
            if (side != 0 && inside(t)) return t;
        }
    }

    static bool inside(const ScreenTriangle& t) {
        for (const glm::dvec2& p : t.p_px)
            if (std::max(std::abs(p.x), std::abs(p.y)) > kGuardBandPx) return false;
        return true;
    }

    witness::Dice dice;
    int far = 0, at_corners = 0, slivers = 0;
};

TEST_F(GatherTest, HardTrianglesHaveTheListsOfTheCpu) {
    constexpr std::uint64_t kSeed = 5;
    HardTriangles hard(kSeed);
    ScreenScene scene;
    for (int i = 0; i < 30000; ++i) scene.triangles.push_back(hard.triangle());
    fmt::print("seed {}: {} far corners, {} at corners of cells, {} slivers\n", kSeed, hard.far,
               hard.at_corners, hard.slivers);
    EXPECT_GT(hard.far, 1000);
    EXPECT_GT(hard.at_corners, 1000);
    EXPECT_GT(hard.slivers, 1000);
    expectTheSame("hard triangles", scene, CellGrid(Window{-5, 3, 300, 290}));
}

TEST_F(GatherTest, ListsTooLongForOneInvocationAreInOrderToo) {
    constexpr std::uint64_t kSeed = 6;
    HardTriangles hard(kSeed);
    ScreenScene scene;
    while (scene.triangles.size() < kSortLongest + 1000) {
        ScreenTriangle t = hard.triangle();
        for (glm::dvec2& p : t.p_px) p = glm::round(p * 0x1p-17 / kGridPx) * kGridPx;  // within +-8 px
        if (gridOrientation(t.p_px[0], t.p_px[1], t.p_px[2]) > 0) scene.triangles.push_back(t);
    }
    const CellGrid grid(Window{-16, -16, 16, 16});
    const IdLists lists = gather(scene, grid);
    std::size_t longest = 0, shorter = 0;
    for (std::size_t i = 0; i < grid.size(); ++i) {
        const std::size_t length = lists.offsets[i + 1] - lists.offsets[i];
        (length > kSortLongest ? longest : shorter) += length;
    }
    fmt::print("seed {}: {} ids in long lists, {} in shorter ones\n", kSeed, longest, shorter);
    EXPECT_GT(longest, kSortLongest);
    EXPECT_GT(shorter, 500u);
    expectTheSame("long lists", scene, grid);
}

TEST_F(GatherTest, AnEmptySceneHasEmptyLists) {
    expectTheSame("nothing", ScreenScene{}, CellGrid(Window{0, 0, 40, 40}));
}

using ScanTest = test::DeviceTest;

TEST_F(ScanTest, OffsetsOfAnyNumberOfCounts) {
    constexpr std::uint64_t kSeed = 7;
    witness::Dice dice(kSeed);
    const Device& device = test::device();
    Scan scan(device);
    // none, one, around a block, two levels, three levels
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{1}, std::size_t{kScanBlock}, std::size_t{kScanBlock} + 1,
          std::size_t{300001}, std::size_t{kScanBlock} * kScanBlock + 5}) {
        std::vector<std::uint32_t> counts(size);
        for (std::uint32_t& count : counts) count = static_cast<std::uint32_t>(dice.integer(0, 900));
        const Buffer filled = bufferOf(device, "counts", counts);
        PassGraph graph(device);
        const Resource offsets = scan.addTo(graph, "test", graph.input("counts", filled), size);
        graph.run({offsets});
        const auto expected = offsetsFromCounts(counts);
        const auto got = graph[offsets].read<std::uint32_t>(size + 1);
        EXPECT_TRUE(std::equal(got.begin(), got.end(), expected.begin())) << size;
    }
}

TEST_F(ScanTest, SumsBeyond32BitsStayAtTheLargest) {
    const Device& device = test::device();
    Scan scan(device);
    std::vector<std::uint32_t> counts(3 * kScanBlock, 1);
    counts[10] = counts[kScanBlock + 1] = 0xf0000000u;
    const Buffer filled = bufferOf(device, "counts", counts);
    PassGraph graph(device);
    const Resource offsets = scan.addTo(graph, "test", graph.input("counts", filled), counts.size());
    graph.run({offsets});
    const auto got = graph[offsets].read<std::uint32_t>(counts.size() + 1);
    EXPECT_EQ(got[kScanBlock], 0xf0000000u + kScanBlock - 1);
    EXPECT_EQ(got[kScanBlock + 2], 0xffffffffu);
    EXPECT_EQ(got[counts.size()], 0xffffffffu);
}

}  // namespace
}  // namespace edgewise::vulkan
