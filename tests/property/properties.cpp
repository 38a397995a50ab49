#include "tests/property/properties.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "analytic/exact/kernel_weights.h"
#include "pipeline/methods/nsaa.h"
#include "tests/pipeline/nsaa_stages.h"
#include "tests/witness/dice.h"

namespace edgewise::property {
namespace {

constexpr FixedWeight kOne = FixedWeight{1} << kWeightBits;
constexpr Outcome kNotAsked{false, std::nullopt};

/// How far roundings may move a weight that is a sum of so many terms, and its conversion to fixed point.
double roundingsOf(std::uint64_t terms) {
    return static_cast<double>(terms + 1) * (test::kTermRoundings * test::kUnit + 0x1p-60);
}

Outcome wrong(glm::ivec2 pixel, std::string what) {
    return {true, Violation{std::move(what), pixel, {}}};
}

/// A scene as far as weights: every pixel of the box can be asked.
class Weighed {
  public:
    Weighed(const WorldScene& scene, const Trial& trial, const RenderOptions& options = {})
        : filter_(trial.filter), options_(options), view_(viewOf(scene, trial.box)), stages_(input()) {}

    test::PixelParts pixel(glm::ivec2 p) { return stages_.pixel(p.x, p.y); }
    const ScreenScene& screen() const { return stages_.screen(); }

    /// By owner; the depth plane of a triangle that can be seen.
    std::map<Owner, DepthPlane> planes() const {
        std::map<Owner, DepthPlane> out;
        for (const ScreenTriangle& t : screen().triangles) out[t.owner] = screen().planes[t.plane];
        return out;
    }

