#include "sdf/json_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "sdf/nearest_name.h"
#include "sdf/number_rules.h"
#include "sdf/scene_error.h"

namespace edgewise::sdf {
namespace {

constexpr std::size_t kLongestText = 255;

std::string quote(std::string_view text) {
    return text.size() > 40 ? fmt::format("'{}...'", text.substr(0, 40)) : fmt::format("'{}'", text);
}

double readOne(const Json& value, const std::string& path, const NumberInfo& info) {
    if (!value.is_number()) refuse(path, fmt::format("must be a number, not {}", value.type_name()));
    const double number = value.get<double>();
    if (!obeys(info, number)) refuse(path, fmt::format("must be {}, not {}", ruleOf(info), number));
    return info.rule == Rule::kNotNegative && number < kSmallest ? 0.0 : number;
}

}  // namespace

void refuse(const std::string& path, const std::string& rule) {
    throw SceneError(path, rule);
}

void requireObject(const Json& value, const std::string& path) {
    if (!value.is_object()) refuse(path, fmt::format("must be an object, not {}", value.type_name()));
}

void requireKnownKeys(const Json& object, const std::string& path,
                      const std::vector<std::string_view>& known) {
    for (const auto& [key, value] : object.items())
        if (std::find(known.begin(), known.end(), key) == known.end())
            refuse(path, fmt::format("has no key {}{}", quote(key), didYouMean(key, known)));
}

void readNumbers(const Json& value, const std::string& path, const NumberInfo& info,
                 std::vector<double>& to) {
    if (!info.vector) {
        to.push_back(readOne(value, path, info));
        return;
    }
    if (!value.is_array() || value.size() != 3)
        refuse(path, fmt::format("must be a list of three numbers, not {}",
                                 value.is_array() ? fmt::format("of {}", value.size()) : value.type_name()));
    double size = 0.0;
    for (int i = 0; i < 3; ++i) {
        to.push_back(readOne(value[i], fmt::format("{}[{}]", path, i), info));
        size = std::max(size, std::abs(to.back()));
    }
    if (info.rule == Rule::kNotZero && !(size >= kSmallest)) refuse(path, "must not be all 0");
}

std::string readText(const Json& value, const std::string& path) {
    if (!value.is_string()) refuse(path, fmt::format("must be a text, not {}", value.type_name()));
    const auto& text = value.get_ref<const std::string&>();
    if (text.size() > kLongestText)
        refuse(path, fmt::format("must be at most {} bytes, not {}", kLongestText, text.size()));
    return text;
}

bool readFlag(const Json& value, const std::string& path) {
    if (!value.is_boolean()) refuse(path, fmt::format("must be true or false, not {}", value.type_name()));
    return value.get<bool>();
}

std::size_t readChoice(const Json& value, const std::string& path,
                       const std::vector<std::string_view>& options) {
    const std::string text = readText(value, path);
    const auto found = std::find(options.begin(), options.end(), text);
    if (found == options.end())
        refuse(path, fmt::format("must be one of {}, not {}{}", fmt::join(options, ", "), quote(text),
                                 didYouMean(text, options)));
    return static_cast<std::size_t>(found - options.begin());
}

}  // namespace edgewise::sdf
