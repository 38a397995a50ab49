#include "pipeline/eye_plane.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

namespace edgewise {
namespace {

void fill(double* numbers, std::size_t count, std::mt19937& random) {
    std::uniform_real_distribution<double> mantissa(-2.0, 2.0);
    std::uniform_int_distribution<int> exponent(-40, 40);
    for (std::size_t i = 0; i < count; ++i)
        numbers[i] = random() % 16 == 0 ? 0.0 : std::ldexp(mantissa(random), exponent(random));
}

void fill(LaneMatrix& m, std::mt19937& random) {
    fill(&m.hi[0][0], 9, random);
    for (int i = 0; i < 9; ++i) (&m.lo[0][0])[i] = (&m.hi[0][0])[i] * 0x1p-54;
}

TEST(EyePlanes, InstructionSetsAgreeBitForBit) {
    std::mt19937 random(21);
    std::size_t compared = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        WorldMap world;
        EyeMap eye;
        PlanesIn in;
        fill(world.cofactors, random), fill(eye.cofactors, random);
        fill(&world.linear[0][0], 9, random), fill(world.translation, 3, random);
        fill(eye.translation, 3, random), fill(eye.from_principal, 2, random);
        eye.determinant_hi = 1.25, eye.determinant_lo = 0x1.8p-55;
        eye.perspective = trial % 2 == 0, eye.scale_px = 700.0 + trial / 3.0;
        fill(&in.normal_hi[0][0], 3 * kPlaneLanes, random), fill(&in.point[0][0], 3 * kPlaneLanes, random);
        for (int i = 0; i < 3 * kPlaneLanes; ++i)
            (&in.normal_lo[0][0])[i] = (&in.normal_hi[0][0])[i] * 0x1p-55;
        PlanesOut expected;
        const WorldMap* const map = trial % 3 == 0 ? nullptr : &world;
        eyePlanesFor("scalar")(map, eye, in, expected);
        for (const char* name : {"sse2", "avx2", "avx512"}) {
            const EyePlanesFunction function = eyePlanesFor(name);
            if (!function) continue;
            PlanesOut got;
            function(map, eye, in, got);
            // NaN has many bits: equal as numbers, or both none.
            const double *a = &expected.normal[0][0], *b = &got.normal[0][0];
            for (std::size_t i = 0; i < sizeof(PlanesOut) / sizeof(double); ++i)
                ASSERT_TRUE(std::memcmp(&a[i], &b[i], 8) == 0 || (std::isnan(a[i]) && std::isnan(b[i])))
                    << name << ", trial " << trial << ", number " << i;
            ++compared;
        }
    }
    EXPECT_GE(compared, 2000u);
}

}  // namespace
}  // namespace edgewise
