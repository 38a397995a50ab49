#include "pipeline/vulkan/macro_growth.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <map>
#include <vector>

#include "pipeline/vulkan/compile_glsl.h"
#include "pipeline/vulkan/glsl_tokens.h"

namespace edgewise::vulkan {
namespace {

using Tokens = std::vector<GlslToken>;

/// constant + the sum of factor[i] times the words of argument i.
struct Growth {
    double constant = 0.0;
    std::vector<double> factor;

    void add(const Growth& more, double times = 1.0) {
        constant += times * more.constant;
        if (factor.size() < more.factor.size()) factor.resize(more.factor.size());
        for (std::size_t i = 0; i < more.factor.size(); ++i) factor[i] += times * more.factor[i];
    }
    void raise(const Growth& other) {
        constant = std::max(constant, other.constant);
        if (factor.size() < other.factor.size()) factor.resize(other.factor.size());
        for (std::size_t i = 0; i < other.factor.size(); ++i)
            factor[i] = std::max(factor[i], other.factor[i]);
    }
};

struct Macro {
    bool takes_arguments = false;
    std::vector<std::string_view> parameters;
    Tokens body;
};

class Expansion {
  public:
    void define(const Tokens& line, const std::string& text) {
        // # define NAME...
        if (line.size() < 3 || !line[2].word) return;
        Macro macro;
        std::size_t at = 3;
        macro.takes_arguments = at < line.size() && text[line[2].end()] == '(';
        if (macro.takes_arguments) {
            for (++at; at < line.size() && line[at].text != ")"; ++at)
                if (line[at].word) macro.parameters.push_back(line[at].text);
            ++at;
        }
        if (at < line.size()) macro.body.assign(line.begin() + static_cast<std::ptrdiff_t>(at), line.end());
        macros_[line[2].text].push_back(std::move(macro));
    }

    /// After all are defined.
    void settle() {
        Growth worst{0.0, {1.0}};
        for (const auto& [name, unused] : macros_) {
            const Growth& growth = growthOf(name, 0);
            worst.constant = std::max(worst.constant, growth.constant);
            for (const double factor : growth.factor) worst.factor[0] = std::max(worst.factor[0], factor);
        }
        any_ = worst, known_.clear();
    }

    double words(const Tokens& tokens) { return scan(tokens, 0, tokens.size(), {}, 0).constant; }

  private:
    using Names = std::vector<std::string_view>;

    const Growth& growthOf(std::string_view name, int depth) {
        if (const auto found = known_.find(name); found != known_.end()) return found->second;
        if (depth > kMostMacroNesting)
            throw GlslError(0, macros_.at(name).front().body.front().line,
                            fmt::format("macros nest deeper than {}", kMostMacroNesting));
        known_[name] = Growth{1.0, {}};  // within itself a macro is a plain word
        Growth longest;
        for (const Macro& macro : macros_.at(name)) {
            Growth growth = scan(macro.body, 0, macro.body.size(), macro.parameters, depth + 1);
            // Arguments are replaced whether they are used or not.
            growth.factor.resize(macro.parameters.size());
            for (double& factor : growth.factor) factor = std::max(factor, 1.0);
            longest.raise(growth);
        }
        return known_[name] = longest;
    }

    bool isMacro(std::string_view word) const { return macros_.contains(word); }
    bool takesArguments(std::string_view word) const {
        return std::ranges::any_of(macros_.at(word), &Macro::takes_arguments);
    }
    /// Whether what follows the macro may be the arguments of what it ends with.
    bool endsWithCall(std::string_view name) const {
        return std::ranges::any_of(macros_.at(name), [&](const Macro& macro) {
            return !macro.body.empty() && macro.body.back().word;
        });
    }

    Growth scan(const Tokens& tokens, std::size_t first, std::size_t last, const Names& parameters,
                int depth) {
        Growth total;
        for (std::size_t i = first; i < last;) {
            const auto parameter = std::ranges::find(parameters, tokens[i].text);
            const bool is_parameter = parameter != parameters.end();
            const std::string_view word = tokens[i++].text;
            bool may_call = is_parameter;
            if (is_parameter) {
                Growth one;
                one.factor.resize(parameters.size());
                one.factor[static_cast<std::size_t>(parameter - parameters.begin())] = 1.0;
                total.add(one);
            } else if (isMacro(word)) {
                const Growth growth = growthOf(word, depth);
                const bool call = i < last && tokens[i].text == "(" && takesArguments(word);
                if (call) i = apply(growth, tokens, i, last, parameters, depth, total);
                if (!call) total.add({growth.constant, {}});
                may_call = endsWithCall(word);
            } else {
                const bool pastes = word == "#" && i < last && tokens[i].text == "#";
                total.constant += pastes ? std::max(any_.constant, 1.0) : 1.0;
            }
            while (may_call && i < last && tokens[i].text == "(")
                i = apply(any_, tokens, i, last, parameters, depth, total);
        }
        return total;
    }

