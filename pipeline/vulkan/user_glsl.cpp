#include "pipeline/vulkan/user_glsl.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "pipeline/error.h"
#include "pipeline/vulkan/compile_glsl.h"
#include "pipeline/vulkan/glsl_tokens.h"
#include "pipeline/vulkan/macro_growth.h"
#include "pipeline/vulkan/spirv_cost.h"
#include "pipeline/vulkan/text_edits.h"
#include "pipeline/vulkan/user_calls.h"
#include "pipeline/vulkan/user_tables.h"
#include "pipeline/vulkan/user_words.h"
#include "sdf/map_header.h"

namespace edgewise::vulkan {
namespace {

using Tokens = std::vector<GlslToken>;
using Names = std::set<std::string_view>;

const Names kStorage{"uniform", "in", "out", "varying", "attribute", "flat", "smooth", "centroid"};

[[noreturn]] void failAt(const std::string& file, int line, const std::string& why) {
    if (line <= 0) throw InputError(file, why);
    throw InputError(file, fmt::format("line {}: {}", line, why));
}

[[noreturn]] void failAt(const std::string& file, const GlslError& error) {
    const auto trimmed = [](std::string_view text) {
        const std::size_t first = std::min(text.find_first_not_of(' '), text.size());
        return text.substr(first, text.find_last_not_of(" :") + 1 - first);
    };
    std::string_view why = trimmed(error.what());
    if (why.starts_with("''")) why = trimmed(why.substr(why.find(':') + 1));
    constexpr std::size_t kMostOfMessage = 240;
    failAt(file, error.line, std::string(why.substr(0, kMostOfMessage)));
}

/// Without what is ours to say (#version, #extension), what is nobody's (#pragma), and #line: errors name the
/// file's own lines. Takes text without comments.
std::string withoutDirectives(std::string text) {
    for (std::size_t at = 0; at < text.size();) {
        std::size_t end = std::min(text.find('\n', at), text.size());
        const std::size_t hash = text.find_first_not_of(" \t\r\v\f", at);
        const std::size_t word =
            hash < end && text[hash] == '#' ? text.find_first_not_of(" \t", hash + 1) : text.npos;
        bool unwanted = false;
        for (const std::string_view name : {"version", "extension", "pragma", "line"})
            unwanted |= word < end && std::string_view(text).substr(word).starts_with(name);
        for (std::size_t i = at; unwanted && i < end; ++i) {
            const bool joins_next = i + 1 == end || (i + 2 == end && text[i + 1] == '\r');
            if (text[i] == '\\' && joins_next && end < text.size())
                end = std::min(text.find('\n', end + 1), text.size());
            if (text[i] != '\n') text[i] = ' ';
        }
        at = end + 1;
    }
    return text;
}

class Preparation {
  public:
    Preparation(const sdf::GlslMap& map, int width, int height)
        : map_(map),
          width_(width),
          height_(height),
          text_(preprocess()),
          tokens_(glslTokens(text_)),
          parts_(glslParts(tokens_)) {}

    UserGlsl run() {
        requireShortStatements();
        requireMap();
        renameWords();
        leaveOutFunctions();
        for (const GlslPart& part : parts_) {
            if (part.name == "map" || part.name == "albedo") freeParameters(part);
            if (part.is_function) startLocals(part);
            if (!part.is_function) rewriteGlobal(part);
            if (!part.is_function) readByComparisons(tokens_, part, edits_);
        }
        UserGlsl result;
        result.has_loops = countLoops();
        result.has_albedo = hasFunction("vec3", "albedo", {"vec3", "vec3"});
        result.text = inputsText() + fmt::format("#line 1 {}\n", kUserSource) + edits_.apply(text_) + "\n";
        return result;
    }

  private:
    std::string preprocess() const {
        try {
            const std::string text = withoutDirectives(sdf::withoutComments(map_.text));
            requireShortExpansion(text);
            return preprocessGlsl(text);
        } catch (const GlslError& error) {
            failAt(map_.file, error);
        }
    }

