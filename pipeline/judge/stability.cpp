#include "pipeline/judge/stability.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "analytic/exact/kernel_weights.h"
#include "analytic/pixel_weights.h"
#include "analytic/row_owners.h"
#include "analytic/visibility.h"
#include "pipeline/error.h"
#include "pipeline/judge/stability_cases.h"
#include "pipeline/methods/stopwatch.h"

namespace edgewise::judge {
namespace {

using exact::Real;

/// Of a weight in fp32.
constexpr double kFloatBound = 64.0 * 0x1p-24;

struct Weighed {
    std::map<Owner, FixedWeight> weights;
    FixedWeight sum = 0;
    std::uint64_t terms = 0, conflicts = 0;
    double seconds = 0.0;
};

struct Product {
    VisibleMap map;
    VisibilityCounts counts;
    double seconds = 0.0;
    Weighed fp64, fp32;
};

Window windowAround(glm::ivec2 pixel, double radius) {
    const int reach = static_cast<int>(std::ceil(radius)) + 2;
    return {pixel.x - reach, pixel.y - reach, pixel.x + reach + 1, pixel.y + reach + 1};
}

Weighed weigh(const VisibleMap& map, glm::ivec2 pixel, const Prefilter& filter, Precision precision) {
    Weighed out;
    Stopwatch watch;
    const glm::dvec2 sample = glm::dvec2(pixel) + 0.5;
    PixelWeights engine(filter, precision);
    engine.begin(sample, 1);
    for (const VisibleSegment& s : map.segments) engine.add(s, map.lines[s.line], s.left, s.right);
    const Owner base = ownerOnRow(map, pixel.y, sample.x + filter.radius);
    std::vector<OwnerWeight> weights;
    std::size_t offset[2] = {0, 0};
    engine.finish(&base, weights, offset);
    out.seconds = watch.lap();
    for (const OwnerWeight& w : weights) out.weights[w.owner] = w.weight, out.sum += w.weight;
    out.terms = engine.terms();
    out.conflicts = engine.label_conflicts();
    return out;
}

Product runProduct(const StiffScene& stiff, const Prefilter& filter) {
    Product out;
    Stopwatch watch;
    out.map = visibleMap(stiff.scene, windowAround(stiff.pixel, filter.radius), {}, &out.counts);
    out.seconds = watch.lap();
    out.fp64 = weigh(out.map, stiff.pixel, filter, Precision::kFp64);
    out.fp32 = weigh(out.map, stiff.pixel, filter, Precision::kFp32);
    return out;
}

struct Truth {
    exact::Region box;  ///< around the support
    std::vector<exact::Face> faces;
    std::map<Owner, Real> weights;
    Real error = 0;
};

Truth runOracle(const StiffScene& stiff, const Prefilter& filter) {
    const glm::dvec2 sample = glm::dvec2(stiff.pixel) + 0.5;
    const double reach = filter.radius;
    const exact::KernelWeights kernel(filter);
    const exact::Point at{exact::Rational(sample.x), exact::Rational(sample.y)};
    Truth truth;
    truth.box = {sample.x - reach, sample.y - reach, sample.x + reach, sample.y + reach};
    truth.faces = exact::visibleFaces(stiff.scene, truth.box);
    Real rest = 1;
    for (const exact::Face& face : truth.faces) {
        const exact::Weight w = kernel.of(face, at);
        truth.weights[face.owner] += w.value;
        truth.error += w.error;
        rest -= w.value;
    }
    truth.weights[kBackground] = rest;
    return truth;
}

/// One unit in the last place that a number of this size has.
double lastPlace(double size, Precision precision) {
    if (precision == Precision::kFp64) return std::nextafter(size, 2.0) - size;
    const auto rounded = static_cast<float>(size);
    return static_cast<double>(std::nextafter(rounded, 2.0f)) - static_cast<double>(rounded);
}

/// All owners that either sees.
std::size_t judgeWeights(const Weighed& product, const Truth& truth, Precision precision, WeightErrors& out) {
    constexpr double kSizeable = 0x1p-30;
    const double bound = promisedBound(product.terms, precision);
    const double seen = std::max(0x1p-50, bound);  // less may be the rounding of all of a weight
    auto all = truth.weights;
    for (const auto& [owner, weight] : product.weights) all.try_emplace(owner, 0);
    for (const auto& [owner, exact_weight] : all) {
        const auto found = product.weights.find(owner);
        const FixedWeight fixed = found == product.weights.end() ? 0 : found->second;
        const double error = std::abs(static_cast<double>(Real(Real(fixed) * Real(0x1p-60) - exact_weight)));
        const double size = std::abs(static_cast<double>(exact_weight));
        if (error > out.max_error) out.max_error = error, out.bound = bound;
        out.worst_of_bound = std::max(out.worst_of_bound, error / bound);
        if (size >= kSizeable) {
            out.max_relative = std::max(out.max_relative, error / size);
            out.max_error_ulp = std::max(out.max_error_ulp, error / lastPlace(size, precision));
        }
        out.ownership_errors += (fixed == 0) != (size < 0x1p-61) && std::max(size, error) >= seen;
    }
    if (out.bound == 0.0) out.bound = bound;
    out.partition_defect =
        std::max(out.partition_defect,
                 std::abs(std::ldexp(double(product.sum - (FixedWeight{1} << kWeightBits)), -60)));
    out.label_conflicts += product.conflicts;
    return all.size();
}

void judge(const Product& product, const Truth& truth, StabilityRow& row) {
    row.weights += judgeWeights(product.fp64, truth, Precision::kFp64, row);
    judgeWeights(product.fp32, truth, Precision::kFp32, row.fp32);
    row.exact_depths += product.counts.exact_depth;
    row.fine_orders += product.counts.fine_orders;
    row.closings += product.counts.closings;
    row.seconds += product.seconds + product.fp64.seconds;
    row.fp32.seconds += product.seconds + product.fp32.seconds;
    row.oracle_error = std::max(row.oracle_error, static_cast<double>(truth.error));
    ++row.scenes;
}

std::optional<Prefilter> filterOf(const StabilityCase& one, const Prefilter& filter, double difficulty) {
    return one.filter ? one.filter(difficulty, filter) : filter;
}

StabilityRow runRow(const StabilityCase& one, const Prefilter& filter, double difficulty, int scenes,
                    Progress& progress) {
    StabilityRow row;
    row.case_name = one.name, row.filter = filter.name, row.condition = difficulty;
    const Prefilter used = filterOf(one, filter, difficulty).value();
    for (int seed = 1; seed <= scenes; ++seed) {
        if (progress.cancelled()) throw Interrupted();
        const StiffScene stiff = one.make(difficulty, used, static_cast<std::uint64_t>(seed));
        const Product product = runProduct(stiff, used);
        const Truth truth = runOracle(stiff, used);
        judge(product, truth, row);
        judgeMap(stiff.scene, truth.faces, product.map, truth.box, row);
        if (!stiff.projection) continue;
        if (!row.projection) row.projection.emplace();
        row.projection->add(*stiff.projection);
    }
    row.seconds /= scenes, row.fp32.seconds /= scenes;
    return row;
}

std::vector<const StabilityCase*> chosenCases(const std::vector<std::string>& names) {
    std::vector<const StabilityCase*> chosen;
    std::vector<std::string> known;
    for (const StabilityCase& one : stabilityCases()) {
        known.push_back(one.name);
        if (names.empty() || std::ranges::find(names, one.name) != names.end()) chosen.push_back(&one);
    }
    for (const std::string& name : names)
        if (std::ranges::find(known, name) == known.end())
            throw InputError("--case", fmt::format("'{}' is none of {}", name, fmt::join(known, ", ")));
    return chosen;
}

bool withinBounds(const WeightErrors& e) {
    return e.worst_of_bound <= 1.0 && e.ownership_errors == 0 && e.partition_defect == 0.0 &&
           e.label_conflicts == 0;
}

}  // namespace

double promisedBound(std::uint64_t terms, Precision precision) {
    if (precision == Precision::kFp32) return kFloatBound;
    return static_cast<double>(terms) * (10.0 * 0x1p-53 + 0x1p-61) + 0x1p-61;
}

void judgeMap(const ScreenScene& scene, const std::vector<exact::Face>& faces, const VisibleMap& map,
              const exact::Region& box, StabilityRow& row) {
    if (scene.triangles.size() > kMostTrianglesCompared) {
        row.map_left_out = "too many triangles";
        return;
    }
    if (!row.map) row.map.emplace();
    row.map->add(compareMaps(scene, faces, map, box));
}

bool keepsPromises(const StabilityRow& r) {
    const bool placed = !r.projection || (r.projection->worst_of_bound <= 1.0 && r.projection->cracks == 0 &&
                                          r.projection->lost_areas == 0);
    const bool mapped = !r.map || r.map->good();
    return placed && mapped && withinBounds(r) && withinBounds(r.fp32);
}

void checkCases(const StabilityOptions& options) {
    chosenCases(options.cases);
}

std::vector<StabilityRow> runStability(const StabilityOptions& options, Progress& progress) {
    struct Task {
        const StabilityCase* one;
        const Prefilter* filter;
        double difficulty;
    };
    std::vector<Task> tasks;
    for (const StabilityCase* one : chosenCases(options.cases))
        for (const Prefilter& filter : options.filters)
            for (std::size_t i = 0; i < one->difficulties.size();
                 i += static_cast<std::size_t>(options.every))
                if (filterOf(*one, filter, one->difficulties[i]))
                    tasks.push_back({one, &filter, one->difficulties[i]});
    std::vector<StabilityRow> rows(tasks.size());
    progress.stage("stability", tasks.size());
    // CGAL's lazy numbers share nodes between threads without a lock: one thread.
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        rows[i] = runRow(*tasks[i].one, *tasks[i].filter, tasks[i].difficulty, options.scenes, progress);
        progress.advance(1);
    }
    return rows;
}

}  // namespace edgewise::judge
