// What may never show in a picture: threads, memory, crops, instruction sets, whole pixels, runs. And what
// must hold in every pixel: the weights sum to exactly 1, and nothing of the background comes through a
// closed edge.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <set>
#include <thread>

#include "analytic/edge_integral.h"
#include "pipeline/error.h"
#include "pipeline/methods/nsaa.h"
#include "tests/pipeline/nsaa_stages.h"
#include "tests/pipeline/shipped_picture.h"
#include "tests/witness/kernels.h"

namespace edgewise {
namespace {

using test::ShippedPicture;

constexpr FixedWeight kOne = FixedWeight{1} << kWeightBits;

void expectSameBits(const ImageBuffer& a, const ImageBuffer& b) {
    EXPECT_EQ(a.rgba, b.rgba);
    EXPECT_EQ(a.edge, b.edge);
}

/// `part` has the bits of `whole` where it lies in it.
void expectPartOf(const ImageBuffer& part, const ImageBuffer& whole) {
    for (int y = part.box.y0; y < part.box.y1; ++y)
        for (int x = part.box.x0; x < part.box.x1; ++x) {
            ASSERT_EQ(part.rgba[part.index(x, y)], whole.rgba[whole.index(x, y)]) << x << ", " << y;
            ASSERT_EQ(part.edge[part.index(x, y)], whole.edge[whole.index(x, y)]) << x << ", " << y;
        }
}

/// With every instruction set of this machine; EDGEWISE_ISA is read whenever a thread begins with the
/// weights.
std::map<std::string, MethodResult> rendersBySet(const ShippedPicture& picture, const Prefilter& filter) {
    std::map<std::string, MethodResult> results;
    for (const char* set : {"scalar", "sse2", "avx2", "avx512"}) {
        if (edgeTermsFor(set) == nullptr) continue;
        setenv("EDGEWISE_ISA", set, 1);
        results.emplace(set, renderPicture(picture, filter, test::onBlue()));
    }
    unsetenv("EDGEWISE_ISA");
    return results;
}

class NsaaScene : public testing::TestWithParam<scenes::Recipe> {
  protected:
    static constexpr int kSidePx = 48;
    ShippedPicture picture_ = test::shippedPicture(GetParam(), kSidePx);
    Prefilter filter_ = makePrefilter("gaussian", {}, {});
    MethodResult render(const RenderOptions& options = test::onBlue()) const {
        return renderPicture(picture_, filter_, options);
    }
};

TEST_P(NsaaScene, RunsAndThreadsDoNotShow) {
    const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 4);
    RenderOptions options = test::onBlue();
    options.threads = 1;
    const MethodResult once = render(options), again = render(options);
    expectSameBits(once.image, again.image);
    EXPECT_EQ(once.counts, again.counts);
    for (const int threads : {2, 3}) {
        options.threads = threads;
        const MethodResult many = render(options);
        expectSameBits(once.image, many.image);
        EXPECT_EQ(once.counts, many.counts);
    }
}

TEST_P(NsaaScene, CropsDoNotShow) {
    const MethodResult whole = render();
    const PixelBox all = picture_.film.crop;
    const int w = all.width(), h = all.height();
    for (const PixelBox& crop :
         {PixelBox{all.x0 + 1, all.y0 + 3, all.x1 - 5, all.y1 - 7},
          PixelBox{all.x0 + w / 2, all.y0 + h / 2 + 1, all.x0 + w / 2 + 1, all.y0 + h / 2 + 2},
          PixelBox{all.x0 + 7, all.y0, all.x0 + 20, all.y1},
          PixelBox{all.x0, all.y1 - 11, all.x1, all.y1 - 8}}) {
        picture_.film.crop = crop;
        expectPartOf(render().image, whole.image);
    }
}

TEST_P(NsaaScene, InstructionSetsDoNotShow) {
    const MethodResult chosen = render();
    const auto by_set = rendersBySet(picture_, filter_);
    for (const auto& [set, result] : by_set) {
        SCOPED_TRACE(set);
        expectSameBits(chosen.image, result.image);
    }
    EXPECT_TRUE(by_set.contains("scalar"));
}

TEST_P(NsaaScene, WholePixelsDoNotShow) {
    const MethodResult plain = render();
    for (const glm::dvec2 offset : {glm::dvec2(1, 0), glm::dvec2(-37, 501), glm::dvec2(16384, -8191)}) {
        picture_.film.debug_offset_px = offset;
        expectSameBits(plain.image, render().image);
    }
}

TEST_P(NsaaScene, AlphaAndTheBackgroundMakeOne) {
    const RenderOptions options = test::onBlue();
    const MethodResult result = render(options);
    EXPECT_EQ(result.counts.at("label_conflicts"), 0u);
    Progress progress;
    const MethodInput input{picture_.scene, picture_.camera, picture_.film, filter_, options, progress};
    test::NsaaStages stages(input);
    const PixelBox& box = picture_.film.crop;
    for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x) {
            const test::PixelParts parts = stages.pixel(x, y);
            ASSERT_EQ(parts.sum(), kOne) << x << ", " << y;
            // two roundings to double, and one of the sum
            const double alpha = result.image.rgba[result.image.index(x, y)].a;
            ASSERT_NEAR(alpha + parts.background(), 1.0, 4 * test::kUnit) << x << ", " << y;
        }
    const int x = (box.x0 + box.x1) / 2, y = (box.y0 + box.y1) / 2;
    const PixelReport report = pixelWeights(input, x, y);
    EXPECT_EQ(report.sum, 1.0);
    EXPECT_NEAR(report.background, stages.pixel(x, y).background(), stages.pixel(x, y).colorError());
}

