#include "paper_figures/aliased_part.h"

#include <cmath>

#include "analytic/filter_properties.h"
#include "paper_figures/fourier.h"

namespace edgewise::figures {
namespace {

double luminanceOf(const glm::dvec4& c) {
    return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

/// From 0 at the border to 1 at the margin's inner side; `at` and all in samples.
double fade(int at, int side, int margin) {
    const double inside = std::min(at, side - 1 - at) + 0.5;
    if (inside >= margin) return 1.0;
    const double s = std::sin(0.5 * M_PI * inside / margin);
    return s * s;
}

double meanOf(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double v : values) sum += v;
    return sum / static_cast<double>(values.size());
}

}  // namespace

FinePicture renderFinely(const PatternView& view, const Prefilter& filter, int per_px, Progress& progress,
                         const std::function<void()>& advance) {
    const MethodSpec nsaa = parseMethod("nsaa");
    RenderOptions options;
    options.device = DeviceChoice::kCpu;
    const int side = view.film.crop.width();
    FinePicture fine;
    fine.per_px = per_px;
    fine.luminance.resize(static_cast<std::size_t>(side) * per_px * side * per_px);
    for (int b = 0; b < per_px; ++b)
        for (int a = 0; a < per_px; ++a) {
            Film film = view.film;
            film.shift_px = {static_cast<double>(a) / per_px, static_cast<double>(b) / per_px};
            ImageBuffer image =
                runMethod(nsaa, {view.scene, view.camera, film, filter, options, progress}).image;
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x)
                    fine.luminance[static_cast<std::size_t>(y * per_px + b) * side * per_px + x * per_px +
                                   a] = luminanceOf(image.rgba[static_cast<std::size_t>(y) * side + x]);
            if (a == 0 && b == 0) fine.picture = std::move(image);
            advance();
        }
    return fine;
}

AliasedPart aliasedPart(const FinePicture& fine, int margin_px) {
    const int s = fine.per_px, side = fine.picture.box.width() * s, margin = margin_px * s;
    const double mean = meanOf(fine.luminance);
    std::vector<double> faded(fine.luminance.size());
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * side + x;
            faded[i] = (fine.luminance[i] - mean) * fade(x, side, margin) * fade(y, side, margin);
        }
    const std::vector<double> high = beyondFrequency(faded, side, kNyquist / s);
    const PixelBox outer = fine.picture.box;
    AliasedPart part;
    part.picture =
        ImageBuffer({outer.x0 + margin_px, outer.y0 + margin_px, outer.x1 - margin_px, outer.y1 - margin_px});
    part.aliased = ImageBuffer(part.picture.box);
    double sum = 0.0, squares = 0.0, aliased = 0.0, count = 0.0;
    for (int y = margin; y < side - margin; ++y)
        for (int x = margin; x < side - margin; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * side + x;
            sum += faded[i], squares += faded[i] * faded[i], aliased += high[i] * high[i], count += 1;
            if (x % s != 0 || y % s != 0) continue;
            const std::size_t to = part.picture.index(outer.x0 + x / s, outer.y0 + y / s);
            part.picture.rgba[to] = fine.picture.rgba[fine.picture.index(outer.x0 + x / s, outer.y0 + y / s)];
            part.aliased.rgba[to] = glm::dvec4(high[i], high[i], high[i], 1.0);
        }
    const double variance = squares / count - (sum / count) * (sum / count);
    part.rms = std::sqrt(aliased / count);
    part.share = variance > 0.0 ? aliased / count / variance : 0.0;
    return part;
}

}  // namespace edgewise::figures
