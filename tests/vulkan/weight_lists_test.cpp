// The device's lists of segments and owners against the host's, tile by tile.
#include "pipeline/vulkan/weight_lists.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "tests/vulkan/test_device.h"

namespace edgewise::vulkan {
namespace {

class WeightListsTest : public test::DeviceTest {};

constexpr PixelBox kArea{-5, 3, 96, 80};  // no multiple of a tile wide or high
constexpr glm::dvec2 kOffset{7.0, -2.0};
constexpr double kRadius = 1.5;
constexpr Owner kOwners = 40;

/// Distance of a pixel's sample to a segment.
double distance(const VisibleSegment& s, glm::dvec2 sample) {
    const glm::dvec2 a = s.a.grid + s.a.rest, b = s.b.grid + s.b.rest, along = b - a;
    const double size2 = along.x * along.x + along.y * along.y;
    const glm::dvec2 from = sample - a;
    const double t = size2 > 0.0 ? std::clamp((from.x * along.x + from.y * along.y) / size2, 0.0, 1.0) : 0.0;
    const glm::dvec2 d = from - t * along;
    return std::hypot(d.x, d.y);
}

class RandomMap {
  public:
    explicit RandomMap(unsigned seed) : random_(seed) {
        map.lines.resize(1);
        map.row_begin = kArea.y0 - 10;
        map.row_offset.assign(static_cast<std::size_t>(kArea.height()) + 21, 0);
        for (std::size_t row = 0; row + 1 < map.row_offset.size(); ++row)
            map.rows.push_back({-100.0, kBackground}), map.row_offset[row + 1] = row + 1;
    }
    /// `size_px` at most in either direction; also level and upright ones.
    void add(std::size_t count, double size_px, const PixelBox& around) {
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec2 from{number(around.x0, around.x1), number(around.y0, around.y1)};
            glm::dvec2 by{number(-size_px, size_px), number(0.0, size_px)};
            if (i % 16 == 0) by.y = 0.0;
            if (i % 16 == 1) by.x = 0.0;
            VisibleSegment s;
            s.a.grid = from + kOffset, s.b.grid = from + by + kOffset;
            s.a.rest = {0x1p-60, -0x1p-61};
            s.length = std::hypot(by.x, by.y);
            s.left = owner(), s.right = owner();
            map.segments.push_back(s);
        }
    }
    VisibleMap map;

  private:
    double number(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
    Owner owner() {
        const Owner o = std::uniform_int_distribution<Owner>(0, kOwners)(random_);
        return o == kOwners ? kBackground : o;
    }
    std::mt19937 random_;
};

/// Owners in pairs are one.
OwnerClasses pairs() {
    OwnerClasses classes;
    for (Owner o = 0; o < kOwners; ++o) classes.representative.push_back(o / 2 * 2);
    return classes;
}

using Sides = std::array<Owner, 2>;

struct ListedTile {
    std::multimap<std::uint32_t, Sides> segments;
    std::vector<Owner> owners;
    bool operator==(const ListedTile&) const = default;
};

ListedTile onHost(const WeightInput& input, std::span<const std::uint32_t> ids) {
    ListedTile tile;
    std::set<Owner> owners;
    for (const std::uint32_t id : ids) {
        const VisibleSegment& s = input.map.segments[id];
        const Sides sides{input.classes.of(s.left), input.classes.of(s.right)};
        if (sides[0] == sides[1]) continue;
        tile.segments.emplace(id, sides);
        owners.insert(sides.begin(), sides.end());
    }
    tile.owners.assign(owners.begin(), owners.end());
    return tile;
}

class ReadLists {
  public:
    explicit ReadLists(const WeightLists& lists) : lists_(lists) {
        const auto entries = lists.entries.read<GpuTileSegment>(lists.entry_begin.back());
        entries_.assign(entries.begin(), entries.end());
        const auto owners = lists.owners.read<uint>(lists.slot_begin.back());
        owners_.assign(owners.begin(), owners.end());
    }
    ListedTile tile(std::size_t t) const {
        ListedTile out;
        const uint first = lists_.slot_begin[t];
        out.owners.assign(owners_.begin() + first, owners_.begin() + lists_.slot_begin[t + 1]);
        for (std::size_t e = lists_.entry_begin[t]; e < lists_.entry_begin[t + 1]; ++e)
            out.segments.emplace(
                lists_.map->segment(entries_[e].segment),
                Sides{owners_.at(first + entries_[e].left), owners_.at(first + entries_[e].right)});
        return out;
    }

