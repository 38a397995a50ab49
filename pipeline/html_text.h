// Text inside a page.
#pragma once

#include <string>

namespace edgewise {

/// & < > " ' as HTML has them.
std::string escapedHtml(const std::string& text);

}  // namespace edgewise
