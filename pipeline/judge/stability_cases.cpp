#include "pipeline/judge/stability_cases.h"

#include <cmath>
#include <numbers>
#include <random>

#include "pipeline/judge/stiff_scene.h"

namespace edgewise::judge {
namespace {

using glm::dvec2;
using glm::dvec3;
constexpr glm::ivec2 kPixel{37, 21};
constexpr double kPi = std::numbers::pi;

/// Random numbers that are the same on every machine.
class Random {
  public:
    Random(std::uint64_t seed, double difficulty)
        : engine_(seed * 0x9e3779b97f4a7c15ull + std::uint64_t(1e6 * std::log10(difficulty) + 5e8)) {}
    double within(double low, double high) {
        return low + (high - low) * (double(engine_() >> 11) * 0x1p-53);
    }
    double angle() { return within(0.0, 2.0 * kPi); }
    dvec2 around(double reach) { return {within(-reach, reach), within(-reach, reach)}; }

  private:
    std::mt19937_64 engine_;
};

dvec2 sampleOf(glm::ivec2 pixel) {
    return dvec2(pixel) + 0.5;
}
dvec2 direction(double angle) {
    return {std::cos(angle), std::sin(angle)};
}
dvec2 across(dvec2 v) {
    return {-v.y, v.x};
}

/// 10^from, 10^(from - step), ... 10^to.
std::vector<double> decades(int from, int to, int step = 1) {
    std::vector<double> out;
    for (int e = from; e >= to; e -= step) out.push_back(std::pow(10.0, e));
    return out;
}

StiffScene finish(const StiffSceneBuilder& builder) {
    return {builder.scene(), kPixel};
}

/// A quad of one plane around a segment, half a width to either side.
void addBar(StiffSceneBuilder& builder, dvec2 a, dvec2 b, double half, const DepthPlane& plane) {
    const dvec2 n = across(b - a) * (half / std::sqrt((b - a).x * (b - a).x + (b - a).y * (b - a).y));
    builder.add({a - n, b - n, b + n}, plane);
    builder.add({a - n, b + n, a + n}, plane);
}

/// Six triangles around the sample, of `least` to `most` times the support's radius.
void addTriangles(StiffSceneBuilder& builder, Random& random, glm::ivec2 pixel, double radius, double least,
                  double most) {
    for (int k = 0; k < 6; ++k) {
        const dvec2 at = sampleOf(pixel) + random.around(0.5 * radius);
        const double turn = random.angle(), size = radius * random.within(least, most);
        std::array<dvec3, 3> corners;
        for (int c = 0; c < 3; ++c)
            corners[c] = dvec3(at + size * direction(turn + 2.0 * c), random.within(0, 1));
        builder.add(corners);
    }
}

StiffScene sliver(double angle, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, angle);
    StiffSceneBuilder builder(sampleOf(kPixel));
    const double length = 4.0 * filter.radius;
    for (int k = 0; k < 6; ++k) {
        const dvec2 d = direction(random.angle()), at = sampleOf(kPixel) + random.around(0.5 * filter.radius);
        const dvec2 tip = at - 0.5 * length * d, end = tip + length * d;
        const dvec2 half = across(d) * (length * std::tan(0.5 * angle));
        builder.add({dvec3(tip, random.within(0, 1)), dvec3(end - half, random.within(0, 1)),
                     dvec3(end + half, random.within(0, 1))});
    }
    return finish(builder);
}

StiffScene sized(double size, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, size);
    StiffSceneBuilder builder(sampleOf(kPixel));
    const double reach = std::max(0.5 * filter.radius, 0.25 * size);
    for (int k = 0; k < 5; ++k) {
        const dvec2 at = sampleOf(kPixel) + random.around(std::min(reach, filter.radius));
        const double turn = random.angle();
        std::array<dvec3, 3> corners;
        for (int c = 0; c < 3; ++c)
            corners[c] = dvec3(at + size * direction(turn + 2.0 * kPi * c / 3.0), random.within(0, 1));
        builder.add(corners);
    }
    return finish(builder);
}

/// An edge whose distance from the sample is the difficulty.
StiffScene edgeBeside(double distance, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, distance);
    StiffSceneBuilder builder(sampleOf(kPixel));
    const dvec2 d = direction(random.angle()), foot = sampleOf(kPixel) + across(d) * distance;
    const double length = filter.radius * random.within(1.5, 4.0), beyond = random.within(0.2, 0.8) * length;
    builder.add({dvec3(foot - beyond * d, 0), dvec3(foot + (length - beyond) * d, 0),
                 dvec3(foot + length * across(d), 0)});
    return finish(builder);
}

