#include "tests/studies/term_bounds/edge_study.h"

#include "tests/studies/term_bounds/claim_tally.h"
#include "tests/studies/term_bounds/errors.h"

namespace edgewise::study {
namespace {

/// A category that met the support in fewer of its edges would never end.
constexpr long kMostAttempts = 50;

struct EdgeCase {
    std::size_t kernel;
    Edge edge;
};

bool insideFlags(Claim claim, double coordinate, double radius, bool crossed) {
    return claim == Claim::kStrip ? coordinate > radius : crossed;
}

template <class Number>
double errorOf(Claim claim, const Truth<Number>& truth, double radius, const Edge& e,
               const ObservedTerm& seen) {
    if (claim == Claim::kFanInside) return insideError(truth, e, seen);
    if (claim == Claim::kFanPiece) return pieceError(truth, e, seen);
    // an untouched edge counts as one whose ends are both outside
    const bool a_out = insideFlags(claim, e.a.x, radius, seen.entered || !seen.touched);
    const bool b_out = insideFlags(claim, e.b.x, radius, seen.left || !seen.touched);
    return settledError(truth, e, seen, a_out, b_out);
}

/// The product's fixed-point term is the one seen, rounded to the nearest 2^-60.
bool sameBits(const ObservedTerm& seen, const EdgeTerms& product) {
    const bool equal =
        seen.fixed.value[0] == product.value[0] && seen.touched == bool(product.touched & 1u) &&
        seen.entered == bool(product.crossed[0] & 1u) && seen.left == bool(product.crossed[1] & 1u);
    const Wide rounding = fromFixed<Wide>(product.value[0]) - Wide(seen.term);
    return equal && !(abs(rounding) > Wide(0x1p-61));
}

class EdgeStudy {
  public:
    EdgeStudy(const StudyKernels& kernels, Category category, BoundsResult& result)
        : kernels_(kernels), category_(category), result_(result), radial_(kernels[0]->spots.radial) {
        for (int c = 0; c < kClaims; ++c)
            tally_.emplace_back(static_cast<Claim>(c), category, result.options, kernels.size());
    }

    void run() {
        witness::Dice dice(streamSeed(result_.options, category_, radial_ ? 0 : 1));
        long& met = result_.edges[radial_ ? 0 : 1][static_cast<int>(category_)];
        for (long i = 0; met < result_.options.edges && i < kMostAttempts * result_.options.edges; ++i) {
            const std::size_t k = static_cast<std::size_t>(i) % kernels_.size();
            met += consider(k, canonical(makeEdge(category_, kernels_[k]->spots, dice)));
        }
        if (radial_)
            for (const Claim claim : {Claim::kFanInside, Claim::kFanPiece, Claim::kFanSettled}) keep(claim);
        else
            keep(Claim::kStrip);
    }

  private:
    bool consider(std::size_t k, const Edge& edge) {
        const StudyKernel& kernel = *kernels_[k];
        const ObservedTerm seen = observe(kernel.kernel, edge);
        EdgeTerms product{};
        const EdgeInput input = inputOf(edge);
        const EdgePair pair{&input, kSample.x, kSample.y};
        product_terms_(kernel.kernel.lanes, &pair, 1, product);
        result_.unequal_bits += !sameBits(seen, product);
        if (!radial_)
            screen(Claim::kStrip, k, edge, seen);
        else if (seen.touched && !seen.clipped())
            screen(Claim::kFanInside, k, edge, seen);
        else {
            if (seen.touched) screen(Claim::kFanPiece, k, edge, seen);
            screen(Claim::kFanSettled, k, edge, seen);
        }
        if (!seen.touched) return false;
        hard_ += isHard(category_, kernel.spots, edge);
        return true;
    }

    void screen(Claim claim, std::size_t k, const Edge& edge, const ObservedTerm& seen) {
        const double error = errorOf(claim, *kernels_[k]->screen, kernels_[k]->spots.R, edge, seen);
        tally_[static_cast<std::size_t>(claim)].offer(error, k, {k, edge});
    }

    void keep(Claim claim) {
        BoundsRow row = tally_[static_cast<std::size_t>(claim)].finish(
            [&](const EdgeCase& c) {
                const StudyKernel& kernel = *kernels_[c.kernel];
                const ObservedTerm seen = observe(kernel.kernel, c.edge);
                const double error = errorOf(claim, kernel.judge, kernel.spots.R, c.edge, seen);
                return Verdict{error, kernel.judge.reported() / kU};
            },
            [&](const EdgeCase& c) { return kernels_[c.kernel]->name; });
        row.hard = hard_;
        result_.rows.push_back(row);
    }

    const StudyKernels& kernels_;
    Category category_;
    BoundsResult& result_;
    bool radial_;
    long hard_ = 0;
    EdgeTermsFunction product_terms_ = chooseEdgeTerms();
    std::vector<ClaimTally<EdgeCase>> tally_;
};

}  // namespace

std::uint64_t streamSeed(const BoundsOptions& options, Category category, int stream) {
    return options.seed * 64 + static_cast<std::uint64_t>(stream * 16 + static_cast<int>(category));
}

void studyEdges(const StudyKernels& kernels, Category category, BoundsResult& result) {
    EdgeStudy(kernels, category, result).run();
}

}  // namespace edgewise::study
