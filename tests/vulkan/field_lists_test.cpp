// Lists of a fold's children: are they safe from rounding, and what is too long refused?
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "data/generate/recipes.h"
#include "pipeline/device_error.h"
#include "pipeline/load_scene.h"
#include "pipeline/scene_catalog.h"
#include "pipeline/vulkan/field_rays.h"
#include "sdf/glsl_text.h"
#include "sdf/machine.h"
#include "sdf/running_error.h"
#include "tests/vulkan/test_device.h"

namespace edgewise::vulkan {
namespace {

using sdf::Kind, sdf::RunningError;

/// The largest share of the lists' slack (glsl_text.cpp) that two of float's running errors take, of any
/// value of the tape: one where the list was made, one where the ray asks.
double worstShare(const sdf::Tape& tape, const glm::vec3& p) {
    double largest = 0.0, worst = 0.0;
    for (const double number : tape.numbers) largest = std::max(largest, std::abs(number));
    const double size = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    static sdf::Slots<RunningError> slots;
    slots.position[0] = {RunningError(p.x, 0.0), RunningError(p.y, 0.0), RunningError(p.z, 0.0)};
    for (const sdf::Instruction& i : tape.instructions) {
        sdf::step(i, tape.numbers.data() + i.numbers, slots);
        if (sdf::codeInfo(i.code).form == sdf::CodeForm::kMove) continue;
        const RunningError& value = slots.value[i.to];
        const double slack = 0x1p-16 * (std::abs(value.value) + size + std::min(largest, 1e6));
        worst = std::max(worst, 2.0 * value.error / slack);
    }
    return worst;
}

TEST(FieldLists, SlackHoldsWhatFloatMayBeOff) {
    int asked = 0;
    for (const scenes::Recipe& recipe : scenes::sdfRecipes()) {
        const Scene scene = loadScene(findScene(recipe.name));
        const sdf::Tape tape = sdf::lower(scene.field->tree);
        if (sdf::glslText(tape).batches.empty()) continue;
        std::mt19937_64 random(5);
        double worst = 0.0;
        for (int n = 0; n < 200; ++n) {
            glm::vec3 p;
            for (int k = 0; k < 3; ++k) {
                const double low = scene.field->bounds.low[k], high = scene.field->bounds.high[k];
                p[k] = static_cast<float>(std::uniform_real_distribution<double>(
                    low - 0.2 * (high - low), high + 0.2 * (high - low))(random));
            }
            worst = std::max(worst, worstShare(tape, p));
        }
        fmt::print("{:16} two running errors take {:.3f} of a list's slack (seed 5)\n", recipe.name, worst);
        EXPECT_LT(worst, 1.0) << recipe.name;
        ++asked;
    }
    EXPECT_GT(asked, 1);
}

using FieldLimits = test::DeviceTest;

sdf::FieldScene spheres(std::uint32_t count) {
    sdf::FieldScene scene;
    scene.source = "many";
    scene.materials.resize(1);
    std::vector<std::uint32_t> children;
    for (std::uint32_t i = 0; i < count; ++i)
        children.push_back(scene.tree.add(Kind::kTranslate, {0.1 * (i % 100), 0.1 * (i / 100), 0.0},
                                          {scene.tree.add(Kind::kSphere, {0.01})}));
    scene.tree.root = scene.tree.add(Kind::kUnion, {}, children);
    return scene;
}

/// Loops that the device would cut off are refused by a line, never traced wrong.
TEST_F(FieldLimits, AFoldOfMoreChildrenThanTheDeviceCanLoopOverIsRefused) {
    const std::uint32_t turns = test::device().traits().loop_turns;
    if (turns > 1u << 20) GTEST_SKIP() << "the device stops no loops";
    const std::uint32_t most = (turns - 8192) / 2;  // an evaluation has a turn of its own, and a first child
    const auto made = [](std::uint32_t children) {
        const sdf::TraceSettings settings;
        const FieldShaders shaders = makeFieldShaders(spheres(children), settings, 8, 8, true);
        FieldTiles(test::device(), shaders, settings.prepass, true);
    };
    EXPECT_NO_THROW(made(most));
    try {
        made(most + 1);
        ADD_FAILURE() << most + 1 << " children are taken";
    } catch (const DeviceError& error) {
        const std::string message = error.what();
        fmt::print("{}\n", message);
        EXPECT_NE(message.find(fmt::format("a field of {} like children needs more", most)), message.npos);
        EXPECT_EQ(message.find('\n'), message.npos);
    }
}

}  // namespace
}  // namespace edgewise::vulkan