    std::vector<std::string_view> parameterTypes(const GlslPart& part, std::size_t name) const {
        static const Names kQualifiers{"in", "const", "highp", "mediump", "lowp"};
        std::vector<std::string_view> types;
        bool at_type = true;
        for (std::size_t i = name + 2; i + 1 < part.body; ++i) {
            const std::string_view word = tokens_[i].text;
            if (word == ",")
                at_type = true;
            else if (word == "[" || (at_type && !kQualifiers.contains(word)))
                types.push_back(word), at_type = false;
        }
        return types;
    }
    std::size_t nameToken(const GlslPart& part) const {
        std::size_t i = part.first;
        while (i < part.last && tokens_[i].text.data() != part.name.data()) ++i;
        return i;
    }
    bool hasFunction(std::string_view result, std::string_view name,
                     const std::vector<std::string_view>& types) const {
        return std::ranges::any_of(parts_, [&](const GlslPart& part) {
            if (!part.is_function || part.name != name) return false;
            const std::size_t at = nameToken(part);
            return at > part.first && tokens_[at - 1].text == result && parameterTypes(part, at) == types;
        });
    }

    /// glslang walks expressions by recursion: what is chained without end would exhaust its stack.
    void requireShortStatements() const {
        constexpr std::size_t kMostWords = 10000;
        std::size_t words = 0;
        for (const GlslToken& token : tokens_) {
            const char c = token.text[0];
            words = c == ';' || c == '{' || c == '}' ? 0 : words + 1;
            if (words > kMostWords)
                failAt(map_.file, token.line,
                       fmt::format("a statement has more than {} words and signs", kMostWords));
        }
    }

    /// Names that GLSL ES leaves free, and functions that are built into desktop GLSL alone.
    void renameWords() {
        Names own_functions;
        for (const GlslPart& part : parts_)
            if (part.is_function && isFunctionEsLacks(part.name)) own_functions.insert(part.name);
        for (const GlslToken& token : tokens_)
            if (token.word && (isFreeNameInEs(token.text) || own_functions.contains(token.text)))
                edits_.insert(token.begin, "ew_");
    }

    void requireMap() const {
        if (hasFunction("float", "map", {"vec3"})) return;
        for (const GlslPart& part : parts_)
            if (part.is_function && part.name == "map")
                failAt(map_.file, tokens_[part.first].line, "map is not `float map(vec3 p)`");
        throw InputError(map_.file, "there is no `float map(vec3 p)`");
    }

    void leaveOutFunctions() {
        const UserCalls calls = userCalls(tokens_, parts_);
        for (const RefusedWord& word : calls.refused)
            failAt(map_.file, tokens_[word.token].line,
                   fmt::format("{}: {}", tokens_[word.token].text, word.why));
        for (const std::size_t part : calls.left_out) eraseTokens(parts_[part].first, parts_[part].last);
    }

    void eraseTokens(std::size_t first, std::size_t last) {
        edits_.erase(tokens_[first].begin, tokens_[last - 1].end());
    }

    /// The values of inputs that a text may declare itself.
    std::string inputValue(std::string_view name, std::string_view type) const {
        for (const Input& input : inputs())
            if (input.name == name && input.type == type) return input.value;
        if (name == "iResolution" && type == "vec2") return fmt::format("vec2({}, {})", width_, height_);
        if (name == "time" || name == "u_time") return fmt::format("{}({})", type, map_.time);
        if ((name == "resolution" || name == "u_resolution") && type == "vec2")
            return fmt::format("vec2({}, {})", width_, height_);
        return fmt::format("{}(0)", type);
    }

    /// Our declarations of these functions have no qualifiers, which must agree.
    void freeParameters(const GlslPart& part) {
        const std::size_t open = nameToken(part) + 1;
        if (open >= part.last || tokens_[open].text != "(") return;
        for (std::size_t i = open; i < afterClosing(tokens_, open); ++i)
            if (tokens_[i].text == "const" || isPrecision(tokens_[i].text)) eraseTokens(i, i + 1);
    }
    static bool isPrecision(std::string_view word) {
        return word == "highp" || word == "mediump" || word == "lowp";
    }

    /// What a stage before or the program would give a value becomes a plain global.
    void rewriteGlobal(const GlslPart& part) {
        std::size_t i = part.first;
        bool storage = false;
        while (i < part.last && (tokens_[i].text == "layout" || kStorage.contains(tokens_[i].text))) {
            i = tokens_[i].text == "layout" ? afterClosing(tokens_, i + 1) : i + 1;
            storage = true;
        }
        while (i < part.last && (isPrecision(tokens_[i].text) || tokens_[i].text == "const")) ++i;
        const std::size_t type = i;
        if (type + 2 >= part.last && !storage) return;
        const bool block = type + 1 < part.last && tokens_[type + 1].text == "{";
        const bool opaque = type < part.last && isOpaqueType(tokens_[type].text);
        if (storage && (block || opaque || type + 2 >= part.last)) {
            eraseTokens(part.first, part.last);
            return;
        }
        if (storage) eraseTokens(part.first, type);
        rewriteDeclared(type, part.last, storage);
    }

