// Weights on the device against the CPU's: every entry of every pixel, bit for bit, in either precision.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "tests/pipeline/shipped_picture.h"
#include "tests/vulkan/weighed_picture.h"

namespace edgewise::vulkan {
namespace {

constexpr int kSidePx = 40;

/// fp32's promise: 64 roundings of a float.
constexpr double kFloatBound = 64.0 * 0x1p-24;

struct NamedFilter {
    const char* name;
    double radius;
};
constexpr NamedFilter kFilters[] = {{"box", 0.5},        {"disk", 0.7},     {"tent", 1.0},
                                    {"cone", 1.5},       {"gaussian", 2.0}, {"gaussian-separable", 2.0},
                                    {"mitchell", 2.0},   {"bspline", 2.0},  {"catmull-rom", 2.0},
                                    {"bc:0.2,0.4", 2.0}, {"lanczos", 3.0},  {"poly:1,-2,1", 1.25}};
constexpr std::size_t kFilterCount = std::size(kFilters);

using edgewise::test::ShippedPicture;

test::WeightComparison weigh(const ShippedPicture& picture, const NamedFilter& filter, Precision precision) {
    RenderOptions options = edgewise::test::onBlue();
    options.precision = precision;
    Progress progress;
    const Prefilter kernel = makePrefilter(filter.name, filter.radius, {});
    const auto found =
        test::compareWeights({picture.scene, picture.camera, picture.film, kernel, options, progress});
    fmt::print("{} {}: {} pixels, {} entries, {} handed back, worst {:.3g}\n", picture.name, filter.name,
               found.pixels, found.entries, found.handed, found.worst);
    EXPECT_EQ(found.differing, 0u) << filter.name;
    return found;
}

/// Scenes take turns with the filters, so that every filter meets several scenes: three a scene.
class DeviceWeights : public testing::TestWithParam<std::size_t> {
  protected:
    ShippedPicture picture() const {
        return edgewise::test::shippedPicture(edgewise::test::shippedRecipes()[GetParam()], kSidePx);
    }
    const NamedFilter& filter(std::size_t i) const {
        return kFilters[(GetParam() + i * kFilterCount / 3) % kFilterCount];
    }
    void TearDown() override { test::expectNoMessages(); }
};

TEST_P(DeviceWeights, AreTheCpusBitForBit) {
    test::device();
    const ShippedPicture shown = picture();
    std::uint64_t terms = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto found = weigh(shown, filter(i), Precision::kFp64);
        EXPECT_EQ(found.device_terms, found.terms) << filter(i).name;
        terms += found.terms;
    }
    EXPECT_GT(terms, std::uint64_t{3 * kSidePx}) << "less than one edge across the crop a filter";
}

TEST_P(DeviceWeights, InFloatAreTheCpusFloatsAndKeepTheirBound) {
    test::device();
    const ShippedPicture shown = picture();
    for (std::size_t i = 0; i < 3; ++i) {
        const auto found = weigh(shown, filter(i), Precision::kFp32);
        EXPECT_LE(found.worst, kFloatBound) << filter(i).name;
        EXPECT_GT(found.worst, 0.0) << "float is no double";
    }
}

INSTANTIATE_TEST_SUITE_P(Shipped, DeviceWeights,
                         testing::Range(std::size_t{0}, edgewise::test::shippedRecipes().size()),
                         [](const auto& one) {
                             return edgewise::test::nameOf(edgewise::test::shippedRecipes()[one.param]);
                         });

}  // namespace
}  // namespace edgewise::vulkan
