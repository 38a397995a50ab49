// A picture too large for --memory is made strip by strip: a crop has the bits of the whole.
#pragma once

#include <vector>

#include "pipeline/methods/method.h"

namespace edgewise::cli {

/// Bytes that a pixel of the finished picture takes: RGBA and edge, and the AOVs.
std::size_t bytesPerPixel(const std::set<Aov>& aovs);

/// The crop in strips, each with an image of at most half of --memory; whole where stages are dumped, since
/// each strip would replace the last one's files.
std::vector<PixelBox> stripsOf(const PixelBox& crop, const RenderOptions& options);

/// Adds what a further strip took. Its image is left out, and so are counts of what is there once.
void addStrip(const MethodResult& strip, MethodResult& all);

}  // namespace edgewise::cli
