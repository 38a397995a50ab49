// "Sphere Tracing AA" as published: what it does well, and its measured bias.
#include "pipeline/methods/lottes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <complex>

#include "pipeline/error.h"
#include "tests/pipeline/field_pictures.h"

namespace edgewise {
namespace {

using test::FieldPicture;

/// A white half-plane whose edge is slanted, on black.
FieldPicture slantedEdge(int side) {
    FieldPicture picture = test::flatPicture(side, side);
    picture.field->materials = {test::unlitWhite()};
    const auto box = picture.field->tree.add(sdf::Kind::kBox, {400, 200, 2}, {}, 0);
    const auto moved = picture.field->tree.add(sdf::Kind::kTranslate, {0, -100, 0}, {box});
    picture.field->tree.root = picture.field->tree.add(sdf::Kind::kRotate, {0, 0, 1, 17}, {moved});
    return picture;
}

/// A white wire of that diameter in pixels, on black.
FieldPicture wire(int side, double diameter) {
    FieldPicture picture = test::flatPicture(side, side);
    picture.field->materials = {test::unlitWhite()};
    const auto rod =
        picture.field->tree.add(sdf::Kind::kCapsule, {-100, 0, 0, 100, 0, 0, 0.5 * diameter}, {}, 0);
    picture.field->tree.root = picture.field->tree.add(sdf::Kind::kRotate, {0, 0, 1, 11}, {rod});
    return picture;
}

double rmse(const ImageBuffer& a, const ImageBuffer& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) sum += std::pow(a.rgba[i].r - b.rgba[i].r, 2);
    return std::sqrt(sum / static_cast<double>(a.rgba.size()));
}

/// The largest difference between a corner box's share of a pixel's first samples and its area, over a
/// lattice of corners; the mean over pixels.
double discrepancy(int frames) {
    double sum = 0.0;
    for (int x = 0; x < 8; ++x) {
        double worst = 0.0;
        for (double u = 0.1; u < 1.0; u += 0.1)
            for (double v = 0.1; v < 1.0; v += 0.1) {
                int within = 0;
                for (int f = 0; f < frames; ++f) {
                    const glm::dvec2 p = lottesJitter(x, 3, f, 7);
                    within += p.x < u && p.y < v;
                }
                worst = std::max(worst, std::abs(within / double(frames) - u * v));
            }
        sum += worst / 8.0;
    }
    return sum;
}

TEST(Lottes, TheJitterOfAPixelIsLowDiscrepancyAndItsOwn) {
    const double few = discrepancy(64), many = discrepancy(1024);
    std::printf("R2: discrepancy of 64 frames %.4f, of 1024 %.4f\n", few, many);
    EXPECT_LT(many, few / 8.0);  // of random positions, a fourth
    EXPECT_NE(lottesJitter(0, 0, 0, 0), lottesJitter(1, 0, 0, 0));
    EXPECT_NE(lottesJitter(0, 0, 0, 0), lottesJitter(0, 0, 0, 1));
    EXPECT_EQ(lottesJitter(-1, 2, 5, 9), lottesJitter(-1, 2, 5, 9));
}

TEST(Lottes, SkyIsTheBackgroundAndInteriorsAreTheSurface) {
    FieldPicture picture = slantedEdge(24);
    picture.options.background = {0.25, 0.5, 0.75};
    const ImageBuffer image = picture.made("lottes:grain=0").image;
    const glm::dvec4 sky(0.25, 0.5, 0.75, 0.0);
    EXPECT_LT(glm::length(image.rgba[image.index(1, 1)] - sky), 1e-14);
    EXPECT_LT(glm::length(image.rgba[image.index(12, 23)] - glm::dvec4(1.0)), 1e-14);
}

TEST(Lottes, TheTemporalDeviationFallsWithTheFrames) {
    FieldPicture picture = slantedEdge(24);
    double last = 1.0;
    for (const int frames : {4, 16, 64}) {
        picture.options.frames = frames;
        std::vector<MethodResult> runs;
        for (picture.options.seed = 0; picture.options.seed < 4; ++picture.options.seed)
            runs.push_back(picture.made("lottes:grain=0"));
        double truth = 0.0;  // two means of independent starts differ by sqrt 2 of their own deviation
        for (int i = 0; i < 4; ++i)
            truth += rmse(runs[i].image, runs[(i + 1) % 4].image) / 4.0 / std::sqrt(2.0);
        const double one = runs[0].counts.at("temporal_deviation_micro") * 1e-6;
        const double mean = runs[0].counts.at("temporal_deviation_of_mean_micro") * 1e-6;
        std::printf(
            "%2d frames: deviation from frame to frame %.4f, of the mean %.4f (by even and odd frames "
            "%.4f)\n",
            frames, one, truth, mean);
        EXPECT_GT(one, 0.001);
        EXPECT_LT(truth, 0.75 * last);
        EXPECT_LT(truth, one / std::sqrt(frames));  // what random rays would have
        last = truth;
    }
}

TEST(Lottes, ItsBiasIsCoverageAndF) {
    FieldPicture picture = slantedEdge(24);
    picture.options.frames = 64;
    const ImageBuffer lottes = picture.made("lottes:grain=0").image;
    const ImageBuffer f = picture.made("lottes:grain=0,coverage=off,distance=0.05").image;
    // The edge's exact distance from each pixel's centre gives the box: its area on the white side, by
    // quadrature.
    ImageBuffer box(picture.film.crop);
    const double angle = 17.0 * M_PI / 180.0;
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
            double sum = 0.0;
            for (int j = 0; j < 64; ++j)
                for (int i = 0; i < 64; ++i) {
                    const double px = x + (i + 0.5) / 64 - 12.0, py = 12.0 - (y + (j + 0.5) / 64);
                    sum += -std::sin(angle) * px + std::cos(angle) * py < 0.0;
                }
            box.rgba[box.index(x, y)] = glm::dvec4(sum / 4096.0);
        }
    std::printf("rmse: lottes - box %.4f, lottes - F %.4f, F - box %.4f\n", rmse(lottes, box),
                rmse(lottes, f), rmse(f, box));
    double dilation = 0.0;
    for (std::size_t i = 0; i < box.rgba.size(); ++i) dilation += lottes.rgba[i].r - box.rgba[i].r;
    std::printf("the edge lies %.3f px outside of itself\n", dilation / (24.0 / std::cos(angle)) * 1.0);
    EXPECT_GT(dilation, 0.0);
    EXPECT_GT(rmse(lottes, box), rmse(lottes, f) * 0.5);
    EXPECT_LT(rmse(f, box), 0.2);
}

