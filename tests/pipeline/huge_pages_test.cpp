// Memory that is zero from the start, small and large, the second time too.
#include "pipeline/huge_pages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

namespace edgewise {
namespace {

TEST(HugePages, AreZeroWhateverWasThereBefore) {
    for (const std::size_t count :
         {std::size_t{1}, std::size_t{1000}, std::size_t{1} << 18, (std::size_t{1} << 19) + 1})
        for (int round = 0; round < 3; ++round) {
            ZeroedVector<double> memory(count);
            ASSERT_TRUE(std::ranges::all_of(memory, [](double v) { return v == 0.0; })) << count;
            std::ranges::fill(memory, 7.0);  // for the next round to find
        }
}

TEST(HugePages, KeepTheirValuesWhenCopiedAndMoved) {
    ZeroedVector<float> first(1 << 20);
    first[12345] = 3.0f;
    const ZeroedVector<float> copy = first;
    const ZeroedVector<float> moved = std::move(first);
    EXPECT_EQ(copy, moved);
    EXPECT_EQ(copy[12345], 3.0f);
    EXPECT_EQ(copy[12346], 0.0f);
}

TEST(HugePages, TooMuchIsRefused) {
    EXPECT_THROW(allocateZeros(SIZE_MAX - 4096), std::bad_alloc);
    EXPECT_THROW(allocateZeros(std::size_t{1} << 60), std::bad_alloc);
}

}  // namespace
}  // namespace edgewise
