// Cone-traced supersampling (Chubarau et al. 2023) as a tracer of samples, on any device's cones.
#pragma once

#include "pipeline/field_tracer.h"

namespace edgewise {

/// A tracer whose samples are weighed over what their cones meet: visibility masks by groupMask(), front to
/// back, colours shaded when all cones are traced. `make` makes the device's. Wants settings.cones.
FieldTracerMaker coneTracerMaker(const FieldTracerMaker& make);

/// The scene with closed forms as parts of the field, seen from the input's camera.
Scene sceneOfCones(const MethodInput& input);

}  // namespace edgewise
