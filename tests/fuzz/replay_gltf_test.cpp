// Every kept glTF input of the fuzzer, each of its truncations, and JSON mutations of it, in ordinary test
// runs.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/fuzz/gltf_from_bytes.h"
#include "tests/fuzz/mutate_json.h"

namespace edgewise::fuzz {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::vector<std::pair<std::string, Bytes>> seeds() {
    std::vector<std::pair<std::string, Bytes>> all;
    for (const auto& entry : std::filesystem::directory_iterator(EDGEWISE_GLTF_SEEDS)) {
        std::ifstream file(entry.path(), std::ios::binary);
        all.emplace_back(entry.path().filename().string(), Bytes{std::istreambuf_iterator<char>(file), {}});
    }
    std::sort(all.begin(), all.end());
    return all;
}

TEST(GltfFuzzReplay, EverySeedHolds) {
    for (const auto& [name, bytes] : seeds()) EXPECT_EQ(checkLoad(bytes), "") << name;
}

/// What the fuzzer starts from; what it finds is named found_*.
TEST(GltfFuzzReplay, TheFeaturesLoad) {
    int loaded = 0;
    for (const auto& [name, bytes] : seeds()) {
        if (name.starts_with("found_")) continue;
        EXPECT_NO_THROW({
            EXPECT_GT(loadBytes(bytes).triangle_count, 0u) << name;
            ++loaded;
        }) << name;
    }
    EXPECT_GE(loaded, 14);
}

TEST(GltfFuzzReplay, TruncationsHold) {
    for (const auto& [name, bytes] : seeds())
        for (std::size_t length = 0; length < bytes.size(); length += 7)
            EXPECT_EQ(checkLoad(std::span(bytes).first(length)), "") << name << " cut to " << length;
}

TEST(GltfFuzzReplay, MutatedJsonHolds) {
    constexpr std::uint64_t kSeed = 3, kMutations = 60;
    int changed = 0;
    for (const auto& [name, bytes] : seeds()) {
        const auto zero = std::find(bytes.begin(), bytes.end(), 0);
        for (std::uint64_t k = 0; k < kMutations; ++k) {
            const std::string text = mutateJson(std::string(bytes.begin(), zero), kSeed + k);
            Bytes mutant(text.begin(), text.end());
            mutant.insert(mutant.end(), zero, bytes.end());
            changed += !text.empty();
            EXPECT_EQ(checkLoad(mutant), "") << name << ", mutation " << kSeed + k;
        }
    }
    EXPECT_GT(changed, 500);
}

}  // namespace
}  // namespace edgewise::fuzz
