// What methods give for SDF scenes beside the colours: stages' pictures, channels, the same bits whatever the
// threads, the memory, the crop.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

#include "pipeline/field_tracer.h"
#include "pipeline/methods/lottes.h"
#include "tests/pipeline/field_pictures.h"
#include "tests/sweep/scratch.h"

namespace edgewise {
namespace {

using sdf::Kind;
using test::FieldPicture;

/// An orthographic picture, a pixel a unit, of a plane that is tilted about y: z = -x tan(angle).
FieldPicture tiltedPlane(double nx, double nz) {
    FieldPicture picture = test::flatPicture(16, 16);
    picture.field->tree.root = picture.field->tree.add(Kind::kPlane, {nx, 0.0, nz, 0.0}, {}, 0);
    picture.field->materials = {test::unlitWhite()};
    return picture;
}

/// A ball of 5 px in the middle, unlit white, on black.
FieldPicture whiteBall(int side = 24) {
    FieldPicture picture = test::flatPicture(side, side);
    picture.field->tree.add(Kind::kSphere, {5.0}, {}, 0);
    picture.field->materials = {test::unlitWhite()};
    return picture;
}

struct Bytes {
    int width = 0, height = 0;
    std::vector<unsigned char> rgb;
    int at(int x, int y, int channel) const { return rgb[3 * (y * width + x) + channel]; }
};
Bytes readPng(const std::string& path) {
    const auto file = OIIO::ImageInput::open(path);
    Bytes bytes;
    if (!file) return bytes;
    bytes.width = file->spec().width, bytes.height = file->spec().height;
    bytes.rgb.resize(3 * bytes.width * bytes.height);
    file->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, bytes.rgb.data());
    return bytes;
}

/// Of field.csv, the row of a pixel.
std::vector<double> rowOf(const std::string& path, int x, int y) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::vector<double> row;
        for (std::string word; std::getline(words, word, ',');) row.push_back(std::atof(word.c_str()));
        if (row.size() == 5 && row[0] == x && row[1] == y && line[0] != 'x') return row;
    }
    return {};
}

bool sameBits(const ImageBuffer& a, const ImageBuffer& b) {
    return std::memcmp(a.rgba.data(), b.rgba.data(), a.rgba.size() * sizeof(glm::dvec4)) == 0 &&
           std::memcmp(a.edge.data(), b.edge.data(), a.edge.size() * sizeof(float)) == 0 &&
           a.aov.words == b.aov.words;
}

/// Listing 1 by hand on a plane: from 10 above, f = nx x + nz z, steps of f, an end within 1/8 of half a
/// pixel.
TEST(FieldPictures, DumpedStagesAreWhatListingOneSays) {
    const sweep::test::Scratch folder;
    FieldPicture picture = tiltedPlane(0.6, 0.8);
    picture.options.dump_dir = folder.path();
    picture.made("sphere:relax=none,prepass=off,prune=off");
    int most = 0;
    for (int x = 0; x < 16; ++x) {
        double t = 0.0, value = 0.0;
        int evaluations = 0;
        do {
            value = 0.6 * (x + 0.5 - 8.0) + 0.8 * (10.0 - t);
            ++evaluations;
            t += value;
        } while (value > 0.125 * 0.5);
        most = std::max(most, evaluations);
        const std::vector<double> row = rowOf(folder / "field.csv", x, 5);
        ASSERT_EQ(row.size(), 5u);
        EXPECT_EQ(row[2], evaluations) << x;
        EXPECT_EQ(row[3], evaluations) << x;
        EXPECT_NEAR(row[4], value, 1e-6) << x;
        const Bytes residual = readPng(folder / "residual.png");
        const double grey = std::min(100.0 * value, 1.0);
        const double srgb = grey <= 0.0031308 ? 12.92 * grey : 1.055 * std::pow(grey, 1 / 2.4) - 0.055;
        EXPECT_NEAR(residual.at(x, 5, 0), 255.0 * srgb, 0.5 + 1e-3) << x;
    }
    for (const char* name : {"evaluations.png", "iterations.png", "residual.png"}) {
        const Bytes bytes = readPng(folder / name);
        EXPECT_EQ(bytes.width, 16) << name;
        EXPECT_EQ(bytes.height, 16) << name;
    }
    const Bytes evaluations = readPng(folder / "evaluations.png");
    for (int x = 0; x < 16; ++x) {
        const bool white = evaluations.at(x, 5, 0) == 255 && evaluations.at(x, 5, 2) == 255;
        EXPECT_EQ(white, rowOf(folder / "field.csv", x, 5)[2] == most) << x;
    }
    EXPECT_NE(std::ifstream(folder / "scales.csv").peek(), EOF);
}

