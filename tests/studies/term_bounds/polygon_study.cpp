#include <algorithm>
#include <array>
#include <cmath>

#include "analytic/carrier.h"
#include "tests/analytic/triangle_map.h"
#include "tests/studies/term_bounds/claim_tally.h"
#include "tests/studies/term_bounds/edge_study.h"
#include "tests/studies/term_bounds/errors.h"

namespace edgewise::study {
namespace {

using test::MapSegment;
using test::MapTriangle;
using Vec = glm::dvec2;

/// Exact sign of the doubled area of a, b, c.
double orientation(Vec a, Vec b, Vec c) {
    const Wide doubled = exactDifference(b.x, a.x) * exactDifference(c.y, a.y) -
                         exactDifference(b.y, a.y) * exactDifference(c.x, a.x);
    return doubled.v.hi;
}

/// Corners relative to the sample, in the direction of growing angle.
using Corners = std::array<Vec, 3>;

Vec apexOf(const Edge& e, double R, witness::Dice& dice) {
    const Vec along = e.b - e.a, across(-along.y, along.x);
    switch (dice.integer(0, 2)) {
        case 0:  // a sliver
            return e.a + dice.uniform(-0.5, 1.5) * along + smallNumber(dice, 0, 40) * across;
        case 1:  // of the edge's own size
            return e.a + dice.uniform(-1, 2) * along + dice.uniform(0.1, 1) * across;
        default:
            return dice.uniform(0, 1.3) * R * witness::unitVector(dice.angle());
    }
}

/// A triangle on the edge, or several around its first end.
std::vector<Corners> trianglesOn(const Edge& e, double R, witness::Dice& dice) {
    std::vector<Corners> out;
    if (dice.integer(0, 2) > 0) {
        out.push_back({e.a, e.b, onGrid(apexOf(e, R, dice))});
        return out;
    }
    const int count = dice.integer(2, 5);
    const Vec spoke = e.b - e.a;
    Vec before = e.b;
    double angle = 0;
    for (int i = 0; i < count; ++i) {
        angle += dice.uniform(0.1, 0.95) * 2 * M_PI / count;
        const double c = std::cos(angle), s = std::sin(angle), stretch = dice.uniform(0.2, 1.5);
        const Vec next = onGrid(e.a + stretch * Vec(c * spoke.x - s * spoke.y, s * spoke.x + c * spoke.y));
        out.push_back({e.a, before, next});
        before = next;
    }
    return out;
}

/// Turned to grow in angle; false where one is degenerate, or a fan's order was lost on the grid.
bool settle(std::vector<Corners>& triangles) {
    for (Corners& t : triangles) {
        const double sign = orientation(t[0], t[1], t[2]);
        if (sign == 0 || (sign < 0 && triangles.size() > 1)) return false;
        if (sign < 0) std::swap(t[1], t[2]);
    }
    return true;
}

Edge side(const Corners& t, int i) {
    return {t[static_cast<std::size_t>(i)], t[static_cast<std::size_t>((i + 1) % 3)]};
}

/// The weights of all triangles by the product's whole way.
class MapWeights {
  public:
    explicit MapWeights(const StudyKernel& kernel) : radius_(kernel.spots.R), weights_(kernel.filter) {}

    /// False where the map is not one: double arithmetic cannot tell a sliver's side.
    bool measure(const std::vector<Corners>& triangles, std::vector<FixedWeight>& out) {
        std::vector<MapTriangle> map;
        for (const Corners& t : triangles)
            map.push_back(
                {{t[0] + kSample, t[1] + kSample, t[2] + kSample}, static_cast<Owner>(map.size() + 1)});
        for (const MapTriangle& t : map)
            for (int i = 0; i < 3; ++i)
                if (test::cross(t.p[(i + 1) % 3] - t.p[i], t.p[(i + 2) % 3] - t.p[i]) <= 0) return false;
        std::vector<MapSegment> segments = test::segmentsOf(map);
        for (MapSegment& s : segments) {
            s.line = carrierLine({LineRef::edge(0, 0), s.segment.a.grid, s.segment.b.grid});
            s.segment.length = distance(s.segment.a, s.segment.b);
        }
        const test::Weights found = test::weightsOf(weights_, radius_, map, segments, kSample, 1);
        out.clear();
        for (const MapTriangle& t : map) {
            const auto weight = found[0].find(t.owner);
            out.push_back(weight == found[0].end() ? 0 : weight->second);
        }
        return true;
    }

