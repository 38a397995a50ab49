#include "pipeline/gltf_choice.h"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <optional>

#include "pipeline/error.h"

namespace edgewise {
namespace {

/// A non-negative whole number, if the text is nothing else.
std::optional<std::size_t> wholeNumber(const std::string& text) {
    std::size_t value = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
    if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace

std::size_t chooseElement(const std::vector<std::string>& names, const std::string& wanted,
                          const std::string& flag, const std::string& source, const std::string& kind) {
    const auto named = std::find(names.begin(), names.end(), wanted);
    if (named != names.end()) return static_cast<std::size_t>(named - names.begin());
    const auto index = wholeNumber(wanted);
    if (index && *index < names.size()) return *index;
    throw InputError(flag + " " + wanted,
                     fmt::format("{} has {} {}, none of that name or index", source, names.size(), kind));
}

}  // namespace edgewise
