#include "pipeline/methods/pattern_footprint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

namespace edgewise {
namespace {

using Pattern = sdf::SurfaceMaterial::Pattern;

/// Beyond so many fields on a line the halves differ by less than one.
constexpr std::size_t kMostCrossings = 64;
/// Of lines between which the colours' shares are linear; else as many at equal distances.
constexpr std::size_t kMostLines = 32;

/// A footprint as coordinates whose whole numbers are the pattern's borders: three of a checker, one of
/// stripes. Lines of it run along the longer side.
struct Fields {
    int axes = 0;
    std::array<double, 3> corner{}, along{}, step{};

    Fields(const sdf::SurfaceMaterial& material, const glm::dvec3& p, const glm::dvec3& a,
           const glm::dvec3& s) {
        const auto add = [&](const glm::dvec3& scaled) {
            const auto k = static_cast<std::size_t>(axes++);
            along[k] = glm::dot(a, scaled), step[k] = glm::dot(s, scaled);
            corner[k] = glm::dot(p - 0.5 * a - 0.5 * s, scaled);
        };
        if (material.pattern == Pattern::kStripes) {
            add(glm::normalize(material.pattern_axis) * (2.0 / material.pattern_size));
            return;
        }
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 scaled(0.0);
            scaled[axis] = 1.0 / material.pattern_size;
            add(scaled);
        }
    }
    double low(std::size_t k) const { return corner[k] + std::min(along[k], 0.0) + std::min(step[k], 0.0); }
    double high(std::size_t k) const { return corner[k] + std::max(along[k], 0.0) + std::max(step[k], 0.0); }
};

/// Adds where from + t way is whole, t in (0, 1]; false beyond so many.
bool addCrossings(double from, double way, std::vector<double>& at, std::size_t most) {
    const double low = std::min(from, from + way), high = std::max(from, from + way);
    for (double n = std::floor(low) + 1.0; n <= high; ++n) {
        if (at.size() == most) return false;
        at.push_back((n - from) / way);
    }
    return true;
}

/// Adds on which lines two borders meet.
bool addMeetings(const Fields& f, std::size_t a, std::size_t b, std::vector<double>& at) {
    const double det = f.along[a] * f.step[b] - f.along[b] * f.step[a];
    const double rows = f.high(a) - f.low(a), columns = f.high(b) - f.low(b);
    if (std::abs(det) <= 1e-9 * rows * columns) return true;
    if ((rows + 1.0) * (columns + 1.0) > 4.0 * kMostLines) return false;
    for (double n = std::floor(f.low(a)) + 1.0; n <= f.high(a); ++n)
        for (double m = std::floor(f.low(b)) + 1.0; m <= f.high(b); ++m) {
            const double x = n - f.corner[a], y = m - f.corner[b];
            const double u = (x * f.step[b] - y * f.step[a]) / det,
                         v = (f.along[a] * y - f.along[b] * x) / det;
            if (u < 0.0 || u > 1.0 || v < 0.0 || v > 1.0) continue;
            if (at.size() == kMostLines) return false;
            at.push_back(v);
        }
    return true;
}

/// Lines between which the colours' shares change linearly: where borders meet the footprint's sides and each
/// other. Empty: there are too many.
std::vector<double> bendsOf(const Fields& f) {
    std::vector<double> at{0.0, 1.0};
    const auto axes = static_cast<std::size_t>(f.axes);
    for (std::size_t k = 0; k < axes; ++k) {
        if (!addCrossings(f.corner[k], f.step[k], at, kMostLines) ||
            !addCrossings(f.corner[k] + f.along[k], f.step[k], at, kMostLines))
            return {};
        for (std::size_t j = 0; j < k; ++j)
            if (!addMeetings(f, j, k, at)) return {};
    }
    std::ranges::sort(at);
    return at;
}

/// The share of line v that shows the second colour.
template <class Second>
double shareOfLine(const Fields& f, double v, std::vector<double>& at, const Second& second) {
    at.clear();
    for (std::size_t k = 0; k < static_cast<std::size_t>(f.axes); ++k)
        if (!addCrossings(f.corner[k] + v * f.step[k], f.along[k], at, kMostCrossings)) return 0.5;
    std::ranges::sort(at);
    at.push_back(1.0);
    double sum = 0.0, last = 0.0, longest = -1.0, known = 0.5;
    bool shows = false, said = false;
    for (const double next : at) {
        sum += shows ? next - last : 0.0;
        // Where rounding matters least.
        if (next - last > longest) longest = next - last, known = 0.5 * (last + next), said = shows;
        last = next, shows = !shows;
    }
    return second(known, v) == said ? sum : 1.0 - sum;
}

}  // namespace

std::optional<glm::dvec3> patternOver(const sdf::SurfaceMaterial& material, const sdf::SurfaceHit& hit,
                                      const glm::dvec3& right_local, const glm::dvec3& down_local) {
    if (hit.color || material.pattern == Pattern::kNone) return std::nullopt;
    const double right = glm::length(right_local), down = glm::length(down_local);
    const glm::dvec3 &along = right < down ? down_local : right_local,
                     &step = right < down ? right_local : down_local;
    const auto second = [&](double u, double v) {
        return sdf::showsSecondColor(material, hit.p_local + (u - 0.5) * along + (v - 0.5) * step);
    };
    // Half a period is the narrowest that a pattern has: a footprint as wide may hide one between its
    // corners.
    const int corners = second(0.0, 0.0) + second(1.0, 0.0) + second(0.0, 1.0) + second(1.0, 1.0);
    if (std::max(right, down) < 0.25 * material.pattern_size && corners == 4 * second(0.5, 0.5))
        return std::nullopt;
    const Fields fields(material, hit.p_local, along, step);
    std::vector<double> bends = bendsOf(fields), crossings;
    if (bends.empty())
        for (std::size_t i = 0; i <= kMostLines; ++i) bends.push_back(static_cast<double>(i) / kMostLines);
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < bends.size(); ++i) {
        const double width = bends[i + 1] - bends[i];
        if (width > 0.0)
            sum += width * shareOfLine(fields, 0.5 * (bends[i] + bends[i + 1]), crossings, second);
    }
    return glm::mix(material.color, material.second_color, sum);
}

}  // namespace edgewise
