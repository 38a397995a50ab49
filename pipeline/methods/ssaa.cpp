// K x K samples a pixel, shared by the pixels whose filter reaches them; each (pixel, owner) is shaded once.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/ext/vector_int2_sized.hpp>
#include <map>
#include <span>

#include "analytic/first_moments.h"
#include "pipeline/composite.h"
#include "pipeline/methods/aov_report.h"
#include "pipeline/methods/point_samples.h"
#include "pipeline/methods/registry.h"
#include "pipeline/methods/sample_weights.h"
#include "pipeline/methods/stopwatch.h"
#include "pipeline/shade.h"

namespace edgewise {
namespace {

/// The samples of a window of pixels.
struct SampleBand {
    PixelBox window;
    std::size_t stride = 0;  ///< samples a row
    std::vector<Owner> owner;
    LayerStacks stacks;
    std::vector<std::uint32_t>
        run_end;               ///< the first sample of the row, at or after this one, with another owner
    std::vector<Shade> shade;  ///< where each sample is shaded where it lands
};

/// Samples [begin, end) of one row of a pixel's window that one owner covers.
struct OwnerRun {
    Owner owner;
    int row, begin, end;
};

/// An owner's part of a pixel.
struct OwnerPart {
    glm::dvec3 weighted{0.0};  ///< weight times colour
    glm::dvec3 colour{0.0};
    double weight = 0.0;
    double covered = 0.0;  ///< weight times alpha
};

double toDouble(FixedWeight weight) {
    return std::ldexp(static_cast<double>(weight), -kWeightBits);
}

class PixelFilter {
  public:
    PixelFilter(const MethodInput& in, const Shading& shading, const AovPass& aov,
                const SampleWeights& weights, int per_side)
        : in_(in),
          shading_(shading),
          aov_(aov),
          weights_(weights),
          per_side_(per_side),
          weighted_centroids_(centroidMeasure(in.filter).name == in.filter.name) {}

    void shadeSamples(SampleBand& band) const {
        band.shade.resize(band.owner.size());
        tbb::parallel_for(std::size_t(0), band.owner.size() / band.stride, [&](std::size_t row) {
            for (std::size_t i = row * band.stride; i < (row + 1) * band.stride; ++i)
                band.shade[i] = shadeAt(band, band.owner[i], position(band, row, i - row * band.stride));
        });
    }

    void filterRow(const SampleBand& band, int y, ImageBuffer& image,
                   std::atomic<std::uint64_t>& shaded) const {
        std::vector<OwnerRun> runs;
        std::uint64_t count = 0;
        for (int x = image.box.x0; x < image.box.x1; ++x) {
            collectRuns(band, x, y, runs);
            count += blend(band, x, y, runs, image);
            if (aov_.weighs()) aov_.pixel(x, y, ownerWeights(runs), band.stacks, image);
        }
        shaded += count;
    }

  private:
    /// In owner order; an owner's runs from top to bottom, left to right.
    void collectRuns(const SampleBand& band, int x, int y, std::vector<OwnerRun>& runs) const {
        runs.clear();
        bool mixed = false;
        for (int row = 0; row < static_cast<int>(weights_.rows.size()); ++row) {
            const SampleWeights::Row& w = weights_.rows[row];
            const std::size_t start = firstSample(band, x, y, row);
            const auto column = static_cast<std::uint32_t>(start % band.stride);
            for (int begin = 0; begin < w.size();) {
                const int run_end = static_cast<int>(band.run_end[start + begin] - column);
                const int end = std::min(run_end, w.size());
                runs.push_back({band.owner[start + begin], row, begin, end});
                mixed |= runs.back().owner != runs.front().owner;
                begin = end;
            }
        }
        if (mixed)
            std::stable_sort(runs.begin(), runs.end(),
                             [](const auto& a, const auto& b) { return a.owner < b.owner; });
    }

    std::vector<OwnerWeight> ownerWeights(const std::vector<OwnerRun>& runs) const {
        std::vector<OwnerWeight> owners;
        for (const OwnerRun& run : runs) {
            if (owners.empty() || owners.back().owner != run.owner) owners.push_back({run.owner, 0});
            owners.back().weight += weights_.rows[run.row].of(run.begin, run.end);
        }
        return owners;
    }

