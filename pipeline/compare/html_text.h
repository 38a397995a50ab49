// Text and bytes inside a page.
#pragma once

#include <span>
#include <string>

namespace edgewise::compare {

/// & < > " ' as HTML has them.
std::string escaped(const std::string& text);

std::string base64(std::span<const unsigned char> bytes);

}  // namespace edgewise::compare
