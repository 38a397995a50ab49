#include "pipeline/methods/device_choice.h"

#include <fmt/format.h>

#include "pipeline/device_error.h"
#ifdef EDGEWISE_HAS_VULKAN
#include "pipeline/vulkan/device_traits.h"
#endif

namespace edgewise {
namespace {

#ifdef EDGEWISE_HAS_VULKAN
DeviceDecision decideAmong(const std::vector<vulkan::DeviceTraits>& devices, bool real_gpus_only) {
    std::string why = "this machine has no Vulkan device";
    for (const vulkan::DeviceTraits& device : devices) {
        if (real_gpus_only && !device.real_gpu) {
            why = fmt::format("{} is no real GPU", device.name);
            continue;
        }
        if (const auto missing = vulkan::whatIsMissing(device))
            why = *missing;
        else
            return {true, fmt::format("{} has all that is needed", device.name)};
    }
    return {false, why};
}

/// Drivers take tenths of a second to list: once a process.
DeviceDecision askMachine(bool real_gpus_only) {
    static const std::vector<vulkan::DeviceTraits> devices = vulkan::listDevices();
    return decideAmong(devices, real_gpus_only);
}
constexpr bool kBuilt = true;
#else
DeviceDecision askMachine(bool) {
    return {false, "this build has no Vulkan"};
}
constexpr bool kBuilt = false;
#endif

}  // namespace

DeviceChoice deviceChoice(const std::string& name) {
    return name == "cpu"      ? DeviceChoice::kCpu
           : name == "vulkan" ? DeviceChoice::kVulkan
                              : DeviceChoice::kAuto;
}

DeviceDecision decideDevice(DeviceChoice choice, bool has_form) {
    if (choice == DeviceChoice::kCpu) return {false, "the CPU was asked for"};
    if (kBuilt && !has_form) return {false, "it has no Vulkan form here"};
    DeviceDecision decision = askMachine(choice == DeviceChoice::kAuto);
    if (choice == DeviceChoice::kVulkan && !decision.vulkan) throw DeviceError(decision.why);
    return decision;
}

}  // namespace edgewise
