// Visibility on the device against the host's: the visible map in every bit.
#include "pipeline/vulkan/visibility.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <bit>

#include "pipeline/gather.h"
#include "pipeline/plan.h"
#include "pipeline/project.h"
#include "pipeline/visibility.h"
#include "tests/pipeline/shipped_picture.h"
#include "tests/vulkan/test_device.h"
#include "tests/witness/hard_cases.h"
#include "tests/witness/random_scenes.h"

namespace edgewise::vulkan {
namespace {

VisibilityPasses& passes() {
    static VisibilityPasses one(vulkan::test::device());
    return one;
}

bool sameBits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
bool sameBits(glm::dvec2 a, glm::dvec2 b) {
    return sameBits(a.x, b.x) && sameBits(a.y, b.y);
}
bool sameBits(const FinePoint& a, const FinePoint& b) {
    return sameBits(a.grid, b.grid) && sameBits(a.rest, b.rest);
}
bool sameBits(const VisibleSegment& a, const VisibleSegment& b) {
    return sameBits(a.a, b.a) && sameBits(a.b, b.b) && sameBits(a.length, b.length) && a.line == b.line &&
           a.left == b.left && a.right == b.right;
}
bool sameBits(const RowOwner& a, const RowOwner& b) {
    return sameBits(a.x_px, b.x_px) && a.owner == b.owner;
}
bool sameBits(const CarrierLine& a, const CarrierLine& b) {
    return sameBits(a.origin, b.origin) && sameBits(a.nx_hi, b.nx_hi) && sameBits(a.nx_lo, b.nx_lo) &&
           sameBits(a.ny_hi, b.ny_hi) && sameBits(a.ny_lo, b.ny_lo) && sameBits(a.c_hi, b.c_hi) &&
           sameBits(a.c_lo, b.c_lo) && sameBits(a.length, b.length) && sameBits(a.direction, b.direction);
}

/// How many items differ; all of the longer list where the lengths do.
template <class Item>
std::size_t differing(const std::vector<Item>& a, const std::vector<Item>& b) {
    if (a.size() != b.size()) return std::max(a.size(), b.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += sameBits(a[i], b[i]) ? 0 : 1;
    return count;
}

void expectSame(const VisibleMap& device, const VisibleMap& host, const std::string& name) {
    EXPECT_EQ(device.segments.size(), host.segments.size()) << name;
    EXPECT_EQ(differing(device.segments, host.segments), 0u) << name;
    EXPECT_EQ(differing(device.lines, host.lines), 0u) << name;
    EXPECT_EQ(differing(device.rows, host.rows), 0u) << name;
    EXPECT_EQ(device.row_offset, host.row_offset) << name;
    EXPECT_EQ(device.row_begin, host.row_begin) << name;
    ASSERT_EQ(device.stacks.size(), host.stacks.size()) << name;
    for (Owner stack = kFirstStack; stack < kFirstStack + host.stacks.size(); ++stack)
        EXPECT_TRUE(std::ranges::equal(device.stacks.layers(stack), host.stacks.layers(stack))) << name;
}

struct Compared {
    VisibilityReport device;
    VisibilityCounts host;
    std::size_t segments = 0;
};

/// How far apart two cells may put a row's change of owners: from its own part of the line each comes to it
/// with five roundings of at most 2^-49 px within the cell, and one of the place on the screen.
double rowRounding(double x_px) {
    return 2.0 * (5 * 0x1p-49 + 0x1p-53 * std::abs(x_px));
}

/// The device keeps what a sheet hides, and so sweeps other cells than the host: the map is the same, but for
/// the last bits of where the rows change owners.
void expectSameMapWithSheets(const ScreenScene& scene, const CellGrid& grid, const IdLists& lists,
                             const VisibleMap& map, const std::string& name) {
    VisibilityCounts counts;
    Progress progress;
    const VisibleMap host = visibility(scene, grid, lists, {}, progress, counts);
    EXPECT_EQ(differing(map.segments, host.segments), 0u) << name;
    EXPECT_EQ(differing(map.lines, host.lines), 0u) << name;
    ASSERT_EQ(map.row_offset, host.row_offset) << name;
    for (std::size_t i = 0; i < host.rows.size(); ++i) {
        ASSERT_EQ(map.rows[i].owner, host.rows[i].owner) << name;
        ASSERT_NEAR(map.rows[i].x_px, host.rows[i].x_px, rowRounding(host.rows[i].x_px)) << name;
    }
}

/// Both maps of a scene, compared.
Compared compare(const ScreenScene& scene, const CellGrid& grid, VisibilityStageOptions options,
                 const std::string& name) {
    options.cell.sheets = false;
    const IdLists lists = gather(scene, grid);
    Compared result;
    Progress progress;
    const VisibleMap host = visibility(scene, grid, lists, options, progress, result.host);
    const Device& device = vulkan::test::device();
    const std::vector<std::uint32_t> offsets(lists.offsets.begin(), lists.offsets.end());
    const Buffer triangles = bufferOf(device, "triangles", scene.triangles),
                 planes = bufferOf(device, "planes", scene.planes),
                 offset_buffer = bufferOf(device, "offsets", offsets),
                 ids = bufferOf(device, "ids", lists.ids);
    PassGraph graph(device);
    const MapResources map =
        passes().addTo(graph, graph.input("triangles", triangles), graph.input("planes", planes),
                       graph.input("offsets", offset_buffer), graph.input("ids", ids), [&] {
                           return VisibilityInput{scene, grid, options.cell};
                       });
    graph.run({map.segments, map.lines, map.row_offsets, map.row_owners});
    result.device = passes().report();
    result.segments = host.segments.size();
    expectSame(passes().map(), host, name);
    EXPECT_EQ(result.device.counts.pieces, result.host.pieces) << name;
    EXPECT_EQ(result.device.counts.certified, result.host.certified) << name;
    expectSameMapWithSheets(scene, grid, lists, host, name);
    return result;
}

void print(const std::string& name, const Compared& c) {
    fmt::print(
        "{}: {} segments of {} pieces alike; {} cells, {} certified, {} leaves, {} exact, {} handed back; "
        "device {:.1f} ms, handed back {:.1f} ms, merge {:.1f} ms, {} dispatches\n",
        name, c.segments, c.device.counts.pieces, c.device.cells, c.device.counts.certified, c.device.leaves,
        c.device.exact, c.device.handed, c.device.device_seconds * 1e3, c.device.host_seconds * 1e3,
        c.device.merge_seconds * 1e3, c.device.dispatches);
}

class ShippedScene : public vulkan::test::DeviceTest, public testing::WithParamInterface<scenes::Recipe> {};

TEST_P(ShippedScene, HasTheHostsMap) {
    const edgewise::test::ShippedPicture picture = edgewise::test::shippedPicture(GetParam(), 160);
    ScreenPieces pieces;
    const ScreenScene screen = project(picture.scene, picture.camera, picture.film, pieces);
    const PixelBox& box = picture.film.crop;
    const CellGrid grid(Window{box.x0 - 3, box.y0 - 3, box.x1 + 3, box.y1 + 3});
    print(picture.name, compare(screen, grid, {}, picture.name));
}

INSTANTIATE_TEST_SUITE_P(All, ShippedScene, testing::ValuesIn(edgewise::test::shippedRecipes()),
                         [](const auto& recipe) { return edgewise::test::nameOf(recipe.param); });

class RandomScene : public vulkan::test::DeviceTest,
                    public testing::WithParamInterface<witness::SceneKind> {};

TEST_P(RandomScene, HasTheHostsMap) {
    constexpr std::uint64_t kFirstSeed = 1, kLastSeed = 6;
    witness::HardCases met;
    VisibilityReport sum;
    for (std::uint64_t seed = kFirstSeed; seed <= kLastSeed; ++seed) {
        const witness::RandomScene random = witness::makeRandomScene(GetParam(), seed);
        met += witness::countHardCases(random.scene);
        const CellGrid grid(
            Window{random.centre.x - 20, random.centre.y - 20, random.centre.x + 20, random.centre.y + 20});
        const Compared c =
            compare(random.scene, grid, {}, fmt::format("{} seed {}", nameOf(GetParam()), seed));
        sum.leaves += c.device.leaves, sum.exact += c.device.exact, sum.handed += c.device.handed;
        sum.counts.add(c.device.counts);
        if (HasFailure()) break;
    }
    fmt::print("{}, seeds {} to {}: {}; {} leaves, {} exact, {} handed back, {} certified\n",
               nameOf(GetParam()), kFirstSeed, kLastSeed, toString(met), sum.leaves, sum.exact, sum.handed,
               sum.counts.certified);
    EXPECT_GT(sum.leaves + sum.counts.certified, sum.handed);
}

INSTANTIATE_TEST_SUITE_P(All, RandomScene, testing::ValuesIn(witness::allSceneKinds()), [](const auto& kind) {
    return edgewise::test::testName(witness::nameOf(kind.param));
});

using SeeThrough = vulkan::test::DeviceTest;

TEST_F(SeeThrough, CellsAreHandedBackWithTheHostsStacks) {
    std::size_t handed = 0, leaves = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        witness::RandomScene random = witness::makeRandomScene(witness::SceneKind::kPiercing, seed);
        Owner last = 0;
        for (const ScreenTriangle& t : random.scene.triangles) last = std::max(last, t.owner);
        random.scene.see_through.assign(last + 1, 0);
        random.scene.see_through[last] = 1;
        const CellGrid grid(
            Window{random.centre.x - 20, random.centre.y - 20, random.centre.x + 20, random.centre.y + 20});
        const Compared c = compare(random.scene, grid, {}, fmt::format("see-through, seed {}", seed));
        handed += c.device.handed, leaves += c.device.leaves;
    }
    fmt::print("see-through, seeds 1 to 4: {} cells handed back, {} leaves on the device\n", handed, leaves);
    EXPECT_GT(handed, 0u);
}

}  // namespace
}  // namespace edgewise::vulkan
