// Where in a picture edges of one kind are best seen.
#pragma once

#include <span>
#include <vector>

#include "pipeline/film.h"
#include "pipeline/judge/edge_kinds.h"

namespace edgewise::figures {

using judge::EdgeKind, judge::kEdgeKinds;

/// The part with most pixels of the kind, each pixel of another kind counting against one, that meets none of
/// `others`. `kinds`: of the whole film, row by row. A part without any where there is none.
PixelBox partOfKind(const std::vector<EdgeKind>& kinds, const Film& film, EdgeKind kind, glm::ivec2 size,
                    std::span<const PixelBox> others);

}  // namespace edgewise::figures