    /// Adds the growth with the arguments in the brackets at `open`; gives the place behind them.
    std::size_t apply(const Growth& growth, const Tokens& tokens, std::size_t open, std::size_t last,
                      const Names& parameters, int depth, Growth& total) {
        total.constant += growth.constant;
        std::size_t at = open + 1, argument = 0;
        for (int brackets = 1; at < last && brackets > 0; ++argument) {
            const std::size_t begin = at;
            for (; at < last; ++at) {
                const char c = tokens[at].text[0];
                brackets += c == '(';
                brackets -= c == ')';
                if (brackets == 0 || (brackets == 1 && c == ',')) break;
            }
            const std::size_t which = std::min(argument, growth.factor.size() - 1);
            total.add(scan(tokens, begin, at, parameters, depth),
                      growth.factor.empty() ? 1.0 : growth.factor[which]);
            if (at < last) ++at;
        }
        return at;
    }

    std::map<std::string_view, std::vector<Macro>> macros_;
    std::map<std::string_view, Growth> known_;
    Growth any_{0.0, {1.0}};  ///< of a macro that is not known: the worst of all
};

/// Lines that end in a backslash joined; the line ends stay, as blanks.
std::string joinedLines(std::string text) {
    for (std::size_t at = text.find('\\'); at != text.npos; at = text.find('\\', at + 1)) {
        std::size_t end = at + 1;
        if (end < text.size() && text[end] == '\r') ++end;
        if (end < text.size() && text[end] == '\n') text[at] = ' ', text[end] = '\v';
    }
    return text;
}

struct Line {
    std::string text;
    Tokens tokens;
    int number;
};

std::deque<Line> linesOf(const std::string& text) {
    std::deque<Line> lines;
    int number = 1;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        lines.push_back({text.substr(at, end - at), {}, number});
        Line& line = lines.back();
        number += 1 + static_cast<int>(std::ranges::count(line.text, '\v'));
        // A directive's sign is a word among others here.
        const std::size_t hash = line.text.find_first_not_of(" \t\r\v\f");
        const bool directive = hash != line.text.npos && line.text[hash] == '#';
        if (directive) line.text[hash] = ';';
        line.tokens = glslTokens(line.text);
        if (directive) line.text[hash] = '#';
        for (GlslToken& token : line.tokens) token.line = line.number;
        at = end + 1;
    }
    return lines;
}

bool isDirective(const Line& line, std::string_view name) {
    return line.tokens.size() > 1 && line.tokens[0].text == "#" && line.tokens[1].text == name;
}

void requireShallow(const std::deque<Line>& lines) {
    int depth = 0;
    for (const Line& line : lines)
        for (const GlslToken& token : line.tokens) {
            const char c = token.text[0];
            depth += c == '(' || c == '[' || c == '{';
            depth -= (c == ')' || c == ']' || c == '}') && depth > 0;
            if (depth > kMostGlslBrackets)
                throw GlslError(0, token.line,
                                fmt::format("brackets nest deeper than {}", kMostGlslBrackets));
        }
}

}  // namespace

void requireShortExpansion(const std::string& text) {
    const std::deque<Line> lines = linesOf(joinedLines(text));
    requireShallow(lines);
    Expansion expansion;
    for (const Line& line : lines)
        if (isDirective(line, "define")) expansion.define(line.tokens, line.text);
    expansion.settle();
    // Statements go over lines, and so do a macro's arguments.
    double words = 0.0;
    Tokens statement;
    const auto count = [&](int line) {
        words += expansion.words(statement);
        statement.clear();
        if (words > static_cast<double>(kMostGlslWords))
            throw GlslError(0, line,
                            fmt::format("with its macros replaced the text has more than {} words "
                                        "and signs",
                                        kMostGlslWords));
    };
    for (const Line& line : lines) {
        if (isDirective(line, "define")) continue;
        for (const GlslToken& token : line.tokens) {
            statement.push_back(token);
            if (token.text == ";") count(line.number);
        }
        if (!line.tokens.empty() && line.tokens[0].text == "#") count(line.number);
    }
    count(lines.empty() ? 1 : lines.back().number);
}

}  // namespace edgewise::vulkan
