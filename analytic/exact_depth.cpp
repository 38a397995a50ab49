#include "analytic/exact_depth.h"

#include <array>

#include "analytic/double_double.h"

namespace edgewise {
namespace {

/// A nonoverlapping expansion (Shewchuk 1997): the exact sum of its components, smallest first.
struct Expansion {
    std::array<double, 16> component{};
    int size = 0;

    void add(double value) {
        int kept = 0;
        for (int i = 0; i < size; ++i) {
            const f64::dd sum = f64::twoSum(value, component[static_cast<std::size_t>(i)]);
            value = sum.hi;
            if (sum.lo != 0.0) component[static_cast<std::size_t>(kept++)] = sum.lo;
        }
        if (value != 0.0) component[static_cast<std::size_t>(kept++)] = value;
        size = kept;
    }
    void addProduct(double a, double b) {
        const f64::dd p = f64::twoProd(a, b);
        add(p.lo);
        add(p.hi);
    }
    int sign() const {
        if (size == 0) return 0;
        return component[static_cast<std::size_t>(size - 1)] > 0.0 ? 1 : -1;
    }
};

}  // namespace

int depthDifferenceSign(const DepthPlane& p, const DepthPlane& q, double dx, double dy) {
    Expansion sum;
    sum.addProduct(p.dz_dx, dx);
    sum.addProduct(-q.dz_dx, dx);
    sum.addProduct(p.dz_dy, dy);
    sum.addProduct(-q.dz_dy, dy);
    sum.add(p.z_anchor);
    sum.add(-q.z_anchor);
    return sum.sign();
}

}  // namespace edgewise