/// An edge that misses touching the support's border by the difficulty, on either side of it.
StiffScene tangent(double gap, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, gap);
    StiffSceneBuilder builder(sampleOf(kPixel));
    const double turn = filter.radial() ? random.angle() : 0.5 * kPi * double(seed % 4);
    const dvec2 d = direction(turn);
    const double h = filter.radius + (seed % 2 ? gap : -gap);
    const dvec2 foot = sampleOf(kPixel) + across(d) * h;
    const double length = 3.0 * filter.radius;
    builder.add(
        {dvec3(foot - length * d, 0), dvec3(foot + length * d, 0), dvec3(foot + length * across(d), 0)});
    builder.add(
        {dvec3(foot - length * d, 1), dvec3(foot + length * d, 1), dvec3(foot - length * across(d), 1)});
    return finish(builder);
}

/// A fan whose hub is the difficulty away from the sample.
StiffScene vertexNear(double distance, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, distance);
    StiffSceneBuilder builder(sampleOf(kPixel));
    const dvec2 hub = toGrid(sampleOf(kPixel) + distance * direction(random.angle()));
    std::vector<dvec3> rim;
    for (int k = 0; k < 7; ++k)
        rim.push_back(dvec3(hub + filter.radius * random.within(0.5, 2.0) *
                                      direction(2.0 * kPi * (k + random.within(0, 0.7)) / 7.0),
                            random.within(0, 1)));
    for (std::size_t k = 0; k < 7; ++k)
        if (k != seed % 7) builder.add({dvec3(hub, 0.5), rim[k], rim[(k + 1) % 7]});
    return finish(builder);
}

/// Long edges that cross at the angle of the difficulty.
StiffScene nearParallel(double angle, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, angle);
    StiffSceneBuilder builder(sampleOf(kPixel));
    const double turn = random.angle(), length = 6.0 * filter.radius;
    for (int k = 0; k < 4; ++k) {
        const dvec2 d = direction(turn + angle * (k + random.within(0, 0.5)));
        const dvec2 at = sampleOf(kPixel) + 0.1 * random.around(filter.radius);
        addBar(builder, at - length * d, at + length * d, 0.2 * filter.radius,
               {0.0, 0.0, random.within(0, 1)});
    }
    return finish(builder);
}

/// A stack of planes that differ by the difficulty in depth and in tilt.
StiffScene nearCoincident(double apart, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, apart);
    StiffSceneBuilder builder(sampleOf(kPixel));
    const DepthPlane common{random.within(-.1, .1), random.within(-.1, .1), 0.5};
    for (int k = 0; k < 8; ++k) {
        const DepthPlane plane{common.dz_dx + apart * random.within(-1, 1),
                               common.dz_dy + apart * random.within(-1, 1),
                               common.z_anchor + apart * random.within(-1, 1)};
        const double turn = random.angle(), size = 3.0 * filter.radius;
        const dvec2 at = sampleOf(kPixel) + random.around(0.5 * filter.radius);
        builder.add({at + size * direction(turn), at + size * direction(turn + 2.0),
                     at + size * direction(turn + 4.0)},
                    plane);
    }
    return finish(builder);
}

/// Depths over as many orders of magnitude as the difficulty has.
StiffScene depthRatio(double ratio, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, ratio);
    StiffSceneBuilder builder(sampleOf(kPixel));
    for (int k = 0; k < 6; ++k) {
        const dvec2 at = sampleOf(kPixel) + random.around(0.5 * filter.radius);
        const double turn = random.angle(), size = 2.0 * filter.radius;
        std::array<dvec3, 3> corners;
        for (int c = 0; c < 3; ++c)
            corners[c] = dvec3(at + size * direction(turn + 2.0 * c), std::pow(ratio, -random.within(0, 1)));
        builder.add(corners);
    }
    return finish(builder);
}

/// As many layers over each other as the difficulty says.
StiffScene stack(double layers, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, layers);
    StiffSceneBuilder builder(sampleOf(kPixel));
    for (int k = 0; k < static_cast<int>(layers); ++k) {
        const dvec2 at = sampleOf(kPixel) + random.around(0.3 * filter.radius);
        const double turn = random.angle(), size = 3.0 * filter.radius;
        const DepthPlane plane{random.within(-.01, .01), random.within(-.01, .01), random.within(0, 1)};
        builder.add({at + size * direction(turn), at + size * direction(turn + 2.1),
                     at + size * direction(turn + 4.2)},
                    plane);
    }
    return finish(builder);
}

