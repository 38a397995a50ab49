// --aov: values that can be worked out by hand, coverage against the weights themselves, and bits that depend
// on nothing but the picture.
#include "pipeline/aov.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "pipeline/error.h"
#include "pipeline/methods/nsaa.h"
#include "tests/pipeline/shipped_picture.h"
#include "tests/pipeline/test_scene.h"
#include "tests/witness/dice.h"
#include "tests/witness/kernels.h"

namespace edgewise {
namespace {

const std::set<Aov> kAll{Aov::kDepth, Aov::kNormal, Aov::kIndex, Aov::kOwners, Aov::kCryptomatte};

class Channels {
  public:
    explicit Channels(const ImageBuffer& image) : image_(image) {}

    std::uint32_t word(const std::string& name, int x, int y) const {
        const auto& channels = image_.aov.channels;
        for (std::size_t c = 0; c < channels.size(); ++c)
            if (channels[c].name == name) return image_.aov.pixel(image_.index(x, y))[c];
        throw std::invalid_argument("no channel " + name);
    }
    float at(const std::string& name, int x, int y) const { return std::bit_cast<float>(word(name, x, y)); }
    glm::vec3 normal(int x, int y) const { return {at("N.X", x, y), at("N.Y", x, y), at("N.Z", x, y)}; }

