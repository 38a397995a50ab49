// What each triangle lets through, as far as its whole area agrees: from factors, vertex colours and the
// range of its texture's alpha.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/scene.h"

namespace edgewise {

enum class Opacity : std::uint8_t {
    kOpaque,      ///< alpha is 1 all over: nothing behind shows
    kSeeThrough,  ///< alpha varies, or lies between 0 and 1
    kInvisible    ///< alpha is 0 all over: it is not there
};

/// By contract index. A mask (glTF's MASK) whose alpha lies on one side of the cutoff all over the triangle
/// is decided here, exactly; a texture's alpha is bounded by that of its texels, which no filter and no mip
/// level leaves. An empty vector: every triangle is opaque.
std::vector<Opacity> opacityOf(const Scene& scene);

}  // namespace edgewise
