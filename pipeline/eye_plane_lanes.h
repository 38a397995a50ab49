// What the code of one instruction set takes and gives for planes in eye space: plain data, no library types,
// so that nothing compiled for a newer machine can be linked into code for an older one.
#pragma once

namespace edgewise {

/// As many planes as the widest instruction set takes at once.
inline constexpr int kPlaneLanes = 8;

/// Double-double, rows first.
struct LaneMatrix {
    double hi[3][3], lo[3][3];
};

/// From a geometry's file into the world. cof(M) (a x b) = (M a) x (M b), also where M is singular or
/// mirrors.
struct WorldMap {
    LaneMatrix cofactors;
    double linear[3][3], translation[3];  ///< rows first
};

/// n' = cof(C) n, and for a point q of the plane d' = n' . (C q + c) = det(C) d + n' . c.
struct EyeMap {
    LaneMatrix cofactors;
    double determinant_hi, determinant_lo, translation[3];
    bool perspective;
    double scale_px, from_principal[2];  ///< of the screen; the anchor's place, px
};

/// Planes of one geometry: the normal, and a point. By axis and lane.
struct PlanesIn {
    alignas(64) double normal_hi[3][kPlaneLanes];
    alignas(64) double normal_lo[3][kPlaneLanes];
    alignas(64) double point[3][kPlaneLanes];
};

/// n . p = d in eye space, rounded, and the plane's depth on the screen, relative to the anchor: 1/w = n.(u,
/// v, -1)/d for perspective, with no vertex projected, so that triangles partly behind the eye are no special
/// case; z_eye for orthographic.
struct PlanesOut {
    alignas(64) double normal[3][kPlaneLanes];
    alignas(64) double d[kPlaneLanes];
    alignas(64) double dz_dx[kPlaneLanes], dz_dy[kPlaneLanes], z_anchor[kPlaneLanes];
};

/// `world` null: the planes are given in the world.
using EyePlanesFunction = void (*)(const WorldMap* world, const EyeMap& eye, const PlanesIn& in,
                                   PlanesOut& out);

}  // namespace edgewise