    /// From a declaration's type on: what has no value gets one. WebGL starts all with 0; what a device
    /// leaves undefined may make anything of the whole expression.
    void rewriteDeclared(std::size_t type, std::size_t last, bool input) {
        int brackets = 0;
        const std::size_t behind_type =
            tokens_[type + 1].text == "[" ? afterClosing(tokens_, type + 1) : type + 1;
        for (std::size_t k = behind_type; k + 1 < last; ++k) {
            const char c = tokens_[k].text[0];
            brackets += (c == '(' || c == '{' || c == '[') - (c == ')' || c == '}' || c == ']');
            const std::string_view before = tokens_[k - 1].text;
            if (brackets != 0 || !tokens_[k].word || (k > behind_type && before != ",")) continue;
            const std::size_t after = tokens_[k + 1].text == "[" ? afterClosing(tokens_, k + 1) : k + 1;
            if (after >= tokens_.size()) return;
            const std::string_view next = tokens_[after].text;
            if (next != ";" && next != "," && next != "=") continue;
            own_.insert(tokens_[k].text);
            if (next == "=" || (!input && !isPlainType(tokens_[type].text))) continue;
            startWith(k, type, after, behind_type, input);
        }
    }
    void startWith(std::size_t name, std::size_t type, std::size_t after, std::size_t behind_type,
                   bool input) {
        const std::string_view word = tokens_[type].text;
        const bool array_name = after > name + 1, array_type = behind_type > type + 1;
        if (!array_name && !array_type) {
            const std::string value =
                input ? inputValue(tokens_[name].text, word) : fmt::format("{}(0)", word);
            edits_.insert(tokens_[name].end(), " = " + value);
            return;
        }
        // [ NUMBER ]
        const std::size_t size = array_name ? name + 2 : type + 2, close = array_name ? after : behind_type;
        unsigned count = 0;
        std::from_chars(tokens_[size].text.data(), tokens_[size].end() + text_.data(), count);
        if (close != size + 2 || array_name == array_type || count == 0 || count > kMostUserWords) return;
        std::string values;
        for (unsigned i = 0; i < count; ++i) values += fmt::format("{}{}(0)", i ? ", " : "", word);
        edits_.insert(tokens_[after - 1].end(), fmt::format(" = {}[{}]({})", word, count, values));
    }

    /// Of a function: declarations at the beginnings of statements.
    void startLocals(const GlslPart& part) {
        for (std::size_t i = part.body + 1; i + 2 < part.last; ++i) {
            const std::string_view before = tokens_[i - 1].text;
            if (tokens_[i].text == "struct") i = afterClosing(tokens_, i + 2);
            const bool begins = before == ";" || before == "{" || before == "}" || isPrecision(before);
            if (i + 2 >= part.last || !begins || !isPlainType(tokens_[i].text)) continue;
            std::size_t end = i;
            while (end < part.last && tokens_[end].text != ";") ++end;
            const Names globals = own_;
            rewriteDeclared(i, std::min(end + 1, part.last), false);
            own_ = globals;
        }
    }

    struct Input {
        std::string type, name, value;
    };
    std::vector<Input> inputs() const {
        const std::string size = fmt::format("vec3({}, {}, 1.0)", width_, height_);
        return {{"float", "iTime", fmt::format("float({})", map_.time)},
                {"float", "iGlobalTime", fmt::format("float({})", map_.time)},
                {"float", "iTimeDelta", "0.0"},
                {"float", "iFrameRate", "60.0"},
                {"float", "iSampleRate", "44100.0"},
                {"vec3", "iResolution", size},
                {"vec4", "iMouse", "vec4(0.0)"},
                {"vec4", "iDate", "vec4(0.0)"},
                {"int", "iFrame", "0"},
                {"float[4]", "iChannelTime", "float[4](0.0, 0.0, 0.0, 0.0)"},
                {"vec3[4]", "iChannelResolution", "vec3[4](vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0))"}};
    }
    /// Those that the text does not declare itself.
    std::string inputsText() const {
        std::string text;
        for (const Input& input : inputs())
            if (!own_.contains(input.name))
                text += fmt::format("const {} {} = {};\n", input.type, input.name, input.value);
        return text;
    }