/// The largest over the least energy of a picture over 64 shifts, and the mean.
struct Spread {
    double spread, mean;
};
Spread energySpread(const std::string& method, int frames) {
    FieldPicture picture = wire(20, 0.2);
    picture.options.frames = frames;
    double least = 1e300, most = 0.0, sum = 0.0;
    for (int i = 0; i < 64; ++i) {
        picture.film.shift_px = {(i % 8) / 8.0, (i / 8) / 8.0};
        double energy = 0.0;
        for (const glm::dvec4& p : picture.made(method).image.rgba) energy += p.r;
        least = std::min(least, energy), most = std::max(most, energy), sum += energy / 64.0;
    }
    return {(most - least) / sum, sum};
}

TEST(Lottes, AThinWiresEnergyHardlyDependsOnTheShift) {
    const double ideal = 0.2 * 20.0 / std::cos(11.0 * M_PI / 180.0);
    for (const char* method :
         {"lottes:grain=0,distance=0.5", "lottes:grain=0,distance=0.75", "lottes:grain=0,distance=1",
          "lottes:grain=0,distance=1,scale=1", "lottes:grain=0,distance=1,weights=disk"})
        for (const int frames : {1, 16}) {
            const Spread s = energySpread(method, frames);
            std::printf("%-40s %2d frames: spread %.1f %%, energy %.2f of the wire's\n", method, frames,
                        100 * s.spread, s.mean / ideal);
            const bool full_reach = std::string(method).find("distance=1") != std::string::npos;
            if (frames == 16 && full_reach) {
                EXPECT_LE(s.spread, 0.05) << method;
            }
        }
}

/// A thin white solid under a sun that throws shadows, seen obliquely; `made` adds it to the tree.
template <class Make>
FieldPicture thinSolid(const Make& make) {
    FieldPicture picture = test::flatPicture(48, 48);
    sdf::SurfaceMaterial white;
    white.color = glm::dvec3(1.0);
    picture.field->materials = {white};
    sdf::SurfaceLight sun;
    sun.direction_world = glm::normalize(glm::dvec3(-0.3, -0.2, -1.0)), sun.intensity = M_PI;
    picture.field->lights = {sun};
    sdf::Tree& tree = picture.field->tree;
    tree.root = tree.add(sdf::Kind::kTranslate, {0, 0, -40}, {make(tree)});
    return picture;
}

