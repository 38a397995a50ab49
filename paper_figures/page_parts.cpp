#include "paper_figures/page_parts.h"

#include <fmt/format.h>

namespace edgewise::figures {

std::string table(const std::string& heads, const std::string& rows) {
    return fmt::format(
        "<div class='card scroll'><table><thead><tr>{}</tr></thead><tbody>\n{}</tbody></table></div>\n",
        heads, rows);
}

std::string number(double value, const char* format) {
    return fmt::format("<td data-value='{}'>{}</td>", value, fmt::format(fmt::runtime(format), value));
}

}  // namespace edgewise::figures
