// The oracle as a method: the same scene, shading (at the same points) and blending as nsaa, but weights from
// the exact visible map.
#include "pipeline/methods/exact.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "analytic/exact/kernel_weights.h"
#include "pipeline/error.h"
#include "pipeline/methods/nsaa_cpu.h"
#include "pipeline/methods/registry.h"
#include "pipeline/methods/stopwatch.h"
#include "pipeline/shade.h"

namespace edgewise {
namespace {

using exact::Real;

/// The faces around a box of pixels, and one kernel's weights in them.
class Oracle {
  public:
    Oracle(const ScreenScene& screen, const PixelBox& box, glm::dvec2 offset_px, const Prefilter& filter)
        : filter_(filter), kernel_(filter), offset_px_(offset_px) {
        const glm::dvec2 reach(filter.radius + 1.0);
        const glm::dvec2 low = glm::dvec2(box.x0, box.y0) + offset_px - reach,
                         high = glm::dvec2(box.x1, box.y1) + offset_px + reach;
        const exact::Region region{low.x, low.y, high.x, high.y};
        requireJudgeable(screen, region);
        faces_ = exact::visibleFaces(screen, region);
    }

    std::size_t faces() const { return faces_.size(); }

    /// By owner, the background among them: what the others leave.
    std::map<Owner, Real> weights(int x, int y) const {
        const glm::dvec2 at = glm::dvec2(x + 0.5, y + 0.5) + offset_px_;
        const exact::Point sample{exact::Rational(at.x), exact::Rational(at.y)};
        std::map<Owner, Real> out;
        Real rest = 1;
        for (const exact::Face& face : faces_) {
            const Real w = weight(face, sample);
            if (w == 0) continue;
            out[face.owner] += w;
            rest -= w;
        }
        // What a sum of 50 digits cannot tell from 0 is 0: the oracle promises 30.
        if (abs(rest) > Real("1e-40")) out[kBackground] = rest;
        return out;
    }

  private:
    Real weight(const exact::Face& face, const exact::Point& sample) const {
        if (filter_.kind == KernelKind::kBox)
            return Real(exact::boxWeight(face, sample, exact::Rational(filter_.radius)));
        const exact::Weight w = kernel_.of(face, sample);
        return abs(w.value) <= w.error ? Real(0) : w.value;  // a face that only its box brings near
    }

    static void requireJudgeable(const ScreenScene& screen, const exact::Region& region) {
        std::size_t count = 0;
        for (const ScreenTriangle& t : screen.triangles) {
            if (!exact::meets(t, region)) continue;
            if (screen.seesThrough(t.owner))
                throw FailureError(fmt::format("triangle {}", t.owner),
                                   "is seen through, and the oracle judges opaque triangles only");
            ++count;
        }
        if (count > kMaxOracleTriangles)
            throw FailureError("exact",
                               fmt::format("{} triangles around the crop, the limit is {}; see --crop", count,
                                           kMaxOracleTriangles));
    }

    const Prefilter& filter_;
    exact::KernelWeights kernel_;
    glm::dvec2 offset_px_;
    std::vector<exact::Face> faces_;
};

/// The unit in the last place of a double; of 0 that of the fixed point which holds weights.
double ulpOf(double x) {
    if (x == 0.0) return 0x1p-60;
    const double next = std::nextafter(std::abs(x), HUGE_VAL);
    return next - std::abs(x);
}

/// Where nsaa shades each owner of each pixel.
class PointCollector : public CpuStages {
  public:
    explicit PointCollector(const PixelBox& crop) : crop_(crop) {
        points_.resize(static_cast<std::size_t>(crop.width()) * crop.height());
    }

    /// From the pixel's sample; none: the closest point.
    std::span<const glm::dvec2> of(Owner owner, int x, int y) const {
        const auto& pixel = points_[indexOf(x, y)];
        const auto found = pixel.find(owner);
        return found == pixel.end() ? std::span<const glm::dvec2>() : found->second;
    }

  private:
    std::size_t indexOf(int x, int y) const {
        return static_cast<std::size_t>(y - crop_.y0) * crop_.width() + (x - crop_.x0);
    }

    /// From any thread: no two tiles share a pixel.
    void finishTile(NsaaFrame&, const BandOwners&, WeightTile& tile) override {
        std::size_t pixel = 0;
        for (int y = tile.box.y0; y < tile.box.y1; ++y)
            for (int x = tile.box.x0; x < tile.box.x1; ++x, ++pixel)
                for (std::size_t e = tile.offset[pixel]; e < tile.offset[pixel + 1]; ++e) {
                    const auto offsets = tile.points.of(e);
                    points_[indexOf(x, y)][tile.entries[e].owner].assign(offsets.begin(), offsets.end());
                }
    }

