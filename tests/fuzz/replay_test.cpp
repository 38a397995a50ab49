// Every kept fuzzer input, and random bytes, in ordinary test runs.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/fuzz/check_visibility.h"
#include "tests/fuzz/scene_from_bytes.h"
#include "tests/witness/dice.h"
#include "tests/witness/hard_cases.h"

namespace edgewise::fuzz {
namespace {

std::vector<std::uint8_t> readAll(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(FuzzReplay, EverySeedHolds) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(EDGEWISE_SEEDS)) {
        EXPECT_EQ(checkVisibility(sceneFromBytes(readAll(entry.path()))), "") << entry.path().filename();
        ++count;
    }
    EXPECT_GT(count, 0u);
}

/// Inputs that are still wrong. One that holds has been mended: move it to seeds/, so that it stays so.
TEST(FuzzReplay, KnownIssuesAreStillOpen) {
    if (!std::filesystem::exists(EDGEWISE_KNOWN_ISSUES)) return;
    for (const auto& entry : std::filesystem::directory_iterator(EDGEWISE_KNOWN_ISSUES)) {
        const std::string wrong = checkVisibility(sceneFromBytes(readAll(entry.path())));
        fmt::print("open: {}: {}\n", entry.path().filename().string(), wrong);
        EXPECT_NE(wrong, "") << entry.path().filename() << " holds now: move it to seeds/";
    }
}

TEST(FuzzReplay, RandomBytesHold) {
    constexpr int kScenes = 400;
    constexpr std::uint64_t kSeed = 20;
    witness::Dice dice(kSeed);
    witness::HardCases met;
    for (int k = 0; k < kScenes; ++k) {
        std::vector<std::uint8_t> bytes(std::size_t(dice.integer(12, 122)));
        for (std::uint8_t& byte : bytes) byte = std::uint8_t(dice.integer(0, 255));
        const ScreenScene scene = sceneFromBytes(bytes);
        EXPECT_EQ(checkVisibility(scene), "") << "scene " << k << " of seed " << kSeed;
        met += witness::countHardCases(scene);
    }
    fmt::print("seed {}: {}\n", kSeed, toString(met));
    EXPECT_GT(met.piercing_pairs, 100u);
    EXPECT_GT(met.coplanar_overlaps, 100u);
    EXPECT_GT(met.horizontal, 20u);
    EXPECT_GT(met.t_junctions, 5u);
}

}  // namespace
}  // namespace edgewise::fuzz
