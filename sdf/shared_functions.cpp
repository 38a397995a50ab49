#include "sdf/shared_functions.h"

#include <array>
#include <cassert>
#include <cctype>
#include <string_view>
#include <vector>

#include "sdf_operators_text.h"
#include "sdf_shapes_text.h"
#include "sdf_sine_text.h"

namespace edgewise::sdf {
namespace {

constexpr std::string_view kMark = "EDGEWISE_FN ";

struct Function {
    std::string name, text;
    std::set<std::string> words;
};

/// The name stands before the first parenthesis.
std::string nameOf(std::string_view text) {
    const std::size_t end = text.find('('), begin = text.rfind(' ', end) + 1;
    return std::string(text.substr(begin, end - begin));
}

std::set<std::string> wordsOf(std::string_view text) {
    std::set<std::string> words;
    std::string word;
    for (const char c : text) {
        if (std::isalnum(static_cast<unsigned char>(c)) || c == '_') {
            word += c;
        } else if (!word.empty()) {
            words.insert(std::move(word));
            word.clear();
        }
    }
    return words;
}

/// A definition ends at the brace of the first column.
std::vector<Function> parse() {
    std::vector<Function> functions;
    for (const std::string_view file : {kSdf_sine, kSdf_shapes, kSdf_operators})
        for (std::size_t at = file.find(kMark); at != file.npos; at = file.find(kMark, at + 1)) {
            const std::size_t begin = at + kMark.size(), end = file.find("\n}", begin) + 3;
            const std::string_view text = file.substr(begin, end - begin);
            functions.push_back({nameOf(text), std::string(text), wordsOf(text)});
        }
    return functions;
}

const std::vector<Function>& all() {
    static const std::vector<Function> functions = parse();
    return functions;
}

struct Helper {
    std::string_view name, text;
};
constexpr std::array kHelpers{
    Helper{"square", "real square(real a) { return a * a; }\n"},
    Helper{"less", "bool less(real a, real b) { return a < b; }\n"},
    Helper{"choose", "real choose(bool condition, real a, real b) { return condition ? a : b; }\n"}};

}  // namespace

std::string sharedFunctions(const std::set<std::string>& wanted) {
    std::set<std::string> needed = wanted;
    // Functions call only what stands before them, so that one pass from the end finds all.
    for (auto function = all().rbegin(); function != all().rend(); ++function)
        if (needed.contains(function->name)) needed.insert(function->words.begin(), function->words.end());
    std::string text = "#define real float\n";
    for (const Helper& helper : kHelpers)
        if (needed.contains(std::string(helper.name))) text += helper.text;
    for (const Function& function : all())
        if (needed.contains(function.name)) text += function.text;
    return text;
}

}  // namespace edgewise::sdf