    bool countLoops() {
        bool any = false;
        for (std::size_t i = 0; i + 1 < tokens_.size(); ++i) {
            const bool is_for = tokens_[i].text == "for", is_while = tokens_[i].text == "while";
            if ((!is_for && !is_while) || tokens_[i + 1].text != "(") continue;
            any = true;
            std::size_t first = i + 2, last = afterClosing(tokens_, i + 1) - 1;
            if (is_for) {
                first = semicolonAfter(first, last) + 1;
                last = semicolonAfter(first, last);
            }
            if (first <= last && last < tokens_.size()) countCondition(i, first, last);
        }
        return any;
    }
    std::size_t semicolonAfter(std::size_t at, std::size_t last) const {
        while (at < last && tokens_[at].text != ";") ++at;
        return at;
    }
    void countCondition(std::size_t loop, std::size_t first, std::size_t last) {
        const std::string turn = fmt::format("ew_turn({}u)", tokens_[loop].line);
        if (first == last) {
            edits_.insert(tokens_[last].begin, turn);
            return;
        }
        if (first + 2 < last && tokens_[first].word && tokens_[first + 1].word &&
            tokens_[first + 2].text == "=")
            failAt(map_.file, tokens_[first].line, "a loop's condition declares a variable");
        edits_.insert(tokens_[first].begin, turn + " && (");
        edits_.insert(tokens_[last - 1].end(), ")");
    }

    const sdf::GlslMap& map_;
    int width_, height_;
    std::string text_;
    Tokens tokens_;
    std::vector<GlslPart> parts_;
    Edits edits_;
    std::set<std::string_view> own_;
};

}  // namespace

UserGlsl prepareUserGlsl(const sdf::GlslMap& map, int width, int height) {
    return Preparation(map, width, height).run();
}

namespace {

/// The line where the last function of that name begins; of the last declaration without a body.
int lineOf(const std::string& shader, std::string_view name, bool with_body) {
    const Tokens tokens = glslTokens(shader);
    int line = 0;
    for (const GlslPart& part : glslParts(tokens))
        if (part.is_function == with_body && part.name == name) line = tokens[part.first].line;
    return line;
}

/// What is found when all is linked has no place; our own text is not recursive.
[[noreturn]] void failLinking(const std::string& shader, const std::string& file, const GlslError& error) {
    // "... Recursion detected: f(vf3; calling g(vf3;", "... No function definition (body) found: f(vf3;"
    const std::string_view why = error.what();
    const auto nameBehind = [&](std::string_view mark) {
        const std::size_t at = why.find(mark);
        if (at == why.npos) return std::string_view();
        const std::string_view rest =
            why.substr(std::min(why.find_first_not_of(' ', at + mark.size()), why.size()));
        return rest.substr(0, rest.find('('));
    };
    if (const auto name = nameBehind(" calling "); !name.empty())
        failAt(file, lineOf(shader, name, true),
               fmt::format("{} calls itself, which GLSL does not allow", name));
    if (const auto name = nameBehind("(body) found:"); !name.empty())
        failAt(file, lineOf(shader, name, false),
               fmt::format("{} is declared and called, and has no body", name));
    failAt(file, error);
}

void requireCheap(const std::vector<std::uint32_t>& spirv, const std::string& file) {
    const SpirvCost cost = spirvCost(spirv);
    if (cost.instructions > kMostUserInstructions)
        throw FailureError(file, fmt::format("the map is too long: with all functions in the place of their "
                                             "calls it has {:.3g} instructions, more than {}",
                                             cost.instructions, kMostUserInstructions));
    if (cost.array_words > kMostUserWords)
        throw FailureError(file, fmt::format("the map's arrays take {:.3g} words of 4 bytes, more than {}",
                                             cost.array_words, kMostUserWords));
}

}  // namespace

std::vector<std::uint32_t> compileWithUserGlsl(const std::string& shader, const std::string& file) {
    try {
        std::vector<std::uint32_t> spirv = compileGlsl(shader);
        requireCheap(spirv, file);
        return spirv;
    } catch (const GlslError& error) {
        if (error.line == 0) failLinking(shader, file, error);
        if (error.source == kUserSource) failAt(file, error);
        throw FailureError(file, fmt::format("the shader around it does not compile (line {}): {}",
                                             error.line, error.what()));
    }
}

}  // namespace edgewise::vulkan