  private:
    MethodInput input() { return {view_.scene, view_.camera, view_.film, filter_, options_, progress_}; }
    Prefilter filter_;
    RenderOptions options_;
    Progress progress_;
    View view_;
    test::NsaaStages stages_;
};

bool samePlane(const DepthPlane& p, const DepthPlane& q) {
    return p.dz_dx == q.dz_dx && p.dz_dy == q.dz_dy && p.z_anchor == q.z_anchor;
}

template <class Ask>
Outcome forPixels(const PixelBox& box, const Ask& ask) {
    for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x)
            if (Outcome outcome = ask(glm::ivec2(x, y)); outcome.wrong) return outcome;
    return {};
}

/// The weights of both, where owner i of `now` was was[i]; none: the same bits, same owners.
std::string differences(const test::PixelParts& before, const test::PixelParts& now,
                        const std::vector<Owner>& was, double allowed) {
    std::map<Owner, FixedWeight> off;
    for (const OwnerWeight& w : before.entries) off[w.owner] += w.weight;
    for (const OwnerWeight& w : now.entries)
        off[w.owner == kBackground || was.empty() ? w.owner : was[w.owner]] -= w.weight;
    for (const auto& [owner, difference] : off) {
        const double size = std::abs(std::ldexp(static_cast<double>(difference), -kWeightBits));
        if (size > allowed)
            return fmt::format("owner {} moved by {:.3g}, allowed {:.3g}", owner, size, allowed);
    }
    return {};
}

exact::Rational depthAt(const ScreenScene& screen, const DepthPlane& plane, glm::dvec2 at_px) {
    return exact::Rational(plane.dz_dx) * exact::Rational(at_px.x - screen.anchor_px.x) +
           exact::Rational(plane.dz_dy) * exact::Rational(at_px.y - screen.anchor_px.y) +
           exact::Rational(plane.z_anchor);
}

/// `now` is the scene written in another way, in which owner i was was[i].
Outcome sameWeights(const Trial& trial, const WorldScene& now, const std::vector<Owner>& was) {
    Weighed a(trial.scene, trial), b(now, trial);
    const auto before = a.planes();
    for (const auto& [owner, plane] : b.planes()) {
        const auto old = before.find(was[owner]);
        if (old == before.end() || !samePlane(old->second, plane)) return kNotAsked;
    }
    return forPixels(trial.box, [&](glm::ivec2 p) -> Outcome {
        const test::PixelParts x = a.pixel(p), y = b.pixel(p);
        std::string what = differences(x, y, was, roundingsOf(x.terms) + roundingsOf(y.terms));
        return what.empty() ? Outcome{} : wrong(p, std::move(what));
    });
}

MethodResult picture(const View& view, const Prefilter& filter, const RenderOptions& options) {
    Progress progress;
    return runMethod(parseMethod("nsaa"), {view.scene, view.camera, view.film, filter, options, progress});
}

Outcome samePicture(const ImageBuffer& whole, const ImageBuffer& part, const char* what) {
    return forPixels(part.box, [&](glm::ivec2 p) -> Outcome {
        const std::size_t i = whole.index(p.x, p.y), k = part.index(p.x, p.y);
        if (whole.rgba[i] == part.rgba[k] && whole.edge[i] == part.edge[k]) return {};
        return wrong(p, what);
    });
}

/// That other cells, which cut the scene elsewhere, leave all but roundings.
Outcome nearPicture(const Trial& trial, const ImageBuffer& a, const ImageBuffer& b) {
    Weighed product(trial.scene, trial);
    return forPixels(a.box, [&](glm::ivec2 p) -> Outcome {
        const double allowed = 2 * product.pixel(p).colorError();
        const glm::dvec4 off = glm::abs(a.rgba[a.index(p.x, p.y)] - b.rgba[b.index(p.x, p.y)]);
        const double most = std::max(std::max(off.r, off.g), std::max(off.b, off.a));
        if (most <= allowed) return {};
        return wrong(p, fmt::format("whole pixels show by {:.3g}, allowed {:.3g}", most, allowed));
    });
}

bool hasNegativeLobes(const Prefilter& filter) {
    return filter.kind == KernelKind::kCubic || filter.kind == KernelKind::kLanczos ||
           filter.kind == KernelKind::kPoly;
}

glm::ivec2 pixelOf(const PixelBox& box, witness::Dice& dice) {
    return {dice.integer(box.x0, box.x1 - 1), dice.integer(box.y0, box.y1 - 1)};
}

/// By owner, the background with what the others leave. `weight` gives a face's.
template <class WeightOf>
std::map<Owner, exact::Real> oracleWeights(const std::vector<exact::Face>& faces, const WeightOf& weight) {
    std::map<Owner, exact::Real> weights;
    exact::Real rest = 1;
    for (const exact::Face& face : faces) {
        const exact::Real w = weight(face);
        weights[face.owner] += w, rest -= w;
    }
    weights[kBackground] = rest;
    return weights;
}

Outcome judgePixel(std::map<Owner, exact::Real> off, const test::PixelParts& parts, glm::ivec2 pixel) {
    const double allowed = roundingsOf(parts.terms);
    for (const OwnerWeight& w : parts.entries) off[w.owner] -= exact::Real(w.weight) / std::pow(2.0, 60);
    for (const auto& [owner, error] : off)
        if (std::abs(static_cast<double>(error)) > allowed)
            return wrong(pixel, fmt::format("owner {} is {:.3g} off the oracle, allowed {:.3g}", owner,
                                            static_cast<double>(error), allowed));
    return {};
}

std::vector<exact::Face> facesAround(const ScreenScene& screen, const PixelBox& box, double radius) {
    const double reach = radius + 1;
    return exact::visibleFaces(screen, {box.x0 - reach, box.y0 - reach, box.x1 + reach, box.y1 + reach});
}

exact::Point sampleOf(glm::ivec2 pixel) {
    return {exact::Rational(pixel.x + 0.5), exact::Rational(pixel.y + 0.5)};
}

/// The volume of p, q, r and s, times 6.
exact::Rational volume(const glm::vec3& p, const glm::vec3& q, const glm::vec3& r, const glm::vec3& s) {
    std::array<std::array<exact::Rational, 3>, 3> m;
    for (int axis = 0; axis < 3; ++axis) {
        m[0][axis] = exact::Rational(double(q[axis])) - exact::Rational(double(p[axis]));
        m[1][axis] = exact::Rational(double(r[axis])) - exact::Rational(double(p[axis]));
        m[2][axis] = exact::Rational(double(s[axis])) - exact::Rational(double(p[axis]));
    }
    exact::Rational sum = 0;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        sum += m[0][i] * (m[1][j] * m[2][k] - m[1][k] * m[2][j]);
    }
    return sum;
}

