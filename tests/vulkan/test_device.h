// One device for all tests of a program, with the validation layer on.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>

#include "pipeline/vulkan/device.h"

namespace edgewise::vulkan::test {

inline const Device& device() {
    static const Device one = [] {
        ::setenv("EDGEWISE_VALIDATION", "1", 1);
        return Device();
    }();
    return one;
}

/// Zero validation messages so far.
inline void expectNoMessages() {
    for (const std::string& message : device().validationMessages()) ADD_FAILURE() << message;
    EXPECT_TRUE(device().validated());
}

/// Every test that uses the device ends with this check.
class DeviceTest : public testing::Test {
  protected:
    void TearDown() override { expectNoMessages(); }
};

}  // namespace edgewise::vulkan::test
