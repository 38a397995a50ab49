// Errors by kinds of edges: sums over pixels that are given by hand.
#include "pipeline/judge/kind_errors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace edgewise::judge {
namespace {

/// Four pixels, each grey of its number's tenth.
ImageBuffer row(int x0, std::initializer_list<double> tenths) {
    ImageBuffer image({x0, 5, x0 + static_cast<int>(tenths.size()), 6});
    std::size_t i = 0;
    for (const double t : tenths) image.rgba[i++] = glm::dvec4(glm::dvec3(0.1 * t), 1.0);
    return image;
}
const std::vector<EdgeKind> kRow{EdgeKind::kContour, EdgeKind::kNone, EdgeKind::kContour, EdgeKind::kShadow};

TEST(KindErrors, EachPixelCountsForItsKind) {
    const KindErrors errors = errorsByKind(row(7, {1, 2, 3, 4}), row(7, {1, 3, 5, 8}), kRow);
    EXPECT_EQ(errors.of(EdgeKind::kContour).pixels, 2u);
    EXPECT_NEAR(errors.of(EdgeKind::kContour).rmse(), std::sqrt(0.2 * 0.2 / 2), 1e-15);
    EXPECT_NEAR(errors.of(EdgeKind::kShadow).rmse(), 0.4, 1e-15);
    EXPECT_NEAR(*errors.of(EdgeKind::kNone).psnr(), 20.0, 1e-12);  // 0.1 of 1
    EXPECT_EQ(errors.edges().pixels, 3u);
    EXPECT_NEAR(errors.edges().rmse(), std::sqrt((0.2 * 0.2 + 0.4 * 0.4) / 3), 1e-15);
    EXPECT_EQ(errors.of(EdgeKind::kTexture).pixels, 0u);
    EXPECT_FALSE(errors.of(EdgeKind::kTexture).psnr());
}

/// Red, green and blue count alike; alpha does not count.
TEST(KindErrors, ChannelsAreMeans) {
    ImageBuffer image = row(0, {0, 0, 0, 0});
    image.rgba[3] = {0.3, 0.0, 0.0, 0.5};
    const KindErrors errors = errorsByKind(image, row(0, {0, 0, 0, 0}), kRow);
    EXPECT_NEAR(errors.of(EdgeKind::kShadow).rmse(), 0.3 / std::sqrt(3.0), 1e-15);
    EXPECT_FALSE(errors.of(EdgeKind::kContour).psnr()) << "no error";
}

TEST(KindErrors, PartsAddUp) {
    const ImageBuffer reference = row(7, {1, 3, 5, 8});
    const KindErrors whole = errorsByKind(row(7, {1, 2, 3, 4}), reference, kRow);
    KindErrors parts = errorsByKind(row(7, {1}), reference, kRow);
    parts += errorsByKind(row(8, {2, 3, 4}), reference, kRow);
    for (const EdgeKind kind : {EdgeKind::kNone, EdgeKind::kContour, EdgeKind::kShadow}) {
        EXPECT_EQ(parts.of(kind).pixels, whole.of(kind).pixels);
        EXPECT_DOUBLE_EQ(parts.of(kind).squares, whole.of(kind).squares);
    }
}

TEST(KindErrors, JsonReadsBack) {
    const KindErrors errors = errorsByKind(row(7, {1, 2, 3, 4}), row(7, {1, 3, 5, 8}), kRow);
    const auto json = kindErrorsJson(errors);
    EXPECT_EQ(json.at("edges").at("pixels"), 3);
    EXPECT_EQ(json.at("no_edge").at("pixels"), 1);
    EXPECT_TRUE(json.at("texture").at("psnr").is_null());
    const KindErrors back = kindErrorsFrom(json);
    EXPECT_EQ(back.by_kind.size(), 3u);
    for (const auto& [kind, error] : errors.by_kind) {
        EXPECT_EQ(back.of(kind).pixels, error.pixels);
        // a root, and a square
        EXPECT_NEAR(back.of(kind).squares, error.squares, 4 * 0x1p-53 * error.squares);
    }
}

TEST(KindErrors, ThePictureHasAColourAKind) {
    const ImageBuffer picture = edgeKindPicture(kRow, {7, 5, 11, 6});
    EXPECT_EQ(picture.rgba[0], picture.rgba[2]);
    EXPECT_NE(picture.rgba[0], picture.rgba[1]);
    EXPECT_NE(picture.rgba[0], picture.rgba[3]);
    for (const EdgeKind kind : kEdgeKinds) EXPECT_STRNE(colorOf(kind), colorOf(EdgeKind::kNone));
}

}  // namespace
}  // namespace edgewise::judge
