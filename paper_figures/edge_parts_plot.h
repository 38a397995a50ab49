// Parts of a picture where one kind of edge is best seen, enlarged, by several methods side by side.
#pragma once

#include <glm/vec2.hpp>

#include "paper_figures/edge_part.h"
#include "paper_figures/method_views.h"

namespace edgewise::figures {

struct EdgePart {
    EdgeKind kind;
    PixelBox box;
};

/// One of each kind that the picture has, none over another. Empty for a picture smaller than `size`.
std::vector<EdgePart> edgeParts(const MethodViews& views, glm::ivec2 size);

struct PartColumn {
    std::string method, title;
    bool error = false;  ///< against "reference", and the part's PSNR below it
};

inline constexpr double kErrorGain = 4.0;  ///< errors are drawn so many times as bright

/// The whole picture by one method with the parts framed, and below it a row a part: an <svg>.
std::string edgePartsSvg(const MethodViews& views, const std::vector<EdgePart>& parts,
                         const std::string& whole, const std::vector<PartColumn>& columns);

}  // namespace edgewise::figures
