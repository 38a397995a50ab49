// A small change to a JSON text that leaves it JSON.
#pragma once

#include <cstdint>
#include <string>

namespace edgewise::fuzz {

/// Changes one random value: a number to an awkward one, an array by dropping or doubling an element, an
/// object by dropping a member or taking over one from elsewhere, a string to another of the text. Empty if
/// the text is not JSON.
std::string mutateJson(const std::string& text, std::uint64_t seed);

}  // namespace edgewise::fuzz