    std::size_t firstSample(const SampleBand& band, int x, int y, int row) const {
        const int top = (y - weights_.margin_px - band.window.y0) * per_side_;
        const int left = (x - weights_.margin_px - band.window.x0) * per_side_;
        return static_cast<std::size_t>(top + row) * band.stride + left + weights_.rows[row].first;
    }

    std::uint64_t blend(const SampleBand& band, int x, int y, const std::vector<OwnerRun>& runs,
                        ImageBuffer& image) const {
        glm::dvec4 sum(0.0);
        glm::dvec3 least(std::numeric_limits<double>::infinity()), most(-least);
        std::uint64_t owners = 0;
        for (std::size_t begin = 0; begin < runs.size(); ++owners) {
            std::size_t end = begin + 1;
            while (end < runs.size() && runs[end].owner == runs[begin].owner) ++end;
            const OwnerPart part = partOf(band, x, y, std::span(runs).subspan(begin, end - begin));
            sum += glm::dvec4(part.weighted, part.covered);
            least = glm::min(least, part.colour);
            most = glm::max(most, part.colour);
            begin = end;
        }
        const glm::dvec3 contrast = most - least;
        image.rgba[image.index(x, y)] = sum;
        image.edge[image.index(x, y)] =
            std::max({contrast.r, contrast.g, contrast.b}) > kEdgeContrast ? 1.0f : 0.0f;
        return owners;
    }

    OwnerPart partOf(const SampleBand& band, int x, int y, std::span<const OwnerRun> runs) const {
        FixedWeight weight = 0;
        for (const OwnerRun& run : runs) weight += weights_.rows[run.row].of(run.begin, run.end);
        OwnerPart part;
        part.weight = toDouble(weight);
        if (in_.options.shading.mode == ShadingMode::kHit) return hitPart(band, x, y, runs, part);
        const Shade seen = shade(band, x, y, runs);
        part.colour = seen.color;
        part.weighted = part.colour * part.weight;
        part.covered = part.weight * seen.alpha;
        return part;
    }

    /// Every layer of the owner is shaded where the owner as a whole is seen.
    Shade shade(const SampleBand& band, int x, int y, std::span<const OwnerRun> runs) const {
        const Owner& owner = runs.front().owner;
        const auto layers = band.stacks.layersOf(owner);
        const glm::dvec2 corner(x, y);
        requireShadable(layers, corner);
        const auto over = [&](const auto& shadeLayer) {
            return composite(layers, shadeLayer, in_.options.background);
        };
        if (in_.options.shading.mode == ShadingMode::kClosest || owner == kBackground)
            return over([&](Owner o) { return shading_.closest(o, corner + 0.5); });
        const std::vector<glm::dvec2> seen = seenAt(band, x, y, runs);
        if (in_.options.shading.mode == ShadingMode::kSamples)
            return over([&](Owner o) { return meanOver(o, seen); });
        const glm::dvec2 centroid = corner + centroidOf(seen, runs, corner);
        return over([&](Owner o) { return shading_.closest(o, centroid); });
    }

    /// From the corner; by the measure that nsaa takes. Samples that weigh nothing: the pixel's own.
    glm::dvec2 centroidOf(const std::vector<glm::dvec2>& seen, std::span<const OwnerRun> runs,
                          glm::dvec2 corner) const {
        glm::dvec2 sum(0.0);
        double total = 0.0;
        auto p = seen.begin();
        for (const OwnerRun& run : runs)
            for (int i = run.begin; i < run.end; ++i, ++p) {
                const double weight =
                    weighted_centroids_ ? toDouble(weights_.rows[run.row].of(i, i + 1)) : 1.0;
                sum += weight * (*p - corner), total += weight;
            }
        return total > 0.0 ? sum / total : glm::dvec2(0.5);
    }