  private:
    const ImageBuffer& image_;
};

MethodResult render(const Scene& scene, const ResolvedCamera& camera, const Film& film, const char* method,
                    const char* filter = "box", RenderOptions options = {}) {
    if (options.aovs.empty()) options.aovs = kAll;
    const Prefilter prefilter = makePrefilter(filter, {}, {});
    Progress progress;
    return runMethod(parseMethod(method), {scene, camera, film, prefilter, options, progress});
}

const char* const kMethods[] = {"nsaa", "ssaa:4", "msaa:4", "csaa:32", "none"};

// 8 px high at 90 degrees: a pixel is 1/4 at distance 1. A square from pixel 2 to pixel 6 at distance 4 is
// node 0; behind it, at distance 8, a half plane left of pixel 3.5 is node 1.
Scene squareBeforeHalfPlane() {
    const auto quad = [](float x0, float x1, float y0, float y1, float z) {
        const glm::vec3 a(x0, y0, z), b(x1, y0, z), c(x1, y1, z), d(x0, y1, z);
        return test::makeGeometry({{a, b, c}, {a, c, d}});
    };
    Scene scene = test::makeScene({quad(-2, 2, -2, 2, -4), quad(-100, -1, -100, 100, -8)});
    scene.node_names = {"square", "wall"};
    return scene;
}

TEST(Aov, DepthNormalAndIndexOfTwoPlanes) {
    const Scene scene = squareBeforeHalfPlane();
    for (const char* method : kMethods) {
        const MethodResult result = render(scene, test::makePerspective(), test::makeFilm(8, 8), method);
        const Channels channels(result.image);
        EXPECT_EQ(channels.at("Z", 3, 3), 4.0f) << method;
        EXPECT_EQ(channels.at("Z", 0, 0), 8.0f) << method;
        EXPECT_EQ(channels.at("Z", 7, 0), static_cast<float>(kBackgroundDepth)) << method;
        EXPECT_EQ(channels.word("index", 7, 0), 4294967295u) << method;
        EXPECT_EQ(channels.word("index", 5, 4), 0u) << method;  // the lower right half of the square
        EXPECT_EQ(channels.word("index", 2, 3), 1u) << method;
        EXPECT_EQ(channels.normal(3, 3), glm::vec3(0, 0, 1)) << method;
        EXPECT_EQ(channels.normal(7, 0), glm::vec3(0)) << method;
    }
}

// The wall's border is at x = -1 at distance 8: 1/8 of 4 px left of the centre, px 3.5.
TEST(Aov, OwnersAndCoverageOfTwoPlanes) {
    const Scene scene = squareBeforeHalfPlane();
    const auto id = [](const char* name) { return cryptomatteIdBits(murmurHash3(name)); };
    for (const char* method : kMethods) {
        const MethodResult result = render(scene, test::makePerspective(), test::makeFilm(8, 8), method);
        const Channels channels(result.image);
        const bool sees_halves = std::string(method) != "none";
        EXPECT_EQ(channels.at("owners", 3, 0), sees_halves ? 2.0f : 1.0f) << method;
        EXPECT_EQ(channels.at("owners", 7, 0), 1.0f) << method;
        EXPECT_EQ(channels.at("owners", 5, 3), 1.0f) << method;  // off the diagonal
        EXPECT_EQ(channels.word("CryptoObject00.red", 0, 0), id("wall")) << method;
        EXPECT_EQ(channels.at("CryptoObject00.green", 0, 0), 1.0f) << method;
        EXPECT_EQ(channels.word("CryptoObject00.red", 4, 4), id("square")) << method;
        EXPECT_EQ(channels.at("CryptoObject00.green", 4, 4), 1.0f) << method;  // two triangles, one object
        EXPECT_EQ(channels.word("CryptoObject00.red", 7, 0), 0u) << method;
        EXPECT_EQ(channels.at("CryptoObject00.green", 7, 0), 0.0f) << method;
        EXPECT_EQ(channels.word("CryptoMaterial00.red", 4, 4), id("material_0")) << method;
        if (sees_halves) {
            EXPECT_EQ(channels.at("CryptoObject00.green", 3, 0), 0.5f) << method;
        }
    }
}

// The square lets three quarters of what is behind it through.
TEST(Aov, ALayerCoversItsShare) {
    Scene scene = squareBeforeHalfPlane();
    scene.materials.push_back(scene.materials[0]);
    scene.materials[1].alpha_mode = AlphaMode::kBlend;
    scene.materials[1].base_color.a = 0.25;
    scene.geometry[0].material = 1;
    const auto id = [](const char* name) { return cryptomatteIdBits(murmurHash3(name)); };
    for (const char* method : kMethods) {
        const MethodResult result = render(scene, test::makePerspective(), test::makeFilm(8, 8), method);
        const Channels channels(result.image);
        EXPECT_EQ(channels.word("CryptoObject00.red", 2, 4), id("wall")) << method;
        EXPECT_EQ(channels.at("CryptoObject00.green", 2, 4), 0.75f) << method;
        EXPECT_EQ(channels.word("CryptoObject00.blue", 2, 4), id("square")) << method;
        EXPECT_EQ(channels.at("CryptoObject00.alpha", 2, 4), 0.25f) << method;
        EXPECT_EQ(channels.at("CryptoObject00.green", 5, 3), 0.25f) << method;  // over the background
        EXPECT_EQ(channels.at("CryptoObject00.alpha", 5, 3), 0.0f) << method;
        EXPECT_EQ(channels.at("Z", 2, 4), 4.0f) << method;
        EXPECT_EQ(channels.at("owners", 2, 4), 1.0f) << method;
    }
    scene.materials[1].base_color.a = 0.0;  // nothing is there
    const MethodResult clear = render(scene, test::makePerspective(), test::makeFilm(8, 8), "nsaa");
    EXPECT_EQ(Channels(clear.image).at("Z", 2, 4), 8.0f);
}

// z = -2 - x: on the ray to (u, -1) times t it is t = 2 + u t, so t = 2 / (1 - u). Its normal is (1, 0, 1).
TEST(Aov, DepthOfATiltedPlaneIsAlongTheViewAxis) {
    const float big = 1.5f;
    const glm::vec3 a(-big, -90, -2 + big), b(big, -90, -2 - big), c(big, 90, -2 - big),
        d(-big, 90, -2 + big);
    const Scene scene = test::makeScene({test::makeGeometry({{a, b, c}, {a, c, d}})});
    const MethodResult result = render(scene, test::makePerspective(), test::makeFilm(8, 8), "nsaa");
    const Channels channels(result.image);
    int seen = 0;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            const double u = (x + 0.5 - 4) / 4;
            if (channels.word("index", x, y) == kBackground) continue;
            ++seen;
            EXPECT_FLOAT_EQ(channels.at("Z", x, y), static_cast<float>(2 / (1 - u))) << x << ' ' << y;
            EXPECT_FLOAT_EQ(channels.normal(x, y).x, static_cast<float>(std::sqrt(0.5)));
        }
    EXPECT_GT(seen, 30);
}

TEST(Aov, OrthographicDepthIsTheDistanceToTheEyesPlane) {
    const Scene scene = squareBeforeHalfPlane();
    const MethodResult result = render(scene, test::makeOrthographic(4.0), test::makeFilm(8, 8), "nsaa");
    EXPECT_EQ(Channels(result.image).at("Z", 4, 4), 4.0f);
    EXPECT_EQ(Channels(result.image).at("Z", 0, 0), 8.0f);
}

// A camera at (5, 0, 0) that looks down -x at a wall at x = 0 whose vertices share one normal.
TEST(Aov, NormalsAreTheShadingOnesInWorldSpace) {
    Geometry wall = test::makeGeometry({{glm::vec3(0, -9, 9), glm::vec3(0, -9, -9), glm::vec3(0, 9, 0)}});
    wall.normal_world.assign(3, glm::dvec3(3, 4, 0));
    ResolvedCamera camera = test::makePerspective();
    camera.camera_from_world = glm::lookAt(glm::dvec3(5, 0, 0), glm::dvec3(0, 0, 0), glm::dvec3(0, 1, 0));
    const Scene scene = test::makeScene({wall});
    const MethodResult result = render(scene, camera, test::makeFilm(8, 8), "nsaa");
    const Channels channels(result.image);
    ASSERT_EQ(channels.word("index", 4, 4), 0u);
    EXPECT_NEAR(channels.normal(4, 4).x, 0.6, std::numeric_limits<float>::epsilon());
    EXPECT_NEAR(channels.normal(4, 4).y, 0.8, std::numeric_limits<float>::epsilon());
    EXPECT_FLOAT_EQ(channels.at("Z", 4, 4), 5.0f);
}

/// The shipped scene with its triangles dealt out to `nodes` nodes.
test::ShippedPicture dealtOut(const char* name, int side_px, std::uint32_t nodes) {
    test::ShippedPicture picture = test::shippedPicture(name, side_px);
    std::vector<Geometry> dealt;
    for (const Geometry& whole : picture.scene.geometry) {
        const std::size_t share = whole.triangles.size() / nodes + 1;
        for (std::size_t first = 0; first < whole.triangles.size(); first += share) {
            Geometry part = whole;
            const std::size_t end = std::min(first + share, whole.triangles.size());
            part.triangles.assign(whole.triangles.begin() + static_cast<std::ptrdiff_t>(first),
                                  whole.triangles.begin() + static_cast<std::ptrdiff_t>(end));
            part.node = static_cast<std::uint32_t>(dealt.size()) % nodes;
            part.first_triangle = whole.first_triangle + static_cast<std::uint32_t>(first);
            dealt.push_back(std::move(part));
        }
    }
    picture.scene.geometry = std::move(dealt);
    picture.scene.node_names.clear();
    return picture;
}

/// What the weights of a pixel come to for each node.
std::map<std::uint32_t, FixedWeight> weightsById(const Scene& scene, const PixelReport& report) {
    std::map<std::uint32_t, FixedWeight> by_id;
    for (const PixelOwner& owner : report.owners) {
        const std::uint32_t node = scene.geometry[findTriangle(scene, owner.index).geometry].node;
        by_id[cryptomatteIdBits(murmurHash3("node_" + std::to_string(node)))] +=
            static_cast<FixedWeight>(std::llround(std::ldexp(owner.weight, kWeightBits)));
    }
    std::erase_if(by_id, [](const auto& entry) { return entry.second == 0; });
    return by_id;
}

// A weight that is printed as a double has 53 bits, of the 60 that were summed: a sum of n of them errs by
// n 2^-54, far below the float32 that the file holds, but it may round that the other way.
TEST(Aov, CoverageIsTheSumOfTheWeights) {
    const test::ShippedPicture picture = dealtOut("random-2k", 12, 5);
    std::size_t shared = 0, negative = 0, compared = 0;
    for (const char* filter : {"box", "gaussian", "lanczos"}) {
        const MethodResult result = render(picture.scene, picture.camera, picture.film, "nsaa", filter);
        const Channels channels(result.image);
        const Prefilter prefilter = makePrefilter(filter, {}, {});
        Progress progress;
        const RenderOptions options;
        const MethodInput input{picture.scene, picture.camera, picture.film, prefilter, options, progress};
        const PixelBox& crop = picture.film.crop;
        for (int y = crop.y0; y < crop.y1; y += 3)
            for (int x = crop.x0; x < crop.x1; x += 3) {
                const PixelReport report = pixelWeights(input, x, y);
                const auto expected = weightsById(picture.scene, report);
                EXPECT_EQ(channels.at("owners", x, y),
                          static_cast<float>(report.owners.size() + (report.background != 0.0)));
                std::size_t ranks = 0;
                float last = std::numeric_limits<float>::infinity();
                for (int layer = 0; layer < kCryptomatteLayers; ++layer)
                    for (const auto& [id, coverage] :
                         {std::pair(".red", ".green"), std::pair(".blue", ".alpha")}) {
                        const std::string name = "CryptoObject0" + std::to_string(layer);
                        const std::uint32_t bits = channels.word(name + id, x, y);
                        if (bits == 0) continue;
                        const float value = channels.at(name + coverage, x, y);
                        const double sum = std::ldexp(static_cast<double>(expected.at(bits)), -kWeightBits);
                        EXPECT_NEAR(value, sum,
                                    std::abs(sum) * 0x1p-24 + 0x1p-54 * double(report.owners.size()));
                        EXPECT_LE(std::abs(value), last);
                        last = std::abs(value);
                        ++ranks, negative += value < 0;
                    }
                EXPECT_EQ(ranks, expected.size());
                shared += ranks > 1, ++compared;
            }
    }
    EXPECT_EQ(compared, 3u * 16u);
    EXPECT_GT(shared, compared / 3);
    EXPECT_GT(negative, 0u);
}

TEST(Aov, PointSampledOnesAreTheSameForEveryMethod) {
    const test::ShippedPicture picture = dealtOut("torus-20k", 64, 3);
    RenderOptions options;
    options.aovs = {Aov::kDepth, Aov::kNormal, Aov::kIndex};
    const MethodResult nsaa = render(picture.scene, picture.camera, picture.film, "nsaa", "box", options);
    std::size_t seen = 0;
    for (int y = picture.film.crop.y0; y < picture.film.crop.y1; ++y)
        for (int x = picture.film.crop.x0; x < picture.film.crop.x1; ++x)
            seen += Channels(nsaa.image).word("index", x, y) != kBackground;
    EXPECT_GT(seen, 1000u);
    for (const char* method : {"none", "ssaa:3", "msaa:4", "csaa:32"}) {
        const MethodResult other =
            render(picture.scene, picture.camera, picture.film, method, "box", options);
        EXPECT_EQ(other.image.aov.words, nsaa.image.aov.words) << method;
    }
}

TEST(Aov, ThePictureKeepsItsBits) {
    const test::ShippedPicture picture = dealtOut("random-2k", 48, 5);
    const MethodResult with = render(picture.scene, picture.camera, picture.film, "nsaa", "gaussian");
    const MethodResult without =
        test::renderPicture(picture, makePrefilter("gaussian", {}, {}), RenderOptions{});
    EXPECT_EQ(with.image.rgba, without.image.rgba);
    EXPECT_EQ(with.image.edge, without.image.edge);
}

/// With the least memory that suffices.
MethodResult renderTightly(const test::ShippedPicture& picture, const char* method, RenderOptions options) {
    for (options.memory_mib = 1;; ++options.memory_mib) {
        try {
            return render(picture.scene, picture.camera, picture.film, method, "gaussian", options);
        } catch (const FailureError&) {
            if (options.memory_mib > 1024) throw;
        }
    }
}

TEST(Aov, ThreadsMemoryAndCropsDoNotEnter) {
    const test::ShippedPicture picture = dealtOut("random-2k", 96, 5);
    for (const char* method : kMethods) {
        RenderOptions options;
        options.aovs = kAll;
        options.threads = 1;
        const MethodResult one =
            render(picture.scene, picture.camera, picture.film, method, "gaussian", options);
        options.threads = 4;
        const MethodResult four = renderTightly(picture, method, options);
        EXPECT_EQ(one.image.aov.words, four.image.aov.words) << method;
        if (std::string(method) == "nsaa") {
            EXPECT_GT(four.counts.at("bands"), 1u);
        }
        Film part = picture.film;
        part.crop = {part.crop.x0 + 17, part.crop.y0 + 5, part.crop.x1 - 9, part.crop.y1 - 21};
        const MethodResult crop = render(picture.scene, picture.camera, part, method, "gaussian", options);
        for (int y = part.crop.y0; y < part.crop.y1; ++y)
            for (int x = part.crop.x0; x < part.crop.x1; ++x)
                for (std::size_t c = 0; c < crop.image.aov.channels.size(); ++c)
                    ASSERT_EQ(crop.image.aov.pixel(crop.image.index(x, y))[c],
                              one.image.aov.pixel(one.image.index(x, y))[c])
                        << method << ' ' << crop.image.aov.channels[c].name << ' ' << x << ' ' << y;
    }
}

}  // namespace
}  // namespace edgewise
