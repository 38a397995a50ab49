// ctss-x: cones find the pixels that edges cross, lines divide those exactly.
#pragma once

#include "pipeline/field_tracer.h"

namespace edgewise {

/// A tracer whose samples are means over pixels, of what their surfaces' parts show. A pixel is complex where
/// its cone meets more than one surface or its neighbours' hits are not on its tangent plane. There rays
/// through corners say which surfaces share it; creases and outlines divide it in closed form where all rays
/// agree with them, sixteen more rays where not. Textures are averaged over the footprint; where neighbours
/// on one surface see different lights or reflections, the border between them is searched. Wants
/// settings.cones and a scene of sceneOfCones().
FieldTracerMaker coneXMaker(const FieldTracerMaker& make);

}  // namespace edgewise