INSTANTIATE_TEST_SUITE_P(Shipped, NsaaScene, testing::ValuesIn(test::shippedRecipes()),
                         [](const auto& one) { return test::nameOf(one.param); });

class NsaaFilter : public testing::TestWithParam<Prefilter> {};

TEST_P(NsaaFilter, WeightsSumToExactlyOneOnEveryScene) {
    const Prefilter filter = makePrefilter(GetParam().name, {}, {});
    const RenderOptions options = test::onBlue();
    std::uint64_t pixels = 0, terms = 0;
    for (const scenes::Recipe& recipe : test::shippedRecipes()) {
        const ShippedPicture picture = test::shippedPicture(recipe, 24, {0.5, 0.35});
        EXPECT_EQ(renderPicture(picture, filter, options).counts.at("label_conflicts"), 0u) << picture.name;
        Progress progress;
        test::NsaaStages stages({picture.scene, picture.camera, picture.film, filter, options, progress});
        const PixelBox& box = picture.film.crop;
        for (int y = box.y0; y < box.y1; ++y)
            for (int x = box.x0; x < box.x1; ++x) {
                const test::PixelParts parts = stages.pixel(x, y);
                ASSERT_EQ(parts.sum(), kOne) << picture.name << " " << x << ", " << y;
                ++pixels, terms += parts.terms;
            }
    }
    EXPECT_GT(terms, pixels / 4);
    fmt::print("{} pixels, {} terms\n", pixels, terms);
}

TEST_P(NsaaFilter, NothingShowsThatMayNot) {
    const Prefilter filter = makePrefilter(GetParam().name, {}, {});
    for (const char* name :
         {"random-20k", "two-spheres", "slivers", "t-junctions", "pixel-edges", "fan-1000"}) {
        SCOPED_TRACE(name);
        ShippedPicture picture = test::shippedPicture(name, 29, {0.4, 0.6});
        const MethodResult whole = renderPicture(picture, filter, test::onBlue());
        RenderOptions one_thread = test::onBlue();
        one_thread.threads = 1;
        expectSameBits(whole.image, renderPicture(picture, filter, one_thread).image);
        for (const auto& [set, result] : rendersBySet(picture, filter)) {
            SCOPED_TRACE(set);
            expectSameBits(whole.image, result.image);
        }
        picture.film.debug_offset_px = {-513, 77};
        expectSameBits(whole.image, renderPicture(picture, filter, test::onBlue()).image);
        PixelBox& crop = picture.film.crop;
        crop = {crop.x0 + 3, crop.y0 + 5, crop.x1 - 7, crop.y1 - 1};
        expectPartOf(renderPicture(picture, filter, test::onBlue()).image, whole.image);
    }
}