/// As many edges through one point, on the sample or on the support's border, as the difficulty says.
StiffScene star(double edges, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, edges);
    StiffSceneBuilder builder(sampleOf(kPixel));
    const int count = static_cast<int>(edges);
    const dvec2 hub = toGrid(sampleOf(kPixel) + (seed % 2 ? dvec2(0.0) : dvec2(filter.radius, 0.0)));
    std::vector<dvec3> rim;
    for (int k = 0; k < count; ++k)
        rim.push_back(dvec3(hub + filter.radius * random.within(1.0, 2.0) *
                                      direction(2.0 * kPi * (k + random.within(0, 0.8)) / count),
                            random.within(0, 1)));
    for (int k = 0; k < count; ++k)
        builder.add({dvec3(hub, 0.5), rim[static_cast<std::size_t>(k)],
                     rim[static_cast<std::size_t>((k + 1) % count)]});
    return finish(builder);
}

/// Bricks of one plane whose courses meet in T-junctions, turned by the difficulty.
StiffScene tJunctions(double angle, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, angle);
    StiffSceneBuilder builder(sampleOf(kPixel));
    const dvec2 x = 0.6 * filter.radius * direction(angle), y = across(x);
    const dvec2 start = sampleOf(kPixel) + random.around(0.2 * filter.radius);
    const DepthPlane plane{random.within(-.1, .1), random.within(-.1, .1), 0.5};
    for (int row = -2; row < 2; ++row)
        for (int column = -2; column < 2; ++column) {
            const dvec2 a = start + double(row) * y + (column + 0.37 * (row & 1)) * x;
            builder.add({a, a + x, a + x + y}, plane);
            builder.add({a, a + x + y, a + y}, plane);
        }
    return finish(builder);
}

/// The same random triangles as far from the origin as the difficulty says.
StiffScene farAway(double distance, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, 1.0);  // the same scene at every distance, but for the grid
    const glm::ivec2 pixel(static_cast<int>(distance), static_cast<int>(0.7 * distance));
    StiffSceneBuilder builder(sampleOf(pixel));
    addTriangles(builder, random, pixel, filter.radius, 0.5, 2.0);
    return {builder.scene(), pixel};
}

/// Triangles of the support's own size, for filters of every size.
StiffScene ordinary(double difficulty, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, difficulty);
    StiffSceneBuilder builder(sampleOf(kPixel));
    addTriangles(builder, random, kPixel, filter.radius, 0.3, 1.5);
    return finish(builder);
}

Prefilter resized(double radius, const Prefilter& filter) {
    return makePrefilter(filter.name, radius, filter.sigma ? std::optional(radius / 3.0) : std::nullopt);
}

/// Gaussians alone have a sigma; other filters stay as they are.
Prefilter sharpened(double ratio, const Prefilter& filter) {
    if (!filter.sigma) return filter;
    return makePrefilter(filter.name, filter.radius, filter.radius * ratio);
}

std::vector<double> upwards(std::vector<double> list) {
    return {list.rbegin(), list.rend()};
}

}  // namespace

const std::vector<StabilityCase>& stabilityCases() {
    static const std::vector<StabilityCase> cases{
        {"slivers", "triangles that grow thin", "angle, radians", decades(-1, -15), sliver},
        {"sizes", "triangles from far below the grid's step to the guard band", "size, px",
         upwards(decades(5, -8)), sized},
        {"edge-beside-sample", "an edge that passes the sample", "distance, px", decades(-1, -15),
         edgeBeside},
        {"tangent", "an edge that touches the support's border", "gap, px", decades(-1, -15), tangent},
        {"vertex-near-sample", "a vertex beside the sample", "distance, px", decades(-1, -15), vertexNear},
        {"near-parallel", "edges that cross at small angles", "angle, radians", decades(-1, -15),
         nearParallel},
        {"near-coincident", "planes that hardly differ", "difference of depth and tilt", decades(-1, -16),
         nearCoincident},
        {"depth-ratio", "depths of many orders of magnitude", "ratio", upwards(decades(12, 1)), depthRatio},
        {"stack", "layers over each other, all piercing", "layers", {10, 30, 100, 300, 1000}, stack},
        {"star", "edges through one point", "edges", {10, 30, 100, 300, 1000}, star},
        {"t-junctions", "courses of bricks, turned", "angle, radians", decades(0, -10), tJunctions},
        {"far-away", "coordinates far from the origin", "distance, px", upwards(decades(5, 0)), farAway},
        {"radius", "filters of every size", "R, px", upwards(decades(3, -3)), ordinary, resized},
        {"sigma", "Gaussians within a support that they hardly fill, or overfill", "sigma / R",
         upwards(decades(2, -2)), ordinary, sharpened},
    };
    return cases;
}

}  // namespace edgewise::judge
