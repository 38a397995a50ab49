#include "tests/studies/term_bounds/term_bounds.h"

#include <algorithm>
#include <limits>

#include "tests/studies/term_bounds/edge_study.h"

namespace edgewise::study {

const char* nameOf(Claim claim) {
    constexpr std::array<const char*, kClaims> kNames = {"fan inside",     "fan piece",      "fan settled",
                                                         "strip",          "polygon inside", "polygon across",
                                                         "polygon literal"};
    return kNames[static_cast<std::size_t>(claim)];
}

double boundOf(Claim claim) {
    constexpr double kTerm = 16, kPolygon = 10;
    switch (claim) {
        case Claim::kPolygonInside:
        case Claim::kPolygonAcross:
            return kPolygon;
        case Claim::kPolygonLiteral:
            return std::numeric_limits<double>::infinity();
        default:
            return kTerm;
    }
}

BoundsResult measureBounds(const BoundsOptions& options) {
    BoundsResult result;
    result.options = options;
    const StudyKernels radial = makeStudyKernels(true), separable = makeStudyKernels(false);
    for (int c = 0; c < kCategories; ++c) {
        const std::vector<int>& wanted = options.categories;
        if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), c) == wanted.end()) continue;
        const Category category = static_cast<Category>(c);
        studyEdges(radial, category, result);
        studyEdges(separable, category, result);
        studyPolygons(radial, category, result);
    }
    return result;
}

}  // namespace edgewise::study
