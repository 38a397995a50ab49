// eyePlanes() for one instruction set: define EDGEWISE_ISA (a namespace) and EDGEWISE_LANES (1, 2, 4 or 8), then include.
// Nothing here may call an inline function of another namespace: it could be linked into code for an older machine.
#include "analytic/shared_text.h"
#include "pipeline/eye_plane_lanes.h"

#if defined(__x86_64__) && EDGEWISE_LANES > 1
#include <immintrin.h>
#define EDGEWISE_X86
#endif

namespace edgewise::EDGEWISE_ISA {
namespace {
#include "analytic/real_lanes.h"
#include "shaders/shared/double_double.glsl"

struct Vector {
    dd x, y, z;
};

EDGEWISE_FN real load(const double* numbers) {
    real lanes;
    __builtin_memcpy(&lanes, numbers, sizeof lanes);
    return lanes;
}
EDGEWISE_FN void store(real lanes, double* numbers) { __builtin_memcpy(numbers, &lanes, sizeof lanes); }
EDGEWISE_FN dd widen(double number) { return {splat(number), splat(0.0)}; }

EDGEWISE_FN Vector row(const LaneMatrix& m, int i) {
    return {{splat(m.hi[i][0]), splat(m.lo[i][0])},
            {splat(m.hi[i][1]), splat(m.lo[i][1])},
            {splat(m.hi[i][2]), splat(m.lo[i][2])}};
}

EDGEWISE_FN dd dot(const Vector& a, const Vector& b) {
    return ddAdd(ddAdd(ddMul(a.x, b.x), ddMul(a.y, b.y)), ddMul(a.z, b.z));
}

/// The same with a b that is not longer than a double.
EDGEWISE_FN dd dotReal(const Vector& a, real x, real y, real z) {
    return ddAdd(ddAdd(ddMulReal(a.x, x), ddMulReal(a.y, y)), ddMulReal(a.z, z));
}

EDGEWISE_FN Vector multiply(const LaneMatrix& m, const Vector& v) {
    return {dot(row(m, 0), v), dot(row(m, 1), v), dot(row(m, 2), v)};
}

EDGEWISE_FN dd moved(const WorldMap& world, int i, real x, real y, real z) {
    const double* m = world.linear[i];
    const dd turned = dotReal({widen(m[0]), widen(m[1]), widen(m[2])}, x, y, z);
    return ddAdd(turned, widen(world.translation[i]));
}

/// (a x + b y + c) scale, all double-double.
EDGEWISE_FN dd affine(dd a, double x, dd b, double y, dd c, double scale) {
    return ddAdd(ddAdd(ddMulReal(a, splat(x)), ddMulReal(b, splat(y))), ddMulReal(c, splat(scale)));
}

EDGEWISE_FN void storeDepth(const EyeMap& eye, const Vector& n, dd d, int first, PlanesOut& out) {
    const dd down = ddNeg(n.y);  // the screen's y points down
    const dd per_px = ddMulReal(eye.perspective ? d : ddNeg(n.z), splat(eye.scale_px));
    const dd constant = ddNeg(eye.perspective ? n.z : d);
    const dd anchor = affine(n.x, eye.from_principal[0], down, eye.from_principal[1], constant, eye.scale_px);
    store(ddDiv(n.x, per_px).hi, out.dz_dx + first);
    store(ddDiv(down, per_px).hi, out.dz_dy + first);
    store(ddDiv(anchor, per_px).hi, out.z_anchor + first);
}

EDGEWISE_FN void planesFrom(int first, const WorldMap* world, const EyeMap& eye, const PlanesIn& in, PlanesOut& out) {
    Vector n{{load(in.normal_hi[0] + first), load(in.normal_lo[0] + first)},
             {load(in.normal_hi[1] + first), load(in.normal_lo[1] + first)},
             {load(in.normal_hi[2] + first), load(in.normal_lo[2] + first)}};
    const real x = load(in.point[0] + first), y = load(in.point[1] + first), z = load(in.point[2] + first);
    dd d;
    if (world) {
        n = multiply(world->cofactors, n);
        d = dot(n, {moved(*world, 0, x, y, z), moved(*world, 1, x, y, z), moved(*world, 2, x, y, z)});
    } else {
        d = dotReal(n, x, y, z);
    }
    n = multiply(eye.cofactors, n);
    const dd determinant{splat(eye.determinant_hi), splat(eye.determinant_lo)};
    const double* c = eye.translation;
    d = ddAdd(ddMul(determinant, d), dotReal(n, splat(c[0]), splat(c[1]), splat(c[2])));
    store(n.x.hi, out.normal[0] + first);
    store(n.y.hi, out.normal[1] + first);
    store(n.z.hi, out.normal[2] + first);
    store(d.hi, out.d + first);
    storeDepth(eye, n, d, first, out);
}
}  // namespace

void eyePlanes(const WorldMap* world, const EyeMap& eye, const PlanesIn& in, PlanesOut& out);
void eyePlanes(const WorldMap* world, const EyeMap& eye, const PlanesIn& in, PlanesOut& out) {
    for (int first = 0; first < kPlaneLanes; first += EDGEWISE_LANES) planesFrom(first, world, eye, in, out);
}

}  // namespace edgewise::EDGEWISE_ISA
