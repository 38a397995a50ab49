#include "pipeline/judge/stability_cases.h"

#include <cmath>
#include <stdexcept>

#include "pipeline/judge/camera_cases.h"
#include "pipeline/judge/case_tools.h"
#include "pipeline/judge/grid_line.h"
#include "pipeline/judge/stiff_scene.h"

namespace edgewise::judge {
namespace {

StiffScene finish(const StiffSceneBuilder& builder) {
    return {builder.scene(), kPixel, {}};
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

/// A direction of the grid whose lines pass points at multiples of 2^-66 px or so.
GridDirection gridDirection(Random& random) {
    const auto m = static_cast<std::int64_t>(random.within(0x1p16, 0x1p17));
    return pythagorean(m, static_cast<std::int64_t>(random.within(0.05, 0.95) * double(m)));
}

/// One of the eight directions that a mirror or two make of one: all ways round.
std::array<dvec2, 2> mirrored(std::array<dvec2, 2> ends, std::uint64_t which) {
    for (dvec2& p : ends) {
        if (which & 1) p.x = -p.x;
        if (which & 2) p.y = -p.y;
        if (which & 4) std::swap(p.x, p.y);
    }
    return ends;
}

/// Two triangles that share an edge on a line of the grid, c / h grid steps from the sample.
void addAtOffset(StiffSceneBuilder& builder, const GridDirection& d, WideSteps c, double reach,
                 std::uint64_t seed) {
    auto ends = mirrored(lineAtOffset(d, c, reach), seed);
    for (dvec2& p : ends) p += sampleOf(kPixel);
    const dvec2 side = across(ends[1] - ends[0]), middle = 0.5 * (ends[0] + ends[1]);
    builder.add({dvec3(ends[0], 0), dvec3(ends[1], 0), dvec3(middle + side, 0)});
    builder.add({dvec3(ends[0], 1), dvec3(ends[1], 1), dvec3(middle - side, 1)});
}

WideSteps stepsOf(double px, const GridDirection& d) {
    return static_cast<WideSteps>(std::nearbyint(px / kGridPx * double(d.h)));
}

/// An edge whose distance from the sample is the difficulty, to 2^-66 px.
StiffScene edgeBeside(double distance, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, distance);
    StiffSceneBuilder builder(sampleOf(kPixel));
    const GridDirection d = gridDirection(random);
    addAtOffset(builder, d, stepsOf(distance, d), filter.radius * random.within(0.2, 2.0), seed);
    return finish(builder);
}

/// An edge exactly through the sample, as long as the difficulty; shorter than a step along its line, it runs
/// parallel to an axis or at 45 degrees.
StiffScene edgeThrough(double length, const Prefilter&, std::uint64_t seed) {
    Random random(seed, length);
    StiffSceneBuilder builder(sampleOf(kPixel));
    const GridDirection d = gridDirection(random);
    if (length > double(d.h) * kGridPx) {
        addAtOffset(builder, d, 0, 0.5 * length, seed);
    } else {
        const double turn = 0.25 * kPi * double(seed % 8), half = std::max(kGridPx, 0.5 * length);
        const dvec2 way = glm::round(direction(turn)) * half, s = sampleOf(kPixel);
        builder.add({dvec3(s - way, 0), dvec3(s + way, 0), dvec3(s + 3.0 * across(way), 0)});
        builder.add({dvec3(s - way, 1), dvec3(s + way, 1), dvec3(s - 3.0 * across(way), 1)});
    }
    return finish(builder);
}

/// An edge that misses touching the support's border by the difficulty, on either side of it.
StiffScene tangent(double gap, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, gap);
    StiffSceneBuilder builder(sampleOf(kPixel));
    const GridDirection d = filter.radial() ? gridDirection(random) : GridDirection{};
    const WideSteps c = stepsOf(filter.radius, d), off = stepsOf(gap, d);
    addAtOffset(builder, d, seed % 2 ? c + off : c - off, 3.0 * filter.radius, seed / 2);
    return finish(builder);
}

/// An edge that touches the support's border exactly, as long as the difficulty.
StiffScene touching(double length, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, length);
    StiffSceneBuilder builder(sampleOf(kPixel));
    const bool along_axis = !filter.radial() || length < 8.0;
    const GridDirection d = along_axis ? GridDirection{} : gridDirection(random);
    addAtOffset(builder, d, stepsOf(filter.radius, d), std::max(kGridPx, 0.5 * length), seed);
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

/// As many triangles in one plane as the difficulty says, over each other, some twice: all depths are tied.
StiffScene coincident(double layers, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, layers);
    StiffSceneBuilder builder(sampleOf(kPixel));
    const DepthPlane plane{random.within(-.1, .1), random.within(-.1, .1), 0.5};
    std::array<dvec2, 3> corners{};
    for (int k = 0; k < static_cast<int>(layers); ++k) {
        const double turn = random.angle(), size = filter.radius * random.within(0.5, 2.0);
        const dvec2 at = sampleOf(kPixel) + random.around(0.7 * filter.radius);
        if (k % 3 != 2)
            for (int c = 0; c < 3; ++c)
                corners[static_cast<std::size_t>(c)] = at + size * direction(turn + 2.0 * c);
        builder.add(corners, plane);  // the third is the second, again
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

/// A long edge on which two triangles of the other side meet, their stem at the angle of the difficulty; the
/// vertex is rounded beside the edge.
StiffScene tStem(double angle, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, angle);
    StiffSceneBuilder builder(sampleOf(kPixel));
    const double turn = random.angle(), length = 3.0 * filter.radius;
    const dvec2 bar = direction(turn), stem = direction(turn + (seed % 2 ? angle : kPi - angle));
    const dvec2 at = sampleOf(kPixel) + random.around(0.3 * filter.radius);
    const dvec2 a = at - length * bar, b = at + length * bar, end = at + length * stem;
    const DepthPlane plane{random.within(-.1, .1), random.within(-.1, .1), 0.5};
    builder.add({a, b, at - length * across(bar)}, plane);
    builder.add({a, at, end}, plane);
    builder.add({at, b, end}, plane);
    return finish(builder);
}

/// The same random triangles as far from the origin as the difficulty says.
StiffScene farAway(double distance, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, 1.0);  // the same scene at every distance, but for the grid
    const glm::ivec2 pixel(static_cast<int>(distance), static_cast<int>(0.7 * distance));
    StiffSceneBuilder builder(sampleOf(pixel));
    addTriangles(builder, random, pixel, filter.radius, 0.5, 2.0);
    return {builder.scene(), pixel, {}};
}

