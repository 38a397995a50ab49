// One projected scene in Embree: the owners at samples, by primary rays.
#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <mutex>

#include "pipeline/methods/coplanar_ties.h"
#include "pipeline/methods/point_samples.h"
#include "pipeline/methods/view_triangles.h"
#include "pipeline/pixel_patterns.h"

namespace edgewise {

struct ReleaseEmbree {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using EmbreeDevice = std::unique_ptr<RTCDeviceTy, ReleaseEmbree>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, ReleaseEmbree>;

/// What Embree decides is float32's: an edge may lie 2^-24 of the film's half side from its place, and where
/// different planes are as deep or nearly so any of their triangles may win, the same one each time. Of
/// triangles that share a plane the lowest index does (CoplanarTies). The order of see-through layers among
/// themselves and against what ends the view is the depth planes', in double, equal planes by index. Packets
/// are cut from pixels that lie where they lie whatever is asked for: threads, tiles and crops do not show.
class RayScene {
  public:
    /// Builds the trees; refers to the scene. Throws FailureError where Embree fails.
    RayScene(const ScreenScene& screen, const Film& film, bool perspective, int margin_px);

    /// Owners of all samples of a window's pixels, in rows of pixels, a pixel's side by side in the order of
    /// its pattern. Parallel by tiles. Throws FailureError naming the pixel where a sample has more than
    /// kMostLayers layers.
    SampledOwners trace(const PixelBox& window, const PixelPatterns& patterns) const;

    /// Rays of a packet: the widest that the processor has.
    int packetSize() const;

  private:
    template <int kWidth>
    friend class PacketTracer;
    template <int kWidth>
    void traceWindow(const PixelBox& window, const PixelPatterns& patterns, SampledOwners& out) const;

    const ScreenScene& screen_;
    ViewScene triangles_;
    CoplanarTies ties_;
    EmbreeDevice device_;
    EmbreeScene opaque_, see_through_;
    mutable std::mutex stacks_mutex_;
};

}  // namespace edgewise
