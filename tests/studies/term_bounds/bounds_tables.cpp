#include <fmt/format.h>

#include "tests/studies/term_bounds/term_bounds.h"

namespace edgewise::study {
namespace {

bool ofStrips(Claim claim) {
    return claim == Claim::kStrip;
}

std::string rowText(const BoundsRow& r) {
    const double bound = boundOf(r.claim);
    return fmt::format("| {} | {} | {} | {} | {:.3g} | {:.3g} | {} | {} | {:.1e} | {:.1e} | {} |\n",
                       nameOf(r.claim), nameOf(r.category), r.cases, r.hard, r.judged, r.screened,
                       std::isinf(bound) ? "none" : fmt::format("{:.0f}", bound), r.judged_cases,
                       r.disagreement, r.reported, r.worst_kernel);
}

std::string claimTable(const BoundsResult& result, Claim claim) {
    std::string text;
    for (const BoundsRow& row : result.rows)
        if (row.claim == claim) text += rowText(row);
    return text;
}

/// Over all categories.
std::string kernelTable(const BoundsResult& result, Claim claim) {
    const std::vector<std::string> names = kernelNames(!ofStrips(claim));
    std::string text;
    for (std::size_t k = 0; k < names.size(); ++k) {
        double worst = 0;
        for (const BoundsRow& row : result.rows)
            if (row.claim == claim) worst = std::max(worst, row.by_kernel[k]);
        text += fmt::format("| {} | {} | {:.3g} |\n", nameOf(claim), names[k], worst);
    }
    return text;
}

}  // namespace

std::string boundsTable(const BoundsResult& result) {
    std::string text = fmt::format(
        "seed {}, at least {} edges that meet the support in each category, of radial kernels, of separable "
        "ones "
        "and of triangles; kernels take turns. Errors in u = 2^-53.\n\n"
        "| claim | category | cases | hard | worst, 50 digits | worst, screen | bound | judged | "
        "disagreement | "
        "judge's own | kernel |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
        result.options.seed, result.options.edges);
    for (int c = 0; c < kClaims; ++c) text += claimTable(result, static_cast<Claim>(c));
    text +=
        "\nBy kernel, over all categories, by the screen:\n\n| claim | kernel | worst |\n| --- | --- | --- "
        "|\n";
    for (int c = 0; c < kClaims; ++c) text += kernelTable(result, static_cast<Claim>(c));
    return text + fmt::format("\nterms in fixed point that are not the term seen, rounded: {}\n",
                              result.unequal_bits);
}

std::string boundsCsv(const BoundsResult& result) {
    std::string text =
        "claim,category,seed,cases,hard,worst_u,screened_u,bound_u,judged,disagreement_u,judge_error_u,"
        "kernel,"
        "a_x,a_y,b_x,b_y\n";
    for (const BoundsRow& r : result.rows)
        text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},\"{}\",{},{},{},{}\n", nameOf(r.claim),
                            nameOf(r.category), result.options.seed, r.cases, r.hard, r.judged, r.screened,
                            boundOf(r.claim), r.judged_cases, r.disagreement, r.reported, r.worst_kernel,
                            r.worst_edge.a.x, r.worst_edge.a.y, r.worst_edge.b.x, r.worst_edge.b.y);
    return text;
}

}  // namespace edgewise::study
