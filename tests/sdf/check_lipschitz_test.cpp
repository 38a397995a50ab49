#include "sdf/check_lipschitz.h"

#include <gtest/gtest.h>

#include "sdf/load_sdf.h"

namespace edgewise::sdf {
namespace {

std::vector<LipschitzViolation> checked(const std::string& tree, std::uint64_t seed = 1) {
    return checkLipschitz(loadSdf(R"({"tree": )" + tree + "}"), {.seed = seed});
}

TEST(CheckLipschitz, FindsADeclaredBoundThatIsTooSmall) {
    // The values change by 3 a unit, not by the 2 that are declared.
    const auto found = checked(R"({"type": "union", "children": [{"type": "sphere", "radius": 1},
        {"type": "scale-value", "factor": 3, "lipschitz": 2, "at": [3, 0, 0],
         "child": {"type": "sphere", "radius": 0.5}}]})");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].path, "tree.children[1]");
    EXPECT_EQ(found[0].bound, 2.0);
    EXPECT_GT(found[0].measured, 2.5);
    EXPECT_LE(found[0].measured, 3.0);
    EXPECT_GT(found[0].pairs, found[0].of / 10);
    EXPECT_NE(wordsOf(found[0]).find("more than its bound 2"), std::string::npos);
}

TEST(CheckLipschitz, ABoundIsTheNodesOwnWhateverIsAroundIt) {
    const std::string wrong = R"({"type": "sphere", "radius": 1, "lipschitz": 0.9, "scale": 0.25})";
    const auto found = checked(wrong);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].bound, 0.9);
    EXPECT_GT(found[0].measured, 0.9);
    EXPECT_LE(found[0].measured, 1.0);
    EXPECT_TRUE(checked(R"({"type": "sphere", "radius": 1, "lipschitz": 1, "scale": 0.25})").empty());
}

TEST(CheckLipschitz, IsTheSameForTheSameSeed) {
    const std::string tree = R"({"type": "torus", "major": 1, "minor": 0.2, "lipschitz": 0.99})";
    const auto a = checked(tree, 7), b = checked(tree, 7), c = checked(tree, 8);
    ASSERT_EQ(a.size(), 1u);
    EXPECT_EQ(wordsOf(a[0]), wordsOf(b[0]));
    EXPECT_NE(a[0].measured, c.at(0).measured);
}

TEST(CheckLipschitz, EveryKindKeepsItsOwnBound) {
    const std::string part = R"({"type": "union", "children": [{"type": "torus", "major": 0.5, "minor": 0.2},
        {"type": "box", "size": [0.4, 1, 0.7], "at": [0.3, 0.2, -0.1],
         "rotate": {"axis": [1, 2, 3], "degrees": 40}}]})";
    for (const char* head :
         {R"("twist", "degrees_per_unit": 90)", R"("displace", "amplitude": 0.3, "frequency": [5, 0, 7])",
          R"("repeat", "spacing": [3, 0, 2.5], "count": [2, 0, 3])", R"("elongate", "by": [1, 0, 2])",
          R"("stretch", "factors": [1, 3, 0.5])", R"("mirror", "axes": [1, 0, 1])",
          R"("shell", "thickness": 0.1)", R"("offset", "distance": 0.2)", R"("complement")"}) {
        const auto found = checked(R"({"type": )" + std::string(head) + R"(, "child": )" + part + "}");
        EXPECT_TRUE(found.empty()) << head << ": " << wordsOf(found[0]);
    }
}

}  // namespace
}  // namespace edgewise::sdf