    /// The mean over N of the seen samples; colours count by their alpha.
    Shade meanOver(Owner owner, const std::vector<glm::dvec2>& seen) const {
        if (const auto constant = shading_.constant(owner)) return *constant;
        const std::size_t count = std::min<std::size_t>(in_.options.shading.samples, seen.size());
        const std::vector<glm::dvec2> spread = spreadOut(seen, count);
        Shade sum{glm::dvec3(0.0), 0.0};
        for (std::size_t i = 0; i < count; ++i) {
            const Shade one = shading_.atPoint(owner, spread[i]);
            sum.color += one.alpha * one.color, sum.alpha += one.alpha;
        }
        return {sum.alpha > 0.0 ? sum.color / sum.alpha : sum.color, sum.alpha / double(count)};
    }

    /// `count` of the seen samples, spread over them: those in whose cells of the sample grid the points of
    /// the R2 sequence (Roberts 2018: frac(j/g), frac(j/g^2), g^3 = g + 1) over their bounding box fall
    /// first.
    std::vector<glm::dvec2> spreadOut(const std::vector<glm::dvec2>& seen, std::size_t count) const {
        constexpr double kPlastic = 1.32471795724474602596;
        if (count == seen.size()) return seen;
        const auto cellOf = [&](glm::dvec2 p) { return glm::i64vec2(glm::floor(p * double(per_side_))); };
        const auto key = [](glm::i64vec2 cell) { return std::pair(cell.y, cell.x); };
        std::map<std::pair<std::int64_t, std::int64_t>, glm::dvec2> left;
        glm::i64vec2 low = cellOf(seen.front()), high = low;
        for (const glm::dvec2& p : seen) {
            left.emplace(key(cellOf(p)), p);
            low = glm::min(low, cellOf(p)), high = glm::max(high, cellOf(p));
        }
        const glm::dvec2 size(high - low + std::int64_t(1));
        std::vector<glm::dvec2> chosen;
        // A region that the sequence hardly meets takes the rest in order.
        for (std::size_t j = 1; chosen.size() < count && j <= 16 * seen.size() + 64; ++j) {
            const glm::dvec2 at =
                glm::fract(glm::dvec2(0.5) + double(j) * glm::dvec2(1 / kPlastic, 1 / (kPlastic * kPlastic)));
            const auto found = left.find(key(low + glm::i64vec2(glm::floor(at * size))));
            if (found == left.end()) continue;
            chosen.push_back(found->second);
            left.erase(found);
        }
        for (auto rest = left.begin(); chosen.size() < count; ++rest) chosen.push_back(rest->second);
        return chosen;
    }

    OwnerPart hitPart(const SampleBand& band, int x, int y, std::span<const OwnerRun> runs,
                      OwnerPart part) const {
        std::size_t count = 0;
        for (const OwnerRun& run : runs) {
            const std::size_t start = firstSample(band, x, y, run.row);
            for (int i = run.begin; i < run.end; ++i, ++count) {
                const double weight = toDouble(weights_.rows[run.row].of(i, i + 1));
                part.colour += band.shade[start + i].color;
                part.weighted += band.shade[start + i].color * weight;
                part.covered += band.shade[start + i].alpha * weight;
            }
        }
        part.colour /= double(count);
        return part;
    }

    std::vector<glm::dvec2> seenAt(const SampleBand& band, int x, int y,
                                   std::span<const OwnerRun> runs) const {
        std::vector<glm::dvec2> seen;
        for (const OwnerRun& run : runs) {
            const std::size_t start = firstSample(band, x, y, run.row);
            for (int i = run.begin; i < run.end; ++i)
                seen.push_back(position(band, (start + i) / band.stride, (start + i) % band.stride));
        }
        return seen;
    }

    glm::dvec2 position(const SampleBand& band, std::size_t row, std::size_t column) const {
        auto place = [&](int first, std::size_t i) {
            const int sample = static_cast<int>(i);
            return first + sample / per_side_ + sampleOffsetPx(sample % per_side_, per_side_);
        };
        return {place(band.window.x0, column), place(band.window.y0, row)};
    }

    Shade shadeAt(const SampleBand& band, const Owner& owner, glm::dvec2 p_px) const {
        requireShadable(band.stacks.layersOf(owner), p_px);
        return composite(
            band.stacks.layersOf(owner), [&](Owner o) { return shading_.atPoint(o, p_px); },
            in_.options.background);
    }

