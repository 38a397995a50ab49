#include "pipeline/methods/field_frame.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "pipeline/methods/color_spread.h"
#include "pipeline/methods/field_aov.h"
#include "pipeline/methods/field_pictures.h"
#include "pipeline/methods/part_filter.h"
#include "pipeline/methods/sample_weights.h"
#include "pipeline/methods/stopwatch.h"

namespace edgewise {
namespace {

/// A sample's results, its hit while it is traced, and the ray.
constexpr double kBytesPerSample = sizeof(glm::dvec4) + sizeof(double) + sizeof(glm::vec3) +
                                   4 * sizeof(std::uint32_t) + sizeof(sdf::FieldRay);

PixelBox grown(const PixelBox& box, int margin) {
    return {box.x0 - margin, box.y0 - margin, box.x1 + margin, box.y1 + margin};
}
PixelBox within(const PixelBox& box, const Film& film) {
    return {std::max(box.x0, 0), std::max(box.y0, 0), std::min(box.x1, film.width),
            std::min(box.y1, film.height)};
}

/// A picture in bands of rows.
class FieldFrame {
  public:
    FieldFrame(const MethodInput& in, const FieldSettings& settings, const FieldTracerMaker& make,
               int per_side = 1)
        : in_(in),
          settings_(settings),
          make_(make),
          tracer_(make(in, ofSamples(settings, per_side))),
          aov_(in),
          pictures_(in.options.dump_dir, in.film.crop) {
        result_.image = ImageBuffer(in.film.crop);
        aov_.begin(result_.image);
    }

    MethodResult pixels() {
        forBands(1, 1, [&](const PixelBox& part) {
            FieldWindow window;
            window.pixels = within(grown(part, 1), in_.film);
            const FieldSamples samples = tracer_->trace(window);
            watch_.lap();
            pictures_.add(window, samples);
            forRows(part, [&](int x, int y) { takeCentre(window, samples, x, y); });
            watch_.book("filter", stages_);
        });
        return finished();
    }

    MethodResult filtered(int per_side) {
        const SampleWeights weights(in_.filter, per_side);
        forBands(per_side, weights.margin_px, [&](const PixelBox& part) {
            FieldWindow window;
            window.pixels = grown(part, weights.margin_px), window.per_side = per_side;
            const FieldSamples samples = tracer_->trace(window);
            watch_.lap();
            pictures_.add(window, samples);
            forRows(part, [&](int x, int y) { filterPixel(weights, window, samples, x, y); });
            watch_.book("filter", stages_);
            takeAovs(part);
        });
        return finished();
    }

    MethodResult parts() {
        const PartFilter filter(in_.filter);
        forBands(1, filter.marginPx(), [&](const PixelBox& part) {
            FieldWindow window;
            window.pixels = grown(part, filter.marginPx());
            const FieldSamples samples = tracer_->trace(window);
            watch_.lap();
            pictures_.add(window, samples);
            filter.apply(window, samples, part, result_.image);
            forRows(part, [&](int x, int y) {
                const std::size_t i = static_cast<std::size_t>(y - window.pixels.y0) * window.stride() +
                                      static_cast<std::size_t>(x - window.pixels.x0);
                if (aov_.active()) aov_.pixel(x, y, samples, i, result_.image);
            });
            watch_.book("filter", stages_);
        });
        return finished();
    }

  private:
    /// Samples are as much smaller than pixels.
    static FieldSettings ofSamples(FieldSettings settings, int per_side) {
        settings.trace.threshold /= per_side;
        return settings;
    }

    template <class Band>
    void forBands(int per_side, int margin, const Band& band) {
        const PixelBox& crop = in_.film.crop;
        const double row = kBytesPerSample * per_side * per_side * (crop.width() + 2.0 * margin);
        const double fit = 0.5 * 0x1p20 * static_cast<double>(in_.options.memory_mib) / row - 2.0 * margin;
        const int rows = static_cast<int>(std::clamp(fit, 1.0, static_cast<double>(crop.height())));
        in_.progress.stage("samples", static_cast<std::size_t>(crop.height()));
        for (int y = crop.y0; y < crop.y1; y += rows) {
            band({crop.x0, y, crop.x1, std::min(y + rows, crop.y1)});
            checkCancelled(in_.progress);
            in_.progress.advance(static_cast<std::size_t>(std::min(rows, crop.y1 - y)));
        }
    }
    template <class Pixel>
    static void forRows(const PixelBox& part, const Pixel& pixel) {
        tbb::parallel_for(part.y0, part.y1, [&](int y) {
            for (int x = part.x0; x < part.x1; ++x) pixel(x, y);
        });
    }