    PixelBox crop_;
    std::vector<std::map<Owner, std::vector<glm::dvec2>>> points_;  ///< by pixel
};

/// The same points as nsaa's, so that pictures differ by their weights alone; none where the mode has none.
std::optional<PointCollector> nsaaPoints(const MethodInput& in) {
    const ShadingMode mode = in.options.shading.mode;
    if (mode != ShadingMode::kCentroid && mode != ShadingMode::kSamples) return std::nullopt;
    RenderOptions options = in.options;
    options.dump_dir.reset();
    const MethodInput same{in.scene, in.camera, in.film, in.filter, options, in.progress};
    std::optional<PointCollector> points(in.film.crop);
    NsaaFrame frame(same);
    frame.plan.classes.representative.clear();  // every owner has its own points
    frame.render(*points);
    return points;
}

class Colours {
  public:
    Colours(const MethodInput& in, const Shading& shading, const PointCollector* points)
        : in_(in), shading_(shading), points_(points) {}

    void blend(const std::map<Owner, Real>& weights, int x, int y, ImageBuffer& image) const {
        glm::dvec3 color(0.0), low(HUGE_VAL), high(-HUGE_VAL);
        Real covered = 0;
        for (const auto& [owner, weight] : weights) {
            const bool behind = owner == kBackground;
            const glm::dvec3 c = behind ? in_.options.background : shade(owner, x, y);
            color += static_cast<double>(weight) * c;
            if (!behind) covered += weight;
            low = glm::min(low, c), high = glm::max(high, c);
        }
        const glm::dvec3 span = high - low;
        image.rgba[image.index(x, y)] = glm::dvec4(color, static_cast<double>(covered));
        image.edge[image.index(x, y)] = std::max({span.r, span.g, span.b}) > kEdgeContrast ? 1.0f : 0.0f;
    }

  private:
    glm::dvec3 shade(Owner owner, int x, int y) const {
        const glm::dvec2 sample_px = glm::dvec2(x + 0.5, y + 0.5) + in_.film.debug_offset_px;
        if (points_ == nullptr) return shading_.closest(owner, sample_px).color;
        return shading_.mean(owner, sample_px, points_->of(owner, x, y)).color;
    }

    const MethodInput& in_;
    const Shading& shading_;
    const PointCollector* points_;
};

}  // namespace

MethodResult runExact(const MethodSpec&, const MethodInput& in) {
    MethodResult result;
    Stopwatch watch;
    ScreenPieces pieces;
    if (!in.options.aovs.empty()) throw InputError("--aov", "exact has none; nsaa, ssaa and none have them");
    const ScreenScene screen = project(in.scene, in.camera, in.film, pieces, in.progress);
    const Shading shading(in.scene, in.camera, in.film, screen, pieces);
    watch.book("project", result.stages);
    checkCancelled(in.progress);
    const Oracle oracle(screen, in.film.crop, in.film.debug_offset_px, in.filter);
    watch.book("visibility", result.stages);
    const std::optional<PointCollector> points = nsaaPoints(in);
    watch.book("points", result.stages);
    const Colours colours(in, shading, points ? &*points : nullptr);
    result.image = ImageBuffer(in.film.crop);
    in.progress.stage("exact weights", in.film.crop.height());
    tbb::parallel_for(in.film.crop.y0, in.film.crop.y1, [&](int y) {
        for (int x = in.film.crop.x0; x < in.film.crop.x1; ++x) {
            checkCancelled(in.progress);
            colours.blend(oracle.weights(x, y), x, y, result.image);
        }
        in.progress.advance(1);
    });
    watch.book("weights", result.stages);
    if (in.options.shading.mode == ShadingMode::kHit)
        result.notes.emplace_back("exact has no samples that hit: shaded at the closest point");
    if (in.options.dump_dir) result.notes.emplace_back("'exact' has no stages to dump");
    result.counts = {{"triangles", in.scene.triangle_count},
                     {"screen_triangles", screen.triangles.size()},
                     {"faces", oracle.faces()}};
    return result;
}

std::vector<ExactWeight> exactWeights(const MethodInput& in, int x, int y,
                                      const std::vector<std::pair<Owner, double>>& product) {
    ScreenPieces pieces;
    const ScreenScene screen = project(in.scene, in.camera, in.film, pieces);
    std::map<Owner, double> ours;
    for (const auto& [owner, weight] : product) ours[owner] += weight;
    std::map<Owner, Real> truth =
        Oracle(screen, {x, y, x + 1, y + 1}, in.film.debug_offset_px, in.filter).weights(x, y);
    for (const auto& [owner, weight] : ours) truth.try_emplace(owner, 0);
    std::vector<ExactWeight> out;
    for (const auto& [owner, weight] : truth) {
        const double nearest = static_cast<double>(weight);
        const Real off = Real(ours.contains(owner) ? ours[owner] : 0.0) - weight;
        out.push_back({owner, weight.str(32), nearest, static_cast<double>(Real(off / ulpOf(nearest)))});
    }
    return out;
}

}  // namespace edgewise
