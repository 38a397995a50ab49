#include "pipeline/cli/parse_values.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "pipeline/error.h"
#include "pipeline/resolve_camera.h"

namespace edgewise::cli {
namespace {

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> parts;
    for (;;) {
        const std::size_t end = text.find(separator);
        parts.emplace_back(text.substr(0, end));
        if (end == std::string_view::npos) return parts;
        text.remove_prefix(end + 1);
    }
}

template <typename Value>
std::from_chars_result readAll(const std::string& text, Value& value) {
    std::from_chars_result result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec == std::errc{} && result.ptr != text.data() + text.size())
        result.ec = std::errc::invalid_argument;
    return result;
}

template <std::size_t count>
std::array<double, count> parseList(const std::string& option, const std::string& text, const char* form) {
    const std::vector<std::string> parts = split(text, ',');
    if (parts.size() != count)
        throw InputError(option, fmt::format("'{}' is not of the form {}", text, form));
    std::array<double, count> values;
    for (std::size_t i = 0; i < count; ++i) values[i] = parseNumber(option, parts[i]);
    return values;
}

}  // namespace

double parseNumber(const std::string& option, const std::string& text) {
    double value = 0.0;
    const std::from_chars_result result = readAll(text, value);
    if (result.ec == std::errc::result_out_of_range)
        throw InputError(option, fmt::format("'{}' is outside the range of a double", text));
    if (result.ec != std::errc{}) throw InputError(option, fmt::format("'{}' is not a number", text));
    if (!std::isfinite(value)) throw InputError(option, fmt::format("'{}' is not finite", text));
    return value;
}

std::int64_t parseInteger(const std::string& option, const std::string& text, std::int64_t least,
                          std::int64_t most) {
    std::int64_t value = 0;
    const std::from_chars_result result = readAll(text, value);
    if (result.ec == std::errc::invalid_argument)
        throw InputError(option, fmt::format("'{}' is not an integer", text));
    if (result.ec != std::errc{} || value < least || value > most)
        throw InputError(option, fmt::format("'{}' is not in {}..{}", text, least, most));
    return value;
}

glm::dvec2 parsePair(const std::string& option, const std::string& text) {
    const auto v = parseList<2>(option, text, "X,Y");
    return {v[0], v[1]};
}

glm::dvec3 parseTriple(const std::string& option, const std::string& text) {
    const auto v = parseList<3>(option, text, "X,Y,Z");
    return {v[0], v[1], v[2]};
}

glm::ivec2 parseSize(const std::string& option, const std::string& text) {
    const std::vector<std::string> parts = split(text, 'x');
    if (parts.size() != 2) throw InputError(option, fmt::format("'{}' is not of the form WxH", text));
    return {parseInteger(option, parts[0], 1, kMaxFilmSide), parseInteger(option, parts[1], 1, kMaxFilmSide)};
}

PixelBox parseCrop(const std::string& option, const std::string& text) {
    const std::vector<std::string> parts = split(text, ',');
    if (parts.size() != 4) throw InputError(option, fmt::format("'{}' is not of the form X0,Y0,X1,Y1", text));
    std::array<int, 4> v;
    for (std::size_t i = 0; i < v.size(); ++i)
        v[i] = static_cast<int>(parseInteger(option, parts[i], 0, kMaxFilmSide));
    if (v[0] >= v[2] || v[1] >= v[3]) throw InputError(option, fmt::format("'{}' holds no pixel", text));
    return {v[0], v[1], v[2], v[3]};
}

void checkCrop(const std::string& option, const PixelBox& crop, int width, int height) {
    if (crop.x1 > width || crop.y1 > height)
        throw InputError(option, fmt::format("{},{},{},{} is not inside the picture of {}x{}", crop.x0,
                                             crop.y0, crop.x1, crop.y1, width, height));
}

}  // namespace edgewise::cli
