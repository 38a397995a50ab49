// A cone through a field on the plane z = 0, step by step.
#pragma once

#include <vector>

#include "paper_figures/field_slice.h"
#include "sdf/cone_trace.h"

namespace edgewise::figures {

struct ConeMarchStep {
    double t = 0.0, value = 0.0;  ///< value: f / L there
    double radius = 0.0;          ///< of the cone
    bool open = false;            ///< a group is, after it
};

struct ConeMarchGroup {
    sdf::ConeGroup group;
    double exit = 0.0;  ///< the last point asked within it
};

struct ConeMarch {
    std::vector<ConeMarchStep> steps;
    std::vector<ConeMarchGroup> groups;  ///< front to back
    bool full = false;                   ///< it ended within the solid
    double slope = 0.0;                  ///< of the cone's radius
};

/// By the text that traces pictures (sdf_cone_step), with Algorithm 1's steps.
ConeMarch marchCone(const sdf::Tape& field, const SliceRay& ray, const sdf::ConeSettings& settings);

}  // namespace edgewise::figures
