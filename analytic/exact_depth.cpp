#include "analytic/exact_depth.h"

#include "analytic/expansion.h"

namespace edgewise {

int depthDifferenceSign(const DepthPlane& p, const DepthPlane& q, f64::dd dx, f64::dd dy) {
    Expansion<18> sum;
    for (const double x : {dx.lo, dx.hi}) {
        sum.addProduct(p.dz_dx, x);
        sum.addProduct(-q.dz_dx, x);
    }
    for (const double y : {dy.lo, dy.hi}) {
        sum.addProduct(p.dz_dy, y);
        sum.addProduct(-q.dz_dy, y);
    }
    sum.add(p.z_anchor);
    sum.add(-q.z_anchor);
    return sum.sign();
}

int depthDifferenceSign(const DepthPlane& p, const DepthPlane& q, double dx, double dy) {
    return depthDifferenceSign(p, q, f64::dd{dx, 0.0}, f64::dd{dy, 0.0});
}

}  // namespace edgewise
