#include "pipeline/vulkan/user_tables.h"

#include <fmt/format.h>

#include "pipeline/vulkan/user_words.h"

namespace edgewise::vulkan {
namespace {

using Tokens = std::vector<GlslToken>;

struct Table {
    std::string_view type, name;
    std::size_t entries = 0;
};

std::size_t behindBrackets(const Tokens& tokens, std::size_t at) {
    return at < tokens.size() && tokens[at].text == "[" ? afterClosing(tokens, at) : at;
}

/// Between brackets, by the commas outside of inner ones.
std::size_t entriesOf(const Tokens& tokens, std::size_t open) {
    std::size_t entries = 1;
    int depth = 0;
    for (std::size_t i = open + 1; i + 1 < afterClosing(tokens, open); ++i) {
        const char c = tokens[i].text[0];
        depth += (c == '(' || c == '[') - (c == ')' || c == ']');
        entries += depth == 0 && c == ',';
    }
    return entries;
}

/// const TYPE [N] NAME [N] = TYPE [N] (...) ; the N may be absent. Without entries: something else.
Table tableOf(const Tokens& tokens, const GlslPart& part) {
    std::size_t i = part.first;
    const auto is = [&](std::string_view text) { return i < part.last && tokens[i].text == text; };
    if (!is("const")) return {};
    ++i;
    while (is("highp") || is("mediump") || is("lowp")) ++i;
    if (i >= part.last || !isPlainType(tokens[i].text)) return {};
    Table table{tokens[i].text, {}, 0};
    i = behindBrackets(tokens, i + 1);
    if (i >= part.last || !tokens[i].word) return {};
    table.name = tokens[i].text;
    i = behindBrackets(tokens, i + 1);
    if (!is("=")) return {};
    ++i;
    if (!is(table.type)) return {};
    ++i;
    if (!is("[")) return {};
    i = behindBrackets(tokens, i);
    if (!is("(") || afterClosing(tokens, i) + 1 != part.last) return {};
    table.entries = entriesOf(tokens, i);
    return table;
}

bool isDeclaredElsewhere(const Tokens& tokens, const GlslPart& part, std::string_view name) {
    for (std::size_t i = 1; i < tokens.size(); ++i) {
        if (tokens[i].text != name || (i >= part.first && i < part.last)) continue;
        const GlslToken& before = tokens[i - 1];
        if (before.text == "." || before.text == "]") return true;
        if (before.word && before.text != "return" && before.text != "else") return true;
    }
    return false;
}

std::string functionOf(const Table& table) {
    std::string text = fmt::format(" {0} ew_at_{1}(int i) {{ {0} value = {1}[0];", table.type, table.name);
    for (std::size_t i = 1; i < table.entries; ++i)
        text += fmt::format(" value = i == {1} ? {0}[{1}] : value;", table.name, i);
    return text + " return value; }";
}

}  // namespace

void readByComparisons(const std::vector<GlslToken>& tokens, const GlslPart& part, Edits& edits) {
    constexpr std::size_t kFewEntries = 4;
    const Table table = tableOf(tokens, part);
    if (table.entries <= kFewEntries || isDeclaredElsewhere(tokens, part, table.name)) return;
    edits.insert(tokens[part.last - 1].end(), functionOf(table));
    for (std::size_t i = part.last; i + 1 < tokens.size(); ++i) {
        if (tokens[i].text != table.name || tokens[i + 1].text != "[") continue;
        const std::size_t close = afterClosing(tokens, i + 1) - 1;
        if (close == i + 3 && !tokens[i + 2].word) continue;  // a number
        edits.insert(tokens[i].begin, "ew_at_");
        edits.insert(tokens[i + 1].begin, "(int(");
        edits.erase(tokens[i + 1].begin, tokens[i + 1].end());
        edits.insert(tokens[close].begin, "))");
        edits.erase(tokens[close].begin, tokens[close].end());
    }
}

}  // namespace edgewise::vulkan
