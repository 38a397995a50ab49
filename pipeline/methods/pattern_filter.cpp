#include "pipeline/methods/pattern_filter.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "analytic/first_moments.h"
#include "pipeline/composite.h"
#include "pipeline/error.h"
#include "pipeline/methods/owner_shares.h"
#include "pipeline/shading_text.h"

namespace edgewise {
namespace {

constexpr int kTilePx = 32;
constexpr FixedWeight kOne = FixedWeight(1) << kWeightBits;
/// A fixed-point weight holds -8 to 8: no owner can get more than the sum of all weights' sizes.
constexpr double kLargestWeight = 7.0;

}  // namespace

/// One tile's pixels, filtered one after the other.
class PatternTile {
  public:
    explicit PatternTile(const PatternFilter& filter)
        : f_(filter), margin_(filter.margin_px_), side_(2 * margin_ + 1), shares_(filter.weights_) {}

    std::uint64_t run(const PixelBox& tile, const PixelBox& window, const SampledOwners& sampled,
                      ImageBuffer& image) {
        window_ = window;
        sampled_ = &sampled;
        source_ = {tile.x0 - margin_, tile.y0 - margin_, tile.x1 + margin_, tile.y1 + margin_};
        if (f_.in_.options.shading.mode == ShadingMode::kHit) shadeSamples();
        shareOut();
        std::uint64_t shaded = 0;
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x) {
                weigh(x, y);
                if (f_.aov_.weighs()) f_.aov_.pixel(x, y, owners_, sampled.stacks, image);
                blend(x, y, image);
                shaded += owners_.size();
            }
        return shaded;
    }

  private:
    std::size_t sourceOf(int x, int y) const {
        return static_cast<std::size_t>(y - source_.y0) * source_.width() + (x - source_.x0);
    }

    std::span<const Owner> samplesOf(int x, int y) const {
        const std::size_t pixel =
            static_cast<std::size_t>(y - window_.y0) * window_.width() + (x - window_.x0);
        return std::span(sampled_->owner).subspan(pixel * f_.patterns_.samples, f_.patterns_.samples);
    }

    /// Shares of all source pixels; owners are numbered in their order, so that a pixel sums by number.
    void shareOut() {
        shares_.clear();
        for (int y = source_.y0; y < source_.y1; ++y)
            for (int x = source_.x0; x < source_.x1; ++x)
                shares_.add(samplesOf(x, y), f_.patterns_.patternOf(x, y));
        known_ = shares_.owners();
        std::ranges::sort(known_);
        known_.erase(std::unique(known_.begin(), known_.end()), known_.end());
        number_.clear();
        for (const Owner owner : shares_.owners()) number_.push_back(numberOf(owner));
        sum_.assign(known_.size(), 0);
        met_.assign(known_.size(), 0);
    }