  private:
    const WeightLists& lists_;
    std::vector<GpuTileSegment> entries_;
    std::vector<uint> owners_;
};

void expectAllNearAreListed(const WeightInput& input, const PixelBox& box, const ListedTile& tile) {
    for (std::uint32_t id = 0; id < input.map.segments.size(); id += 7) {
        const VisibleSegment& s = input.map.segments[id];
        if (input.classes.of(s.left) == input.classes.of(s.right) || tile.segments.contains(id)) continue;
        for (int y = box.y0; y < box.y1; ++y)
            for (int x = box.x0; x < box.x1; ++x)
                ASSERT_GT(distance(s, glm::dvec2(x + 0.5, y + 0.5) + input.offset_px), kRadius) << id;
    }
}

/// Gives the longest list, in segments.
std::size_t compare(const WeightInput& input) {
    const auto lists = WeightListPasses(test::device(), kRadius).make(input);
    if (!lists) return ADD_FAILURE() << "does not fit", 0;
    const WeightTiles expected = gatherSegments(input.map, input.area, input.offset_px, kRadius, kTilePx);
    EXPECT_EQ(lists->entry_begin.size(), expected.boxes.size() + 1);
    const ReadLists read(*lists);
    std::size_t longest = 0, differing = 0;
    for (std::size_t t = 0; t < expected.boxes.size(); ++t) {
        const std::size_t begin = expected.segments.offsets[t], end = expected.segments.offsets[t + 1];
        const ListedTile host = onHost(input, std::span(expected.segments.ids).subspan(begin, end - begin));
        const ListedTile device = read.tile(t);
        differing += !(device == host);
        longest = std::max(longest, device.segments.size());
        expectAllNearAreListed(input, expected.boxes[t], device);
    }
    EXPECT_EQ(differing, 0u);
    return longest;
}

TEST_F(WeightListsTest, AreTheHostsForAWholeMapAndForAPart) {
    const unsigned seed = std::random_device{}();
    fmt::print("seed {}\n", seed);
    RandomMap random(seed);
    random.add(3000, 3.0, {kArea.x0 - 4, kArea.y0 - 4, kArea.x1 + 4, kArea.y1 + 4});
    random.add(300, 200.0, {kArea.x0 - 99, kArea.y0 - 99, kArea.x1, kArea.y1});  // across many tiles
    const OwnerClasses classes = pairs();
    auto all = WeightMap::ofAll(test::device(), random.map, classes);
    ASSERT_TRUE(all);
    const auto shared = std::make_shared<const WeightMap>(std::move(*all));
    EXPECT_GT(compare({random.map, classes, kArea, kOffset, shared}), 10u);
    EXPECT_GT(compare({random.map, classes, kArea, kOffset, {}}), 10u);
    EXPECT_GT(compare({random.map, classes, {3, 11, 7, 12}, kOffset, shared}), 10u);
}

TEST_F(WeightListsTest, AreTheHostsWhereATileHasMoreThanOneInvocationSorts) {
    const unsigned seed = std::random_device{}();
    fmt::print("seed {}\n", seed);
    RandomMap random(seed);
    random.add(3 * kSortLongest, 1.0, {12, 20, 18, 26});
    random.add(200, 1.0, kArea);
    const OwnerClasses classes;
    EXPECT_GT(2 * compare({random.map, classes, kArea, kOffset, {}}), kSortLongest);
}

TEST_F(WeightListsTest, AreEmptyWhereNothingIsNear) {
    const RandomMap random(1);
    const OwnerClasses classes;
    EXPECT_EQ(compare({random.map, classes, kArea, kOffset, {}}), 0u);
}

TEST_F(WeightListsTest, AnAreaBeyondTheTurnsOfLoopsIsHalved) {
    if (test::device().traits().loop_turns == 0xffffffff) GTEST_SKIP() << "loops turn as long as they want";
    const RandomMap random(1);
    const OwnerClasses classes;
    PixelBox wide = kArea;
    wide.x1 = wide.x0 + 40000;
    EXPECT_FALSE(WeightListPasses(test::device(), kRadius).make({random.map, classes, wide, kOffset, {}}));
}

}  // namespace
}  // namespace edgewise::vulkan
