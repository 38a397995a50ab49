// How rays are traced through a field: each entry is a switch, so that each can be judged alone.
#pragma once

namespace edgewise::sdf {

enum class Relaxation : unsigned char {
    kNone,     ///< Hart 1996: steps of f / L
    kKeinert,  ///< Keinert et al. 2014, Listing 2: steps of omega f / L until they fail once
    kBalint,   ///< Balint and Valasek 2018: steps that a plane would allow, taken back where they fail
    kAuto      ///< Ban and Valasek 2023: omega from the smoothed slope of f along the ray
};

struct TraceSettings {
    Relaxation relaxation = Relaxation::kAuto;
    double omega = 1.2;  ///< Keinert's, 1 to 2
    bool screen_candidate =
        true;  ///< out of steps: the point nearest to a surface in pixels, not the last one
    int discontinuity_steps = 0;  ///< of equation 3 after the hit
    bool prepass = true;          ///< cones through tiles find how far all their rays may start
    bool prune = true;            ///< tapes and lists a tile
    bool convex = true;           ///< section 3.5, where the scene is convex
    bool dynamic_epsilon = true;  ///< section 3.3; else `epsilon` alone
    double epsilon = 1e-6;        ///< least offset of secondary rays, times the distance from the eye
    int most_steps = 1024;        ///< a ray
    /// A ray has hit where f / L is below this part of the pixel's radius there (half its side): 1 is the
    /// paper's. Less keeps silhouettes within that part of half a pixel of the true ones.
    double threshold = 0.125;
    /// Traces f + threshold radius instead, so that the hit is on f = 0 and nothing is inflated (Hart 1996).
    bool level_set = false;
};

}  // namespace edgewise::sdf