    std::uint32_t numberOf(Owner owner) const {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(known_, owner) - known_.begin());
    }

    /// Calls visit(source x, source y, place in the sample's reach): the pixels whose samples reach one, from
    /// the top left. A sample reaches it at the mirrored place.
    template <class Visit>
    void forSources(int x, int y, const Visit& visit) const {
        for (int j = -margin_; j <= margin_; ++j)
            for (int i = -margin_; i <= margin_; ++i)
                visit(x + i, y + j, (margin_ - j) * side_ + (margin_ - i));
    }

    /// Of the pixel: its owners in order, with weights that sum to exactly 1.
    void weigh(int x, int y) {
        numbers_.clear();
        FixedWeight all = 0;
        forSources(x, y, [&](int sx, int sy, int place) {
            const std::size_t source = sourceOf(sx, sy);
            all += f_.weights_.total(f_.patterns_.patternOf(sx, sy))[place];
            for (std::size_t e = shares_.first(source); e < shares_.first(source + 1); ++e) {
                const FixedWeight weight = shares_.weightsOf(e)[place];
                if (weight == 0) continue;
                const std::uint32_t n = number_[e];
                if (!met_[n]) met_[n] = 1, numbers_.push_back(n);
                sum_[n] += weight;
            }
        });
        if (all <= 0)
            throw InputError(fmt::format("rt: pixel {},{}", x, y),
                             "the samples' weights do not sum to more than 0: use more samples or a larger "
                             "radius");
        std::ranges::sort(numbers_);
        normalise(x, y, all);
    }

    /// What rounding leaves goes to the largest.
    void normalise(int x, int y, FixedWeight all) {
        owners_.clear();
        FixedWeight rest = kOne;
        std::size_t largest = 0;
        double size = 0.0;
        unit_ = static_cast<double>(kOne) / static_cast<double>(all);
        for (const std::uint32_t n : numbers_) {
            const double weight = static_cast<double>(sum_[n]) * unit_;
            size += std::fabs(weight);
            sum_[n] = 0, met_[n] = 0;
            if (size > kLargestWeight * static_cast<double>(kOne))
                throw FailureError(fmt::format("rt: pixel {},{}", x, y),
                                   "the filter's negative lobes nearly cancel its positive ones: some "
                                   "weights could exceed 7");
            owners_.push_back({known_[n], static_cast<FixedWeight>(std::llround(weight))});
            rest -= owners_.back().weight;
            if (owners_.back().weight > owners_[largest].weight) largest = owners_.size() - 1;
        }
        owners_[largest].weight += rest;
    }

    void blend(int x, int y, ImageBuffer& image) {
        const bool apart = f_.in_.options.shading.mode != ShadingMode::kClosest;
        if (apart) collectSeen(x, y);
        f64::PixelSum sum{glm::dvec3(0.0), 0, 0.0, glm::dvec3(HUGE_VAL), glm::dvec3(-HUGE_VAL)};
        for (std::size_t i = 0; i < owners_.size(); ++i) {
            if (f_.in_.options.shading.mode == ShadingMode::kHit) {
                addHits(sum, i);
            } else {
                const Shade seen = shade(x, y, i);
                sum = f64::withOwner(sum, owners_[i].weight, seen.color, seen.alpha);
            }
        }
        image.rgba[image.index(x, y)] = glm::dvec4(sum.color, f64::alphaOf(sum));
        image.edge[image.index(x, y)] = f64::contrastOf(sum) > kEdgeContrast ? 1.0f : 0.0f;
    }

    /// A sample that weighs something for the pixel.
    struct Seen {
        std::uint32_t entry;  ///< of owners_
        double weight;        ///< of the pixel's 1
        glm::dvec2 p_px;
        std::size_t shade;  ///< of shades_
    };

    /// Owner by owner, from the top left source pixel on.
    void collectSeen(int x, int y) {
        seen_.clear();
        forSources(x, y, [&](int sx, int sy, int place) {
            const std::size_t pattern = f_.patterns_.patternOf(sx, sy);
            const auto at_px = f_.patterns_.pattern(pattern);
            const auto samples = samplesOf(sx, sy);
            for (int i = 0; i < f_.patterns_.samples; ++i) {
                const FixedWeight weight = f_.weights_.of(pattern, i)[place];
                if (weight == 0) continue;
                const auto own = std::ranges::lower_bound(owners_, samples[i], {}, &OwnerWeight::owner);
                // Weights of opposite signs may have cancelled.
                if (own == owners_.end() || own->owner != samples[i]) continue;
                seen_.push_back({static_cast<std::uint32_t>(own - owners_.begin()),
                                 std::ldexp(static_cast<double>(weight) * unit_, -kWeightBits),
                                 glm::dvec2(sx, sy) + at_px[i], sourceOf(sx, sy) * f_.patterns_.samples + i});
            }
        });
        std::ranges::stable_sort(seen_, {}, &Seen::entry);
    }

    std::span<const Seen> seenOf(std::size_t entry) const {
        const auto own = std::ranges::equal_range(seen_, entry, {}, &Seen::entry);
        return {own.begin(), own.end()};
    }

    Shade shadeAt(const Owner& owner, glm::dvec2 p_px) const {
        const auto layers = sampled_->stacks.layersOf(owner);
        requireShadable(layers, p_px);
        return composite(
            layers, [&](Owner o) { return f_.shading_.atPoint(o, p_px); }, f_.in_.options.background);
    }

    void shadeSamples() {
        shades_.clear();
        for (int y = source_.y0; y < source_.y1; ++y)
            for (int x = source_.x0; x < source_.x1; ++x) {
                const auto samples = samplesOf(x, y);
                const auto at_px = f_.patterns_.pattern(f_.patterns_.patternOf(x, y));
                for (std::size_t i = 0; i < samples.size(); ++i)
                    shades_.push_back(shadeAt(samples[i], glm::dvec2(x, y) + at_px[i]));
            }
    }

    /// The owner's samples as they were shaded; its colour, for the pixel's contrast, is their mean.
    void addHits(f64::PixelSum& sum, std::size_t entry) const {
        const auto seen = seenOf(entry);
        glm::dvec3 colour(0.0);
        for (const Seen& s : seen) {
            const Shade& shade = shades_[s.shade];
            colour += shade.color;
            sum.color += s.weight * shade.color;
            sum.half_covered += s.weight * shade.alpha;
        }
        colour /= double(seen.size());
        sum.low = glm::min(sum.low, colour), sum.high = glm::max(sum.high, colour);
    }

    /// Every layer of the owner is shaded where the owner as a whole is seen.
    Shade shade(int x, int y, std::size_t entry) const {
        const Owner& owner = owners_[entry].owner;
        const auto layers = sampled_->stacks.layersOf(owner);
        const glm::dvec2 corner(x, y);
        requireShadable(layers, corner);
        const auto over = [&](const auto& shadeLayer) {
            return composite(layers, shadeLayer, f_.in_.options.background);
        };
        const ShadingMode mode = f_.in_.options.shading.mode;
        if (mode == ShadingMode::kClosest || owner == kBackground)
            return over([&](Owner o) { return f_.shading_.closest(o, corner + 0.5); });
        const auto seen = seenOf(entry);
        if (mode == ShadingMode::kSamples) return over([&](Owner o) { return meanOver(o, seen); });
        const glm::dvec2 centroid = centroidOf(seen, corner + 0.5);
        return over([&](Owner o) { return f_.shading_.closest(o, centroid); });
    }

    /// By the measure that nsaa takes.
    glm::dvec2 centroidOf(std::span<const Seen> seen, glm::dvec2 centre) const {
        glm::dvec2 sum(0.0);
        double total = 0.0;
        for (const Seen& s : seen) {
            const double weight = f_.weighted_centroids_ ? s.weight : 1.0;
            sum += weight * (s.p_px - centre), total += weight;
        }
        return total > 0.0 ? centre + sum / total : centre;
    }

    /// The mean over N of the seen samples, evenly through their list, which follows the Z-order curve in
    /// each pixel; colours count by their alpha.
    Shade meanOver(Owner owner, std::span<const Seen> seen) const {
        if (const auto constant = f_.shading_.constant(owner)) return *constant;
        const std::size_t count = std::min<std::size_t>(f_.in_.options.shading.samples, seen.size());
        Shade sum{glm::dvec3(0.0), 0.0};
        for (std::size_t i = 0; i < count; ++i) {
            const Shade one = f_.shading_.atPoint(owner, seen[(2 * i + 1) * seen.size() / (2 * count)].p_px);
            sum.color += one.alpha * one.color, sum.alpha += one.alpha;
        }
        return {sum.alpha > 0.0 ? sum.color / sum.alpha : sum.color, sum.alpha / double(count)};
    }

    const PatternFilter& f_;
    int margin_, side_;
    PixelBox window_, source_;
    const SampledOwners* sampled_ = nullptr;
    OwnerShares shares_;
    std::vector<Owner> known_;
    std::vector<std::uint32_t> number_;  ///< by entry of shares_
    std::vector<FixedWeight> sum_;       ///< by number, of the pixel at work
    std::vector<std::uint8_t> met_;
    std::vector<std::uint32_t> numbers_;
    double unit_ = 1.0;
    std::vector<OwnerWeight> owners_;
    std::vector<Seen> seen_;
    std::vector<Shade> shades_;
};