bool coplanar(const WorldTriangle& s, const WorldTriangle& t) {
    const auto& [a, b, c] = s.p_world;
    return s.node == t.node &&
           std::ranges::all_of(t.p_world, [&](const glm::vec3& p) { return volume(a, b, c, p) == 0; });
}

/// Halves of a triangle at the middle of its side k; none where float32 has no such point.
std::optional<std::pair<WorldTriangle, WorldTriangle>> halves(const WorldTriangle& t, std::size_t k) {
    const glm::vec3 a = t.p_world[k], b = t.p_world[(k + 1) % 3], c = t.p_world[(k + 2) % 3];
    const glm::dvec3 exact = 0.5 * (glm::dvec3(a) + glm::dvec3(b));
    const glm::vec3 middle(exact);
    if (glm::dvec3(middle) != exact || middle == a || middle == b) return std::nullopt;
    return std::pair{WorldTriangle{{a, middle, c}, t.node}, WorldTriangle{{middle, b, c}, t.node}};
}

}  // namespace

Outcome ownersAreTheOracles(const Trial& trial) {
    Trial boxed = trial;
    boxed.filter = makePrefilter("box", {}, {});
    Weighed product(boxed.scene, boxed);
    const exact::Rational radius(boxed.filter.radius);
    const auto faces = facesAround(product.screen(), boxed.box, boxed.filter.radius);
    Outcome outcome = forPixels(boxed.box, [&](glm::ivec2 p) {
        const exact::Point sample = sampleOf(p);
        const auto truth = oracleWeights(faces, [&](const exact::Face& face) {
            return exact::Real(exact::boxWeight(face, sample, radius));
        });
        return judgePixel(truth, product.pixel(p), p);
    });
    if (outcome.wrong) outcome.wrong->filter = boxed.filter.name;
    return outcome;
}

Outcome weightsAreTheOracles(const Trial& trial) {
    constexpr int kPixels = 2;
    Weighed product(trial.scene, trial);
    const auto faces = facesAround(product.screen(), trial.box, trial.filter.radius);
    const exact::KernelWeights kernel(trial.filter);
    witness::Dice dice(trial.seed);
    for (int k = 0; k < kPixels; ++k) {
        const glm::ivec2 p = pixelOf(trial.box, dice);
        const auto truth =
            oracleWeights(faces, [&](const exact::Face& face) { return kernel.of(face, sampleOf(p)).value; });
        Outcome outcome = judgePixel(truth, product.pixel(p), p);
        if (outcome.wrong) return outcome;
    }
    return {};
}

Outcome weightsSumToOne(const Trial& trial) {
    Weighed product(trial.scene, trial);
    return forPixels(trial.box, [&](glm::ivec2 p) -> Outcome {
        const test::PixelParts parts = product.pixel(p);
        if (parts.sum() != kOne) return wrong(p, "the weights do not sum to 1");
        if (parts.label_conflicts != 0) return wrong(p, "the border's labels do not chain");
        for (const OwnerWeight& w : parts.entries)
            if (std::ldexp(static_cast<double>(w.weight), -kWeightBits) < -roundingsOf(parts.terms) &&
                !hasNegativeLobes(trial.filter))
                return wrong(p, fmt::format("owner {} has a negative weight", w.owner));
        return {};
    });
}

