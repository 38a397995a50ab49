// Sampling textures: wrap modes, nearest and linear, trilinear mip levels, in linear light.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "pipeline/scene.h"

namespace edgewise {

/// What texels hold. A normal's three coordinates lie at 2 texel - 1.
enum class TexelKind { kValue, kNormal };

/// Box-filtered levels of an image of any size: each level halves both sides, rounded down, and a texel of it
/// is the exact area mean of the texels above, weighted where an odd side does not divide. Held as float,
/// computed in double. The means of normals are brought back to length 1 (but a mean of 0 stays).
class MipPyramid {
  public:
    explicit MipPyramid(const Image& image, TexelKind kind = TexelKind::kValue);

    int levels() const { return static_cast<int>(levels_.size()) + 1; }
    const Image& level(int i) const { return i == 0 ? *base_ : levels_[i - 1]; }

    /// The colour if all texels are equal.
    const std::optional<glm::dvec4>& uniform() const { return uniform_; }

  private:
    const Image* base_;
    std::vector<Image> levels_;
    std::optional<glm::dvec4> uniform_;
};

/// How far a pixel reaches in texture space: the derivatives of (u, v), KHR_texture_transform applied, along
/// the screen's axes.
struct TextureFootprint {
    glm::dvec2 duv_dx{0.0}, duv_dy{0.0};
};

/// The texture at uv, (0, 0) being the image's upper left corner. The level is log2 of the longer of the
/// footprint's two sides in texels of level 0 (OpenGL's rule); at 0 and below the mag filter holds, above it
/// the min filter. uv need not be small, but must be finite.
glm::dvec4 sampleTexture(const Texture& texture, const MipPyramid& pyramid, glm::dvec2 uv,
                         const TextureFootprint& footprint);

}  // namespace edgewise
