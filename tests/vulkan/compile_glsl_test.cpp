#include "pipeline/vulkan/compile_glsl.h"

#include <gtest/gtest.h>

namespace edgewise::vulkan {
namespace {

TEST(CompileGlsl, MakesSpirv) {
    const std::vector<std::uint32_t> words = compileGlsl("#version 460\nvoid main() {}\n");
    ASSERT_GT(words.size(), 5u);
    EXPECT_EQ(words[0], 0x07230203u);
}

TEST(CompileGlsl, SaysWhereTheFirstErrorIs) {
    try {
        compileGlsl("#version 460\nvoid f();\n#line 41 1\nfloat g() { return 1.0; }\nvoid f() { x = 1; }\n");
        FAIL();
    } catch (const GlslError& error) {
        EXPECT_EQ(error.source, 1);
        EXPECT_EQ(error.line, 42);
        EXPECT_NE(std::string(error.what()).find("undeclared identifier"), std::string::npos) << error.what();
    }
}

TEST(CompileGlsl, PreprocessingKeepsLines) {
    const std::string text = preprocessGlsl(
        "#version 460\n#define N(a) for (int i = 0; i < a; ++i)\n// for\n/* while\n*/\n#if "
        "0\nno\n#endif\nN(3) x();\n");
    std::size_t line = 1;
    for (std::size_t i = 0; i < text.find("for"); ++i) line += text[i] == '\n';
    EXPECT_EQ(line, 9u) << text;
    EXPECT_EQ(text.find("while"), text.npos);
    EXPECT_THROW(preprocessGlsl("#version 460\n#if\n"), GlslError);
}

}  // namespace
}  // namespace edgewise::vulkan
