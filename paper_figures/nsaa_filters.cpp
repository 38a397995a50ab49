// NSAA, Figure 6: filters of one radius, and whether a sampler's error would drown what they differ by.
#include <fmt/format.h>

#include "paper_figures/nsaa_patterns.h"
#include "paper_figures/page_parts.h"

namespace edgewise::figures {
namespace {

constexpr const char* kPoly = "poly:1,-3,3,-1";
constexpr double kRadius = 2.0;

std::vector<PatternMethod> methods() {
    return {{"csaa:32", "", {}, "csaa:32"},
            {"nsaa", "box", 0.5, "nsaa, box of a pixel: what csaa:32 stands for"},
            {"nsaa", "disk", kRadius, "nsaa, disk R 2 (the paper's box)"},
            {"nsaa", "cone", kRadius, "nsaa, cone R 2 (the paper's tent)"},
            {"nsaa", "gaussian", kRadius, "nsaa, gaussian R 2"},
            {"nsaa", kPoly, kRadius, "nsaa, (1 - r^2/R^2)^3, R 2"}};
}

double rmse(const ImageBuffer& a, const ImageBuffer& b) {
    return judge::compareImages(a, b).rmse;
}

/// The paper's claim in numbers.
struct Dominance {
    double csaa = 0.0;     ///< csaa:32 against the integral over its own box
    double filters = 0.0;  ///< the largest of the differences between two of the paper's filters
    std::string between;
};

/// Of what `seen` leaves of each picture.
template <class Seen>
Dominance dominanceOf(const PatternPictures& found, const Seen& seen) {
    Dominance out{rmse(seen(found.row("csaa:32").image), seen(found.row("nsaa", "box").image)), 0.0, ""};
    constexpr const char* kPaper[]{"disk", "cone", "gaussian"};
    for (const char* a : kPaper)
        for (const char* b : kPaper) {
            const double apart = rmse(seen(found.row("nsaa", a).image), seen(found.row("nsaa", b).image));
            if (apart > out.filters) out.filters = apart, out.between = fmt::format("{} and {}", a, b);
        }
    return out;
}

FigureClaim claimOf(const std::string& where, const Dominance& found) {
    return {"Figure 6",
            "sampling's error over what filters differ by, " + where,
            "> 1 (aliasing would dominate)",
            fmt::format("{:.3f} (csaa:32 {:.4f}; {} {:.4f})", found.csaa / found.filters, found.csaa,
                        found.between, found.filters),
            "",
            found.csaa > found.filters
                ? ""
                : "by root mean square the paper's filters differ by more: a disk blurs what a "
                  "Gaussian keeps, everywhere, and csaa:32 errs by little where it errs (its positions are "
                  "ours)"};
}

void addClaims(const PatternPictures& found, std::vector<FigureClaim>& claims) {
    constexpr int kTimes = 4;
    claims.push_back(claimOf(found.plan.scene, dominanceOf(found, [](const ImageBuffer& i) { return i; })));
    claims.push_back(
        claimOf(fmt::format("{}, at frequencies that {} times fewer pixels hold", found.plan.scene, kTimes),
                dominanceOf(found, [](const ImageBuffer& i) { return shrunk(i, kTimes); })));
}

}  // namespace

std::vector<FigureFile> makeNsaaFilters(const FigureInput& input) {
    std::string body, csv;
    std::vector<FigureFile> pictures;
    FigureWords words{
        "nsaa-6",
        "Filters of radius 2",
        "After NSAA's Figure 6: disk, cone and Gaussian of radius 2 beside CSAA. Which kernel the "
        "paper integrates is not published in full, and its conclusion speaks of polynomials: "
        "(1 - r^2/R^2)^3 stands in for them. The figure filter-study goes on with frequency "
        "responses, ringing and aliasing of all filters.",
        {{"R", "2 px for all kernels; csaa:32 has its own box of a pixel"},
         {"sigma", "R/3 (not published: ours)"},
         {"device", "cpu"},
         {"seed", "none"}},
        {},
        input.quick};
    for (PatternPlan plan : {zonePlatePlan(input.quick), logGridPlan(input.quick)}) {
        plan.methods = methods();
        const PatternPictures found = makePatternPictures(plan, input.progress);
        addClaims(found, input.claims);
        body += pictureRowsHtml(found.pictures) + "<h2>Errors</h2>" + patternTable(found);
        const std::string rows = patternCsv(found);
        csv += csv.empty() ? rows : rows.substr(rows.find('\n') + 1);
        appendPictureFiles(found.pictures, pictures);
        for (const PatternMethod& method : plan.methods) words.commands.push_back(commandOf(plan, method));
    }
    std::vector<FigureFile> files{{"report.html", figurePage(words, body)}, {"results.csv", csv}};
    files.insert(files.end(), pictures.begin(), pictures.end());
    return files;
}

}  // namespace edgewise::figures
