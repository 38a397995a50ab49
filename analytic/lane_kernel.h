// What the code of one instruction set takes and gives: plain data, no library types, so that nothing
// compiled for a newer machine can be linked into code for an older one.
#pragma once

#include <cstdint>

namespace edgewise {

enum TermForm : int { kDiskTerm, kConeTerm, kGaussianTerm, kPolyTerm, kStripTerm };

/// A GaussRule: the mean of f over [0, 1] is sum weight[i] f(node[i]).
struct RuleView {
    int count = 0;
    const double* node = nullptr;
    const double* weight = nullptr;
};

/// A Gaussian's segment is cut into equal parts no longer than this, and a part takes one of these many
/// rules.
inline constexpr double kLongestPieceSigmas = 3.0;
inline constexpr int kPieceRules = 3;

/// A Gaussian piece no longer than `limit_sigma` sigma takes `rule`. [E9]
struct PieceRule {
    double limit_sigma = 0.0;
    RuleView rule;
};

/// Nodes that the rule of a table's cells has at most, and cells along a side.
inline constexpr int kMostCellNodes = 24, kMostIntervals = 32;

/// A KernelTable.
struct TableView {
    int intervals = 0, k_count = 0;
    const double *knot = nullptr, *centre = nullptr, *inverse_half = nullptr, *k = nullptr, *K = nullptr;
    double k_max = 0.0;
    RuleView rule;
};

/// Everything about a kernel that its terms need.
struct LaneKernel {
    TermForm form = kDiskTerm;
    double radius = 0.0;
    double inner_radius = 0.0;   ///< Gaussian: beyond it g is 1/(2 pi r^2) to 2^-61
    double scale = 0.0;          ///< F_in = h L' mean(..) scale
    double sigma = 0.0;          ///< Gaussian
    double inverse_reach = 0.0;  ///< Gaussian: 1/(sqrt 2 sigma)
    PieceRule piece_rules[kPieceRules];
    const double* poly = nullptr;  ///< c_k / (2k + 2): g in powers of (r/R)^2
    RuleView poly_rule;
    TableView table;
};

/// A segment and its line, px. Names as in VisibleSegment and CarrierLine.
struct EdgeInput {
    double a_x, a_y, a_rest_x, a_rest_y, b_x, b_y, b_rest_x, b_rest_y, len;
    double origin_x, origin_y, nx_hi, nx_lo, ny_hi, ny_lo, c_hi, c_lo, line_length, direction_x, direction_y;
};

/// A segment and a sample.
struct EdgePair {
    const EdgeInput* edge;
    double sample_x, sample_y;
};

/// Pairs that one call takes at most.
inline constexpr int kMostPairs = 64;

/// Bit i is pair i.
using PairSet = std::uint64_t;

/// By pair. A crossing with the border: radial, its angle over 2 pi in (-1/2, 1/2]; separable, K(y) on the
/// side x = sample.x + R. In fixed point 2^-60.  Going along the border (by angle, by y) an entry [0] leads
/// from the segment's left owner to its right one, an exit [1] from right to left. [E12], [E13]
struct EdgeTerms {
    alignas(64) std::int64_t value[kMostPairs];
    alignas(64) std::int64_t position[2][kMostPairs];
    alignas(64) double order[2][kMostPairs];  ///< what crossings are sorted by: the angle in turns; y, px
    alignas(64) double doubt[2][kMostPairs];  ///< how far rounding may have moved `order`
    /// Sorts the crossings of segments that part at a vertex so near to the border that `order` cannot: along
    /// the border over across it, on the way from the vertex through the border.
    alignas(64) double spread[2][kMostPairs];
    PairSet touched;  ///< pairs whose segment meets the sample's support: the others' value is 0
    PairSet crossed[2];
};

}  // namespace edgewise
