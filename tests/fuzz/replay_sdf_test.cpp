// Every kept SDF input of the fuzzers, each of its truncations, and JSON mutations of it, in ordinary test
// runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "sdf/load_sdf.h"
#include "tests/fuzz/mutate_json.h"
#include "tests/fuzz/sdf_from_bytes.h"

namespace edgewise::fuzz {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Of one kind: "sdf_" or "map_".
std::vector<std::pair<std::string, Bytes>> seeds(const std::string& kind) {
    std::vector<std::pair<std::string, Bytes>> all;
    for (const auto& entry : std::filesystem::directory_iterator(EDGEWISE_SDF_SEEDS)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with(kind)) continue;
        std::ifstream file(entry.path(), std::ios::binary);
        all.emplace_back(name, Bytes{std::istreambuf_iterator<char>(file), {}});
    }
    std::sort(all.begin(), all.end());
    return all;
}

TEST(SdfFuzzReplay, EverySeedAndItsTruncationsHold) {
    EXPECT_GE(seeds("sdf_").size(), 6u);
    for (const auto& [name, bytes] : seeds("sdf_")) {
        EXPECT_EQ(checkSdf(bytes), "") << name;
        for (std::size_t length = 0; length < bytes.size(); length += 11)
            EXPECT_EQ(checkSdf(std::span(bytes).first(length)), "") << name << " cut to " << length;
    }
}

/// What the fuzzers start from; what they find is named sdf_found_* or map_found_*.
TEST(SdfFuzzReplay, TheFeaturesLoad) {
    for (const auto& [name, bytes] : seeds("sdf_")) {
        if (name.starts_with("sdf_found_")) continue;
        const std::string text(bytes.begin(), bytes.end());
        EXPECT_NO_THROW(EXPECT_FALSE(sdf::loadSdf(text).tree.empty())) << name;
    }
}

TEST(SdfFuzzReplay, MutatedJsonHolds) {
    constexpr std::uint64_t kSeed = 5, kMutations = 80;
    int changed = 0;
    for (const auto& [name, bytes] : seeds("sdf_"))
        for (std::uint64_t k = 0; k < kMutations; ++k) {
            const std::string text = mutateJson(std::string(bytes.begin(), bytes.end()), kSeed + k);
            changed += !text.empty();
            EXPECT_EQ(checkSdf(Bytes(text.begin(), text.end())), "") << name << ", mutation " << kSeed + k;
        }
    EXPECT_GT(changed, 300);
}

TEST(MapFuzzReplay, EverySeedAndItsTruncationsHold) {
    EXPECT_GE(seeds("map_").size(), 2u);
    for (const auto& [name, bytes] : seeds("map_"))
        for (std::size_t length = 0; length <= bytes.size(); ++length)
            EXPECT_EQ(checkMap(std::span(bytes).first(length)), "") << name << " cut to " << length;
}

}  // namespace
}  // namespace edgewise::fuzz
