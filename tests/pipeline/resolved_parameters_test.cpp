// What results say of a method's parameters is all of them, and makes the same method again.
#include "pipeline/methods/resolved_parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "pipeline/methods/registry.h"

namespace edgewise {
namespace {

using Json = nlohmann::ordered_json;

/// As a user would type it.
std::string typedOf(const std::string& name, const Json& parameters) {
    std::vector<std::string> parts;
    std::string composed;
    for (const auto& [key, value] : parameters.items())
        if (value.is_object())
            composed.append("+").append(typedOf(key, value));
        else if (key == "number")
            parts.push_back(value.dump());
        else
            parts.push_back(
                fmt::format("{}={}", key, value.is_string() ? value.get<std::string>() : value.dump()));
    return name + (parts.empty() ? "" : fmt::format(":{}", fmt::join(parts, ","))) + composed;
}

void expectSame(const MethodSpec& a, const MethodSpec& b) {
    SCOPED_TRACE(a.typed);
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.number, b.number);
    EXPECT_EQ(a.parameters, b.parameters);
    ASSERT_EQ(a.composed.size(), b.composed.size());
    for (std::size_t i = 0; i < a.composed.size(); ++i) expectSame(a.composed[i], b.composed[i]);
}

std::string withNumber(const MethodEntry& entry) {
    if (entry.number == MethodEntry::Number::kAbsent) return entry.name;
    return fmt::format("{}:{}", entry.name, entry.numbers.empty() ? entry.largest : entry.numbers.back());
}

/// The method bare, with every word and both ends of every range, and composed.
std::vector<std::string> spellings(const MethodEntry& entry) {
    const std::string bare = withNumber(entry), comma = bare == entry.name ? ":" : ",";
    std::vector<std::string> typed{bare, bare + comma + "device=cpu"};
    for (const auto& [key, choice] : entry.choices)
        for (const std::string& word : choice.words)
            typed.push_back(fmt::format("{}{}{}={}", bare, comma, key, word));
    for (const auto& [key, range] : entry.ranges)
        for (const double end : {range.low, range.high})
            typed.push_back(fmt::format("{}{}{}={}", bare, comma, key, end));
    if (!entry.composes_with.empty()) typed.push_back(fmt::format("{}+{}:3", bare, entry.composes_with));
    return typed;
}

TEST(ResolvedParameters, MakeTheSameMethodAgain) {
    for (const MethodEntry& entry : methodRegistry())
        for (const std::string& typed : spellings(entry)) {
            const MethodSpec spec = parseMethod(typed);
            const std::string again = typedOf(spec.name, resolvedParameters(spec));
            SCOPED_TRACE(again);
            expectSame(spec, parseMethod(again));
        }
}

TEST(ResolvedParameters, NameEveryParameter) {
    for (const MethodEntry& entry : methodRegistry()) {
        SCOPED_TRACE(entry.name);
        const Json json = resolvedParameters(parseMethod(withNumber(entry)));
        EXPECT_EQ(json.contains("number"), entry.number == MethodEntry::Number::kRequired);
        for (const auto& [key, choice] : entry.choices) EXPECT_TRUE(json.contains(key)) << key;
        for (const auto& [key, range] : entry.ranges) EXPECT_TRUE(json.at(key).is_number()) << key;
    }
}

TEST(ResolvedParameters, ReadWell) {
    EXPECT_EQ(resolvedParameters(parseMethod("ssaa:2")), Json({{"number", 2}}));
    EXPECT_EQ(resolvedParameters(parseMethod("fxaa")), Json({{"preset", 12}}));
    const Json composed = resolvedParameters(parseMethod("ctss:coverage=1.5+ssaa:2"));
    EXPECT_EQ(composed.at("coverage"), 1.5);
    EXPECT_EQ(composed.at("mask"), "6x6");
    EXPECT_EQ(composed.at("ssaa"), Json({{"number", 2}}));
    EXPECT_EQ(resolvedParameters(parseMethod("mesh+none")).at("mesh"),
              Json({{"error", 0.2}, {"mesher", "dual"}}));
}

}  // namespace
}  // namespace edgewise
