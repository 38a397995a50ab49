// A raw GLSL map as a field that is asked at many points at once.
#pragma once

#include <memory>

#include "sdf/field_scene.h"
#include "sdf/point_field.h"

namespace edgewise {

/// On a Vulkan device. Throws InputError for GLSL that does not compile, DeviceError where there is no
/// device; its answers throw FailureError for values that are no numbers and loops without end.
std::shared_ptr<const sdf::PointField> makeMapPoints(const sdf::FieldScene& scene);

}  // namespace edgewise
