// A picture before it was sampled, and what of it the pixels cannot hold.
#pragma once

#include <functional>
#include <vector>

#include "pipeline/methods/method.h"

namespace edgewise::figures {

/// A part of a scene's picture with the margin that its border needs.
struct PatternView {
    std::string name;
    Scene scene;
    ResolvedCamera camera;
    Film film;  ///< crop: a square of the part and its margin
    int margin_px = 0;
};

/// The filtered scene between the pixels: `per_px` samples a pixel along each axis.
struct FinePicture {
    ImageBuffer picture;  ///< the pixels' own samples
    int per_px = 1;
    std::vector<double> luminance;  ///< Rec.709, of all samples, in rows; every per_px-th is a pixel's
};

/// By nsaa with the film moved by fractions of a pixel: the same filter, radius and texture footprints, only
/// more samples. `advance` is called after each of its per_px^2 pictures. Throws Interrupted when cancelled.
FinePicture renderFinely(const PatternView& view, const Prefilter& filter, int per_px, Progress& progress,
                         const std::function<void()>& advance);

/// What has a frequency above kNyquist along an axis: in the pixels it is there under a false one.
struct AliasedPart {
    ImageBuffer picture, aliased;  ///< of the view without its margin; `aliased` is grey, signed
    double rms = 0.0;              ///< luminance
    double share = 0.0;            ///< of the picture's variance; 0 for a picture of one colour
};

/// The margin fades the picture out towards its mean, so that its border makes no frequencies of its own.
AliasedPart aliasedPart(const FinePicture& fine, int margin_px);

}  // namespace edgewise::figures
