// A shipped SDF scene's picture of one size, whatever the setting of tracing.
#pragma once

#include <string>

#include "pipeline/field_rays.h"
#include "pipeline/field_tracer.h"

namespace edgewise::figures {

/// Primary rays alone, as Keinert et al. time them: no light, no mirrors, no glass.
struct TracedView {
    Scene scene;
    Film film;
    ResolvedCamera camera;
    Prefilter filter = makePrefilter("box", {}, {});
    RenderOptions options;
    sdf::RayGrid rays;

    TracedView(const std::string& name, int width, int height);
    std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * film.width + x; }
    /// Half a pixel's side at a depth.
    double pixelRadius(double depth) const;
};

struct Traced {
    FieldSamples samples;
    MethodResult report;
    double seconds = 0.0;  ///< of tracing
};
/// On the CPU. Throws Interrupted when cancelled.
Traced trace(const TracedView& view, const sdf::TraceSettings& settings, Progress& progress);

sdf::TraceSettings settingsOf(sdf::Relaxation relaxation, bool prepass, double omega = 1.2);

/// Keinert's own omega where he states one for a scene of that kind.
double keinertOmega(const std::string& scene);

/// Whether two rays of a pixel end on the same surface: both on none, or at depths no further apart than 64
/// radii of the pixel, for grazing surfaces lie within the threshold for many of them.
bool sameHit(const TracedView& view, double depth, double other_depth);

}  // namespace edgewise::figures
