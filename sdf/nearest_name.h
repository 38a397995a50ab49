// "Did you mean": of some names the one that a mistyped word is nearest to.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace edgewise::sdf {

/// Levenshtein's distance.
std::size_t editDistance(std::string_view a, std::string_view b);

/// The first of the nearest names where a third of its letters or fewer are wrong. Words beyond 64 letters
/// have none.
std::optional<std::string_view> nearestName(std::string_view word,
                                            const std::vector<std::string_view>& names);

/// "; did you mean 'NAME'?", or nothing.
std::string didYouMean(std::string_view word, const std::vector<std::string_view>& names);

}  // namespace edgewise::sdf
