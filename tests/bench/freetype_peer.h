// FreeType's grey rasterizer as a renderer of flat scenes: coverages of outlines, summed with their colours.
#pragma once

#include <ft2build.h>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "analytic/screen_triangle.h"
#include FT_FREETYPE_H

namespace edgewise::bench {

/// One outline: closed contours, and the colour inside.
struct FlatShape {
    std::vector<std::vector<glm::dvec2>> contours_px;
    glm::dvec3 color{0.0};
};

/// `run` triangles in turn are a shape: the boundary of what they cover, without the edges that two of them
/// share. They do not overlap and have one colour, that of `colors` by owner.
std::vector<FlatShape> flatShapes(const ScreenScene& screen, std::span<const glm::dvec3> colors,
                                  std::size_t run);

/// All shapes of a colour as one, colours that are the background's left out.
std::vector<FlatShape> onePerColor(std::span<const FlatShape> shapes);

/// Outlines in FreeType's own form (26.6 fixed point), made once.
class FreeTypePeer {
  public:
    FreeTypePeer(std::span<const FlatShape> shapes, int side_px);
    ~FreeTypePeer();

    /// Clears the picture, then renders each outline by FT_Outline_Render and adds coverage/255 times colour
    /// of each span: exact where shapes do not overlap, but for FreeType's 8 bits a coverage.
    void draw();
    const std::vector<glm::vec3>& picture() const { return picture_; }  ///< rows from the top

  private:
    struct Outlines;
    FT_Library library_ = nullptr;
    std::unique_ptr<Outlines> outlines_;
    int side_px_;
    std::vector<glm::vec3> picture_;
};

}  // namespace edgewise::bench