Outcome wholePixelsDoNotShow(const Trial& trial) {
    View view = viewOf(trial.scene, trial.box);
    const MethodResult here = picture(view, trial.filter, {});
    witness::Dice dice(trial.seed);
    view.film.debug_offset_px =
        double(kCellPx) * glm::dvec2(dice.integer(-250, 250), dice.integer(-250, 250));
    if (Outcome o = samePicture(here.image, picture(view, trial.filter, {}).image, "whole cells show");
        o.wrong)
        return o;
    view.film.debug_offset_px = {dice.integer(-4000, 4000), dice.integer(-4000, 4000)};
    return nearPicture(trial, here.image, picture(view, trial.filter, {}).image);
}

Outcome splittingATriangleDoesNotShow(const Trial& trial) {
    if (trial.scene.lens == Lens::kPerspective) return kNotAsked;  // the middle is rounded on the screen
    witness::Dice dice(trial.seed);
    const std::size_t count = trial.scene.triangles.size();
    const auto from = std::size_t(dice.integer(0, 1000));
    for (std::size_t k = 0; k < 3 * count; ++k) {
        const std::size_t chosen = (from + k) % count;
        const auto parts = halves(trial.scene.triangles[chosen], k / count);
        if (!parts) continue;
        WorldScene split = trial.scene;
        const auto at = split.triangles.begin() + std::ptrdiff_t(chosen);
        *at = parts->first;
        split.triangles.insert(at + 1, parts->second);
        std::vector<Owner> was(count);
        std::iota(was.begin(), was.end(), Owner{0});
        was.insert(was.begin() + std::ptrdiff_t(chosen) + 1, Owner(chosen));
        return sameWeights(trial, split, was);
    }
    return kNotAsked;
}

Outcome orderDoesNotShow(const Trial& trial) {
    const std::size_t count = trial.scene.triangles.size();
    const auto planes = Weighed(trial.scene, trial).planes();
    witness::Dice dice(trial.seed);
    std::vector<Owner> was(count);
    std::iota(was.begin(), was.end(), Owner{0});
    const auto mayPass = [&](Owner a, Owner b) {
        const auto p = planes.find(a), q = planes.find(b);
        return trial.scene.triangles[a].node == trial.scene.triangles[b].node && p != planes.end() &&
               q != planes.end() && !samePlane(p->second, q->second);
    };
    std::size_t passed = 0;
    for (std::size_t k = 0; count > 1 && k < 4 * count; ++k) {
        const auto i = std::size_t(dice.integer(0, int(count) - 2));
        if (mayPass(was[i], was[i + 1])) std::swap(was[i], was[i + 1]), ++passed;
    }
    if (passed == 0) return kNotAsked;
    WorldScene sorted{{}, trial.scene.lens};
    for (const Owner i : was) sorted.triangles.push_back(trial.scene.triangles[i]);
    return sameWeights(trial, sorted, was);
}

Outcome windingDoesNotShow(const Trial& trial) {
    if (trial.scene.lens == Lens::kPerspective) return kNotAsked;  // what is clipped is cut into other pieces
    WorldScene turned = trial.scene;
    witness::Dice dice(trial.seed);
    for (WorldTriangle& t : turned.triangles)
        if (dice.coin()) std::swap(t.p_world[1], t.p_world[2]);
    const MethodResult a = picture(viewOf(trial.scene, trial.box), trial.filter, {}),
                       b = picture(viewOf(turned, trial.box), trial.filter, {});
    return samePicture(a.image, b.image, "the winding shows");
}

Outcome threadsAndCropsDoNotShow(const Trial& trial) {
    const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 4);
    View view = viewOf(trial.scene, trial.box);
    RenderOptions options;
    options.threads = 1;
    const MethodResult one = picture(view, trial.filter, options);
    options.threads = 3;
    if (Outcome o = samePicture(one.image, picture(view, trial.filter, options).image, "threads show");
        o.wrong)
        return o;
    witness::Dice dice(trial.seed);
    const glm::ivec2 p = pixelOf(trial.box, dice);
    view.film.crop = {p.x, p.y, dice.integer(p.x + 1, trial.box.x1), dice.integer(p.y + 1, trial.box.y1)};
    return samePicture(one.image, picture(view, trial.filter, options).image, "the crop shows");
}

