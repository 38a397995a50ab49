#include "sdf/map_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "sdf/scene_error.h"

namespace edgewise::sdf {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";
constexpr double kLargest = 1e6;

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

std::vector<std::string_view> wordsOf(std::string_view text) {
    std::vector<std::string_view> words;
    for (std::size_t end = 0;;) {
        const std::size_t begin = text.find_first_not_of(kBlanks, end);
        if (begin == std::string_view::npos) return words;
        end = std::min(text.find_first_of(kBlanks, begin), text.size());
        words.push_back(text.substr(begin, end - begin));
    }
}

[[noreturn]] void refuse(const HeaderLine& header, const std::string& rule) {
    throw SceneError(fmt::format("line {}", header.line), fmt::format("{}: {}", header.key, rule));
}

double readNumber(const HeaderLine& header, std::string_view word) {
    double value = 0.0;
    std::string_view digits = word;
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (read.ec != std::errc() || read.ptr != digits.data() + digits.size() || !(std::abs(value) <= kLargest))
        refuse(header,
               fmt::format("'{}' is not a number from {} to {}", word.substr(0, 40), -kLargest, kLargest));
    return value;
}

std::string usageOf(const std::vector<HeaderWord>& words) {
    std::string usage;
    for (const HeaderWord& word : words) {
        const std::string part = fmt::format("{}{}{}", word.name, word.name.empty() ? "" : " ",
                                             word.count == 1 ? "a number" : "three numbers");
        usage += (usage.empty() ? "" : ", ") + (word.required ? part : "[" + part + "]");
    }
    return usage;
}

}  // namespace

namespace {

/// What follows the block comments that a line goes on with or begins with.
std::string_view behindBlocks(std::string_view line, bool& in_block) {
    while (in_block || line.starts_with("/*")) {
        if (!in_block) line.remove_prefix(2);
        const std::size_t close = line.find("*/");
        in_block = close == std::string_view::npos;
        if (in_block) return {};
        line = trimmed(line.substr(close + 2));
    }
    return line;
}

/// Whether a block comment that begins in a line of code goes on behind it.
bool opensBlock(std::string_view line) {
    for (std::size_t at = 0; at + 1 < line.size(); ++at) {
        if (line.substr(at, 2) == "//") return false;
        if (line.substr(at, 2) != "/*") continue;
        const std::size_t close = line.find("*/", at + 2);
        if (close == std::string_view::npos) return true;
        at = close + 1;
    }
    return false;
}

}  // namespace

std::vector<HeaderLine> headerLines(std::string_view text) {
    std::vector<HeaderLine> lines;
    bool in_block = false, in_code = false;
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = text.find('\n');
        std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
        line = behindBlocks(line, in_block);
        if (line.empty() || line.starts_with('#') || line.starts_with("precision ")) continue;
        if (!line.starts_with("//")) {
            in_code = true, in_block = opensBlock(line);
            continue;
        }
        const std::string_view comment = trimmed(line.substr(2));
        const std::size_t colon = comment.find(':');
        if (colon == std::string_view::npos) continue;
        const HeaderLine found{number, trimmed(comment.substr(0, colon)), trimmed(comment.substr(colon + 1))};
        // A bound may stand beside the map that it is of; what other comments say there is not for us.
        if (!in_code || found.key == "lipschitz") lines.push_back(found);
    }
    return lines;
}

namespace {

/// Up to the line's end, which is none behind a backslash.
std::size_t lineSize(std::string_view text) {
    std::size_t end = text.find('\n');
    while (end != std::string_view::npos) {
        const std::size_t before = text[end - 1] == '\r' && end > 1 ? end - 2 : end - 1;
        if (text[before] != '\\') return end;
        end = text.find('\n', end + 1);
    }
    return text.size();
}

}  // namespace

std::string withoutComments(std::string_view text) {
    std::string code;
    for (std::size_t i = 0; i < text.size();) {
        const std::string_view rest = text.substr(i);
        if (!rest.starts_with("//") && !rest.starts_with("/*")) {
            code += text[i++];
            continue;
        }
        const bool block = rest[1] == '*';
        const std::size_t size = block ? std::min(rest.find("*/", 2), rest.size() - 2) + 2 : lineSize(rest);
        code += ' ';
        code.append(static_cast<std::size_t>(std::count(rest.begin(), rest.begin() + size, '\n')), '\n');
        i += size;
    }
    return code;
}

std::vector<std::vector<double>> readHeaderWords(const HeaderLine& header,
                                                 const std::vector<HeaderWord>& words) {
    const std::vector<std::string_view> typed = wordsOf(header.words);
    std::vector<std::vector<double>> numbers(words.size());
    for (std::size_t at = 0; at < typed.size();) {
        std::size_t which = 0;
        while (which < words.size() && !words[which].name.empty() && words[which].name != typed[at]) ++which;
        if (which == words.size())
            refuse(header,
                   fmt::format("'{}' is out of place; it takes {}", typed[at].substr(0, 40), usageOf(words)));
        if (!words[which].name.empty()) ++at;
        if (!numbers[which].empty()) refuse(header, fmt::format("has too much; it takes {}", usageOf(words)));
        for (int i = 0; i < words[which].count; ++i, ++at) {
            if (at == typed.size())
                refuse(header, fmt::format("ends too early; it takes {}", usageOf(words)));
            numbers[which].push_back(readNumber(header, typed[at]));
        }
    }
    for (std::size_t which = 0; which < words.size(); ++which)
        if (numbers[which].empty() && words[which].required)
            refuse(header, fmt::format("lacks something; it takes {}", usageOf(words)));
    return numbers;
}

}  // namespace edgewise::sdf
