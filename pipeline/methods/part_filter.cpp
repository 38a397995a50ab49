#include "pipeline/methods/part_filter.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "pipeline/methods/color_spread.h"
#include "sdf/film_line.h"

namespace edgewise {
namespace {

/// A box's pixels while they are summed.
struct PixelSums {
    explicit PixelSums(const PixelBox& pixels)
        : box(pixels),
          color(static_cast<std::size_t>(box.width()) * static_cast<std::size_t>(box.height())),
          spread(color.size()) {}
    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y - box.y0) * static_cast<std::size_t>(box.width()) +
               static_cast<std::size_t>(x - box.x0);
    }
    void add(int x, int y, double weight, const glm::dvec4& c) {
        color[at(x, y)] += weight * c;
        if (weight != 0.0) spread[at(x, y)].add(c);
    }
    PixelBox box;
    std::vector<glm::dvec4> color;
    std::vector<ColorSpread> spread;
};

/// Which samples have parts.
std::vector<char> divided(const FieldSamples& samples) {
    std::vector<char> out(samples.color.size());
    for (const FilmPart& part : samples.parts) out[part.sample] = 1;
    return out;
}

std::vector<std::vector<PixelShare>> sharesOf(const Prefilter& filter, std::span<const FilmPart> parts) {
    std::vector<std::vector<PixelShare>> out(parts.size());
    tbb::enumerable_thread_specific<PolygonWeights> weights([&] { return PolygonWeights(filter); });
    tbb::parallel_for(std::size_t(0), parts.size(),
                      [&](std::size_t i) { weights.local().add(parts[i].polygon_px, out[i]); });
    return out;
}

}  // namespace

PartFilter::PartFilter(const Prefilter& filter) : filter_(filter) {
    PolygonWeights(filter).add(sdf::squareWithin({0.5, 0.5}, {}), square_);
    for (const PixelShare& share : square_)
        margin_px_ = std::max({margin_px_, std::abs(share.x), std::abs(share.y)});
}

void PartFilter::apply(const FieldWindow& window, const FieldSamples& samples, const PixelBox& box,
                       ImageBuffer& image) const {
    const std::vector<char> in_parts = divided(samples);
    const auto sampleAt = [&](int x, int y) {
        return static_cast<std::size_t>(y - window.pixels.y0) * window.stride() +
               static_cast<std::size_t>(x - window.pixels.x0);
    };
    PixelSums sums(box);
    tbb::parallel_for(box.y0, box.y1, [&](int y) {
        for (int x = box.x0; x < box.x1; ++x)
            for (const PixelShare& share : square_) {
                const std::size_t from = sampleAt(x - share.x, y - share.y);
                if (!in_parts[from]) sums.add(x, y, share.weight, samples.color[from]);
            }
    });
    const std::vector<std::vector<PixelShare>> shares = sharesOf(filter_, samples.parts);
    for (std::size_t i = 0; i < shares.size(); ++i)
        for (const PixelShare& share : shares[i])
            if (box.contains(share.x, share.y))
                sums.add(share.x, share.y, samples.parts[i].share * share.weight, samples.parts[i].color);
    tbb::parallel_for(box.y0, box.y1, [&](int y) {
        for (int x = box.x0; x < box.x1; ++x) {
            const std::size_t pixel = image.index(x, y), sum = sums.at(x, y);
            image.rgba[pixel] = sums.color[sum];
            image.edge[pixel] = sums.spread[sum].edge();
        }
    });
}

}  // namespace edgewise
