// Filters of a finished picture: fxaa and smaa, on the picture of `none` or on one from elsewhere.
#pragma once

#include <functional>
#include <vector>

#include "pipeline/image_buffer.h"
#include "pipeline/methods/method.h"

namespace edgewise {

/// Replaces the colour and alpha of an image, which ends where the picture does or `reach_px` beyond what is
/// wanted of it. Other channels stay. Throws Interrupted when cancelled.
struct PostProcess {
    int reach_px = 0;  ///< no pixel's result depends on pixels further away, in x or in y
    std::function<void(ImageBuffer&, Progress&, std::vector<StageTime>&)> apply;
    double setup_seconds = 0.0;  ///< what making it took: tables
};

PostProcess makeFxaa(const MethodSpec& spec);  ///< preset=
PostProcess makeSmaa(const MethodSpec& spec);  ///< preset=, edges=, blend=

/// Throws InputError for a method that filters no picture.
PostProcess makePostProcess(const MethodSpec& spec);

/// `none` and the filter. A crop has the bits of the whole: `none` makes what the filter reaches beyond it.
MethodResult runOnNone(const PostProcess& process, const MethodSpec& spec, const MethodInput& input);
/// The same with whatever makes the picture.
MethodResult runOnPicture(const PostProcess& process, const MethodInput& input,
                          const std::function<MethodResult(const MethodInput&)>& make);

}  // namespace edgewise
