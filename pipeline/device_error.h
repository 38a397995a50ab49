// What goes wrong on a Vulkan device.
#pragma once

#include "pipeline/error.h"

namespace edgewise {

/// It could not: no driver, too little memory, lost. `--device auto` goes on without it.
struct DeviceError : FailureError {
    explicit DeviceError(const std::string& why) : FailureError("device vulkan", why) {}
};

}  // namespace edgewise
