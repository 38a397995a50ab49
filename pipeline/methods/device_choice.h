// Where a method runs: what the user asked for against what this build and this machine have.
#pragma once

#include <string>

namespace edgewise {

enum class DeviceChoice { kAuto, kCpu, kVulkan };

struct DeviceDecision {
    bool vulkan = false;
    std::string why;  ///< one sentence
};

/// `has_form`: the method has a Vulkan form. kAuto takes Vulkan only when a real GPU has all that is needed;
/// kVulkan any device that has it, and throws FailureError where there is none. A method without a Vulkan
/// form runs on the CPU.
DeviceDecision decideDevice(DeviceChoice choice, bool has_form);

/// "auto", "cpu" or "vulkan".
DeviceChoice deviceChoice(const std::string& name);

}  // namespace edgewise