    const MethodInput& in_;
    const Shading& shading_;
    const AovPass& aov_;
    const SampleWeights& weights_;
    int per_side_;
    bool weighted_centroids_;
};

void findRuns(SampleBand& band) {
    band.run_end.resize(band.owner.size());
    tbb::parallel_for(std::size_t(0), band.owner.size() / band.stride, [&](std::size_t row) {
        const Owner* owner = band.owner.data() + row * band.stride;
        std::uint32_t* end = band.run_end.data() + row * band.stride;
        for (std::size_t j = band.stride; j-- > 0;) {
            const bool last = j + 1 == band.stride || owner[j + 1] != owner[j];
            end[j] = last ? static_cast<std::uint32_t>(j + 1) : end[j + 1];
        }
    });
}

PixelBox grown(const PixelBox& box, int margin) {
    return {box.x0 - margin, box.y0 - margin, box.x1 + margin, box.y1 + margin};
}

/// Rows of pixels whose samples fit half the memory; at least one.
int rowsPerBand(const RenderOptions& options, const PixelBox& crop, int margin, int per_side) {
    const bool hit = options.shading.mode == ShadingMode::kHit;
    const double bytes = sizeof(Owner) + sizeof(std::uint32_t) + (hit ? sizeof(Shade) : 0);
    const double row_bytes = bytes * per_side * per_side * (crop.width() + 2.0 * margin);
    const double rows = 0.5 * 0x1p20 * double(options.memory_mib) / row_bytes - 2.0 * margin;
    return static_cast<int>(std::clamp(rows, 1.0, double(crop.height())));
}

}  // namespace

MethodResult runSsaa(const MethodSpec& spec, const MethodInput& in) {
    MethodResult result;
    Stopwatch watch;
    const int per_side = *spec.number;
    const SampleWeights weights(in.filter, per_side);
    ScreenPieces pieces;
    const ScreenScene screen = project(in.scene, in.camera, in.film, pieces, in.progress);
    const Shading shading(in.scene, in.camera, in.film, screen, pieces);
    const AovPass aov(in.options.aovs, in.scene, in.camera, in.film, screen, pieces, shading);
    const PixelFilter filter(in, shading, aov, weights, per_side);
    watch.book("project", result.stages);
    checkCancelled(in.progress);
    const PixelBox& crop = in.film.crop;
    const PointSampler sampler(screen, grown(crop, weights.margin_px), per_side);
    watch.book("gather", result.stages);
    result.image = ImageBuffer(crop);
    aov.begin(result.image);
    aov.samplePoints(in.progress, result.image);
    if (aov.pointSamples()) watch.book("aov", result.stages);
    std::atomic<std::uint64_t> shaded{0};
    std::uint64_t samples = 0;
    const int rows = rowsPerBand(in.options, crop, weights.margin_px, per_side);
    in.progress.stage("ssaa", crop.height());
    for (int y = crop.y0; y < crop.y1; y += rows) {
        const PixelBox part{crop.x0, y, crop.x1, std::min(y + rows, crop.y1)};
        SampleBand band;
        band.window = grown(part, weights.margin_px);
        band.stride = static_cast<std::size_t>(band.window.width()) * per_side;
        SampledOwners sampled = sampler.sample(band.window);
        band.owner = std::move(sampled.owner), band.stacks = std::move(sampled.stacks);
        samples += band.owner.size();
        watch.book("visibility", result.stages);
        findRuns(band);
        if (in.options.shading.mode == ShadingMode::kHit) filter.shadeSamples(band);
        tbb::parallel_for(part.y0, part.y1, [&](int row) {
            if (in.progress.cancelled()) return;
            filter.filterRow(band, row, result.image, shaded);
            in.progress.advance(1);
        });
        checkCancelled(in.progress);
        watch.book("shade", result.stages);
    }
    result.counts = {{"triangles", in.scene.triangle_count},
                     {"pieces", screen.triangles.size()},
                     {"samples", samples},
                     {"shaded", shaded},
                     {"exact_depths", sampler.exactDepths()}};
    reportAovs(aov, result);
    return result;
}

}  // namespace edgewise