TEST(FieldPictures, APictureOfSamplesIsTheirMean) {
    const sweep::test::Scratch folder;
    FieldPicture picture = tiltedPlane(0.0, 1.0);
    picture.options.dump_dir = folder.path();
    picture.made("ssaa:3");
    const std::vector<double> row = rowOf(folder / "field.csv", 7, 9);
    ASSERT_EQ(row.size(), 5u);
    EXPECT_GE(row[2], 1.0);
    EXPECT_LE(row[2], 3.0) << "a plane that is faced is met in two steps, or one behind a cone";
}

TEST(FieldAov, EveryMethodHasThoseOfThePixelsCentre) {
    FieldPicture picture = whiteBall();
    picture.options.aovs = {Aov::kDepth, Aov::kNormal, Aov::kIndex};
    const ImageBuffer none = picture.made("none").image;
    for (const char* method : {"ssaa:3", "sphere", "path:2", "lottes"})
        EXPECT_EQ(picture.made(method).image.aov.words, none.aov.words) << method;
    // The ball's front: z = 5 seen from z = 10, (x, y) = (0.5, -0.5) or so.
    const std::uint32_t* words = none.aov.pixel(none.index(12, 12));
    const double z = std::sqrt(25.0 - 0.5);
    float depth = 0, normal = 0;
    std::memcpy(&depth, words, 4), std::memcpy(&normal, words + 3, 4);
    EXPECT_NEAR(depth, 10.0 - z, 0.125 * 0.5);
    EXPECT_NEAR(normal, z / 5.0, 0.01);
    EXPECT_EQ(words[4], 0u);
    EXPECT_EQ(none.aov.pixel(none.index(0, 0))[4], kNone);
}

TEST(FieldAov, LittleMemoryHasTheSame) {
    FieldPicture picture = whiteBall(96);
    picture.options.aovs = {Aov::kDepth, Aov::kNormal};
    picture.options.frames = 2;
    for (const char* method : {"lottes", "path:1", "none", "ssaa:2"}) {
        picture.options.memory_mib = 1024;
        const ImageBuffer whole = picture.made(method).image;
        picture.options.memory_mib = 1;
        EXPECT_TRUE(sameBits(picture.made(method).image, whole)) << method;
    }
}

TEST(FieldBits, ThreadsAreNotSeen) {
    for (const char* method :
         {"none", "sphere:discontinuity=3", "ssaa:2", "smaa", "fxaa", "lottes", "path:2"}) {
        FieldPicture one = whiteBall(80), two = whiteBall(80);
        one.options.threads = 1, two.options.threads = 2;
        EXPECT_TRUE(sameBits(one.made(method).image, two.made(method).image)) << method;
    }
}

/// All positions are multiples of 2^-n: a shift by whole pixels moves the rays, and without cones, which lie
/// on the film's grid, every bit.
TEST(FieldBits, AShiftByWholePixelsMovesThePicture) {
    FieldPicture still = whiteBall(), moved = whiteBall();
    still.options.aovs = moved.options.aovs = {Aov::kDepth, Aov::kNormal, Aov::kIndex};
    moved.film.shift_px = {3.0, -2.0};
    for (const char* method : {"sphere:prepass=off", "sphere:prepass=off,prune=off,relax=balint", "ssaa:2"}) {
        const ImageBuffer a = still.made(method).image, b = moved.made(method).image;
        const bool cones = std::string(method) == "ssaa:2";
        int surfaces = 0;
        for (int y = 2; y < 24; ++y)
            for (int x = 0; x + 3 < 24; ++x) {
                const std::size_t here = b.index(x, y), there = a.index(x + 3, y - 2);
                surfaces += b.aov.pixel(here)[4] == 0;
                EXPECT_EQ(b.rgba[here], a.rgba[there]) << method;
                EXPECT_EQ(b.edge[here], a.edge[there]) << method;
                for (int word = cones ? 4 : 0; word < 5; ++word)
                    EXPECT_EQ(b.aov.pixel(here)[word], a.aov.pixel(there)[word]) << method;
            }
        EXPECT_GT(surfaces, 50);
    }
}

