// The sine that every device computes alike, against the C library's.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "sdf/reals.h"

namespace edgewise::sdf {
namespace {

/// As sdf_sine.glsl says: a few units of the last place of 1, and |x| of them. The C library is right to one.
template <class Real>
void expectSine(double reach) {
    constexpr double kUnit = std::numeric_limits<Real>::epsilon();
    constexpr unsigned kSeed = 77;
    std::mt19937_64 random(kSeed);
    std::uniform_real_distribution<double> exponent(-6.0, std::log10(reach));
    double worst = 0.0;
    for (int i = 0; i < 200000; ++i) {
        const auto x = static_cast<Real>(std::pow(10.0, exponent(random)) * (i % 2 ? 1 : -1));
        const double bound = (4.0 + std::abs(static_cast<double>(x))) * kUnit;
        const double sine_off = std::abs(double(sine(x)) - std::sin(static_cast<long double>(x)));
        // The quarter turn that cosine adds is rounded once more.
        const double cosine_off = std::abs(double(cosine(x)) - std::cos(static_cast<long double>(x)));
        worst = std::max({worst, sine_off / bound, cosine_off / bound});
        ASSERT_LE(sine_off, bound) << x << " seed " << kSeed;
        ASSERT_LE(cosine_off, 2.0 * bound) << x << " seed " << kSeed;
    }
    std::printf("worst %.2f of the bound\n", worst);
}

TEST(Sine, IsTheSineInDouble) {
    expectSine<double>(1e6);
}

TEST(Sine, IsTheSineInFloat) {
    expectSine<float>(2e4);
}

}  // namespace
}  // namespace edgewise::sdf
