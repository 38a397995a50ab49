// What is wrong is said in one line, with the contract's exit status, and leaves nothing behind.
#include <gtest/gtest.h>

#include <cstdlib>
#include <ostream>

#include "tests/cli/run_program.h"

namespace edgewise::test {
namespace {

struct WrongCase {
    Arguments arguments;
    const char* fragment;  ///< the error names this
    int status = 2;
};

std::ostream& operator<<(std::ostream& out, const WrongCase& wrong) {
    for (const std::string& argument : wrong.arguments) out << argument << ' ';
    return out;
}

Arguments renderScene(const std::string& scene) {
    return {"render", scene, "-o", "a.exr", "--method", "none"};
}

/// A command line that is right, with more arguments behind.
Arguments renderWith(Arguments more) {
    Arguments arguments = renderScene("torus-20k");
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

class WrongCommandLine : public testing::TestWithParam<WrongCase> {};

TEST_P(WrongCommandLine, IsOneLineAndAStatus) {
    const TemporaryFolder folder;
    writeFile(folder / "empty.glb", "");
    writeFile(folder / "text.gltf", "this is no JSON");
    writeFile(folder / "scene.txt", "x");
    const std::vector<std::string> before = folder.names();
    const ProgramRun run = runProgram(GetParam().arguments, folder.path());
    EXPECT_EQ(run.status, GetParam().status) << run.err;
    EXPECT_EQ(run.out, "");
    ASSERT_EQ(lines(run.err).size(), 1u) << run.err;
    EXPECT_TRUE(run.err.starts_with("edgewise: error: ")) << run.err;
    EXPECT_NE(run.err.find(GetParam().fragment), std::string::npos) << run.err;
    EXPECT_EQ(folder.names(), before);
}

/// No driver is found while it lives.
class NoDrivers {
  public:
    NoDrivers() { ::setenv("VK_ICD_FILENAMES", "/nonexistent", 1); }
    ~NoDrivers() { ::unsetenv("VK_ICD_FILENAMES"); }
};

TEST(DeviceOption, WithoutADriverVulkanFailsAndAutoTakesTheCpu) {
    const NoDrivers none;
    const TemporaryFolder folder;
    const Arguments render{"render", "zone-plate", "-o", "a.exr", "--size", "8x8", "--quiet"};
    for (const char* method : {"nsaa", "none", "ssaa:2", "msaa:4"}) {
        Arguments on_vulkan = render;
        on_vulkan.insert(on_vulkan.end(), {"--device", "vulkan", "--method", method});
        const ProgramRun asked = runProgram(on_vulkan, folder.path());
        EXPECT_EQ(asked.status, 1) << method;
        EXPECT_NE(asked.err.find("edgewise: error: device vulkan: "), std::string::npos) << asked.err;
        EXPECT_TRUE(folder.names().empty()) << method;
    }
    const ProgramRun automatic = runProgram(render, folder.path());
    EXPECT_EQ(automatic.status, 0) << automatic.err;
}

INSTANTIATE_TEST_SUITE_P(Program, WrongCommandLine,
                         testing::Values(WrongCase{{}, "subcommand"}, WrongCase{{"paint"}, "paint"},
                                         WrongCase{{"--paint"}, "--paint"},
                                         WrongCase{{"filters", "box"}, "box"}, WrongCase{{"render"}, "SCENE"},
                                         WrongCase{{"render", "torus-20k"}, "--output"},
                                         WrongCase{{"info"}, "SCENE"},
                                         WrongCase{{"info", "no-such-scene"}, "no-such-scene"}));

INSTANTIATE_TEST_SUITE_P(Output, WrongCommandLine,
                         testing::Values(WrongCase{{"render", "torus-20k", "-o", "a.jpg"}, "a.jpg"},
                                         WrongCase{{"render", "torus-20k", "-o", "a"}, ".exr"},
                                         WrongCase{{"render", "torus-20k", "-o", ""}, "output"},
                                         WrongCase{{"render", "torus-20k", "-o", "none/a.exr"}, "none"},
                                         WrongCase{{"render", "torus-20k", "-o"}, "--output"},
                                         WrongCase{renderWith({"--stats", "none/a.json"}), "none"},
                                         WrongCase{renderWith({"--stats", "./a.exr"}), "--stats"},
                                         WrongCase{renderWith({"--dump-stages", "empty.glb"}), "empty.glb"}));

INSTANTIATE_TEST_SUITE_P(
    Film, WrongCommandLine,
    testing::Values(WrongCase{renderWith({"--size", "0x5"}), "--size"},
                    WrongCase{renderWith({"--size", "5x0"}), "--size"},
                    WrongCase{renderWith({"--size", "-3x5"}), "--size"},
                    WrongCase{renderWith({"--size", "5"}), "--size"},
                    WrongCase{renderWith({"--size", "5x"}), "--size"},
                    WrongCase{renderWith({"--size", "5x5x5"}), "--size"},
                    WrongCase{renderWith({"--size", "nanxnan"}), "--size"},
                    WrongCase{renderWith({"--size", "5.5x5"}), "--size"},
                    WrongCase{renderWith({"--size", " 5x5"}), "--size"},
                    WrongCase{renderWith({"--size", "99999999999999999999x1"}), "--size"},
                    WrongCase{renderWith({"--size", "2000000x1"}), "--size"},
                    WrongCase{renderWith({"--size", "262144x262144"}), "memory", 1},
                    WrongCase{renderWith({"--size", "5x5", "--size", "6x6"}), "--size"},
                    WrongCase{renderWith({"--size", "8x8", "--crop", "0,0,9,8"}), "--crop"},
                    WrongCase{renderWith({"--crop", "0,0,0,8"}), "--crop"},
                    WrongCase{renderWith({"--crop", "-1,0,4,8"}), "--crop"},
                    WrongCase{renderWith({"--crop", "1,2,3"}), "--crop"},
                    WrongCase{renderWith({"--shift", "0.5"}), "--shift"},
                    WrongCase{renderWith({"--shift", "nan,0"}), "--shift"},
                    WrongCase{renderWith({"--shift", "1e400,0"}), "--shift"}));

INSTANTIATE_TEST_SUITE_P(Filter, WrongCommandLine,
                         testing::Values(WrongCase{renderWith({"--filter", "soft"}), "soft"},
                                         WrongCase{renderWith({"--filter", ""}), "filter"},
                                         WrongCase{renderWith({"--radius", "0"}), "radius"},
                                         WrongCase{renderWith({"--radius", "-1"}), "radius"},
                                         WrongCase{renderWith({"--radius", "nan"}), "--radius"},
                                         WrongCase{renderWith({"--radius", "inf"}), "--radius"},
                                         WrongCase{renderWith({"--radius", "2px"}), "--radius"},
                                         WrongCase{renderWith({"--sigma", "0"}), "sigma"},
                                         WrongCase{renderWith({"--filter", "box", "--sigma", "1"}),
                                                   "sigma"}));

INSTANTIATE_TEST_SUITE_P(
    Method, WrongCommandLine,
    testing::Values(WrongCase{{"render", "torus-20k", "-o", "a.exr", "--method", "magic"}, "magic"},
                    WrongCase{{"render", "torus-20k", "-o", "a.exr", "--method", "ssaa:0"}, "ssaa"},
                    WrongCase{{"render", "torus-20k", "-o", "a.exr", "--method", "ssaa:x"}, "ssaa"},
                    WrongCase{{"render", "torus-20k", "-o", "a.exr", "--method", "msaa:3"}, "2, 4, 8, 16"},
                    WrongCase{{"render", "torus-20k", "-o", "a.exr", "--method", ""}, "method"},
                    WrongCase{renderWith({"--device", "abacus"}), "--device"},
                    WrongCase{renderWith({"--precision", "fp16"}), "--precision"},
                    WrongCase{renderWith({"--shading", "samples:5000"}), "--shading"},
                    WrongCase{renderWith({"--shading", "loud"}), "--shading"},
                    WrongCase{renderWith({"--shading", "samples:0"}), "--shading"},
                    WrongCase{renderWith({"--no-skip", "everything"}), "--no-skip"},
                    WrongCase{renderWith({"--background", "1,1"}), "--background"},
                    WrongCase{renderWith({"--background", "1,nan,1"}), "--background"},
                    WrongCase{renderWith({"--background", "0,1e39,0"}), "--background"},
                    WrongCase{renderWith({"--exposure", "inf"}), "--exposure"},
                    WrongCase{renderWith({"--threads", "0"}), "--threads"},
                    WrongCase{renderWith({"--threads", "many"}), "--threads"},
                    WrongCase{renderWith({"--memory", "0"}), "--memory"},
                    WrongCase{{"render", "torus-20k", "-o", "a.exr", "--size", "16x16", "--radius", "3e4"},
                              "--memory",
                              1},
                    WrongCase{{"weights", "torus-20k", "--pixel", "1,1", "--radius", "1e6"}, "--memory", 1},
                    WrongCase{renderWith({"--seed", "-1"}), "--seed"},
                    WrongCase{renderWith({"--aov", "dept"}), "depth, normal, index, owners, cryptomatte"},
                    WrongCase{renderWith({"--aov", ""}), "--aov"},
                    WrongCase{renderWith({"--aov", "Depth"}), "--aov"},
                    WrongCase{renderWith({"--aov"}), "--aov"},
                    WrongCase{{"weights", "torus-20k", "--pixel", "1,1", "--aov", "depth"}, "--aov"},
                    WrongCase{{"render", "torus-20k", "-o", "a.png", "--aov", "depth"}, ".exr"}));

INSTANTIATE_TEST_SUITE_P(
    Input, WrongCommandLine,
    testing::Values(
        WrongCase{renderScene("nowhere.glb"), "nowhere.glb"},
        WrongCase{renderScene("empty.glb"), "empty.glb"}, WrongCase{renderScene("text.gltf"), "text.gltf"},
        WrongCase{renderScene("scene.txt"), "scene.txt"}, WrongCase{renderScene("."), "."},
        WrongCase{renderScene("two\nlines"), "lines"}, WrongCase{renderWith({"--camera", "99"}), "99"},
        WrongCase{renderWith({"--camera", "nobody"}), "nobody"}, WrongCase{renderWith({"--scene", "7"}), "7"},
        WrongCase{renderWith({"--time", "1"}), "has no animations"},
        WrongCase{renderWith({"--time", "soon"}), "--time"},
        WrongCase{renderWith({"--time", "inf"}), "--time"},
        WrongCase{renderWith({"--animation", "0"}), "--time"},
        WrongCase{renderWith({"--target", "0,0,1"}), "--target"},
        WrongCase{renderWith({"--eye", "0,0"}), "--eye"},
        WrongCase{renderWith({"--eye", "0,0,1", "--target", "0,0,1", "--fovy", "30"}), "target"},
        WrongCase{renderWith({"--eye", "0,0,1", "--target", "0,0,0", "--fovy", "0"}), "fovy"},
        WrongCase{renderWith({"--eye", "0,0,1", "--target", "0,0,0", "--fovy", "180"}), "fovy"},
        WrongCase{renderWith({"--eye", "0,0,1", "--target", "0,0,0", "--fovy", "nan"}), "fovy"}));

}  // namespace
}  // namespace edgewise::test
