// The header comments of a .map.glsl.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace edgewise::sdf {

/// "// KEY: WORDS" of a line.
struct HeaderLine {
    int line = 1;
    std::string_view key, words;
};

/// The `//` lines with a key among the comments, blank lines, directives (#version) and `precision`
/// statements at the top of a text.
std::vector<HeaderLine> headerLines(std::string_view text);

/// The text with every comment as one blank, its line ends kept.
std::string withoutComments(std::string_view text);

/// A name in a header line and how many numbers follow it.
struct HeaderWord {
    std::string_view name;
    int count;
    bool required;
};

/// The numbers behind each word, in the order of `words`; empty where it is absent. A word without a name
/// takes what stands first. Throws SceneError "line N".
std::vector<std::vector<double>> readHeaderWords(const HeaderLine& header,
                                                 const std::vector<HeaderWord>& words);

}  // namespace edgewise::sdf
