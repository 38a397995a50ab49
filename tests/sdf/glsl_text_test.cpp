// The text of generated GLSL: it holds what the tape uses, and nothing else. Its values are tested on the
// device.
#include "sdf/glsl_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "tests/sdf/random_tree.h"

namespace edgewise::sdf {
namespace {

bool holds(const std::string& text, std::string_view part) {
    return text.find(part) != text.npos;
}

Tree manySpheres(int count) {
    Tree tree;
    std::vector<std::uint32_t> children;
    for (int i = 0; i < count; ++i) {
        const std::uint32_t sphere = tree.add(Kind::kSphere, {0.1 + 0.01 * i}, {}, i % 3);
        children.push_back(tree.add(Kind::kTranslate, {0.5 * i, 0.25, 0.0}, {sphere}));
    }
    tree.root = tree.add(Kind::kSmoothUnion, {0.1}, children);
    return tree;
}

TEST(GlslText, HoldsOnlyWhatIsUsed) {
    Tree tree;
    const std::uint32_t sphere = tree.add(Kind::kSphere, {0.5}, {}, 7);
    tree.root = tree.add(Kind::kDifference, {}, {tree.add(Kind::kBox, {1, 1, 1}, {}, 3), sphere});
    const GlslField field = glslText(lower(tree));
    EXPECT_EQ(field.functions, (std::vector<std::string>{"boxAt", "sphereAt", "subtract"}));
    for (const char* part : {"boxAt(p0, vec3(0.5, 0.5, 0.5))", "sphereAt(p0, 0.5)", "m0 = 3u", "m1 = 7u"})
        EXPECT_TRUE(holds(field.text, part)) << part;
    for (const char* part :
         {"torusAt", "sine", "choose", "less", "smoothUnite", "ew_table", "for", "EDGEWISE"})
        EXPECT_FALSE(holds(field.text, part)) << part;
    EXPECT_TRUE(field.batches.empty());
    EXPECT_TRUE(field.prune_text.empty());
}

TEST(GlslText, BringsWhatItsFunctionsCall) {
    Tree tree;
    tree.root = tree.add(Kind::kGyroid, {1.0, 0.1});
    const GlslField field = glslText(lower(tree));
    const std::size_t sine = field.text.find("real sine("), cosine = field.text.find("real cosine("),
                      gyroid = field.text.find("real gyroidAt(");
    EXPECT_LT(sine, cosine);
    EXPECT_LT(cosine, gyroid);
    EXPECT_LT(gyroid, field.text.size());
}

TEST(GlslText, NumbersReadBackAsTheirFloats) {
    RandomTree random(11);
    for (int i = 0; i < 10000; ++i) {
        const double number = random.number(-1.0, 1.0) * std::pow(10.0, random.number(-6.0, 6.0));
        const std::string text = glslNumber(number);
        const char* digits = text.c_str() + (text[0] == '(');
        EXPECT_EQ(std::strtof(digits, nullptr), static_cast<float>(number)) << text;
        EXPECT_TRUE(text.find_first_of(".e") != text.npos) << text;
    }
}

TEST(GlslText, LikeChildrenAreALoopOverATable) {
    const GlslField field = glslText(lower(manySpheres(40)));
    ASSERT_EQ(field.batches.size(), 1u);
    EXPECT_EQ(field.batches[0].rows, 39u);   // the first child begins the fold
    EXPECT_EQ(field.batches[0].stride, 1u);  // x, radius, material: y and z are alike
    EXPECT_EQ(field.table.size(), 39u);
    EXPECT_EQ(field.table[0][2], 1u);
    EXPECT_EQ(field.rows(), 39u);
    EXPECT_TRUE(holds(field.text, "0.25, 0.0)"));
    EXPECT_TRUE(glslText(lower(manySpheres(16))).batches.empty());
    // A child is three instructions.
    EXPECT_TRUE(glslText(lower(manySpheres(40)), {.least_instructions = 118}).batches.empty());
    EXPECT_EQ(glslText(lower(manySpheres(40)), {.least_instructions = 117}).batches.size(), 1u);
}

TEST(GlslText, ChildrenThatDifferInMoreThanNumbersAreNoBatch) {
    Tree tree;
    std::vector<std::uint32_t> children;
    for (int i = 0; i < 60; ++i)
        children.push_back(tree.add(i % 2 ? Kind::kSphere : Kind::kOctahedron, {0.1 + 0.01 * i}));
    tree.root = tree.add(Kind::kUnion, {}, children);
    EXPECT_TRUE(glslText(lower(tree)).batches.empty());
}

}  // namespace
}  // namespace edgewise::sdf
