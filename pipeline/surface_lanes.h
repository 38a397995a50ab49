// Several places of one surface shaded at once. What the code of one instruction set takes and gives: plain
// data, no library types, so that nothing compiled for a newer machine can be linked into code for an older
// one.
#pragma once

#include <cstddef>

namespace edgewise {

/// Places that one call takes at most.
inline constexpr int kSurfaceLanes = 8;

/// A light that is the same everywhere, eye space.
struct LaneLight {
    double towards[3];      ///< unit, from the surface to the light
    double illuminance[3];  ///< lux
    double h[3], fresnel;   ///< f64::Halfway, where the view is the same everywhere
};

/// What all surfaces of a frame share: a ScreenMap and the lights.
struct LaneFrame {
    bool perspective, uniform_view;
    double scale_px, offset_px[2], whole_px[2], fraction_px[2];
    const LaneLight* lights;
    int light_count;
};

/// One triangle, eye space. Its pieces on the screen: three corners (x, y), px, `piece_stride` doubles apart.
struct LaneSurface {
    double p_eye[3][3];
    double normal_eye[3][3];  ///< unit, by corner, where it is `smooth`
    double flat_normal[3];
    const double* pieces_px;
    std::size_t piece_count, piece_stride;
    bool smooth, mapped;  ///< has vertex normals; some map asks for the footprint
};

/// A lit material that is the same all over the surface.
struct LaneMaterial {
    double base[3], metallic, roughness;
    double start[3];  ///< what it sends without the lights
};

/// Samples, px. Places beyond those that count may hold anything finite.
struct LaneSamples {
    alignas(64) double x_px[kSurfaceLanes], y_px[kSurfaceLanes];
};

/// Per place: a f64::SurfacePoint.
struct LanePlaces {
    alignas(64) double barycentric[3][kSurfaceLanes];
    double d_dx[3][kSurfaceLanes], d_dy[3][kSurfaceLanes], p_eye[3][kSurfaceLanes];
};

struct LaneColors {
    alignas(64) double channel[3][kSurfaceLanes];
};

/// Both look at the first `count` samples, 1 <= count <= kSurfaceLanes, and give what Shading gives for its
/// closest point, bit for bit: where it is, and the colour there.
struct SurfaceFunctions {
    void (*locate)(const LaneFrame&, const LaneSurface&, const LaneSamples&, int count, LanePlaces&);
    void (*shade)(const LaneFrame&, const LaneSurface&, const LaneMaterial&, const LaneSamples&, int count,
                  LaneColors&);
};

/// The best form that this machine runs, or the one that EDGEWISE_ISA names.
SurfaceFunctions chooseSurfaceFunctions();
/// By name (scalar, sse2, avx2, avx512); null functions where this machine or build has none.
SurfaceFunctions surfaceFunctionsFor(const char* instruction_set);

}  // namespace edgewise
