#include "pipeline/vulkan/user_glsl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "pipeline/error.h"
#include "pipeline/vulkan/compile_glsl.h"
#include "pipeline/vulkan/glsl_tokens.h"

namespace edgewise::vulkan {
namespace {

using Tokens = std::vector<GlslToken>;
using Names = std::set<std::string_view>;

const Names kEntryPoints{"main", "mainImage", "mainVR", "mainSound", "mainCubemap"};
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
    failAt(file, error.line, std::string(why));
}

/// Without #version, which must come first and is ours, and #extension, which must not come later.
std::string withoutDirectives(std::string text, const Names& unwanted) {
    for (std::size_t at = 0; at < text.size(); at = text.find('\n', at)) {
        at = text.find_first_not_of("\n\r", at);
        if (at == text.npos) break;
        const std::size_t hash = text.find_first_not_of(" \t", at),
                          end = std::min(text.find('\n', at), text.size());
        if (hash >= end || text[hash] != '#') continue;
        const std::size_t word = text.find_first_not_of(" \t", hash + 1);
        for (const std::string_view name : unwanted)
            if (word < end && std::string_view(text).substr(word).starts_with(name))
                std::fill(text.begin() + static_cast<std::ptrdiff_t>(at),
                          text.begin() + static_cast<std::ptrdiff_t>(end), ' ');
    }
    return text;
}

/// Insertions and erasures by place in the text.
class Edits {
  public:
    void insert(std::size_t at, std::string text) { edits_.emplace(at, Edit{0, std::move(text)}); }
    void erase(std::size_t begin, std::size_t end) { edits_.emplace(begin, Edit{end - begin, {}}); }
    /// Lines keep their numbers: ends of lines stay.
    std::string apply(const std::string& text) const {
        std::string result;
        std::size_t at = 0;
        for (const auto& [place, edit] : edits_) {
            if (place < at) continue;  // within what was erased
            result.append(text, at, place - at);
            result += edit.text;
            at = place + edit.erased;
            result.append(
                static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(place),
                                                    text.begin() + static_cast<std::ptrdiff_t>(at), '\n')),
                '\n');
        }
        return result.append(text, at);
    }

  private:
    struct Edit {
        std::size_t erased;
        std::string text;
    };
    std::multimap<std::size_t, Edit> edits_;
};

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
        keepFreeNames();
        leaveOutEntryPoints();
        for (const GlslPart& part : parts_)
            if (!part.is_function) rewriteGlobal(part);
        UserGlsl result;
        result.has_loops = countLoops();
        result.has_albedo = hasFunction("vec3", "albedo", {"vec3", "vec3"});
        result.text = inputs() + fmt::format("#line 1 {}\n", kUserSource) + edits_.apply(text_) + "\n";
        return result;
    }

  private:
    std::string preprocess() const {
        try {
            return withoutDirectives(preprocessGlsl(withoutDirectives(map_.text, {"version", "extension"})),
                                     {"version", "extension", "pragma"});
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
            else if (at_type && !kQualifiers.contains(word))
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

    /// Names in GLSL ES that are words of desktop GLSL's own.
    void keepFreeNames() {
        static const Names kDesktopWords{"buffer", "shared", "precise"};
        for (const GlslToken& token : tokens_)
            if (kDesktopWords.contains(token.text)) edits_.insert(token.begin, "ew_");
    }

    void requireMap() const {
        if (hasFunction("float", "map", {"vec3"})) return;
        for (const GlslPart& part : parts_)
            if (part.is_function && part.name == "map")
                failAt(map_.file, tokens_[part.first].line, "map is not `float map(vec3 p)`");
        throw InputError(map_.file, "there is no `float map(vec3 p)`");
    }

    /// Functions that the part names.
    Names calls(const GlslPart& part, const std::map<std::string_view, Names>& known) const {
        Names names;
        for (std::size_t i = part.is_function ? part.body : part.first; i < part.last; ++i)
            if (tokens_[i].word && known.contains(tokens_[i].text)) names.insert(tokens_[i].text);
        return names;
    }
    static void reach(std::string_view from, const std::map<std::string_view, Names>& graph, Names& seen) {
        if (!seen.insert(from).second) return;
        for (const std::string_view to : graph.at(from)) reach(to, graph, seen);
    }

    void leaveOutEntryPoints() {
        std::map<std::string_view, Names> graph;
        for (const GlslPart& part : parts_)
            if (part.is_function) graph[part.name];
        Names called, from_globals;
        for (const GlslPart& part : parts_) {
            const Names names = calls(part, graph);
            if (part.is_function) {
                graph[part.name].insert(names.begin(), names.end());
                called.insert(names.begin(), names.end());
            } else if (std::any_of(tokens_.begin() + static_cast<std::ptrdiff_t>(part.first),
                                   tokens_.begin() + static_cast<std::ptrdiff_t>(part.last),
                                   [](const GlslToken& t) { return t.text == "="; })) {
                from_globals.insert(names.begin(), names.end());
            }
        }
        Names shown, wanted;
        for (const auto& [name, unused] : graph) {
            if (kEntryPoints.contains(name))
                reach(name, graph, shown);
            else if (!called.contains(name) || name == "map" || name == "albedo")
                reach(name, graph, wanted);
        }
        for (const std::string_view name : from_globals) reach(name, graph, wanted);
        for (const GlslPart& part : parts_)
            if (part.is_function && shown.contains(part.name) && !wanted.contains(part.name))
                eraseTokens(part.first, part.last);
    }

    void eraseTokens(std::size_t first, std::size_t last) {
        edits_.erase(tokens_[first].begin, tokens_[last - 1].end());
    }

    /// The values of inputs that a text may declare itself.
    std::string inputValue(std::string_view name, std::string_view type) const {
        if (name == "time" || name == "u_time") return fmt::format("{}({})", type, map_.time);
        if ((name == "resolution" || name == "u_resolution") && type == "vec2")
            return fmt::format("vec2({}, {})", width_, height_);
        return fmt::format("{}(0)", type);
    }

    void rewriteGlobal(const GlslPart& part) {
        std::size_t i = part.first;
        bool storage = false;
        while (i < part.last) {
            if (tokens_[i].text == "layout")
                i = afterClosing(tokens_, i + 1);
            else if (!kStorage.contains(tokens_[i].text))
                break;
            else
                ++i;
            storage = true;
        }
        while (i < part.last &&
               (tokens_[i].text == "highp" || tokens_[i].text == "mediump" || tokens_[i].text == "lowp"))
            ++i;
        if (!storage) {
            if (i + 1 < part.last) own_.insert(part.name);
            return;
        }
        const std::string_view type = i < part.last ? tokens_[i].text : std::string_view();
        if (inputNames().contains(part.name) || type.starts_with("sampler") || i + 2 >= part.last) {
            eraseTokens(part.first, part.last);
            return;
        }
        own_.insert(part.name);
        eraseTokens(part.first, i);
        for (std::size_t k = i + 1; k + 1 < part.last; ++k)
            if (tokens_[k].word && (tokens_[k + 1].text == ";" || tokens_[k + 1].text == ","))
                edits_.insert(tokens_[k].end(), " = " + inputValue(tokens_[k].text, type));
    }

    static const Names& inputNames() {
        static const Names names{"iTime",       "iGlobalTime", "iTimeDelta", "iFrameRate", "iSampleRate",
                                 "iResolution", "iMouse",      "iDate",      "iFrame"};
        return names;
    }
    std::string inputs() const {
        const std::array<std::array<std::string, 3>, 9> all{{
            {"float", "iTime", fmt::format("float({})", map_.time)},
            {"float", "iGlobalTime", fmt::format("float({})", map_.time)},
            {"float", "iTimeDelta", "0.0"},
            {"float", "iFrameRate", "60.0"},
            {"float", "iSampleRate", "44100.0"},
            {"vec3", "iResolution", fmt::format("vec3({}, {}, 1.0)", width_, height_)},
            {"vec4", "iMouse", "vec4(0.0)"},
            {"vec4", "iDate", "vec4(0.0)"},
            {"int", "iFrame", "0"},
        }};
        std::string text;
        for (const auto& [type, name, value] : all)
            if (!own_.contains(name)) text += fmt::format("const {} {} = {};\n", type, name, value);
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

std::vector<std::uint32_t> compileWithUserGlsl(const std::string& shader, const std::string& file) {
    try {
        return compileGlsl(shader);
    } catch (const GlslError& error) {
        // What is found when all is linked (recursion) has no place; our own text has none of it.
        if (error.source == kUserSource || error.line == 0) failAt(file, error);
        throw FailureError(file, fmt::format("the shader around it does not compile (line {}): {}",
                                             error.line, error.what()));
    }
}

}  // namespace edgewise::vulkan