    void takeCentre(const FieldWindow& window, const FieldSamples& samples, int x, int y) {
        const auto at = [&](int i, int j) {
            return static_cast<std::size_t>(j - window.pixels.y0) * window.stride() + (i - window.pixels.x0);
        };
        ColorSpread spread;
        for (const auto& [i, j] : {std::pair(x, y), {x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}})
            if (window.pixels.contains(i, j)) spread.add(samples.color[at(i, j)]);
        const std::size_t pixel = result_.image.index(x, y);
        result_.image.rgba[pixel] = samples.color[at(x, y)];
        result_.image.edge[pixel] = samples.mixed.empty() ? spread.edge() : samples.mixed[at(x, y)];
        if (aov_.active()) aov_.pixel(x, y, samples, at(x, y), result_.image);
    }

    void filterPixel(const SampleWeights& weights, const FieldWindow& window, const FieldSamples& samples,
                     int x, int y) {
        glm::dvec4 sum(0.0);
        ColorSpread spread;
        const int k = window.per_side;
        const std::size_t left = static_cast<std::size_t>(x - weights.margin_px - window.pixels.x0) * k;
        std::size_t row = static_cast<std::size_t>(y - weights.margin_px - window.pixels.y0) * k;
        for (const SampleWeights::Row& w : weights.rows) {
            const glm::dvec4* color = samples.color.data() + row++ * window.stride() + left + w.first;
            for (int i = 0; i < w.size(); ++i) {
                const double weight = std::ldexp(static_cast<double>(w.of(i, i + 1)), -kWeightBits);
                sum += color[i] * weight;
                if (weight != 0.0) spread.add(color[i]);
            }
        }
        const std::size_t pixel = result_.image.index(x, y);
        result_.image.rgba[pixel] = sum;
        result_.image.edge[pixel] = spread.edge();
    }

    /// Of one sample a pixel, hit as every method's.
    void takeAovs(const PixelBox& part) {
        if (!aov_.active()) return;
        if (!aov_tracer_) aov_tracer_ = make_(in_, settings_);
        FieldWindow window;
        window.pixels = part;
        const FieldSamples samples = aov_tracer_->trace(window);
        forRows(part, [&](int x, int y) {
            const std::size_t i = static_cast<std::size_t>(y - part.y0) * window.stride() + (x - part.x0);
            aov_.pixel(x, y, samples, i, result_.image);
        });
    }

    MethodResult finished() {
        pictures_.finish();
        tracer_->report(result_);
        result_.stages.insert(result_.stages.end(), stages_.begin(), stages_.end());
        return std::move(result_);
    }

    const MethodInput in_;
    const FieldSettings settings_;
    const FieldTracerMaker& make_;
    std::unique_ptr<FieldTracer> tracer_, aov_tracer_;
    FieldAov aov_;
    FieldPictures pictures_;
    MethodResult result_;
    Stopwatch watch_;
    std::vector<StageTime> stages_;
};

}  // namespace

MethodResult tracePixels(const MethodInput& in, const FieldSettings& settings, const FieldTracerMaker& make) {
    return FieldFrame(in, settings, make).pixels();
}

MethodResult traceFiltered(const MethodInput& in, const FieldSettings& settings, int per_side,
                           const FieldTracerMaker& make) {
    return FieldFrame(in, settings, make, per_side).filtered(per_side);
}

MethodResult traceParts(const MethodInput& in, const FieldSettings& settings, const FieldTracerMaker& make) {
    return FieldFrame(in, settings, make).parts();
}

}  // namespace edgewise