Outcome coplanarTrianglesShareAPlane(const Trial& trial) {
    const View view = viewOf(trial.scene, trial.box);
    const ScreenScene screen = project(view.scene, view.camera, view.film);
    const auto& triangles = trial.scene.triangles;
    std::size_t pairs = 0;
    for (const ScreenTriangle& s : screen.triangles)
        for (const ScreenTriangle& t : screen.triangles) {
            if (s.owner >= t.owner || !coplanar(triangles[s.owner], triangles[t.owner])) continue;
            ++pairs;
            if (s.plane != t.plane)
                return wrong(
                    {trial.box.x0, trial.box.y0},
                    fmt::format("triangles {} and {} are coplanar and have a plane each", s.owner, t.owner));
        }
    return {pairs > 0, std::nullopt};
}

Outcome planesPassThroughTheirCorners(const Trial& trial) {
    if (trial.scene.lens == Lens::kPerspective) return kNotAsked;  // corners are rounded on the screen
    const View view = viewOf(trial.scene, trial.box);
    const ScreenScene screen = project(view.scene, view.camera, view.film);
    for (const ScreenTriangle& t : screen.triangles)
        for (const glm::vec3& corner : trial.scene.triangles[t.owner].p_world) {
            const glm::dvec2 at(kFilmPx / 2 + double(corner.x), kFilmPx / 2 - double(corner.y)),
                d = at - screen.anchor_px;
            const DepthPlane& p = screen.planes[t.plane];
            const double off =
                double(exact::Rational(depthAt(screen, p, at) - exact::Rational(double(corner.z))));
            // Each coefficient is rounded once, from one that double-double has to 2^-100.
            const double size = std::abs(p.dz_dx * d.x) + std::abs(p.dz_dy * d.y) + std::abs(p.z_anchor);
            if (std::abs(off) > (1 + 0x1p-20) * test::kUnit * size + 0x1p-100)
                return wrong({trial.box.x0, trial.box.y0},
                             fmt::format("the plane of triangle {} misses a corner by {:.3g}", t.owner, off));
        }
    return {};
}

Outcome omissionsDoNotShow(const Trial& trial) {
    RenderOptions all;
    all.no_skip = {"all"};
    Weighed a(trial.scene, trial), b(trial.scene, trial, all);
    return forPixels(trial.box, [&](glm::ivec2 p) -> Outcome {
        const test::PixelParts x = a.pixel(p), y = b.pixel(p);
        std::string what = differences(x, y, {}, roundingsOf(x.terms) + roundingsOf(y.terms));
        return what.empty() ? Outcome{} : wrong(p, std::move(what));
    });
}

const std::vector<Property>& allProperties() {
    static const std::vector<Property> all{{"WeightsSumToOne", weightsSumToOne},
                                           {"OwnersAreTheOracles", ownersAreTheOracles},
                                           {"WeightsAreTheOracles", weightsAreTheOracles, 6},
                                           {"WholePixelsDoNotShow", wholePixelsDoNotShow},
                                           {"SplittingATriangleDoesNotShow", splittingATriangleDoesNotShow},
                                           {"OrderDoesNotShow", orderDoesNotShow},
                                           {"WindingDoesNotShow", windingDoesNotShow},
                                           {"ThreadsAndCropsDoNotShow", threadsAndCropsDoNotShow},
                                           {"CoplanarTrianglesShareAPlane", coplanarTrianglesShareAPlane},
                                           {"PlanesPassThroughTheirCorners", planesPassThroughTheirCorners},
                                           {"OmissionsDoNotShow", omissionsDoNotShow}};
    return all;
}

}  // namespace edgewise::property