TEST(Lottes, ThinSolidsThrowNoShadowOnTheirLitSide) {
    // Thinner than the reach and thicker, so that rays end within and beyond; its near side is lit whole.
    for (const double thickness : {0.1, 0.3, 0.7, 1.0})
        for (const double degrees : {20.0, 50.0}) {
            FieldPicture picture = thinSolid([&](sdf::Tree& tree) {
                const auto disk = tree.add(sdf::Kind::kBox, {40, 40, thickness}, {}, 0);
                return tree.add(sdf::Kind::kRotate, {0, 1, 0, degrees}, {disk});
            });
            const double angle = degrees * M_PI / 180.0;
            const glm::dvec3 normal(std::sin(angle), 0.0, std::cos(angle));
            const double lit = -dot(picture.field->lights[0].direction_world, normal);
            const ImageBuffer image = picture.made("lottes:grain=0,distance=0.75").image;
            double darkest = 1.0;
            for (int y = 8; y < 40; ++y)
                for (int x = 16; x < 32; ++x)
                    darkest = std::min(darkest, image.rgba[image.index(x, y)].r / lit);
            EXPECT_NEAR(darkest, 1.0, 1e-9) << thickness << " thick, at " << degrees << " degrees";
        }
    FieldPicture ball = thinSolid([](sdf::Tree& tree) {
        const auto sphere = tree.add(sdf::Kind::kSphere, {20}, {}, 0);
        return tree.add(sdf::Kind::kShell, {0.6}, {sphere});
    });
    const ImageBuffer image = ball.made("lottes:grain=0,distance=0.75").image;
    double worst = 0.0;
    for (int y = 8; y < 40; ++y)
        for (int x = 8; x < 40; ++x) {
            const glm::dvec2 p(x - 23.5, 23.5 - y);
            const double z = std::sqrt(20.3 * 20.3 - dot(p, p));
            const double lit = -dot(ball.field->lights[0].direction_world, glm::dvec3(p, z)) / 20.3;
            if (dot(p, p) > 14.0 * 14.0) continue;
            worst = std::max(worst, std::abs(image.rgba[image.index(x, y)].r - lit));
        }
    // 11 rays lie within 2.5 px, their mean within a pixel of the centre, and the shade changes by at most 1
    // in 20.3.
    EXPECT_LT(worst, 1.5 / 20.3);
}

TEST(Lottes, ThreadsAndCropsDoNotShow) {
    FieldPicture picture = slantedEdge(24);
    picture.options.frames = 3;
    const ImageBuffer whole = picture.made("lottes").image;
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    picture.film.crop = {5, 7, 17, 16};
    const ImageBuffer part = picture.made("lottes").image;
    for (int y = 7; y < 16; ++y)
        for (int x = 5; x < 17; ++x) EXPECT_EQ(part.rgba[part.index(x, y)], whole.rgba[whole.index(x, y)]);
    picture.options.seed = 1;
    EXPECT_NE(picture.made("lottes").image.rgba, part.rgba);
}

TEST(Lottes, WhereNoRayCountsThePixelsOwnDoes) {
    // F of that scale is 0 beyond 0.15 px: most pixels have no ray so near.
    FieldPicture picture = slantedEdge(24);
    int plain = 0;
    for (const glm::dvec4& p : picture.made("lottes:grain=0,weights=disk,scale=100").image.rgba) {
        EXPECT_TRUE(p.r >= 0.0 && p.r <= 1.0);
        plain += p.r == 0.0 || p.r == 1.0;
    }
    EXPECT_GT(plain, 560);
}

TEST(Lottes, GrainHasItsSpectrumAndStrength) {
    const int side = 32, frames = 24;
    for (const GrainSpectrum spectrum : {GrainSpectrum::kWhite, GrainSpectrum::kBlue}) {
        double squares = 0.0, worst = 0.0;
        // Along u at three v: the mean periodogram of so many independent fields has a relative spread of
        // 1/sqrt(frames), over 4 neighbours in u half of that.
        for (const int v : {0, 5, 16})
            for (int u = 1; u < 16; u += 4) {
                double power = 0.0, truth = 0.0;
                for (int du = 0; du < 4 && u + du < 17; ++du)
                    for (int f = 0; f < frames; ++f) {
                        std::complex<double> sum = 0.0;
                        for (int y = 0; y < side; ++y)
                            for (int x = 0; x < side; ++x)
                                sum += grainAt(spectrum, x, y, f, 3) *
                                       std::polar(1.0, -2.0 * M_PI * ((u + du) * x + v * y) / side);
                        power += std::norm(sum) / (side * side);
                        truth += grainDensity(spectrum, double(u + du) / side, double(v) / side);
                    }
                worst = std::max(worst, std::abs(power - truth) / (4 * frames));
            }
        for (int f = 0; f < frames; ++f)
            for (int i = 0; i < side * side; ++i)
                squares += std::pow(grainAt(spectrum, i % side, i / side, f, 3), 2);
        squares /= frames * side * side;
        std::printf("%s: power %.4f, spectrum off by at most %.3f\n",
                    spectrum == GrainSpectrum::kBlue ? "blue" : "white", squares, worst);
        EXPECT_NEAR(squares, 1.0, 5.0 / std::sqrt(frames * side * side));
        EXPECT_LT(worst, 5.0 / std::sqrt(4.0 * frames));
    }
    EXPECT_EQ(grainDensity(GrainSpectrum::kBlue, 0.0, 0.0), 0.0);
}

TEST(Lottes, RefusesWhatItCannotDo) {
    FieldPicture picture = slantedEdge(8);
    EXPECT_THROW(parseMethod("lottes:distance=9"), InputError);
    EXPECT_THROW(parseMethod("lottes:distance=nan"), InputError);
    EXPECT_THROW(parseMethod("lottes:grain=0.1,grain=0.2"), InputError);
    picture.scene.field = nullptr;
    EXPECT_THROW(picture.made("lottes"), InputError);
    EXPECT_THROW(picture.made("path:4"), InputError);
}

}  // namespace
}  // namespace edgewise
