// Sums by owner against a map, also where more owners meet than are searched.
#include "analytic/sample_owners.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace edgewise {
namespace {

TEST(SampleOwners, SumsAreThoseOfAMapInOrderOfTheOwners) {
    const unsigned seed = 31415;
    std::mt19937_64 random(seed);
    SampleOwners sums;
    std::size_t crowded = 0, cancelled = 0;
    for (const Owner owners : {1u, 3u, 31u, 32u, 33u, 100u, 1000u}) {
        std::uniform_int_distribution<Owner> any(0, owners - 1);
        std::uniform_int_distribution<FixedWeight> weight(-(FixedWeight{1} << 60), FixedWeight{1} << 60);
        sums.clear();
        std::map<Owner, FixedWeight> expected;
        const auto add = [&](Owner owner, FixedWeight w) {
            sums.add(owner, w);
            const auto sum = static_cast<std::uint64_t>(expected[owner]) + static_cast<std::uint64_t>(w);
            expected[owner] = static_cast<FixedWeight>(sum);
        };
        for (int i = 0; i < 3000; ++i) add(any(random), weight(random));
        add(0, -expected[0]);
        cancelled += std::erase_if(expected, [](const auto& entry) { return entry.second == 0; });
        crowded += expected.size() > 32;
        std::vector<OwnerWeight> out;
        sums.appendTo(out);
        ASSERT_EQ(out.size(), expected.size()) << "seed " << seed << ", " << owners << " owners";
        for (auto at = expected.begin(); const OwnerWeight& one : out) {
            ASSERT_EQ(one.owner, at->first);
            ASSERT_EQ(one.weight, at->second);
            ++at;
        }
    }
    EXPECT_GE(crowded, 2u);
    EXPECT_GE(cancelled, 7u);
}

}  // namespace
}  // namespace edgewise
