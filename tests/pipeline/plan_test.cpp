// What the planner leaves out changes no picture by more than rounding, and it really is left out.
#include "pipeline/plan.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>

#include "tests/pipeline/nsaa_stages.h"
#include "tests/pipeline/shipped_picture.h"

namespace edgewise {
namespace {

using test::ShippedPicture;

/// Small: once nothing is hidden, the book's common line is a thousand crossings in every cell down to the
/// smallest.
ShippedPicture pictureOf(scenes::Recipe recipe) {
    if (recipe.file.ends_with("piercing-book.gltf")) recipe.width_px = recipe.height_px = 8;
    return test::shippedPicture(recipe, 40);
}

RenderOptions forcing(const std::string& omission) {
    RenderOptions options = test::onBlue();
    if (!omission.empty()) options.no_skip.insert(omission);
    return options;
}

std::vector<std::string> omissions() {
    std::vector<std::string> names = skippableStages();
    names.push_back("all");
    return names;
}

/// What these leave out is exact: the same colour is computed elsewhere, or a weight of 1 is 1.
bool changesNoBit(const std::string& omission) {
    return omission == "fetch" || omission == "empty" || omission == "interior";
}

struct Worst {
    double difference = 0.0, of_bound = 0.0;
    std::size_t pixels = 0, edges = 0;
};

/// Compares two pictures pixel by pixel; each difference within what rounding may do to both.
class Comparison {
  public:
    Comparison(const ShippedPicture& picture, const Prefilter& filter, const std::string& omission)
        : box_(picture.film.crop),
          default_options_(forcing("")),
          forced_options_(forcing(omission)),
          default_({picture.scene, picture.camera, picture.film, filter, default_options_, progress_}),
          forced_({picture.scene, picture.camera, picture.film, filter, forced_options_, progress_}) {}

    Worst run(const ImageBuffer& a, const ImageBuffer& b) {
        Worst worst;
        for (int y = box_.y0; y < box_.y1; ++y)
            for (int x = box_.x0; x < box_.x1; ++x) {
                const std::size_t i = a.index(x, y);
                if (a.edge[i] != b.edge[i]) checkEdge(x, y, worst);
                if (a.rgba[i] != b.rgba[i]) checkPixel(x, y, a.rgba[i] - b.rgba[i], worst);
            }
        return worst;
    }

  private:
    void checkPixel(int x, int y, const glm::dvec4& difference, Worst& worst) {
        const double bound = default_.pixel(x, y).colorError() + forced_.pixel(x, y).colorError();
        double largest = 0.0;
        for (glm::length_t k = 0; k < 4; ++k) largest = std::max(largest, std::abs(difference[k]));
        EXPECT_LE(largest, bound) << "pixel " << x << ", " << y;
        worst.difference = std::max(worst.difference, largest);
        worst.of_bound = std::max(worst.of_bound, largest / bound);
        ++worst.pixels;
    }

    /// An owner may be there in one of both pictures alone, if its weight is no more than rounding.
    void checkEdge(int x, int y, Worst& worst) {
        const test::PixelParts a = default_.pixel(x, y), b = forced_.pixel(x, y);
        const double bound = a.colorError() + b.colorError();
        double smallest = 1.0;
        for (const auto* parts : {&a, &b})
            for (const OwnerWeight& entry : parts->entries)
                smallest =
                    std::min(smallest, std::abs(std::ldexp(static_cast<double>(entry.weight), -kWeightBits)));
        EXPECT_LE(smallest, bound) << "edge of pixel " << x << ", " << y;
        ++worst.edges;
    }

