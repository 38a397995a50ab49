// --dump-stages of sampling methods, against the picture that was made of the same samples.
#include "pipeline/dump_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "pipeline/methods/method.h"
#include "pipeline/scoped_path.h"
#include "tests/pipeline/test_scene.h"

namespace edgewise {
namespace {

constexpr int kSidePx = 12;

struct Samples {
    int count = 0, background = 0;
};

/// By pixel.
std::map<std::pair<int, int>, Samples> read(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::string line;
    EXPECT_TRUE(std::getline(file, line));
    EXPECT_EQ(line, "x,y,owner");
    std::map<std::pair<int, int>, Samples> pixels;
    while (std::getline(file, line)) {
        std::istringstream words(line);
        double x = 0.0, y = 0.0;
        char comma = 0;
        std::string owner;
        words >> x >> comma >> y >> comma >> owner;
        Samples& pixel = pixels[{int(std::floor(x)), int(std::floor(y))}];
        ++pixel.count, pixel.background += owner == "background";
    }
    return pixels;
}

struct Case {
    const char* method;
    int samples;
    bool alike;  ///< they weigh alike
};

TEST(DumpSamples, AreThoseOfThePicture) {
    const Scene scene =
        test::makeScene({test::makeGeometry({{{{-1, -1, -1}, {0.5f, -0.7f, -1}, {0.2f, 0.9f, -1}}},
                                             {{{-0.3f, -2, -2}, {2, 0, -2}, {1, 2, -2}}}})});
    const ResolvedCamera camera = test::makePerspective();
    const Film film = test::makeFilm(kSidePx, kSidePx);
    const Prefilter box = makePrefilter("box", {}, {});
    Progress progress;
    for (const Case& one : {Case{"none", 1, true},
                            {"ssaa:3", 9, true},
                            {"msaa:4", 4, true},
                            {"csaa:32", 32, false},
#ifdef EDGEWISE_HAS_EMBREE
                            {"rt:5", 5, false},
#endif
                            {"fxaa", 1, false}}) {
        SCOPED_TRACE(one.method);
        const ScopedPath folder =
            emptyFolder(std::filesystem::temp_directory_path() / "edgewise_dump_samples");
        RenderOptions options;
        options.device = DeviceChoice::kCpu;
        options.dump_dir = folder.path();
        const MethodResult made =
            runMethod(parseMethod(one.method), {scene, camera, film, box, options, progress});
        for (const char* name : {"screen.csv", "samples.csv", "samples.png"})
            EXPECT_TRUE(std::filesystem::exists(folder.path() / name)) << name;
        const auto pixels = read(folder.path() / "samples.csv");
        int mixed = 0;
        for (int y = made.image.box.y0; y < made.image.box.y1; ++y)
            for (int x = made.image.box.x0; x < made.image.box.x1; ++x) {
                const Samples& seen = pixels.at({x, y});
                ASSERT_EQ(seen.count, one.samples);
                mixed += seen.background > 0 && seen.background < seen.count;
                const double covered = 1.0 - double(seen.background) / seen.count;
                if (!one.alike) continue;
                // Weights are multiples of 2^-60, and their sum is rounded.
                EXPECT_NEAR(made.image.rgba[made.image.index(x, y)].a, covered, one.samples * 0x1p-52);
            }
        EXPECT_EQ(mixed > 0, one.samples > 1);
    }
}

}  // namespace
}  // namespace edgewise
