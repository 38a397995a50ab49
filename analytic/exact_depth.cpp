#include "analytic/exact_depth.h"

#include "analytic/expansion.h"

namespace edgewise {

int depthDifferenceSign(const DepthPlane& p, const DepthPlane& q, double dx, double dy) {
    Expansion<10> sum;
    sum.addProduct(p.dz_dx, dx);
    sum.addProduct(-q.dz_dx, dx);
    sum.addProduct(p.dz_dy, dy);
    sum.addProduct(-q.dz_dy, dy);
    sum.add(p.z_anchor);
    sum.add(-q.z_anchor);
    return sum.sign();
}

}  // namespace edgewise