  private:
    double radius_;
    PixelWeights weights_;
};

struct PolygonCase {
    std::size_t kernel;
    Corners corners;
    FixedWeight weight;
    Edge edge;  ///< its first side, for the report
};

struct Sides {
    Wide terms = 0.0;  ///< the sum of the terms before they are rounded
    int touched = 0, clipped = 0;
};

Sides observeSides(const StudyKernel& kernel, const Corners& corners) {
    Sides sides;
    for (int i = 0; i < 3; ++i) {
        const Edge e = side(corners, i), c = canonical(e);
        const ObservedTerm seen = observe(kernel.kernel, c);
        sides.terms += c.a == e.a ? Wide(seen.term) : -Wide(seen.term);
        sides.touched += seen.touched;
        sides.clipped += seen.clipped();
    }
    return sides;
}

template <class Number>
Number fromWide(Wide x) {
    if constexpr (std::is_same_v<Number, Wide>)
        return x;
    else
        return Number(x.v.hi) + Number(x.v.lo);
}

template <class Number>
double errorOf(Claim claim, const Truth<Number>& truth, const StudyKernel& kernel, const PolygonCase& c,
               double& reported) {
    const Sides sides = observeSides(kernel, c.corners);
    Number exact = Number(0.0);
    double fans = 0;
    for (int i = 0; i < 3; ++i) {
        const Number fan = truth.total(side(c.corners, i));
        exact = exact + fan;
        fans += std::abs(static_cast<double>(fan));
        if constexpr (!std::is_same_v<Number, Wide>) reported += kernel.judge.reported();
    }
    const Number found =
        claim == Claim::kPolygonInside ? fromWide<Number>(sides.terms) : fromFixed<Number>(c.weight);
    const double off = std::abs(static_cast<double>(Number(found - exact))) / kU;
    const double scale = claim == Claim::kPolygonAcross ? fans + sides.clipped : fans;
    return off == 0 ? 0 : off / scale;
}

class PolygonStudy {
  public:
    PolygonStudy(const StudyKernels& kernels, Category category, BoundsResult& result)
        : kernels_(kernels), category_(category), result_(result) {
        for (int c = 0; c < kClaims; ++c)
            tally_.emplace_back(static_cast<Claim>(c), category, result.options, kernels.size());
        for (const auto& kernel : kernels) weights_.push_back(std::make_unique<MapWeights>(*kernel));
    }

    void run() {
        witness::Dice dice(streamSeed(result_.options, category_, 2));
        constexpr long kMostAttempts = 50;
        for (long i = 0; sides_ < result_.options.edges && i < kMostAttempts * result_.options.edges; ++i) {
            const std::size_t k = static_cast<std::size_t>(i) % kernels_.size();
            consider(k, makeEdge(category_, kernels_[k]->spots, dice), dice);
        }
        for (const Claim claim : {Claim::kPolygonInside, Claim::kPolygonAcross, Claim::kPolygonLiteral})
            keep(claim);
    }

  private:
    void consider(std::size_t k, const Edge& edge, witness::Dice& dice) {
        std::vector<Corners> triangles = trianglesOn(edge, kernels_[k]->spots.R, dice);
        std::vector<FixedWeight> fixed;
        if (!settle(triangles) || !weights_[k]->measure(triangles, fixed)) return;
        const bool hard = isHard(category_, kernels_[k]->spots, edge);
        for (std::size_t i = 0; i < triangles.size(); ++i)
            hard_ += considerOne({k, triangles[i], fixed[i], side(triangles[i], 0)}) && hard;
    }

    bool considerOne(const PolygonCase& c) {
        const Sides sides = observeSides(*kernels_[c.kernel], c.corners);
        if (sides.touched == 0) return false;
        sides_ += sides.touched;
        if (sides.clipped > 0) {
            screen(Claim::kPolygonAcross, c);
            screen(Claim::kPolygonLiteral, c);
        } else if (sides.touched == 3) {
            screen(Claim::kPolygonInside, c);
            // a rounding of 2^-61 a side, and nothing else, is between the terms and the weight
            const Wide rounding = fromFixed<Wide>(c.weight) - sides.terms;
            result_.unequal_bits += abs(rounding) > Wide(3 * 0x1p-61);
        }
        return true;
    }

    void screen(Claim claim, const PolygonCase& c) {
        double unused = 0;
        const StudyKernel& kernel = *kernels_[c.kernel];
        const double error = errorOf(claim, *kernel.screen, kernel, c, unused);
        tally_[static_cast<std::size_t>(claim)].offer(error, c.kernel, c);
    }

    void keep(Claim claim) {
        BoundsRow row = tally_[static_cast<std::size_t>(claim)].finish(
            [&](const PolygonCase& c) {
                const StudyKernel& kernel = *kernels_[c.kernel];
                Verdict verdict;
                verdict.error = errorOf<exact::Real>(claim, kernel.judge, kernel, c, verdict.reported);
                verdict.reported /= kU;
                return verdict;
            },
            [&](const PolygonCase& c) { return kernels_[c.kernel]->name; });
        row.hard = hard_;
        result_.rows.push_back(row);
    }

    const StudyKernels& kernels_;
    Category category_;
    BoundsResult& result_;
    long sides_ = 0, hard_ = 0;
    std::vector<std::unique_ptr<MapWeights>> weights_;
    std::vector<ClaimTally<PolygonCase>> tally_;
};

}  // namespace

void studyPolygons(const StudyKernels& kernels, Category category, BoundsResult& result) {
    PolygonStudy(kernels, category, result).run();
}

}  // namespace edgewise::study
