// Asks a property of random scenes, and tells of a failure what one needs to look into it.
#pragma once

#include <cstdint>

#include "tests/property/properties.h"

namespace edgewise::property {

/// Scenes number seed, seed + 1, ...; EDGEWISE_PROPERTY_SEED and EDGEWISE_PROPERTY_SCENES override the
/// defaults.
struct Campaign {
    std::uint64_t seed = 1;
    int scenes = 0;
};
Campaign campaignOf(int default_scenes);

/// Of scene `seed`, with a kernel that the seed chooses.
Trial trialOf(std::uint64_t seed);

constexpr int kShrinkBudget = 3000;

/// The smallest scene that still fails as a glTF file in the working directory, failure-NAME-SEED.gltf, and
/// in words how to see it again.
std::string reportFailure(const Property& property, const Trial& trial, int budget = kShrinkBudget);

/// How many scenes were asked. The first failure is shrunk (EDGEWISE_PROPERTY_BUDGET: the smaller scenes that
/// are tried), saved and added to the test's.
int runProperty(const Property& property, const Campaign& campaign);

}  // namespace edgewise::property
