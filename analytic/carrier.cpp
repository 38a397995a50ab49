#include "analytic/carrier.h"

#include <bit>
#include <cmath>
#include <tuple>
#include <utility>

namespace edgewise {
namespace {

using f64::ddAdd;
using f64::ddDiv;
using f64::ddFrom;
using f64::ddMul;
using f64::ddMulReal;
using f64::ddNeg;
using f64::ddSub;
using f64::twoSum;
__extension__ typedef __int128 Int128;

std::int64_t gridSteps(double px) {
    return static_cast<std::int64_t>(px * 0x1p32);
}

/// cross(u, v) of grid vectors in units of 2^-64 px^2, exact: |u|, |v| < 2^22 px.
Int128 crossExact(glm::dvec2 u, glm::dvec2 v) {
    return static_cast<Int128>(gridSteps(u.x)) * gridSteps(v.y) -
           static_cast<Int128>(gridSteps(u.y)) * gridSteps(v.x);
}

DoubleDouble toDoubleDouble(Int128 n) {
    const double hi = static_cast<double>(n);
    return {hi, static_cast<double>(n - static_cast<Int128>(hi))};
}

bool edgeBefore(const Carrier& p, const Carrier& q) {
    return std::tie(p.a.y, p.a.x, p.b.y, p.b.x) < std::tie(q.a.y, q.a.x, q.b.y, q.b.x);
}

FinePoint pointOnEdge(const Carrier& edge, DoubleDouble t) {
    const glm::dvec2 e = edge.b - edge.a;
    return finePoint(fineCoordinate(edge.a.x, ddMulReal(t, e.x)),
                     fineCoordinate(edge.a.y, ddMulReal(t, e.y)));
}

/// p.a + (N / D) e: exact signs decide whether, exact integers decide where.
bool crossEdges(const Carrier& p, const Carrier& q, FinePoint& point) {
    const glm::dvec2 e = p.b - p.a, f = q.b - q.a;
    const Int128 pa = crossExact(f, p.a - q.a), pb = crossExact(f, p.b - q.a);
    if ((pa > 0) == (pb > 0) || pa == 0 || pb == 0) return false;
    const Int128 qa = crossExact(e, q.a - p.a), qb = crossExact(e, q.b - p.a);
    if ((qa > 0) == (qb > 0) || qa == 0 || qb == 0) return false;
    point = pointOnEdge(p, ddDiv(toDoubleDouble(pa), toDoubleDouble(pa - pb)));
    return true;
}

DoubleDouble depthDifference(const Carrier& line, glm::dvec2 p) {
    const glm::dvec2 d = p - line.anchor;
    return ddAdd(ddAdd(ddMulReal(line.A, d.x), ddMulReal(line.B, d.y)), line.C);
}

bool crossEdgeWithDepth(const Carrier& edge, const Carrier& depth, FinePoint& point) {
    const DoubleDouble fa = depthDifference(depth, edge.a), fb = depthDifference(depth, edge.b);
    if ((fa.hi > 0.0) == (fb.hi > 0.0) || fa.hi == 0.0 || fb.hi == 0.0) return false;
    point = pointOnEdge(edge, ddDiv(fa, ddSub(fa, fb)));
    return true;
}

DoubleDouble determinant(DoubleDouble a, DoubleDouble b, DoubleDouble c, DoubleDouble d) {
    return ddSub(ddMul(a, d), ddMul(b, c));
}

/// Cramer's rule in double-double, about the anchor. Of nearly parallel lines it gives a point that may be
/// off along them: one coordinate is kept, and the first line gives the other.
bool crossDepths(const Carrier& p, const Carrier& q, FinePoint& point) {
    const DoubleDouble det = determinant(p.A, p.B, q.A, q.B);
    if (det.hi == 0.0) return false;
    const DoubleDouble x = ddDiv(determinant(p.B, p.C, q.B, q.C), det);
    const DoubleDouble y = ddDiv(determinant(p.C, p.A, q.C, q.A), det);
    if (!(std::abs(x.hi) < kGuardBandPx && std::abs(y.hi) < kGuardBandPx)) return false;
    const bool steep = std::abs(p.A.hi) >= std::abs(p.B.hi);
    point = steep ? pointAtY(p, fineCoordinate(p.anchor.y, y)) : pointAtX(p, fineCoordinate(p.anchor.x, x));
    return true;
}

std::uint64_t mix(std::uint64_t h, std::uint64_t v) {
    h = (h ^ v) * 0x9e3779b97f4a7c15ull;
    return h ^ (h >> 29);
}

/// The cell of 16 px that holds a point, row by row, in the upper 34 bits: edges that begin beside each other
/// are sorted, and then read, beside each other.
std::uint64_t nearby(glm::dvec2 p) {
    const auto cell = [](double px) {
        return static_cast<std::uint64_t>(static_cast<int>(std::floor(px * 0.0625)) + 0x10000) & 0x1ffff;
    };
    return cell(p.y) << 47 | cell(p.x) << 30;
}

}  // namespace

Carrier edgeCarrier(const ScreenScene& scene, LineRef ref) {
    const ScreenTriangle& t = scene.triangles[ref.i];
    const std::uint32_t k = ref.j - LineRef::kFirstEdge;
    Carrier line;
    line.ref = ref;
    line.a = t.p_px[k];
    line.b = t.p_px[(k + 1) % 3];
    const bool downward = line.a.y < line.b.y || (line.a.y == line.b.y && line.a.x > line.b.x);
    if (!downward) std::swap(line.a, line.b);
    return line;
}

Carrier depthCarrier(const ScreenScene& scene, LineRef ref) {
    const DepthPlane& p = scene.planes[ref.i];
    const DepthPlane& q = scene.planes[ref.j];
    Carrier line;
    line.ref = ref;
    line.A = twoSum(p.dz_dx, -q.dz_dx);
    line.B = twoSum(p.dz_dy, -q.dz_dy);
    line.C = twoSum(p.z_anchor, -q.z_anchor);
    line.anchor = scene.anchor_px;
    // Where a line rises across a cell by less than the sweep can tell, it would not run inside any: it
    // counts as horizontal everywhere. 2^-71 of 1/16 px, the narrowest cell, is 2^-75 px; at a corner of the
    // screen the line moves by 2^-71 of the way from the anchor.
    if (std::abs(line.A.hi) < 0x1p-71 * std::abs(line.B.hi)) line.A = {};
    return line;
}

FinePoint pointAtY(const Carrier& line, FineCoordinate y) {
    if (line.isEdge()) {
        const glm::dvec2 e = line.b - line.a;
        const DoubleDouble dy = offsetFrom(y, line.a.y);
        return finePoint(fineCoordinate(line.a.x, ddDiv(ddMulReal(dy, e.x), ddFrom(e.y))), y);
    }
    const DoubleDouble dy = offsetFrom(y, line.anchor.y);
    const DoubleDouble x = ddDiv(ddNeg(ddAdd(ddMul(line.B, dy), line.C)), line.A);
    return finePoint(fineCoordinate(line.anchor.x, x), y);
}

FinePoint pointAtX(const Carrier& line, FineCoordinate x) {
    if (line.isEdge()) {
        const glm::dvec2 e = line.b - line.a;
        const DoubleDouble dx = offsetFrom(x, line.a.x);
        return finePoint(x, fineCoordinate(line.a.y, ddDiv(ddMulReal(dx, e.y), ddFrom(e.x))));
    }
    const DoubleDouble dx = offsetFrom(x, line.anchor.x);
    const DoubleDouble y = ddDiv(ddNeg(ddAdd(ddMul(line.A, dx), line.C)), line.B);
    return finePoint(x, fineCoordinate(line.anchor.y, y));
}

bool crossing(const Carrier& p, const Carrier& q, FinePoint& point) {
    if (p.isEdge() && q.isEdge()) return edgeBefore(p, q) ? crossEdges(p, q, point) : crossEdges(q, p, point);
    if (p.isEdge()) return crossEdgeWithDepth(p, q, point);
    if (q.isEdge()) return crossEdgeWithDepth(q, p, point);
    return p.ref < q.ref ? crossDepths(p, q, point) : crossDepths(q, p, point);
}

int sideOf(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p) {
    const Int128 cross = crossExact(b - a, p - a);
    return cross > 0 ? 1 : cross < 0 ? -1 : 0;
}

std::uint64_t lineKey(const Carrier& line) {
    if (!line.isEdge()) return mix(mix(1, line.ref.i), line.ref.j);
    std::uint64_t h = mix(2, std::bit_cast<std::uint64_t>(line.a.y + 0.0));
    if (line.horizontal()) return h;
    h = mix(h, std::bit_cast<std::uint64_t>(line.a.x + 0.0));
    h = mix(h, std::bit_cast<std::uint64_t>(line.b.y + 0.0));
    return nearby(line.a) | mix(h, std::bit_cast<std::uint64_t>(line.b.x + 0.0)) >> 30;
}

std::uint64_t closingKey(FineCoordinate y) {
    return mix(mix(3, std::bit_cast<std::uint64_t>(y.grid + 0.0)),
               std::bit_cast<std::uint64_t>(y.rest + 0.0));
}

CarrierLine closingLine(const FinePoint& p) {
    CarrierLine out;
    out.origin = p.grid;
    out.ny_hi = -1.0;
    out.c_hi = p.rest.y;
    out.direction = {-1.0, 0.0};
    return out;
}

CarrierLine carrierLine(const Carrier& line) {
    CarrierLine out;
    if (line.isEdge()) {
        const glm::dvec2 e = line.b - line.a;
        out.origin = line.a;
        out.nx_hi = -e.y + 0.0;
        out.ny_hi = e.x;
    } else {
        const bool towards = line.A.hi != 0.0 ? line.A.hi < 0.0 : line.B.hi < 0.0;
        const double s = towards ? 1.0 : -1.0;
        out.origin = line.anchor;
        out.nx_hi = s * line.A.hi, out.nx_lo = s * line.A.lo;
        out.ny_hi = s * line.B.hi, out.ny_lo = s * line.B.lo;
        out.c_hi = s * line.C.hi, out.c_lo = s * line.C.lo;
    }
    out.length = std::hypot(out.nx_hi, out.ny_hi);
    out.direction = glm::dvec2(out.ny_hi, -out.nx_hi) / out.length;
    return out;
}

}  // namespace edgewise
