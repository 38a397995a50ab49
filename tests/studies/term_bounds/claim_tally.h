// What one claim met in one category, and its row.
#pragma once

#include <cmath>
#include <string>

#include "tests/studies/term_bounds/term_bounds.h"
#include "tests/studies/term_bounds/worst_cases.h"

namespace edgewise::study {

/// What the judge says of a kept case.
struct Verdict {
    double error = 0.0, reported = 0.0;  ///< in u
};

template <class Case>
class ClaimTally {
  public:
    ClaimTally(Claim claim, Category category, const BoundsOptions& options, std::size_t kernels)
        : worst_(static_cast<std::size_t>(options.judged)) {
        row_.claim = claim, row_.category = category;
        row_.by_kernel.assign(kernels, 0.0);
    }

    void offer(double error, std::size_t kernel, const Case& found) {
        ++row_.cases;
        row_.screened = std::max(row_.screened, error);
        row_.by_kernel[kernel] = std::max(row_.by_kernel[kernel], error);
        worst_.offer(error, found);
    }

    /// `judge` maps a case to its Verdict, `describe` the worst one to its kernel's name.
    template <class JudgeCase, class NameOf>
    BoundsRow finish(const JudgeCase& judge, const NameOf& kernelOf) {
        for (const auto& kept : worst_.all()) {
            const Verdict verdict = judge(kept.found);
            ++row_.judged_cases;
            row_.reported = std::max(row_.reported, verdict.reported);
            row_.disagreement = std::max(row_.disagreement, std::abs(verdict.error - kept.error));
            if (verdict.error < row_.judged || (row_.judged_cases > 1 && verdict.error == row_.judged))
                continue;
            row_.judged = verdict.error;
            row_.worst_kernel = kernelOf(kept.found);
            row_.worst_edge = kept.found.edge;
        }
        return row_;
    }

  private:
    BoundsRow row_{};
    WorstCases<Case> worst_;
};

}  // namespace edgewise::study
