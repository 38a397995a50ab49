// Preprocessed GLSL as words and signs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace edgewise::vulkan {

struct GlslToken {
    std::string_view text;  ///< a word, a number, or one character of anything else
    std::size_t begin = 0;  ///< in the text
    int line = 1;           ///< as `#line` counts
    bool word = false;      ///< starts with a letter or an underscore
    std::size_t end() const { return begin + text.size(); }
};

/// Without space and without directives' lines. Refers to the text.
std::vector<GlslToken> glslTokens(std::string_view text);

/// The index after the bracket that closes the one at `open`; the number of tokens where none does.
std::size_t afterClosing(const std::vector<GlslToken>& tokens, std::size_t open);

/// What stands outside of all braces: a function's definition, or a declaration up to its semicolon.
struct GlslPart {
    std::size_t first = 0, last = 0;  ///< tokens, half open
    std::string_view name;            ///< of what is defined or declared; the first of several
    bool is_function = false;         ///< with a body
    std::size_t body = 0;             ///< of a function: its opening brace's token
};
std::vector<GlslPart> glslParts(const std::vector<GlslToken>& tokens);

}  // namespace edgewise::vulkan
