#include "pipeline/vulkan/glsl_tokens.h"

#include <cctype>
#include <charconv>

namespace edgewise::vulkan {
namespace {

bool isWordCharacter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

/// What follows `#line` is that line's number.
void readLineDirective(std::string_view directive, int& line) {
    const std::size_t word = directive.find("line");
    if (word == directive.npos) return;
    const std::size_t digits = directive.find_first_of("0123456789", word);
    if (digits == directive.npos) return;
    int number = 0;
    std::from_chars(directive.data() + digits, directive.data() + directive.size(), number);
    line = number - 1;  // its own end of line comes next
}

std::size_t wordEnd(std::string_view text, std::size_t at) {
    const bool number = std::isdigit(static_cast<unsigned char>(text[at]));
    std::size_t end = at + 1;
    while (end < text.size() && (isWordCharacter(text[end]) || (number && text[end] == '.'))) ++end;
    return end;
}

}  // namespace

std::vector<GlslToken> glslTokens(std::string_view text) {
    std::vector<GlslToken> tokens;
    int line = 1;
    bool first_of_line = true;
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at];
        if (c == '\n') {
            ++line, ++at, first_of_line = true;
        } else if (std::isspace(static_cast<unsigned char>(c))) {
            ++at;
        } else if (c == '#' && first_of_line) {
            const std::size_t end = std::min(text.find('\n', at), text.size());
            readLineDirective(text.substr(at, end - at), line);
            at = end;
        } else {
            const std::size_t end = isWordCharacter(c) ? wordEnd(text, at) : at + 1;
            tokens.push_back({text.substr(at, end - at), at, line,
                              isWordCharacter(c) && !std::isdigit(static_cast<unsigned char>(c))});
            at = end, first_of_line = false;
        }
    }
    return tokens;
}

std::size_t afterClosing(const std::vector<GlslToken>& tokens, std::size_t open) {
    int depth = 0;
    for (std::size_t i = open; i < tokens.size(); ++i) {
        const char c = tokens[i].text[0];
        depth += c == '(' || c == '{' || c == '[';
        depth -= c == ')' || c == '}' || c == ']';
        if (depth == 0) return i + 1;
    }
    return tokens.size();
}

std::vector<GlslPart> glslParts(const std::vector<GlslToken>& tokens) {
    std::vector<GlslPart> parts;
    for (std::size_t at = 0; at < tokens.size();) {
        GlslPart part{at, at, {}, false, 0};
        std::size_t i = at;
        bool open = true;
        bool after_parameters = false;
        while (i < tokens.size() && open) {
            const char c = tokens[i].text[0];
            if (c == '{' && after_parameters) {
                part.is_function = true, part.body = i;
                i = afterClosing(tokens, i), open = false;
            } else if (c == '(' || c == '{' || c == '[') {
                const std::size_t after = afterClosing(tokens, i);
                // Behind an array's type, as in `float[2] f(vec3 p)`, comes the name.
                const bool type = c == '[' && after < tokens.size() && tokens[after].word;
                const bool named = part.name.empty() && i > at + 1 && tokens[i - 1].word && !type;
                after_parameters = c == '(' && named;
                if (named && c != '{') part.name = tokens[i - 1].text;
                i = after;
            } else {
                open = c != ';';
                if ((c == ';' || c == '=' || c == ',') && part.name.empty() && i > at)
                    part.name = tokens[i - 1].text;
                ++i;
                after_parameters = false;
            }
        }
        part.last = i;
        parts.push_back(part);
        at = i;
    }
    return parts;
}

}  // namespace edgewise::vulkan
