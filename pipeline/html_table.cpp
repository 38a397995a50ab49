#include "pipeline/html_table.h"

#include <fmt/format.h>

namespace edgewise {

std::string sortedCell(const std::optional<double>& value, const std::string& shown) {
    return fmt::format("<td data-value='{}'>{}</td>", value ? fmt::format("{}", *value) : "", shown);
}

std::string numberCell(double value, const char* format) {
    std::string shown = fmt::format(fmt::runtime(format), value);
    if (shown.starts_with('-') && shown.find_first_of("123456789") == std::string::npos) shown.erase(0, 1);
    return sortedCell(value, shown);
}

std::string numberCell(const std::optional<double>& value, const char* format) {
    return value ? numberCell(*value, format) : emptyCell();
}

std::string emptyCell() {
    return sortedCell({}, "");
}

std::string cardTable(const std::string& heads, const std::string& rows, const std::string& style,
                      const std::string& below) {
    return fmt::format(
        "<div class='card scroll'><table{}><thead><tr>{}</tr></thead><tbody>\n{}</tbody></table>{}</div>\n",
        style.empty() ? "" : " class='" + style + "'", heads, rows, below);
}

}  // namespace edgewise
