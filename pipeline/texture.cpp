#include "pipeline/texture.h"

#include <algorithm>
#include <cmath>

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

/// One period of the wrapped coordinate: [0, 1) repeated, [0, 2) mirrored, clamped a texel or more outside
/// [0, 1].
double reduce(double u, Wrap wrap) {
    if (wrap == Wrap::kRepeat) return u - std::floor(u);
    if (wrap == Wrap::kMirroredRepeat) return u - 2.0 * std::floor(0.5 * u);
    return std::clamp(u, -1.0, 2.0);
}

/// The texel that index i, at most a few periods off, means.
int wrapIndex(int i, int size, Wrap wrap) {
    if (wrap == Wrap::kClampToEdge) return std::clamp(i, 0, size - 1);
    const int period = wrap == Wrap::kRepeat ? size : 2 * size;
    i = ((i % period) + period) % period;
    return i < size ? i : period - 1 - i;
}

struct LevelSampler {
    const Texture& texture;
    const Image& image;

    glm::dvec4 texel(int x, int y) const {
        x = wrapIndex(x, image.width, texture.wrap_s);
        y = wrapIndex(y, image.height, texture.wrap_t);
        return glm::dvec4(image.texels[std::size_t(y) * image.width + x]);
    }

    glm::dvec4 at(glm::dvec2 uv, TexelFilter filter) const {
        const double x = reduce(uv.x, texture.wrap_s) * image.width,
                     y = reduce(uv.y, texture.wrap_t) * image.height;
        if (filter == TexelFilter::kNearest)
            return texel(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
        const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
        const double fx = (x - 0.5) - left, fy = (y - 0.5) - top;
        const int i = static_cast<int>(left), j = static_cast<int>(top);
        const glm::dvec4 upper = texel(i, j) * (1.0 - fx) + texel(i + 1, j) * fx;
        const glm::dvec4 lower = texel(i, j + 1) * (1.0 - fx) + texel(i + 1, j + 1) * fx;
        return upper * (1.0 - fy) + lower * fy;
    }
};

/// In x87 arithmetic: the library's double log2 has variants by instruction set that differ in the last bit.
double levelOf(const Image& image, const TextureFootprint& footprint) {
    const glm::dvec2 size(image.width, image.height);
    const double longer =
        std::max(glm::length(footprint.duv_dx * size), glm::length(footprint.duv_dy * size));
    return longer > 1.0 ? static_cast<double>(std::log2(static_cast<long double>(longer))) : 0.0;
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
    auto at = [&](int level, TexelFilter filter) {
        return LevelSampler{texture, pyramid.level(level)}.at(uv, filter);
    };
    const double level = levelOf(pyramid.level(0), footprint);
    if (!(level > 0.0)) return at(0, texture.mag);
    if (!texture.mip) return at(0, texture.min);
    const double last = pyramid.levels() - 1, bounded = std::min(level, last);
    if (*texture.mip == TexelFilter::kNearest)
        return at(static_cast<int>(std::ceil(bounded - 0.5)), texture.min);
    const int finer = static_cast<int>(std::floor(bounded));
    const double t = bounded - finer;
    if (t == 0.0) return at(finer, texture.min);
    return at(finer, texture.min) * (1.0 - t) + at(finer + 1, texture.min) * t;
}

}  // namespace edgewise
