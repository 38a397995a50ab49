// FXAA: hand-computed pixels, and what it makes of pictures.
#include <gtest/gtest.h>

#include <string>

#include "pipeline/decode_image.h"
#include "pipeline/error.h"
#include "pipeline/srgb.h"
#include "tests/pipeline/post_pictures.h"

namespace edgewise {
namespace {

TEST(Fxaa, LeavesFlatAndFaintPicturesAlone) {
    const ImageBuffer flat = test::makePicture(20, 15, [](int, int) { return glm::dvec3(0.3, 7.0, 1e-3); });
    EXPECT_EQ(test::filtered(flat, "fxaa").rgba, flat.rgba);
    // 21/255 is less than the smallest threshold, 22/255 more.
    for (const int step : {21, 22}) {
        const ImageBuffer faint = test::makePicture(
            20, 15, [&](int x, int) { return glm::dvec3(decodeSrgb(x < 9 ? 0.0 : step / 255.0)); });
        EXPECT_EQ(test::filtered(faint, "fxaa").rgba == faint.rgba, step == 21);
    }
}

TEST(Fxaa, AStraightEdgeIsSoftenedByItsSubpixelPart) {
    // Three of eight neighbours differ: (2 + 2)/12 of the contrast, smoothed (3 - 2/3)/9, squared, of which
    // 3/4; both ends are out of reach, so that is all.
    const double part = 7.0 / 27.0, share = 0.75 * part * part;
    for (const bool columns : {false, true}) {
        const ImageBuffer image = test::makePicture(
            64, 64, [&](int x, int y) { return glm::dvec3((columns ? x : y) < 32 ? 0.0 : 1.0); });
        const ImageBuffer result = test::filtered(image, "fxaa:preset=12");
        const auto at = [&](int across) {
            return result.rgba[columns ? result.index(across, 32) : result.index(32, across)].r;
        };
        EXPECT_NEAR(at(31), decodeSrgb(share), 1e-6);  // luma is float32
        EXPECT_NEAR(at(32), decodeSrgb(1.0 - share), 1e-6);
        EXPECT_EQ(at(30), 0.0);
        EXPECT_EQ(at(33), 1.0);
    }
}

TEST(Fxaa, APixelBesideAStepMovesByHowNearTheStepIs) {
    // White from row 17 on, from row 16 on right of column 32. At (36, 16), white, the side above is 3 and a
    // half pixels from the step on the left: read at 1, 2.5, 4.5 px, where it is past; on the right it runs
    // out after 20.5 px. It moves 1/2 - 4.5/25 = 0.32 px towards black.
    const ImageBuffer image = test::makePicture(
        96, 33, [](int x, int y) { return glm::dvec3(y > 16 || (y == 16 && x > 32) ? 1.0 : 0.0); });
    const ImageBuffer result = test::filtered(image, "fxaa:preset=12");
    EXPECT_NEAR(result.rgba[result.index(36, 16)].r, decodeSrgb(1.0 - 0.32), 1e-6);
}

TEST(Fxaa, EveryPresetFindsTheStepWhereItsSearchReadsAndGivesUpWhereItEnds) {
    // The same picture at (34, 16), 1.5 px from the step: the first read at or past it, and the sum of all
    // steps. A read on the step itself differs by a quarter of the contrast, which is just enough.
    struct Preset {
        int name;
        double found, longest;
    };
    constexpr Preset kPresets[] = {
        {10, 1.5, 16.5}, {11, 2.5, 17.5}, {12, 2.5, 20.5}, {13, 2.5, 22.5}, {14, 2.5, 24.5}, {15, 2.5, 26.5},
        {20, 1.5, 11.5}, {21, 2.5, 12.5}, {22, 2.5, 14.5}, {23, 2.5, 16.5}, {24, 2.5, 19.5}, {25, 2.5, 22.5},
        {26, 2.5, 24.5}, {27, 2.5, 26.5}, {28, 2.5, 28.5}, {29, 2.5, 30.5}, {39, 2.0, 26.5}};
    const ImageBuffer image = test::makePicture(
        96, 33, [](int x, int y) { return glm::dvec3(y > 16 || (y == 16 && x > 32) ? 1.0 : 0.0); });
    for (const Preset& preset : kPresets) {
        const std::string method = "fxaa:preset=" + std::to_string(preset.name);
        const ImageBuffer result = test::filtered(image, method.c_str());
        const double moved = 0.5 - preset.found / (preset.found + preset.longest);
        EXPECT_NEAR(result.rgba[result.index(34, 16)].r, decodeSrgb(1.0 - moved), 1e-6) << method;
    }
}

TEST(Fxaa, BringsAnEdgeOfSlopeAnEighthNearerToItsCoverage) {
    for (const char* method : {"fxaa:preset=10", "fxaa", "fxaa:preset=29", "fxaa:preset=39"}) {
        const ImageBuffer image = test::sampledHalfPlane(48, 20.3, 0.125);
        ImageBuffer result = test::filtered(image, method);
        // It mixes encoded colours, so that is where its coverage shows.
        for (glm::dvec4& color : result.rgba)
            color.r = color.r <= 0.0031308 ? 12.92 * color.r : 1.055 * std::pow(color.r, 1 / 2.4) - 0.055;
        const double before = test::errorOfHalfPlane(image, 20.3, 0.125, 9);
        const double after = test::errorOfHalfPlane(result, 20.3, 0.125, 9);
        EXPECT_LT(after, 0.6 * before) << method;
        RecordProperty(std::string("ratio of ") + method, std::to_string(after / before));
    }
}

TEST(Fxaa, MirroredPicturesGiveMirroredResults) {
    const ImageBuffer image = test::makePicture(48, 48, [](int x, int y) {
        const bool inside = y > 10 + 0.21 * x && y < 41 - 0.13 * x && 3 * y > 120 - 9 * x && x < 40;
        return glm::dvec3(inside ? 1.0 : 0.1);
    });
    const ImageBuffer result = test::filtered(image, "fxaa");
    EXPECT_GT(test::largestDifference(image, result), 0.1);
    for (const bool columns : {false, true}) {
        const ImageBuffer mirrored = test::filtered(test::flipped(image, columns), "fxaa");
        EXPECT_LE(test::largestDifference(test::flipped(mirrored, columns), result), 1e-5);
    }
}

TEST(PostProcess, KnowsItsMethodsAndPresets) {
    for (const char* method : {"fxaa:preset=10", "fxaa:preset=15", "fxaa:preset=20", "fxaa:preset=29"})
        EXPECT_NO_THROW(makePostProcess(parseMethod(method))) << method;
    for (const char* method :
         {"fxaa:preset=9", "fxaa:preset=16", "fxaa:preset=30", "fxaa:12", "smaa:preset=12"})
        EXPECT_THROW(parseMethod(method), InputError) << method;
    EXPECT_THROW(makePostProcess(parseMethod("none")), InputError);
}

}  // namespace
}  // namespace edgewise
