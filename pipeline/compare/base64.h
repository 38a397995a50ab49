// Bytes inside a page.
#pragma once

#include <span>
#include <string>

namespace edgewise::compare {

std::string base64(std::span<const unsigned char> bytes);

}  // namespace edgewise::compare
