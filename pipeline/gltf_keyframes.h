// Interpolation between the keys of an animation, as glTF's appendix C defines it.
#pragma once

#include <cstddef>
#include <vector>

namespace edgewise {

/// One key's numbers: a vector, a quaternion (x, y, z, w), or the weights of all morph targets.
using KeyValues = std::vector<double>;

/// The keys around a time: it lies `fraction` of the way from key `before` to key `after`. The same key
/// twice: outside all keys, or on the last.
struct Moment {
    std::size_t before = 0, after = 0;
    double fraction = 0.0;
    double seconds = 0.0;  ///< between the two keys
};

/// `times` increases and is not empty.
Moment momentAt(const std::vector<double>& times, double time);

double dot(const KeyValues& a, const KeyValues& b);

/// u a + v b.
KeyValues combined(double u, const KeyValues& a, double v, const KeyValues& b);

/// q / |q|, without overflow or underflow on the way. Zero stays zero.
KeyValues normalized(KeyValues q);

/// Between two rotations along the shorter arc, at constant speed; neither need be normalised.
KeyValues slerp(const KeyValues& from, const KeyValues& to, double fraction);

/// The cubic through both values with the given slopes a second: CUBICSPLINE.
KeyValues hermite(const Moment& moment, const KeyValues& from, const KeyValues& out_tangent,
                  const KeyValues& in_tangent, const KeyValues& to);

}  // namespace edgewise
