// The bounds that the docstrings promise of terms and polygons, measured: every edge against a screen of 106
// bits, the worst of each category against the oracle's 50 digits.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/studies/term_bounds/adversarial_edges.h"

namespace edgewise::study {

/// What is bounded, and how an error is measured; u = 2^-53.
enum class Claim {
    kFanInside,      ///< F_in of an edge with both ends inside, before its rounding: relative
    kFanPiece,       ///< F_in of a clipped edge, between the clip points that the code uses: relative
    kFanSettled,     ///< F_in and the crossings' positions of a clipped or untouched edge, in fixed point:
                     ///< absolute
    kStrip,          ///< S_in and the crossings' positions of any edge, in fixed point: absolute
    kPolygonInside,  ///< triangles that do not cross the border, terms before rounding: over sum |F_e|
    kPolygonAcross,  ///< triangles that do, PixelWeights: over sum |F_e| + the edges that cross the border
    kPolygonLiteral  ///< the same over sum |F_e| alone: reported, not promised, since positions are absolute
};
inline constexpr int kClaims = 7;
const char* nameOf(Claim claim);
/// In units of u; infinite for what is only reported.
double boundOf(Claim claim);

struct BoundsOptions {
    long edges = 1'000'000;  ///< a category and family that meet the support; of polygons' sides too
    int judged = 1000;       ///< the worst of each claim and category
    std::uint64_t seed = 19890731;
    std::vector<int> categories;  ///< by number; none: all
};

/// One claim in one category. Errors are in u, as the claim says.
struct BoundsRow {
    Claim claim;
    Category category;
    long cases = 0;         ///< edges, or triangles, that the claim is about
    long hard = 0;          ///< edges of the category that meet its hard spot
    double screened = 0.0;  ///< worst by the screen
    double judged = 0.0;    ///< worst by the judge, of those that it got
    int judged_cases = 0;
    double disagreement = 0.0;  ///< largest difference of the two
    double reported = 0.0;      ///< largest error that the judge estimates of itself, absolute, in u
    std::string worst_kernel;
    Edge worst_edge;
    std::vector<double> by_kernel;  ///< worst by the screen, in the order of kernelNames()
    bool holds() const { return judged <= boundOf(claim) && screened <= boundOf(claim) + disagreement; }
};

struct BoundsResult {
    BoundsOptions options;
    std::vector<BoundsRow> rows;
    long edges[2][kCategories] = {};  ///< that met the support, of fans and of strips
    long unequal_bits = 0;            ///< edges whose term in fixed point is not the term seen, rounded
};

/// The kernels that take turns, radial or separable.
std::vector<std::string> kernelNames(bool radial);

BoundsResult measureBounds(const BoundsOptions& options);

/// Tables in Markdown; every row as CSV.
std::string boundsTable(const BoundsResult& result);
std::string boundsCsv(const BoundsResult& result);

}  // namespace edgewise::study
