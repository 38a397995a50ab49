#include "analytic/prefilter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "analytic/kernel_table.h"
#include "tests/analytic/kernel_truth.h"

namespace edgewise::test {
namespace {

const char* const kNames[] = {
    "box",     "disk",     "tent",        "cone",       "gaussian", "gaussian-separable",
    "bspline", "mitchell", "catmull-rom", "bc:0.2,0.4", "lanczos",  "poly:1,-2,1"};

TEST(Prefilter, DefaultsAreTheContracts) {
    const double radii[] = {0.5, 0.5, 1, 1, 2, 2, 2, 2, 2, 2, 3, 2};
    for (int i = 0; i < 12; ++i) {
        const Prefilter filter = makePrefilter(kNames[i], {}, {});
        EXPECT_EQ(filter.radius, radii[i]) << kNames[i];
        EXPECT_EQ(filter.name, kNames[i]);
        EXPECT_EQ(filter.sigma.has_value(), i == 4 || i == 5) << kNames[i];
    }
    EXPECT_EQ(*makePrefilter("gaussian", {}, {}).sigma, 2.0 / 3.0);
    EXPECT_EQ(*makePrefilter("gaussian", 3.0, {}).sigma, 1.0);
    EXPECT_EQ(*makePrefilter("gaussian", 3.0, 0.25).sigma, 0.25);
}

/// evaluate() against the definitions, which are normalised by quadrature.
TEST(Prefilter, ValuesMatchTheDefinitions) {
    double worst = 0;
    for (const char* name : kNames) {
        for (double radius : {0.3, 1.0, 2.0, 3.7}) {
            const Prefilter filter = makePrefilter(name, radius, {});
            const KernelTruth truth(filter);
            const double peak = evaluate(filter, 0, 0);
            for (int i = 0; i < 400; ++i) {
                const double x = radius * (i % 20 - 9.3) / 9.5, y = radius * (i / 20 - 9.7) / 9.5;
                Real exact = truth(x) * truth(y);
                if (filter.radial()) {
                    const Real r = std::sqrt(Real(x) * x + Real(y) * y);
                    exact = r < radius ? truth(r) : 0;
                } else if (std::abs(x) > radius || std::abs(y) > radius) {
                    exact = 0;
                }
                worst = std::max(worst, static_cast<double>(std::abs(evaluate(filter, x, y) - exact)) / peak);
            }
        }
    }
    std::printf("worst error %.2f u of the peak\n", worst * 0x1p53);
    EXPECT_LE(worst,
              64 * 0x1p-53);  // Horner of up to 24 coefficients twice, each sum at most the peak's size
}

TEST(Prefilter, FittedTablesAreFinerThanDouble) {
    for (const char* name : {"gaussian-separable", "lanczos"}) {
        for (double radius : {0.05, 0.5, 1.0, 2.0, 3.0, 8.0, 20.0}) {
            const Prefilter filter = makePrefilter(name, radius, {});
            const KernelTable& table = *filter.table;
            std::printf("%-20s R %5.2f: %3d intervals, degree %2d, fit 2^%.1f, %d nodes\n", name, radius,
                        table.intervals(), table.k_count - 1, std::log2(table.fit_error), table.rule.count());
            EXPECT_LE(table.fit_error, 0x1p-56);
        }
    }
}

std::string refusal(const char* name, std::optional<double> radius, std::optional<double> sigma) {
    try {
        makePrefilter(name, radius, sigma);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

TEST(Prefilter, RefusesWhatTheContractRefuses) {
    const double nan = std::nan(""), infinity = INFINITY;
    EXPECT_NE(refusal("gauss", {}, {}).find("gaussian-separable, bspline, mitchell"), std::string::npos);
    for (const char* name :
         {"", "box:1", "bc", "bc:1", "bc:1,2,3", "bc:a,b", "bc:1,", "bc:1,nan", "bc:0,50", "poly",
          "poly:", "poly:1,x", "poly:0", "poly:-1", "poly:1,-2", "poly:1,inf", "poly:1 ", "Box"})
        EXPECT_NE(refusal(name, {}, {}), "") << name;
    for (const char* name : kNames)
        for (double radius : {0.0, -1.0, nan, infinity, -infinity})
            EXPECT_NE(refusal(name, radius, {}), "") << name << radius;
    for (const char* name : {"box", "disk", "lanczos", "poly:1"})
        EXPECT_NE(refusal(name, {}, 1.0).find("sigma"), std::string::npos);
    for (double sigma : {0.0, -1.0, nan, infinity}) EXPECT_NE(refusal("gaussian", {}, sigma), "");
    EXPECT_EQ(refusal("lanczos", 256.0, {}), "");
    for (double sigma : {2e-3, 200.0}) EXPECT_EQ(refusal("gaussian", 2.0, sigma), "");
}

TEST(Prefilter, EveryFilterIsDescribed) {
    const auto lines = describePrefilters();
    EXPECT_EQ(lines.size(), 12u);
    for (const char* name : kNames) {
        const std::string stem = std::string(name).substr(0, std::string(name).find(':'));
        EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [&](const std::string& l) {
            return l.rfind(stem + ":", 0) == 0;
        })) << stem;
    }
}

}  // namespace
}  // namespace edgewise::test
