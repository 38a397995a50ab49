// Samples of a few triangles shaded at once. What the code of one instruction set takes and gives: plain
// data, no library types, so that nothing compiled for a newer machine can be linked into code for an older
// one.
#pragma once

namespace edgewise {

/// Samples that one call takes at most.
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

/// A triangle that has one piece on the screen.
struct LaneTriangle {
    double corner_px[3][2], p_eye[3][3];
    double normal_eye[3][3];  ///< unit, by corner; flat shading: the normal is [0]
};

/// A lit material that is the same all over the surface.
struct LaneMaterial {
    double base[3], metallic, roughness;
    double start[3];  ///< what it sends without the lights
};

/// By lane a sample, px, and its triangle. Twice as long as it need be: spread() writes whole vectors.
struct SurfaceLanes {
    static constexpr int kLength = 2 * kSurfaceLanes;
    alignas(64) double sample_px[2][kLength];
    double corner_px[3][2][kLength], p_eye[3][3][kLength], normal_eye[3][3][kLength];
};

/// By lane a f64::SurfacePoint.
struct LanePlaces {
    alignas(64) double barycentric[3][kSurfaceLanes];
    double d_dx[3][kSurfaceLanes], d_dy[3][kSurfaceLanes], p_eye[3][kSurfaceLanes];
};

struct LaneColors {
    alignas(64) double channel[3][kSurfaceLanes];
};

struct SurfaceFunctions {
    explicit operator bool() const { return shade != nullptr; }

    /// The triangle from lane `first` on, in all lanes up to kSurfaceLanes.
    void (*spread)(const LaneTriangle&, int first, SurfaceLanes&);

    /// Where the first `count` samples are shaded, 1 <= count <= kSurfaceLanes: bit for bit as Shading's
    /// closest point.
    void (*locate)(const LaneFrame&, const SurfaceLanes&, int count, LanePlaces&);

    /// The colour there. Returns the lanes whose normal is 0, as bits: they have no colour.
    unsigned (*shade)(const LaneFrame&, const LaneMaterial&, bool smooth, const SurfaceLanes&, int count,
                      LaneColors&);
};

/// The best form that this machine runs, or the one that EDGEWISE_ISA names.
SurfaceFunctions chooseSurfaceFunctions();
/// By name (scalar, sse2, avx2, avx512); null functions where this machine or build has none.
SurfaceFunctions surfaceFunctionsFor(const char* instruction_set);

}  // namespace edgewise
