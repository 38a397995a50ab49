// Cone-traced supersampling's switches, as Chubarau et al. 2023 name them.
#pragma once

namespace edgewise::sdf {

struct ConeSettings {
    bool relaxed = false;        ///< CTSS-R: ends at the first hard hit
    double coverage = 1.0;       ///< of the cone's radius: 1 through the pixel's corners
    double alpha = 0.5;          ///< the least step, of the cone's radius
    bool four_by_eight = false;  ///< the A-buffer's mask; else 6 x 6 without corners
    bool uniform = false;        ///< every sample weighs alike (Figure 5)
    bool backtrace = true;       ///< section 3.6
    int visible = 32;            ///< tracing may end once so many bits of the mask are set
    bool normalize_sky =
        false;               ///< as printed: divided by the samples' weights; else the sky is the last sample
    bool hard_only = false;  ///< only the groups that the ray itself meets have their surfaces described
    /// As printed: groups are shaded as they are met, seen or not; Vulkan's cones pause for it. Else those
    /// that are seen, when all are met. The picture is the same.
    bool shade_at_once = false;
};

}  // namespace edgewise::sdf
