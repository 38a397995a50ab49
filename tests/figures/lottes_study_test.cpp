// The rays that the figure draws are those that make the pixel.
#include "paper_figures/lottes_study.h"

#include <gtest/gtest.h>

namespace edgewise::figures {
namespace {

TEST(LottesStudy, DrawnRaysMakeThePixel) {
    Progress quiet;
    LottesEffort effort;
    effort.width = 48, effort.height = 27, effort.frames = 4, effort.shown = 1, effort.reference_side = 2;
    effort.grain = 0.0;
    const LottesStudy found = studyLottes(effort, quiet);
    ASSERT_EQ(found.rays.size(), 11u);
    glm::dvec4 sum(0.0);
    double weights = 0.0;
    for (const LottesWeight& w : found.rays) {
        EXPECT_EQ(glm::ivec2(glm::floor(w.ray.p_px)), w.pixel);
        sum += w.f * w.ray.coverage * w.ray.color, weights += w.f * w.ray.coverage;
    }
    ASSERT_GT(weights, 0.0);
    const ImageBuffer& frame = found.frames.at(0);
    const glm::dvec4 pixel = frame.rgba[frame.index(found.pixel.x, found.pixel.y)];
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(sum[c] / weights, pixel[c], 256 * 0x1p-52);
    ASSERT_EQ(found.points.size(), 3u);  // 1, 2 and 4 frames
    EXPECT_GT(found.points[1].deviation_of_mean, 0.0);
    EXPECT_GT(found.deviation, 0.0);
}

}  // namespace
}  // namespace edgewise::figures
