// A device that fails in the middle: the CPU goes on where nobody asked for the device by name.
#include <gtest/gtest.h>

#include "pipeline/device_error.h"
#include "pipeline/methods/registry.h"
#include "tests/pipeline/shipped_picture.h"

namespace edgewise {
namespace {

[[noreturn]] MethodResult outOfMemory(const MethodSpec&, const MethodInput&) {
    throw DeviceError("sums of 97 MiB: ErrorOutOfDeviceMemory");
}
[[noreturn]] MethodResult lost(const MethodSpec&, const MethodInput&) {
    throw DeviceError("the device was lost");
}
[[noreturn]] MethodResult wrongFile(const MethodSpec&, const MethodInput&) {
    throw InputError("scene.glb", "no triangles");
}
MethodResult onCpu(const MethodSpec&, const MethodInput&) {
    MethodResult result;
    result.device = "cpu";
    return result;
}

class DeviceFallback : public testing::Test {
  protected:
    MethodResult run(MethodResult (*on_device)(const MethodSpec&, const MethodInput&), bool asked) const {
        const MethodEntry entry{
            .name = "fails", .summary = "", .choices = {}, .run = onCpu, .run_vulkan = on_device};
        Progress progress;
        const Prefilter filter = makePrefilter("box", {}, {});
        const RenderOptions options;
        return runOnDevice(entry, {},
                           {picture.scene, picture.camera, picture.film, filter, options, progress}, asked);
    }
    const test::ShippedPicture picture = test::shippedPicture("piercing", 4);
};

TEST_F(DeviceFallback, GoesOnWithTheCpuAndSaysWhy) {
    using DeviceForm = MethodResult (*)(const MethodSpec&, const MethodInput&);
    const std::pair<DeviceForm, const char*> failures[] = {{outOfMemory, "ErrorOutOfDeviceMemory"},
                                                           {lost, "was lost"}};
    for (const auto& [fails, why] : failures) {
        const MethodResult result = run(fails, false);
        EXPECT_EQ(result.device, "cpu");
        ASSERT_EQ(result.notes.size(), 1u);
        EXPECT_NE(result.notes[0].find(why), std::string::npos) << result.notes[0];
    }
}

TEST_F(DeviceFallback, FailsWhereTheDeviceWasAskedFor) {
    EXPECT_THROW(run(outOfMemory, true), DeviceError);
    EXPECT_THROW(run(lost, true), DeviceError);
}

TEST_F(DeviceFallback, ErrorsOfTheInputAreNotTheDevices) {
    EXPECT_THROW(run(wrongFile, false), InputError);
}

}  // namespace
}  // namespace edgewise
