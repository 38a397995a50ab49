// Further channels of a picture, as they will lie in the file.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace edgewise {

struct AovChannel {
    std::string name;
    bool whole_number = false;  ///< uint32; else float32
};

/// Channel c of pixel i is words[i * channels.size() + c]: the bits of a float32 or a uint32.
struct AovImage {
    std::vector<AovChannel> channels;
    std::vector<std::uint32_t> words;
    std::map<std::string, std::string> metadata;  ///< attributes under their full names

    std::uint32_t* pixel(std::size_t i) { return words.data() + i * channels.size(); }
    const std::uint32_t* pixel(std::size_t i) const { return words.data() + i * channels.size(); }
    std::size_t bytes() const { return words.size() * sizeof(std::uint32_t); }
};

inline std::uint32_t floatBits(double value) {
    return std::bit_cast<std::uint32_t>(static_cast<float>(value));
}

}  // namespace edgewise