PatternFilter::PatternFilter(const MethodInput& in, const Shading& shading, const AovPass& aov,
                             const PixelPatterns& patterns, const PatternWeights& weights)
    : in_(in),
      shading_(shading),
      aov_(aov),
      patterns_(patterns),
      weights_(weights),
      margin_px_(PatternWeights::marginPx(in.filter)),
      weighted_centroids_(centroidMeasure(in.filter).name == in.filter.name) {}

void PatternFilter::filter(const PixelBox& box, const PixelBox& window, const SampledOwners& sampled,
                           ImageBuffer& image, std::atomic<std::uint64_t>& shaded) const {
    const int across = (box.width() + kTilePx - 1) / kTilePx, down = (box.height() + kTilePx - 1) / kTilePx;
    tbb::enumerable_thread_specific<PatternTile> tiles([&] { return PatternTile(*this); });
    tbb::parallel_for(0, across * down, [&](int i) {
        if (in_.progress.cancelled()) return;
        const int x0 = box.x0 + i % across * kTilePx, y0 = box.y0 + i / across * kTilePx;
        const PixelBox tile{x0, y0, std::min(x0 + kTilePx, box.x1), std::min(y0 + kTilePx, box.y1)};
        shaded += tiles.local().run(tile, window, sampled, image);
        if (tile.x1 == box.x1) in_.progress.advance(tile.height());
    });
}

}  // namespace edgewise
