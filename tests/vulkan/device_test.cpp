// The device, its buffers, the graph of passes, and the shared arithmetic on it.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "analytic/transcendental.h"
#include "pipeline/vulkan/compute_pass.h"
#include "pipeline/vulkan/pass_graph.h"
#include "tests/vulkan/test_device.h"

namespace edgewise::f64 {
#include "shaders/shared/fan_terms.glsl"
}

namespace edgewise::vulkan {
namespace {

using PassGraphTest = test::DeviceTest;
using SharedArithmetic = test::DeviceTest;
using Names = std::vector<std::string>;

TEST(DeviceErrors, AreWhatVulkansOwnCallsThrow) {
    const auto fails = [] { throw vk::OutOfDeviceMemoryError("vkAllocateMemory"); };
    EXPECT_THROW(withDeviceErrors(fails), DeviceError);
    EXPECT_EQ(withDeviceErrors([] { return 7; }), 7);
}

/// A device of a real GPU's manners: what the host reads are copies, of any part, and always fresh.
TEST(CopiedReads, HaveWhatTheDeviceWrote) {
    test::device();  // validation is on
    ::setenv("EDGEWISE_COPY_READS", "1", 1);
    const Device device;
    ::unsetenv("EDGEWISE_COPY_READS");
    ASSERT_TRUE(device.copiesReads());
    std::vector<std::uint32_t> numbers(1000);
    std::iota(numbers.begin(), numbers.end(), 7u);
    Buffer buffer = bufferOf(device, "numbers", numbers);
    const auto small = buffer.read<std::uint32_t>(3, 4 * sizeof(std::uint32_t));
    EXPECT_EQ(small[2], 7u + 6u);
    EXPECT_NE(small.data(), buffer.view<std::uint32_t>(3, 4 * sizeof(std::uint32_t)).data());
    EXPECT_TRUE(std::ranges::equal(buffer.read<std::uint32_t>(numbers.size()), numbers));
    buffer.view<std::uint32_t>(1)[0] = 1;
    EXPECT_EQ(buffer.read<std::uint32_t>(1)[0], 1u);
    const Buffer moved = std::move(buffer);
    EXPECT_EQ(moved.read<std::uint32_t>(1, 999 * sizeof(std::uint32_t))[0], 7u + 999u);
    EXPECT_TRUE(device.validationMessages().empty());
}

TEST_F(PassGraphTest, WhatFeedsNothingWantedIsNotRun) {
    const Device& device = test::device();
    PassGraph graph(device);
    const auto size = [] { return std::size_t{64}; };
    const Resource bins = graph.buffer("bins", size), lists = graph.buffer("lists", size),
                   heat = graph.buffer("heat", size);
    int binned = 0, heated = 0;
    graph.add("bin", {.reads = {}, .writes = {bins}, .host = [&](const PassGraph& g) {
                          g[bins].view<int>(1)[0] = 7, ++binned;
                      }});
    graph.add("heat map", {.reads = {bins}, .writes = {heat}, .host = [&](const PassGraph&) { ++heated; }});
    graph.add("fill", {.reads = {bins}, .writes = {lists}, .record = [&](const PassContext& pass) {
                           pass.commands.copyBuffer(pass[bins].handle(), pass[lists].handle(),
                                                    vk::BufferCopy(0, 0, 4));
                       }});
    EXPECT_EQ(graph.plan({lists}), (Names{"bin", "fill"}));
    graph.run({lists});
    EXPECT_EQ(graph[lists].read<int>(1)[0], 7);
    EXPECT_EQ(binned, 1);
    EXPECT_EQ(heated, 0);
    ASSERT_EQ(graph.times().size(), 2u);
    EXPECT_EQ(graph.times()[1].name, "fill");
    EXPECT_GT(graph.times()[1].seconds, 0.0);
}

/// Inputs of every size and sign, and the special ones.
std::vector<double> hardInputs(std::size_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<double> x{0.0,    -0.0,  1.0,  -1.0, 0.5,   2.0,
                          1e-300, 1e-12, 12.0, -3.0, 700.0, 0.41421356237309503};
    while (x.size() < count) {
        const double size = std::ldexp(1.0, static_cast<int>(random() % 60) - 45);
        x.push_back((static_cast<double>(random() >> 11) * 0x1p-52 - 1.0) * size);
    }
    return x;
}

std::vector<double> onHost(double a, double b) {
    using namespace f64;
    return {atan2Real(a, b),   expNegative(absolute(a)),
            phi1(absolute(a)), logReal(absolute(a) + 1e-30),
            erfReal(a),        coneMean(a, b, b + 0.25, 0.25, 2.0),
            twoProd(a, b).lo,  ddDiv(ddMul(twoSum(a, b), twoSum(b, a)), twoSum(a, 1.0)).lo};
}

TEST_F(SharedArithmetic, TheDeviceHasTheBitsOfTheHost) {
    constexpr std::uint64_t kSeed = 20;
    constexpr std::uint32_t kPairs = 1 << 16;
    const Device& device = test::device();
    const std::vector<double> x = hardInputs(2 * kPairs, kSeed);
    const Buffer inputs = bufferOf(device, "inputs", x);
    PassGraph graph(device);
    ComputePass probe(device, "arithmetic_probe.comp", 2, sizeof(std::uint32_t));
    const Resource in = graph.input("inputs", inputs),
                   out = graph.buffer("results", [] { return kPairs * 8 * sizeof(double); });
    graph.add("probe",
              {.reads = {in}, .writes = {out}, .record = [&](const PassContext& pass) {
                   probe.dispatch(pass.commands, {pass[in], pass[out]}, Groups::covering(kPairs, 64), kPairs);
               }});
    graph.run({out});
    std::size_t differing = 0, compared = 0;
    for (std::uint32_t i = 0; i < kPairs; ++i) {
        const std::vector<double> expected = onHost(x[2 * i], x[2 * i + 1]);
        for (std::size_t k = 0; k < expected.size(); ++k) {
            const double got = graph[out].read<double>(8 * kPairs)[8 * i + k];
            // subnormal numbers are unspecified on the device
            if (std::abs(expected[k]) < 1e-290 || std::isnan(expected[k])) continue;
            ++compared;
            if (got != expected[k] && differing++ < 5)
                ADD_FAILURE() << "function " << k << " of " << x[2 * i] << ", " << x[2 * i + 1] << ": " << got
                              << ", not " << expected[k];
        }
    }
    fmt::print("seed {}: {} results compared, {} differ\n", kSeed, compared, differing);
    EXPECT_EQ(differing, 0u);
    EXPECT_GT(compared, 7u * kPairs);
}

}  // namespace
}  // namespace edgewise::vulkan