    PixelBox box_;
    RenderOptions default_options_, forced_options_;
    Progress progress_;
    test::NsaaStages default_, forced_;
};

class PlanOf : public testing::TestWithParam<scenes::Recipe> {};

TEST_P(PlanOf, NoOmissionChangesThePicture) {
    const ShippedPicture picture = pictureOf(GetParam());
    for (const char* filter_name : {"box", "gaussian", "mitchell"}) {
        const Prefilter filter = makePrefilter(filter_name, {}, {});
        const MethodResult by_default = renderPicture(picture, filter, forcing(""));
        for (const std::string& omission : omissions()) {
            SCOPED_TRACE(std::string(filter_name) + " --no-skip " + omission);
            const MethodResult forced = renderPicture(picture, filter, forcing(omission));
            if (changesNoBit(omission)) {
                EXPECT_EQ(by_default.image.rgba, forced.image.rgba);
                EXPECT_EQ(by_default.image.edge, forced.image.edge);
                continue;
            }
            const Worst worst = Comparison(picture, filter, omission).run(by_default.image, forced.image);
            if (worst.pixels + worst.edges > 0)
                fmt::print(
                    "{:<9} {:<10} {:4} pixels differ, by up to {:.1e} ({:.2f} of the bound); {} edge flags\n",
                    filter_name, omission, worst.pixels, worst.difference, worst.of_bound, worst.edges);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Shipped, PlanOf, testing::ValuesIn(test::shippedRecipes()),
                         [](const auto& one) { return test::nameOf(one.param); });

// Did it fire?

using Counts = std::map<std::string, std::uint64_t>;

struct Firing {
    const char* omission;
    const char* scene;
    const char* what;
    std::function<bool(const Counts& by_default, const Counts& forced)> fired;
};

const std::vector<Firing>& firings() {
    static const std::vector<Firing> all{
        {"visibility", "torus-20k", "cells are certified",
         [](Counts a, Counts b) { return a["cells_certified"] > 0 && b["cells_certified"] == 0; }},
        {"visibility", "closed-sphere", "cells are certified",
         [](Counts a, Counts b) { return a["cells_certified"] > 0 && b["cells_certified"] == 0; }},
        {"piercing", "two-spheres", "pairs need no depth line, others do",
         [](Counts a, Counts b) { return a["depth_lines"] > 0 && b["depth_lines"] > a["depth_lines"]; }},
        {"piercing", "closed-sphere", "no pair needs a depth line",
         [](Counts a, Counts b) { return a["depth_lines"] == 0 && b["depth_lines"] > 0; }},
        {"occlusion", "random-2k", "pairs are hidden",
         [](Counts a, Counts b) { return a["hidden_pairs"] > 0 && b["hidden_pairs"] == 0; }},
        {"empty", "two-spheres", "cells are empty",
         [](Counts a, Counts b) {
             return a["cells_swept"] + a["cells_certified"] < b["cells_swept"] + b["cells_certified"];
         }},
        {"interior", "random-2k", "pixels are inside one owner",
         [](Counts a, Counts b) { return a["interior_pixels"] > 0 && b["interior_pixels"] == 0; }},
        {"cancel", "log-grid", "segments lie between equal colours",
         [](Counts a, Counts b) {
             return a["terms"] < b["terms"] && a["pixel_owner_pairs"] < b["pixel_owner_pairs"];
         }},
    };
    return all;
}

const PlanEntry& entryOf(const MethodResult& result, const std::string& stage) {
    return *std::find_if(result.plan.begin(), result.plan.end(),
                         [&](const PlanEntry& e) { return e.stage == stage; });
}

TEST(Plan, EveryOmissionFires) {
    const Prefilter filter = makePrefilter("gaussian", {}, {});
    for (const Firing& firing : firings()) {
        const ShippedPicture picture = test::shippedPicture(firing.scene, 64);
        const MethodResult by_default = renderPicture(picture, filter, forcing(""));
        for (const char* forced_name : {firing.omission, "all"}) {
            const MethodResult forced = renderPicture(picture, filter, forcing(forced_name));
            EXPECT_TRUE(firing.fired(by_default.counts, forced.counts))
                << firing.omission << " on " << firing.scene << " by " << forced_name << ": " << firing.what;
            EXPECT_FALSE(entryOf(by_default, firing.omission).runs)
                << firing.omission << " on " << firing.scene;
            EXPECT_TRUE(entryOf(forced, firing.omission).runs) << firing.omission << " on " << firing.scene;
        }
    }
}

TEST(Plan, ForcingOneStageLeavesTheOthersOut) {
    const ShippedPicture picture = test::shippedPicture("log-grid", 16);
    const Prefilter filter = makePrefilter("box", {}, {});
    const MethodResult by_default = renderPicture(picture, filter, forcing(""));
    for (const std::string& omission : skippableStages()) {
        const MethodResult forced = renderPicture(picture, filter, forcing(omission));
        for (const std::string& other : skippableStages())
            EXPECT_EQ(entryOf(forced, other).runs, other == omission || entryOf(by_default, other).runs)
                << omission << " forced, " << other;
    }
}

TEST(Plan, ConstantColoursAreFetchedOnlyWhenForced) {
    const ShippedPicture picture = test::shippedPicture("log-grid", 16);
    const Prefilter filter = makePrefilter("box", {}, {});
    Progress progress;
    const auto fetchedOf = [&](const std::string& omission) {
        const RenderOptions options = forcing(omission);
        const test::NsaaStages stages(
            {picture.scene, picture.camera, picture.film, filter, options, progress});
        const auto& constant = stages.plan().constant;
        return std::count_if(constant.begin(), constant.end(),
                             [](const auto& color) { return color.has_value(); });
    };
    EXPECT_GT(fetchedOf(""), 0);
    EXPECT_EQ(fetchedOf("fetch"), 0);
    EXPECT_EQ(fetchedOf("all"), 0);
}

/// The zone plate's triangles are textured, each from within one texel.
TEST(Plan, TrianglesWithinATexelAreKnownButNotMerged) {
    const ShippedPicture picture = test::shippedPicture("zone-plate", 16);
    const Prefilter filter = makePrefilter("box", {}, {});
    Progress progress;
    const RenderOptions options = forcing("");
    const test::NsaaStages stages({picture.scene, picture.camera, picture.film, filter, options, progress});
    EXPECT_TRUE(stages.plan().classes.representative.empty());
    const auto& constant = stages.plan().constant;
    EXPECT_GT(std::count_if(constant.begin(), constant.end(), [](const auto& c) { return c.has_value(); }),
              1000);
}

TEST(Plan, ScenesWithoutConstantColoursSaySo) {
    const ShippedPicture picture = test::shippedPicture("torus-20k", 16);
    const MethodResult result = renderPicture(picture, makePrefilter("box", {}, {}), forcing(""));
    EXPECT_TRUE(entryOf(result, "cancel").runs);
    EXPECT_TRUE(entryOf(result, "fetch").runs);
}

}  // namespace
}  // namespace edgewise
