// "Paper says / we measure / why they differ".
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "paper_figures/figure.h"

namespace edgewise::figures {

struct ClaimsOf {
    const Figure* figure;
    std::string page;  ///< relative to the page that holds the table; empty: no link
    std::vector<FigureClaim> claims;
};

/// A sortable table; nothing where there are no claims.
std::string claimsHtml(const std::vector<ClaimsOf>& all);
/// figure, of, place, claim, paper, ours, unit, why.
std::string claimsCsv(const std::vector<ClaimsOf>& all);

}  // namespace edgewise::figures
