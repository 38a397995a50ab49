// The sRGB transfer curve of IEC 61966-2-1, exact piecewise form.
#pragma once

#include <cmath>

namespace edgewise {

/// Linear in [0, 1] -> encoded in [0, 1].
inline double encodeSrgb(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

/// And back.
inline double decodeSrgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

}  // namespace edgewise
