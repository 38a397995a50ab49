// Exact sums: a number held as doubles that do not overlap, after Shewchuk (1997), "Adaptive Precision
// Floating-Point Arithmetic and Fast Robust Geometric Predicates", GROW-EXPANSION with zero elimination.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>

#include "analytic/double_double.h"

namespace edgewise {

/// The exact sum of up to kCapacity doubles. Exact while nothing overflows and no partial product of
/// addProduct() falls below 2^-960.
template <std::size_t kCapacity>
class Expansion {
  public:
    void add(double value) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < size_; ++i) {
            const f64::dd sum = f64::twoSum(value, part_[i]);
            value = sum.hi;
            if (sum.lo != 0.0) part_[kept++] = sum.lo;
        }
        if (value != 0.0) {
            assert(kept < kCapacity);
            part_[kept++] = value;
        }
        size_ = kept;
    }

    void addProduct(double a, double b) {
        const f64::dd product = f64::twoProd(a, b);
        add(product.lo);
        add(product.hi);
    }

    template <std::size_t kOther>
    void addScaled(const Expansion<kOther>& other, double factor) {
        for (std::size_t i = 0; i < other.size(); ++i) addProduct(other[i], factor);
    }

    /// -1, 0 or 1: the largest part decides, for the parts do not overlap.
    int sign() const { return size_ == 0 ? 0 : (part_[size_ - 1] > 0.0 ? 1 : -1); }

    std::size_t size() const { return size_; }
    double operator[](std::size_t i) const { return part_[i]; }

    /// The sum as hi + lo, |error| <= 2^-104 |sum|: the rest after a first estimate is formed exactly.
    f64::dd toDoubleDouble() const {
        const double estimate = roundedSum();
        Expansion<kCapacity + 1> rest;
        for (std::size_t i = 0; i < size_; ++i) rest.add(part_[i]);
        rest.add(-estimate);
        return f64::quickTwoSum(estimate, rest.roundedSum());
    }

    double roundedSum() const {
        double sum = 0.0;
        for (std::size_t i = 0; i < size_; ++i) sum += part_[i];
        return sum;
    }

  private:
    std::array<double, kCapacity> part_;
    std::size_t size_ = 0;
};

}  // namespace edgewise
