// FXAA 3.11, quality presets.
//
// Source   T. Lottes, "FXAA", NVIDIA white paper 2009, and the parameters of version 3.11. A pixel whose luma
//          differs enough from its four neighbours lies on an edge; the edge is horizontal or vertical by its
//          second differences; its two ends are sought along the side where luma changes most; the pixel then
//          moves across that side, by how near the nearer end is, or, if that is more, by how much it stands
//          out from its eight neighbours.
// Luma     0.299 R + 0.587 G + 0.114 B of the 8-bit sRGB picture, and the colours that are mixed are
//          sRGB-encoded too: this filter sits behind the display's transfer curve.
//          In float32: the shader reads luma from a channel of the picture, and one of 8 bits gives other
//          results wherever a search ends at exactly a quarter of the contrast, as beside every step of two
//          colours.
#include <array>
#include <cmath>
#include <string>

#include "pipeline/decode_image.h"
#include "pipeline/error.h"
#include "pipeline/methods/display_picture.h"
#include "pipeline/methods/post_process.h"
#include "pipeline/methods/registry.h"
#include "pipeline/srgb.h"

namespace edgewise {
namespace {

constexpr glm::vec3 kLumaWeights{0.299f, 0.587f, 0.114f};
constexpr float kSubpixelAmount = 0.75f;       // how much of a pixel's standing out is removed
constexpr float kEdgeThreshold = 0.166f;       // of the brightest of the five lumas
constexpr float kSmallestThreshold = 0.0833f;  // in the dark

/// Pixels that the search for an edge's ends advances by, step by step.
using Steps = std::vector<float>;

Steps stepsOf(const std::string& preset) {
    static const std::map<std::string, Steps> presets{
        {"10", {1.5f, 3, 12}},
        {"11", {1, 1.5f, 3, 12}},
        {"12", {1, 1.5f, 2, 4, 12}},
        {"13", {1, 1.5f, 2, 2, 4, 12}},
        {"14", {1, 1.5f, 2, 2, 2, 4, 12}},
        {"15", {1, 1.5f, 2, 2, 2, 2, 4, 12}},
        {"20", {1.5f, 2, 8}},
        {"21", {1, 1.5f, 2, 8}},
        {"22", {1, 1.5f, 2, 2, 8}},
        {"23", {1, 1.5f, 2, 2, 2, 8}},
        {"24", {1, 1.5f, 2, 2, 2, 3, 8}},
        {"25", {1, 1.5f, 2, 2, 2, 2, 4, 8}},
        {"26", {1, 1.5f, 2, 2, 2, 2, 2, 4, 8}},
        {"27", {1, 1.5f, 2, 2, 2, 2, 2, 2, 4, 8}},
        {"28", {1, 1.5f, 2, 2, 2, 2, 2, 2, 2, 4, 8}},
        {"29", {1, 1.5f, 2, 2, 2, 2, 2, 2, 2, 2, 4, 8}},
        {"39", {1, 1, 1, 1, 1, 1.5f, 2, 2, 2, 2, 4, 8}},
    };
    return presets.at(preset);
}

/// Lumas of a pixel and its eight neighbours, by compass point; north is up.
struct Neighbourhood {
    float m, n, e, s, w, nw, ne, sw, se;

    Neighbourhood(const Texels<float>& luma, int x, int y)
        : m(luma.at(x, y)),
          n(luma.at(x, y - 1)),
          e(luma.at(x + 1, y)),
          s(luma.at(x, y + 1)),
          w(luma.at(x - 1, y)),
          nw(luma.at(x - 1, y - 1)),
          ne(luma.at(x + 1, y - 1)),
          sw(luma.at(x - 1, y + 1)),
          se(luma.at(x + 1, y + 1)) {}

    /// Largest minus smallest of the pixel and its four neighbours; 0 where that is too little for an edge.
    float contrast() const {
        const float largest = std::max({m, n, e, s, w}), smallest = std::min({m, n, e, s, w});
        const float range = largest - smallest;
        return range < std::max(kSmallestThreshold, largest * kEdgeThreshold) ? 0.0f : range;
    }

    /// Whether the second differences from top to bottom are the larger ones.
    bool isHorizontal() const {
        const float rows =
            std::abs(-2 * w + (nw + sw)) + (std::abs(-2 * m + (n + s)) * 2 + std::abs(-2 * e + (ne + se)));
        const float columns =
            std::abs(-2 * s + (sw + se)) + (std::abs(-2 * m + (w + e)) * 2 + std::abs(-2 * n + (nw + ne)));
        return rows >= columns;
    }

    /// How far the pixel stands out from the mean of its neighbours, smoothed, of the contrast.
    float standsOut(float contrast) const {
        const float sum = ((n + s) + (w + e)) * 2 + ((nw + sw) + (ne + se));
        const float part = std::min(std::abs(sum * (1.0f / 12.0f) - m) * (1.0f / contrast), 1.0f);
        const float smooth = (-2 * part + 3) * (part * part);
        return smooth * smooth;
    }
};

/// The side of a pixel that an edge runs along.
struct Side {
    bool horizontal;
    int across;      ///< -1: the north or west side, +1: the south or east side
    float gradient;  ///< luma changes by that much over it
    float mean;      ///< luma on it

