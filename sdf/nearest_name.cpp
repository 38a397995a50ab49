#include "sdf/nearest_name.h"

#include <algorithm>
#include <numeric>

namespace edgewise::sdf {

// One row at a time.
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

std::optional<std::string_view> nearestName(std::string_view word,
                                            const std::vector<std::string_view>& names) {
    if (word.size() > 64) return std::nullopt;
    std::optional<std::string_view> best;
    std::size_t least = 65;
    for (const std::string_view name : names) {
        const std::size_t distance = editDistance(word, name);
        if (distance < least && 3 * distance <= name.size()) best = name, least = distance;
    }
    return best;
}

std::string didYouMean(std::string_view word, const std::vector<std::string_view>& names) {
    const auto name = nearestName(word, names);
    return name ? "; did you mean '" + std::string(*name) + "'?" : "";
}

}  // namespace edgewise::sdf
