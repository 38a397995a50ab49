#include "pipeline/texture.h"

#include <algorithm>
#include <cmath>

#include "pipeline/shading_text.h"

// The shared text on pyramids in memory.
namespace edgewise::f64 {
namespace {

struct TextureLook {
    int wrap_s, wrap_t, mag, min, mip, levels;
    const MipPyramid* pyramid;
};
struct TextureLevel {
    int width, height;
    const glm::vec4* texels;
};

EDGEWISE_FN TextureLevel levelAt(const TextureLook& look, int i) {
    const Image& image = look.pyramid->level(i);
    return {image.width, image.height, image.texels.data()};
}

EDGEWISE_FN dvec4 texelOf(const TextureLevel& level, int x, int y) {
    return dvec4(level.texels[static_cast<std::size_t>(y) * level.width + x]);
}

#include "shaders/shared/texture.glsl"

static_assert(static_cast<int>(Wrap::kRepeat) == kWrapRepeat &&
              static_cast<int>(Wrap::kMirroredRepeat) == kWrapMirrored &&
              static_cast<int>(Wrap::kClampToEdge) == kWrapClamp &&
              static_cast<int>(TexelFilter::kNearest) == kTexelNearest &&
              static_cast<int>(TexelFilter::kLinear) == kTexelLinear);

TextureLook lookOf(const Texture& texture, const MipPyramid& pyramid) {
    return {static_cast<int>(texture.wrap_s),
            static_cast<int>(texture.wrap_t),
            static_cast<int>(texture.mag),
            static_cast<int>(texture.min),
            texture.mip ? static_cast<int>(*texture.mip) : kNoMips,
            pyramid.levels(),
            &pyramid};
}

}  // namespace
}  // namespace edgewise::f64

namespace edgewise {
namespace {

/// The texels of a finer row that a coarser texel covers, as [begin, end) with the fractions of the first and
/// last.
struct Cover {
    int begin, end;
    double first, last;
};

/// Coarse texel i of `coarse` covers [i fine/coarse, (i + 1) fine/coarse); in units of 1/coarse all is
/// integer.
Cover coverOf(int i, int fine, int coarse) {
    const long long from = 1LL * i * fine, to = 1LL * (i + 1) * fine;
    const int begin = static_cast<int>(from / coarse), end = static_cast<int>((to + coarse - 1) / coarse);
    return {begin, end, 1.0 - double(from - 1LL * begin * coarse) / coarse,
            1.0 - double(1LL * end * coarse - to) / coarse};
}

double share(const Cover& cover, int i) {
    return i == cover.begin ? cover.first : (i == cover.end - 1 ? cover.last : 1.0);
}

glm::vec4 boxMean(const Image& fine, const Cover& x, const Cover& y) {
    glm::dvec4 sum(0.0);
    double weight = 0.0;
    for (int row = y.begin; row < y.end; ++row)
        for (int column = x.begin; column < x.end; ++column) {
            const double part = share(x, column) * share(y, row);
            sum += part * glm::dvec4(fine.texels[std::size_t(row) * fine.width + column]);
            weight += part;
        }
    return glm::vec4(sum / weight);
}

Image halve(const Image& fine) {
    Image coarse;
    coarse.width = std::max(1, fine.width / 2);
    coarse.height = std::max(1, fine.height / 2);
    coarse.texels.reserve(std::size_t(coarse.width) * coarse.height);
    for (int y = 0; y < coarse.height; ++y)
        for (int x = 0; x < coarse.width; ++x)
            coarse.texels.push_back(
                boxMean(fine, coverOf(x, fine.width, coarse.width), coverOf(y, fine.height, coarse.height)));
    return coarse;
}

void normalise(glm::vec4& texel) {
    const glm::dvec3 normal = 2.0 * glm::dvec3(texel) - 1.0;
    const double length = std::sqrt(glm::dot(normal, normal));
    if (length > 0.0) texel = glm::vec4(glm::vec3(0.5 * (normal / length) + 0.5), texel.a);
}

}  // namespace

MipPyramid::MipPyramid(const Image& image, TexelKind kind) : base_(&image) {
    const auto& texels = image.texels;
    const auto differs = [&](const glm::vec4& t) { return t != texels.front(); };
    if (std::none_of(texels.begin(), texels.end(), differs)) {
        uniform_ = glm::dvec4(texels.front());
        return;
    }
    while (level(levels() - 1).width > 1 || level(levels() - 1).height > 1) {
        levels_.push_back(halve(level(levels() - 1)));
        if (kind == TexelKind::kNormal)
            for (glm::vec4& texel : levels_.back().texels) normalise(texel);
    }
}

glm::dvec4 sampleTexture(const Texture& texture, const MipPyramid& pyramid, glm::dvec2 uv,
                         const TextureFootprint& footprint) {
    if (pyramid.uniform()) return *pyramid.uniform();
    return f64::sampleLevels(f64::lookOf(texture, pyramid), uv, footprint.duv_dx, footprint.duv_dy);
}

}  // namespace edgewise
