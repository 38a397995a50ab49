#include "tests/property/run_property.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/pipeline/tiny_gltf_file.h"
#include "tests/property/shrink.h"
#include "tests/witness/kernels.h"

namespace edgewise::property {
namespace {

template <class Number>
Number fromEnvironment(const char* name, Number otherwise) {
    const char* const text = std::getenv(name);
    return text ? static_cast<Number>(std::strtoull(text, nullptr, 10)) : otherwise;
}

}  // namespace

Campaign campaignOf(int default_scenes) {
    return {fromEnvironment("EDGEWISE_PROPERTY_SEED", std::uint64_t{1}),
            fromEnvironment("EDGEWISE_PROPERTY_SCENES", default_scenes)};
}

Trial trialOf(std::uint64_t seed) {
    static const std::vector<Prefilter> filters = witness::allPrefilters();
    RandomWorld world = makeRandomWorld(seed);
    return {std::move(world.scene), world.box, filters[seed % filters.size()], seed};
}

std::string reportFailure(const Property& property, const Trial& trial, int budget) {
    Trial small = trial;
    small.scene = shrink(
        trial.scene,
        [&](const WorldScene& scene) {
            Trial t = trial;
            t.scene = scene;
            return property.check(t).wrong.has_value();
        },
        budget);
    const std::string file = fmt::format("failure-{}-{}.gltf", property.name, trial.seed);
    test::writeFile(file, gltfOf(small.scene));
    const Violation first = *property.check(trial).wrong, last = *property.check(small).wrong;
    return fmt::format(
        "{}: {} at pixel {},{}\nshrunk from {} to {} triangles: {}\n"
        "  edgewise weights {} --size {}x{} --pixel {},{} --filter {} --exact\n"
        "  EDGEWISE_PROPERTY_SEED={} EDGEWISE_PROPERTY_SCENES=1 property_tests --gtest_filter='*{}*'",
        property.name, first.what, first.pixel.x, first.pixel.y, trial.scene.triangles.size(),
        small.scene.triangles.size(), last.what, file, kFilmPx, kFilmPx, last.pixel.x, last.pixel.y,
        last.filter.empty() ? trial.filter.name : last.filter, trial.seed, property.name);
}

int runProperty(const Property& property, const Campaign& campaign) {
    int asked = 0;
    for (int k = 0; k < campaign.scenes; ++k) {
        const Trial trial = trialOf(campaign.seed + std::uint64_t(k));
        const Outcome outcome = property.check(trial);
        asked += outcome.asked;
        if (!outcome.wrong) continue;
        ADD_FAILURE() << reportFailure(property, trial,
                                       fromEnvironment("EDGEWISE_PROPERTY_BUDGET", kShrinkBudget));
        break;
    }
    fmt::print("{}: seeds {} to {}, {} scenes asked\n", property.name, campaign.seed,
               campaign.seed + std::uint64_t(std::max(campaign.scenes, 1)) - 1, asked);
    return asked;
}

}  // namespace edgewise::property
