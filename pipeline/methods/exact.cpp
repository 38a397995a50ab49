// The oracle as a method: the same scene, shading and blending as nsaa, but weights from the exact visible
// map.
#include "pipeline/methods/exact.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <map>

#include "analytic/exact/kernel_weights.h"
#include "pipeline/error.h"
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

class Colours {
  public:
    Colours(const MethodInput& in, const Shading& shading) : in_(in), shading_(shading) {}

    void blend(const std::map<Owner, Real>& weights, int x, int y, ImageBuffer& image) const {
        glm::dvec3 color(0.0), low(HUGE_VAL), high(-HUGE_VAL);
        Real covered = 0;
        for (const auto& [owner, weight] : weights) {
            const bool behind = owner == kBackground;
            const glm::dvec3 c = behind
                                     ? in_.options.background
                                     : shade(owner, glm::dvec2(x + 0.5, y + 0.5) + in_.film.debug_offset_px);
            color += static_cast<double>(weight) * c;
            if (!behind) covered += weight;
            low = glm::min(low, c), high = glm::max(high, c);
        }
        const glm::dvec3 span = high - low;
        image.rgba[image.index(x, y)] = glm::dvec4(color, static_cast<double>(covered));
        image.edge[image.index(x, y)] = std::max({span.r, span.g, span.b}) > kEdgeContrast ? 1.0f : 0.0f;
    }

  private:
    glm::dvec3 shade(Owner owner, glm::dvec2 sample_px) const {
        return shading_.closest(owner, sample_px).color;
    }

    const MethodInput& in_;
    const Shading& shading_;
};

}  // namespace

MethodResult runExact(const MethodSpec&, const MethodInput& in) {
    MethodResult result;
    Stopwatch watch;
    ScreenPieces pieces;
    if (!in.options.aovs.empty())
        throw FailureError("--aov", "exact has none; nsaa, ssaa and none have them");
    const ScreenScene screen = project(in.scene, in.camera, in.film, pieces, in.progress);
    const Shading shading(in.scene, in.camera, in.film, screen, pieces);
    watch.book("project", result.stages);
    checkCancelled(in.progress);
    const Oracle oracle(screen, in.film.crop, in.film.debug_offset_px, in.filter);
    watch.book("visibility", result.stages);
    const Colours colours(in, shading);
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
