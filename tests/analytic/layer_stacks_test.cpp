#include "analytic/layer_stacks.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace edgewise {
namespace {

using Layers = std::vector<Owner>;

Owner nameOf(LayerStacks& table, const Layers& layers) {
    return table.owner(layers);
}

TEST(LayerStacks, ASingleLayerIsItsOwnOwner) {
    LayerStacks table;
    EXPECT_EQ(nameOf(table, {7}), 7u);
    EXPECT_EQ(nameOf(table, {kBackground}), kBackground);
    EXPECT_TRUE(table.empty());
    const Owner seven = 7;
    EXPECT_TRUE(std::ranges::equal(table.layersOf(seven), Layers{7}));
}

TEST(LayerStacks, TheSameLayersHaveOneName) {
    LayerStacks table;
    const Owner first = nameOf(table, {3, 1, kBackground});
    const Owner second = nameOf(table, {1, 3, kBackground});
    EXPECT_TRUE(isStack(first));
    EXPECT_NE(first, second);
    EXPECT_EQ(nameOf(table, {3, 1, kBackground}), first);
    EXPECT_EQ(table.size(), 2u);
    EXPECT_TRUE(std::ranges::equal(table.layersOf(second), Layers{1, 3, kBackground}));
}

TEST(LayerStacks, JoinedTablesAreSortedWhateverCameFirst) {
    LayerStacks a, b;
    const Owner in_a = nameOf(a, {9, 2}), shared_a = nameOf(a, {4, 5, 6});
    const Owner shared_b = nameOf(b, {4, 5, 6}), in_b = nameOf(b, {4, 5});
    std::vector<std::vector<Owner>> names, other_names;
    const LayerStacks* const ab[] = {&a, &b};
    const LayerStacks* const ba[] = {&b, &a};
    const LayerStacks table = LayerStacks::joined(ab, names), other = LayerStacks::joined(ba, other_names);
    ASSERT_EQ(table.size(), 3u);
    EXPECT_EQ(names[0][shared_a - kFirstStack], names[1][shared_b - kFirstStack]);
    EXPECT_LT(names[1][in_b - kFirstStack], names[0][shared_a - kFirstStack]);
    EXPECT_LT(names[0][shared_a - kFirstStack], names[0][in_a - kFirstStack]);
    EXPECT_EQ(names[0], other_names[1]);
    EXPECT_EQ(names[1], other_names[0]);
    EXPECT_TRUE(std::ranges::equal(table.layersOf(names[0][in_a - kFirstStack]), Layers{9, 2}));
    EXPECT_EQ(other.size(), 3u);
}

}  // namespace
}  // namespace edgewise