/// Positions at the centres are the pixels' own samples; elsewhere they are those of a film that is shifted.
TEST(FieldBits, PositionsOfOnesOwnAreSamples) {
    FieldPicture picture = whiteBall(), moved = whiteBall();
    moved.film.shift_px = {0.25, -0.125};
    FieldSettings settings;
    settings.trace.prepass = false;
    FieldWindow plain, centres, aside;
    plain.pixels = centres.pixels = aside.pixels = picture.film.crop;
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
            centres.positions_px.emplace_back(x + 0.5, y + 0.5);
            aside.positions_px.emplace_back(x + 0.75, y + 0.375);
        }
    const MethodInput in = picture.input(), shifted = moved.input();
    const auto tracer = makeCpuFieldTracer(in, settings), other = makeCpuFieldTracer(shifted, settings);
    const FieldSamples a = tracer->trace(plain), b = tracer->trace(centres), c = tracer->trace(aside),
                       d = other->trace(plain);
    EXPECT_EQ(a.depth, b.depth);
    EXPECT_EQ(a.color, b.color);
    EXPECT_EQ(c.depth, d.depth);
    EXPECT_EQ(c.normal, d.normal);
    EXPECT_NE(a.depth, c.depth);
}

TEST(FieldFrames, ThePictureIsTheFramesMean) {
    FieldPicture picture = whiteBall();
    picture.options.frames = 5;
    const MethodResult mean = picture.made("lottes:grain=0.05");
    EXPECT_EQ(mean.counts.at("frames"), 5u);
    EXPECT_GT(mean.counts.at("temporal_deviation_micro"), 1000u);
    LottesSettings settings;
    settings.grain = 0.05;
    const MethodInput in = picture.input();
    const LottesFrames frames(in, settings);
    sdf::RayCounts counts;
    std::vector<glm::dvec4> sum(24 * 24, glm::dvec4(0.0));
    for (int f = 0; f < 5; ++f) {
        const auto frame = frames.reconstruct(frames.trace(f, counts), f);
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += frame[i];
    }
    for (std::size_t i = 0; i < sum.size(); ++i)
        EXPECT_LT(glm::length(sum[i] / 5.0 - mean.image.rgba[i]), 1e-14);
    const ImageBuffer many = picture.made("none").image;
    picture.options.frames = 1;
    EXPECT_TRUE(sameBits(picture.made("none").image, many)) << "no temporal method";
}

/// How far a pixel's centre is from the ball's outline.
double fromOutline(int x, int y, int side) {
    return std::hypot(x + 0.5 - 0.5 * side, y + 0.5 - 0.5 * side) - 5.0;
}

/// The 11 rays of a pixel lie within 2 pixels around it, jittered: within sqrt(2.5^2 + 0.5^2) = 2.55 of its
/// centre, and where the rays' reach of 0.75 pixels inflates the ball.
TEST(FieldEdges, OfLottesAreWhereItsRaysDiffer) {
    FieldPicture picture = whiteBall();
    picture.options.frames = 8;
    const ImageBuffer image = picture.made("lottes:grain=0.2").image;
    int edges = 0;
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
            const double away = fromOutline(x, y, 24);
            const float edge = image.edge[image.index(x, y)];
            edges += edge == 1.0f;
            if (std::abs(away) < 0.5) {
                EXPECT_EQ(edge, 1.0f) << x << " " << y;
            }
            if (away < -2.55 || away > 2.55 + 0.75) {
                EXPECT_EQ(edge, 0.0f) << x << " " << y;
            }
        }
    EXPECT_GT(edges, 60);
}

/// A lit ball whose paths are noise: the edges are its outline's alone, and where its checker's squares meet.
TEST(FieldEdges, OfPathsAreWhereSurfacesDifferAndNotWhereNoiseDoes) {
    FieldPicture picture = whiteBall();
    picture.field->materials[0].shading = sdf::SurfaceMaterial::Shading::kLambert;
    picture.field->materials[0].color = glm::dvec3(0.5);
    const auto edgesOf = [&] {
        const ImageBuffer image = picture.made("path:16").image;
        int within = 0;
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 24; ++x) {
                const double away = fromOutline(x, y, 24);
                const float edge = image.edge[image.index(x, y)];
                if (std::abs(away) < 0.3) {
                    EXPECT_EQ(edge, 1.0f) << x << " " << y;
                }
                if (away > 0.8) {
                    EXPECT_EQ(edge, 0.0f) << x << " " << y;
                }
                within += away < -0.8 && edge == 1.0f;
            }
        return within;
    };
    EXPECT_EQ(edgesOf(), 0);
    picture.field->materials[0].pattern = sdf::SurfaceMaterial::Pattern::kChecker;
    picture.field->materials[0].pattern_size = 2.5;
    picture.field->materials[0].second_color = glm::dvec3(0.9);  // the sky is black
    EXPECT_GT(edgesOf(), 10);
}

}  // namespace
}  // namespace edgewise
