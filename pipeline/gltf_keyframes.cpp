#include "pipeline/gltf_keyframes.h"

#include <algorithm>
#include <cmath>

namespace edgewise {

Moment momentAt(const std::vector<double>& times, double time) {
    const auto after = std::upper_bound(times.begin(), times.end(), time);
    if (after == times.begin()) return {};
    const auto k = static_cast<std::size_t>(after - times.begin()) - 1;
    if (after == times.end()) return {k, k, 0.0, 0.0};
    const double seconds = *after - times[k];
    return {k, k + 1, (time - times[k]) / seconds, seconds};
}

double dot(const KeyValues& a, const KeyValues& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

KeyValues combined(double u, const KeyValues& a, double v, const KeyValues& b) {
    KeyValues sum(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) sum[i] = u * a[i] + v * b[i];
    return sum;
}

/// Divided by the largest part first.
KeyValues normalized(KeyValues q) {
    double largest = 0.0;
    for (const double part : q) largest = std::max(largest, std::abs(part));
    if (largest == 0.0) return q;
    for (double& part : q) part /= largest;
    const double length = std::sqrt(dot(q, q));
    for (double& part : q) part /= length;
    return q;
}

/// Below an angle of 2^-20 the arc's sine is the angle to a rounding, and its chord the arc.
KeyValues slerp(const KeyValues& from, const KeyValues& to, double fraction) {
    const KeyValues a = normalized(from), b = normalized(to);
    const double cosine = dot(a, b), sign = cosine < 0.0 ? -1.0 : 1.0;
    // The angle by its half's tangent, |b - a| / |b + a|: accurate for small ones, where the cosine is flat.
    const KeyValues apart = combined(sign, b, -1.0, a), along = combined(sign, b, 1.0, a);
    const double angle = 2.0 * std::atan2(std::sqrt(dot(apart, apart)), std::sqrt(dot(along, along)));
    if (angle < 0x1p-20) return combined(1.0 - fraction, a, sign * fraction, b);
    const double sine = std::sin(angle);
    return combined(std::sin((1.0 - fraction) * angle) / sine, a, sign * std::sin(fraction * angle) / sine,
                    b);
}

KeyValues hermite(const Moment& m, const KeyValues& from, const KeyValues& out_tangent,
                  const KeyValues& in_tangent, const KeyValues& to) {
    const double t = m.fraction, t2 = t * t, t3 = t2 * t;
    const KeyValues ends = combined(2 * t3 - 3 * t2 + 1, from, 3 * t2 - 2 * t3, to);
    const KeyValues slopes =
        combined(m.seconds * (t3 - 2 * t2 + t), out_tangent, m.seconds * (t3 - t2), in_tangent);
    return combined(1.0, ends, 1.0, slopes);
}

}  // namespace edgewise