/// Triangles of the support's own size, for filters of every size.
StiffScene ordinary(double difficulty, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, difficulty);
    StiffSceneBuilder builder(sampleOf(kPixel));
    addTriangles(builder, random, kPixel, filter.radius, 0.3, 1.5);
    return finish(builder);
}

/// None where the family has no such filter: lanczos grows lobes with its radius, up to a limit.
std::optional<Prefilter> made(const Prefilter& filter, double radius, std::optional<double> sigma) {
    try {
        return makePrefilter(filter.name, radius, sigma);
    } catch (const std::invalid_argument&) {
        return std::nullopt;
    }
}

std::optional<Prefilter> resized(double radius, const Prefilter& filter) {
    return made(filter, radius, filter.sigma ? std::optional(radius / 3.0) : std::nullopt);
}

/// Gaussians alone have a sigma.
std::optional<Prefilter> sharpened(double ratio, const Prefilter& filter) {
    if (!filter.sigma) return std::nullopt;
    return made(filter, filter.radius, filter.radius * ratio);
}

/// Small angles, then the whole turn in steps of 15 degrees and some that no degree names.
std::vector<double> everyAngle(double most) {
    std::vector<double> out = upwards(decades(-1, -15));
    for (double a = kPi / 12; a < most; a += kPi / 12) out.insert(out.end(), {a - 0.07, a});
    out.push_back(most);
    return out;
}

std::vector<StabilityCase> screenCases() {
    return {
        {"slivers", "triangles that grow thin", "angle, radians", decades(-1, -15), sliver},
        {"sizes", "triangles from far below the grid's step to the guard band", "size, px",
         upwards(decades(5, -8)), sized},
        {"edge-through-sample", "an edge exactly through the sample", "length, px", upwards(decades(3, -9)),
         edgeThrough},
        {"edge-beside-sample", "an edge that passes the sample", "distance, px", decades(-1, -15),
         edgeBeside},
        {"tangent", "an edge that touches the support's border", "gap, px", decades(-1, -15), tangent},
        {"touching", "an edge that touches the support's border exactly", "length, px",
         upwards(decades(3, -9)), touching},
        {"vertex-near-sample", "a vertex beside the sample", "distance, px", decades(-1, -15), vertexNear},
        {"near-parallel", "edges that cross at small angles", "angle, radians", decades(-1, -15),
         nearParallel},
        {"near-coincident", "planes that hardly differ", "difference of depth and tilt", decades(-1, -16),
         nearCoincident},
        {"coincident", "layers in one plane, every depth tied", "layers", {2, 4, 8, 16, 32}, coincident},
        {"depth-ratio", "depths of many orders of magnitude", "ratio", upwards(decades(12, 1)), depthRatio},
        {"stack", "layers over each other, all piercing", "layers", {10, 30, 100, 300, 1000}, stack},
        {"star", "edges through one point", "edges", {10, 30, 100, 300, 1000}, star},
        {"t-junctions", "courses of bricks, turned", "angle, radians", everyAngle(kPi), tJunctions},
        {"t-stem", "a vertex on a long edge", "angle of the stem, radians", everyAngle(0.5 * kPi), tStem},
        {"far-away",
         "coordinates far from the origin",
         "distance, px",
         {1, 10, 100, 1e3, 1e4, 1e5, 5e5},
         farAway},
        {"radius", "filters of every size", "R, px", upwards(decades(3, -3)), ordinary, resized},
        {"sigma", "Gaussians within a support that they hardly fill, or overfill", "sigma / R",
         upwards(decades(2, -2)), ordinary, sharpened},
    };
}

}  // namespace

const std::vector<StabilityCase>& stabilityCases() {
    static const std::vector<StabilityCase> cases = [] {
        std::vector<StabilityCase> list = screenCases(), camera = cameraCases();
        list.insert(list.end(), camera.begin(), camera.end());
        return list;
    }();
    return cases;
}

}  // namespace edgewise::judge