    explicit Side(const Neighbourhood& near) : horizontal(near.isHorizontal()) {
        const float before = horizontal ? near.n : near.w, after = horizontal ? near.s : near.e;
        const float to_before = std::abs(before - near.m), to_after = std::abs(after - near.m);
        across = to_before >= to_after ? -1 : 1;
        gradient = std::max(to_before, to_after);
        mean = ((across < 0 ? before : after) + near.m) * 0.5f;
    }
};

/// One of the two ways along a side: how far its end is, and how luma differs there from the side's mean.
struct End {
    float distance_px = 0.0f, difference = 0.0f;

    /// The last step is taken on trust: nothing is read there.
    End(const Texels<float>& luma, int x, int y, const Side& side, float direction, const Steps& steps) {
        distance_px = steps.front();
        for (std::size_t next = 1; next < steps.size(); ++next) {
            const float along = direction * distance_px, across = 0.5f * static_cast<float>(side.across);
            difference = luma.bilinear(static_cast<float>(x) + (side.horizontal ? along : across),
                                       static_cast<float>(y) + (side.horizontal ? across : along)) -
                         side.mean;
            if (std::abs(difference) >= side.gradient * 0.25f) return;
            distance_px += steps[next];
        }
    }
};

/// By how much of a pixel it moves across its side, 0 to 3/4.
float moveAcross(const Texels<float>& luma, int x, int y, const Neighbourhood& near, const Side& side,
                 float contrast, const Steps& steps) {
    const End before(luma, x, y, side, -1.0f, steps), after(luma, x, y, side, 1.0f, steps);
    const End& nearer = before.distance_px < after.distance_px ? before : after;
    const bool ends_on_other_side = (nearer.difference < 0.0f) != (near.m - side.mean < 0.0f);
    const float along = 0.5f - nearer.distance_px / (before.distance_px + after.distance_px);
    return std::max(ends_on_other_side ? along : 0.0f, near.standsOut(contrast) * kSubpixelAmount);
}

glm::dvec4 mixed(const EncodedPicture& encoded, const ImageBuffer& image, glm::ivec2 from, glm::ivec2 to,
                 double amount) {
    const auto alpha = [&](glm::ivec2 p) {
        const int x = std::clamp(p.x, 0, encoded.width() - 1), y = std::clamp(p.y, 0, encoded.height() - 1);
        return image.rgba[image.index(image.box.x0 + x, image.box.y0 + y)].a;
    };
    const glm::dvec3 color =
        glm::mix(glm::dvec3(encoded.at(from.x, from.y)), glm::dvec3(encoded.at(to.x, to.y)), amount);
    return {decodeSrgb(color.r), decodeSrgb(color.g), decodeSrgb(color.b),
            glm::mix(alpha(from), alpha(to), amount)};
}

void fxaaRow(const ImageBuffer& image, const EncodedPicture& encoded, const Texels<float>& luma,
             const Steps& steps, int y, ZeroedVector<glm::dvec4>& out) {
    for (int x = 0; x < luma.width(); ++x) {
        const Neighbourhood near(luma, x, y);
        const float contrast = near.contrast();
        if (contrast == 0.0f) continue;
        const Side side(near);
        const float amount = moveAcross(luma, x, y, near, side, contrast, steps);
        const glm::ivec2 other =
            side.horizontal ? glm::ivec2(x, y + side.across) : glm::ivec2(x + side.across, y);
        out[static_cast<std::size_t>(y) * luma.width() + x] = mixed(encoded, image, {x, y}, other, amount);
    }
}

void applyFxaa(const Steps& steps, ImageBuffer& image, Progress& progress, std::vector<StageTime>& stages) {
    Stopwatch watch;
    const EncodedPicture encoded = encodePicture(image);
    const Texels<float> luma = lumaOf(encoded, kLumaWeights);
    auto out = image.rgba;
    forRows("fxaa", luma.height(), progress, [&](int y) { fxaaRow(image, encoded, luma, steps, y, out); });
    image.rgba = std::move(out);
    watch.book("fxaa", stages);
}

/// The last sample along a side lies within all steps but the last; one more pixel is interpolated.
int reachOf(const Steps& steps) {
    float reach = 2.0f;
    for (const float step : steps) reach += step;
    return static_cast<int>(std::ceil(reach));
}

}  // namespace

PostProcess makeFxaa(const MethodSpec& spec) {
    const Steps steps = stepsOf(spec.parameter("preset"));
    return {.reach_px = reachOf(steps),
            .apply = [steps](ImageBuffer& image, Progress& progress, auto& stages) {
                applyFxaa(steps, image, progress, stages);
            }};
}

MethodResult runFxaa(const MethodSpec& spec, const MethodInput& input) {
    return runOnNone(makeFxaa(spec), spec, input);
}

}  // namespace edgewise
