// Tables of pages, which sort by their columns.
#pragma once

#include <optional>
#include <string>

namespace edgewise {

/// A cell that sorts by a value and shows HTML; without a value it sorts last.
std::string sortedCell(const std::optional<double>& value, const std::string& shown);
/// One that shows its value. What rounds to 0 has no sign.
std::string numberCell(double value, const char* format);
std::string numberCell(const std::optional<double>& value, const char* format);
std::string emptyCell();

/// In a card that scrolls; `heads`, `rows` and what comes `below` are HTML, `style` is a class of its style
/// sheet.
std::string cardTable(const std::string& heads, const std::string& rows, const std::string& style = "",
                      const std::string& below = "");

}  // namespace edgewise