INSTANTIATE_TEST_SUITE_P(All, NsaaFilter, testing::ValuesIn(witness::allPrefilters()),
                         [](const auto& one) { return test::nameOf(one.param); });

/// The smallest --memory that a picture can be made with.
std::pair<std::size_t, MethodResult> renderInLittleMemory(const ShippedPicture& picture,
                                                          const Prefilter& filter) {
    RenderOptions options = test::onBlue();
    for (options.memory_mib = 1;; ++options.memory_mib) {
        try {
            return {options.memory_mib, renderPicture(picture, filter, options)};
        } catch (const FailureError&) {
            if (options.memory_mib > 1024) throw;
        }
    }
}

TEST(Nsaa, BandsDoNotShow) {
    for (const char* name : {"random-20k", "torus-20k", "zone-plate", "torus-sequence"})
        for (const char* filter_name : {"box", "lanczos"}) {
            const ShippedPicture picture = test::shippedPicture(name, 200);
            const Prefilter filter = makePrefilter(filter_name, {}, {});
            const MethodResult whole = renderPicture(picture, filter, test::onBlue());
            const auto [mib, banded] = renderInLittleMemory(picture, filter);
            fmt::print("{} {}: {} bands in {} MiB\n", name, filter_name, banded.counts.at("bands"), mib);
            EXPECT_EQ(whole.counts.at("bands"), 1u);
            EXPECT_GT(banded.counts.at("bands"), 1u) << name;
            expectSameBits(whole.image, banded.image);
        }
}

/// Collects the threads that advance it. Where there is work for many, the first waits for a second one: a
/// busy machine may start it late.
struct ThreadProgress : Progress {
    explicit ThreadProgress(bool wait_) : wait(wait_) {}
    void stage(std::string_view name, std::size_t) override {
        const std::lock_guard lock(mutex);
        wait_for_second = wait && name == "visibility";
    }
    void advance(std::size_t) override {
        std::unique_lock lock(mutex);
        threads.insert(std::this_thread::get_id());
        if (threads.size() > 1) wait_for_second = false, another.notify_all();
        another.wait_for(lock, std::chrono::seconds(20), [&] { return !wait_for_second; });
        wait_for_second = false;
    }
    std::mutex mutex;
    std::condition_variable another;
    std::set<std::thread::id> threads;
    const bool wait;
    bool wait_for_second = false;
};

TEST(Nsaa, AForcedInstructionSetIsTheOneThatRuns) {
    const ShippedPicture picture = test::shippedPicture("slivers", 8);
    const Prefilter filter = makePrefilter("box", {}, {});
    setenv("EDGEWISE_ISA", "abacus", 1);
    EXPECT_THROW(renderPicture(picture, filter), std::invalid_argument);
    unsetenv("EDGEWISE_ISA");
    std::string sets;
    for (const auto& [set, result] : rendersBySet(picture, filter)) sets += set + " ";
    fmt::print("this machine has {}\n", sets);
}

TEST(Nsaa, ThreadsReallyWork) {
    const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 4);
    const ShippedPicture picture = test::shippedPicture("random-2k", 256);
    const Prefilter filter = makePrefilter("box", {}, {});
    RenderOptions options = test::onBlue();
    for (const int threads : {1, 3}) {
        options.threads = threads;
        ThreadProgress progress(threads > 1);
        runMethod(parseMethod("nsaa"),
                  {picture.scene, picture.camera, picture.film, filter, options, progress});
        EXPECT_LE(progress.threads.size(), static_cast<std::size_t>(threads));
        fmt::print("{} threads asked for, {} seen\n", threads, progress.threads.size());
        EXPECT_GE(progress.threads.size(), threads > 1 ? 2u : 1u);
    }
}

}  // namespace
}  // namespace edgewise
