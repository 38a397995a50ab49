#include "pipeline/opacity.h"

#include <algorithm>
#include <optional>

namespace edgewise {
namespace {

struct Range {
    double low = 1.0, high = 1.0;
    Range operator*(const Range& other) const { return {low * other.low, high * other.high}; }
};

Range alphaOf(const Image& image) {
    const auto [low, high] = std::ranges::minmax_element(image.texels, {}, &glm::vec4::a);
    return {low->a, high->a};
}

Opacity decide(const Material& material, const Range& alpha) {
    // A texture's filter sums rounded products of its weights: up to 16 texels of two levels, each product
    // within 8 u; what is nearer to the cutoff than that stays undecided.
    constexpr double kRounding = 0x1p-46;
    if (material.alpha_mode == AlphaMode::kMask) {
        if (alpha.low >= material.alpha_cutoff + (alpha.low < alpha.high ? kRounding : 0.0))
            return Opacity::kOpaque;
        if (alpha.high < material.alpha_cutoff - (alpha.low < alpha.high ? kRounding : 0.0))
            return Opacity::kInvisible;
        return Opacity::kSeeThrough;
    }
    if (alpha.low >= 1.0) return Opacity::kOpaque;
    return alpha.high <= 0.0 ? Opacity::kInvisible : Opacity::kSeeThrough;
}

class OpacityReader {
  public:
    explicit OpacityReader(const Scene& scene) : scene_(scene), images_(scene.images.size()) {}

    void read(const Geometry& geometry, Opacity* out) {
        const Material& material = scene_.materials[geometry.material];
        if (material.alpha_mode == AlphaMode::kOpaque)
            return void(std::fill_n(out, geometry.triangles.size(), Opacity::kOpaque));
        const double factor = material.base_color.a;
        Range alpha{factor, factor};
        if (material.base_color_map.present() &&
            !geometry.uv[static_cast<std::size_t>(material.base_color_map.uv)].empty())
            alpha = alpha * texture(material.base_color_map.texture);
        for (const auto& triangle : geometry.triangles)
            *out++ = decide(material, geometry.color.empty() ? alpha : alpha * corners(geometry, triangle));
    }

  private:
    static Range corners(const Geometry& geometry, const std::array<std::uint32_t, 3>& triangle) {
        const auto [low, high] = std::minmax(
            {geometry.color[triangle[0]].a, geometry.color[triangle[1]].a, geometry.color[triangle[2]].a});
        return {low, high};
    }

    Range texture(std::uint32_t index) {
        const std::uint32_t image = scene_.textures[index].image;
        if (image == kNone) return {};
        if (!images_[image]) images_[image] = alphaOf(scene_.images[image]);
        return *images_[image];
    }

    const Scene& scene_;
    std::vector<std::optional<Range>> images_;
};

}  // namespace

std::vector<Opacity> opacityOf(const Scene& scene) {
    const auto opaque = [](const Material& m) { return m.alpha_mode == AlphaMode::kOpaque; };
    if (std::ranges::all_of(scene.materials, opaque)) return {};
    std::vector<Opacity> opacity(scene.triangle_count);
    OpacityReader reader(scene);
    for (const Geometry& geometry : scene.geometry)
        reader.read(geometry, opacity.data() + geometry.first_triangle);
    return opacity;
}

}  // namespace edgewise
