#include "pipeline/methods/pixel_filter.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/vector_int2_sized.hpp>
#include <map>

#include "analytic/first_moments.h"
#include "pipeline/composite.h"

namespace edgewise {
namespace {

double toDouble(FixedWeight weight) {
    return std::ldexp(static_cast<double>(weight), -kWeightBits);
}

constexpr FixedWeight kOne = FixedWeight(1) << kWeightBits;

/// Of the pixel's 1, what samples take whose weights sum to `sum`, where all that are known weigh `known`.
/// Taken at running sums, differences add up to exactly 1. Error: two roundings.
FixedWeight shareOf(FixedWeight sum, FixedWeight known) {
    if (known == kOne) return sum;
    return std::llround(std::ldexp(static_cast<double>(sum) / static_cast<double>(known), kWeightBits));
}

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

}  // namespace

SampleBand makeBand(const PixelBox& window, const SamplePattern& pattern, SampledOwners sampled) {
    SampleBand band{window,
                    static_cast<std::size_t>(window.width()) * pattern.columns,
                    std::move(sampled.owner),
                    std::move(sampled.stacks),
                    {},
                    {}};
    findRuns(band);
    return band;
}

PixelFilter::PixelFilter(const MethodInput& in, const Shading& shading, const AovPass& aov,
                         const SampleWeights& weights, const SamplePattern& pattern)
    : in_(in),
      shading_(shading),
      aov_(aov),
      weights_(weights),
      pattern_(pattern),
      weighted_centroids_(centroidMeasure(in.filter).name == in.filter.name) {}

void PixelFilter::shadeSamples(SampleBand& band) const {
    band.shade.resize(band.owner.size());
    tbb::parallel_for(std::size_t(0), band.owner.size() / band.stride, [&](std::size_t row) {
        for (std::size_t i = row * band.stride; i < (row + 1) * band.stride; ++i)
            if (band.owner[i] != kUnknown)
                band.shade[i] = shadeAt(band, band.owner[i], position(band, row, i - row * band.stride));
    });
}

void PixelFilter::filterRow(const SampleBand& band, int y, int x0, int x1, ImageBuffer& image,
                            std::atomic<std::uint64_t>& shaded) const {
    std::vector<OwnerRun> runs;
    std::uint64_t count = 0;
    for (int x = x0; x < x1; ++x) {
        collectRuns(band, x, y, runs);
        count += blend(band, x, y, runs, image);
        if (aov_.weighs()) aov_.pixel(x, y, ownerWeights(runs), band.stacks, image);
    }
    shaded += count;
}

std::vector<OwnerWeight> PixelFilter::ownersOf(const SampleBand& band, int x, int y) const {
    std::vector<OwnerRun> runs;
    collectRuns(band, x, y, runs);
    return ownerWeights(runs);
}

/// Of known owners, in their order; an owner's runs from top to bottom, left to right.
void PixelFilter::collectRuns(const SampleBand& band, int x, int y, std::vector<OwnerRun>& runs) const {
    runs.clear();
    bool mixed = false;
    for (int row = 0; row < static_cast<int>(weights_.rows.size()); ++row) {
        const SampleWeights::Row& w = weights_.rows[row];
        const std::size_t start = firstSample(band, x, y, row);
        const auto column = static_cast<std::uint32_t>(start % band.stride);
        for (int begin = 0; begin < w.size();) {
            const int run_end = static_cast<int>(band.run_end[start + begin] - column);
            const int end = std::min(run_end, w.size());
            if (band.owner[start + begin] != kUnknown) {
                runs.push_back({band.owner[start + begin], row, begin, end});
                mixed |= runs.back().owner != runs.front().owner;
            }
            begin = end;
        }
    }
    if (mixed)
        std::stable_sort(runs.begin(), runs.end(),
                         [](const auto& a, const auto& b) { return a.owner < b.owner; });
}

FixedWeight PixelFilter::weightOf(Runs runs) const {
    FixedWeight weight = 0;
    for (const OwnerRun& run : runs) weight += weights_.rows[run.row].of(run.begin, run.end);
    return weight;
}

std::vector<OwnerWeight> PixelFilter::ownerWeights(const std::vector<OwnerRun>& runs) const {
    const FixedWeight known = weightOf(runs);
    std::vector<OwnerWeight> owners;
    FixedWeight before = 0;
    for (const OwnerRun& run : runs) {
        if (owners.empty() || owners.back().owner != run.owner) owners.push_back({run.owner, 0});
        const FixedWeight up_to = before + weights_.rows[run.row].of(run.begin, run.end);
        owners.back().weight += shareOf(up_to, known) - shareOf(before, known);
        before = up_to;
    }
    return owners;
}

std::size_t PixelFilter::firstSample(const SampleBand& band, int x, int y, int row) const {
    const int top = (y - weights_.margin_px - band.window.y0) * pattern_.rows;
    const int left = (x - weights_.margin_px - band.window.x0) * pattern_.columns;
    return static_cast<std::size_t>(top + row) * band.stride + left + weights_.rows[row].first;
}

std::uint64_t PixelFilter::blend(const SampleBand& band, int x, int y, const std::vector<OwnerRun>& runs,
                                 ImageBuffer& image) const {
    f64::PixelSum sum{glm::dvec3(0.0), 0, 0.0, glm::dvec3(HUGE_VAL), glm::dvec3(-HUGE_VAL)};
    const FixedWeight known = weightOf(runs);
    FixedWeight before = 0;
    std::uint64_t owners = 0;
    for (std::size_t begin = 0; begin < runs.size(); ++owners) {
        std::size_t end = begin + 1;
        while (end < runs.size() && runs[end].owner == runs[begin].owner) ++end;
        const Runs own = Runs(runs).subspan(begin, end - begin);
        if (in_.options.shading.mode == ShadingMode::kHit) {
            sum = withHits(sum, band, x, y, own, 1.0 / toDouble(known));
        } else {
            const Shade seen = shade(band, x, y, own);
            const FixedWeight up_to = before + weightOf(own);
            sum = f64::withOwner(sum, shareOf(up_to, known) - shareOf(before, known), seen.color, seen.alpha);
            before = up_to;
        }
        begin = end;
    }
    image.rgba[image.index(x, y)] = glm::dvec4(sum.color, f64::alphaOf(sum));
    image.edge[image.index(x, y)] = f64::contrastOf(sum) > kEdgeContrast ? 1.0f : 0.0f;
    return owners;
}

/// Every layer of the owner is shaded where the owner as a whole is seen.
Shade PixelFilter::shade(const SampleBand& band, int x, int y, Runs runs) const {
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
glm::dvec2 PixelFilter::centroidOf(const std::vector<glm::dvec2>& seen, Runs runs, glm::dvec2 corner) const {
    glm::dvec2 sum(0.0);
    double total = 0.0;
    auto p = seen.begin();
    for (const OwnerRun& run : runs)
        for (int i = run.begin; i < run.end; ++i, ++p) {
            const double weight = weighted_centroids_ ? toDouble(weights_.rows[run.row].of(i, i + 1)) : 1.0;
            sum += weight * (*p - corner), total += weight;
        }
    return total > 0.0 ? sum / total : glm::dvec2(0.5);
}

/// The mean over N of the seen samples; colours count by their alpha.
Shade PixelFilter::meanOver(Owner owner, const std::vector<glm::dvec2>& seen) const {
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

/// `count` of the seen samples, spread over them: those in whose cells the points of the R2 sequence (Roberts
/// 2018: frac(j/g), frac(j/g^2), g^3 = g + 1) over their bounding box fall first.
std::vector<glm::dvec2> PixelFilter::spreadOut(const std::vector<glm::dvec2>& seen, std::size_t count) const {
    constexpr double kPlastic = 1.32471795724474602596;
    if (count == seen.size()) return seen;
    const auto cellOf = [&](glm::dvec2 p) { return glm::i64vec2(glm::floor(p * double(pattern_.cells))); };
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

/// The owner's samples as they were shaded, each weighing `share` of its weight; the owner's colour, for the
/// pixel's contrast, is their mean.
f64::PixelSum PixelFilter::withHits(const f64::PixelSum& sum, const SampleBand& band, int x, int y, Runs runs,
                                    double share) const {
    f64::PixelSum out = sum;
    glm::dvec3 colour(0.0), weighted(0.0);
    double covered = 0.0, count = 0.0;
    for (const OwnerRun& run : runs) {
        const std::size_t start = firstSample(band, x, y, run.row);
        for (int i = run.begin; i < run.end; ++i, ++count) {
            const double weight = share * toDouble(weights_.rows[run.row].of(i, i + 1));
            const Shade& seen = band.shade[start + i];
            colour += seen.color, weighted += seen.color * weight, covered += seen.alpha * weight;
        }
    }
    out.color += weighted, out.half_covered += covered;
    out.low = glm::min(out.low, colour / count), out.high = glm::max(out.high, colour / count);
    return out;
}

std::vector<glm::dvec2> PixelFilter::seenAt(const SampleBand& band, int x, int y, Runs runs) const {
    std::vector<glm::dvec2> seen;
    for (const OwnerRun& run : runs) {
        const std::size_t start = firstSample(band, x, y, run.row);
        for (int i = run.begin; i < run.end; ++i)
            seen.push_back(position(band, (start + i) / band.stride, (start + i) % band.stride));
    }
    return seen;
}

glm::dvec2 PixelFilter::position(const SampleBand& band, std::size_t row, std::size_t column) const {
    const int x = static_cast<int>(column), y = static_cast<int>(row);
    const glm::ivec2 pixel(band.window.x0 + x / pattern_.columns, band.window.y0 + y / pattern_.rows);
    return glm::dvec2(pixel) + pattern_.at_px[y % pattern_.rows * pattern_.columns + x % pattern_.columns];
}

Shade PixelFilter::shadeAt(const SampleBand& band, const Owner& owner, glm::dvec2 p_px) const {
    requireShadable(band.stacks.layersOf(owner), p_px);
    return composite(
        band.stacks.layersOf(owner), [&](Owner o) { return shading_.atPoint(o, p_px); },
        in_.options.background);
}

}  // namespace edgewise
