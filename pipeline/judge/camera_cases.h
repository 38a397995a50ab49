// Stiff scenes of the camera's path: the near plane, the eye, the guard band, far worlds.
#pragma once

#include <vector>

#include "pipeline/judge/stability_cases.h"

namespace edgewise::judge {

std::vector<StabilityCase> cameraCases();

}  // namespace edgewise::judge
