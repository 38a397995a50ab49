// Reading the accessors of a checked glTF: strides, normalized integers, sparse replacements.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
}

namespace edgewise {

/// An accessor's numbers, component by component; the value of one is stored / divisor.
/// Normalized signed integers are clamped to the symmetric range first (-128 reads as -127), as glTF defines
/// them; stored numbers are integers or floats of the file, hence exact as float.
struct AccessorNumbers {
    std::size_t count = 0;
    int components = 1;
    double divisor = 1.0;
    std::vector<double> stored;

    double value(std::size_t element, int component) const {
        return stored[element * static_cast<std::size_t>(components) + static_cast<std::size_t>(component)] /
               divisor;
    }
};

/// More elements than this without stored bytes (an accessor without a buffer view: zeros, and what its
/// sparse part replaces) are refused, as are more such vertices in a scene: 128 MiB at most.
inline constexpr std::uint64_t kMaxUnbackedElements = std::uint64_t(1) << 20;

/// Any accessor but a matrix of fewer than 4 rows. FailureError past kMaxUnbackedElements. Throws InputError
/// "source: accessors[i]" for a number that is not finite and for sparse indices that do not increase or
/// reach past the end.
AccessorNumbers readNumbers(const tinygltf::Model& model, int accessor, const std::string& source);

}  // namespace edgewise
