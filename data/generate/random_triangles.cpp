#include "data/generate/random_triangles.h"

#include "data/generate/scene_parts.h"

namespace edgewise::scenes {
namespace {

constexpr double kPi = 3.141592653589793238;
constexpr double kPicturePx = 1024.0;

Vec3 randomCentre(SplitMix64& random, double margin) {
    const double x = random.between(-margin, kPicturePx + margin);
    const double y = random.between(-margin, kPicturePx + margin);
    return {x, y, random.between(-0.5 * kPicturePx, 0.5 * kPicturePx)};
}

Vec3 randomCorner(SplitMix64& random, Vec3 centre, double radius, const Axes& plane) {
    const Vec2 p = randomOnCircle(random);
    return centre + radius * (p.x * plane.u + p.y * plane.v);
}

Rgba8 randomColor(SplitMix64& random) {
    const std::uint64_t bits = random.next();
    const auto byte = [bits](int shift) { return static_cast<std::uint8_t>((bits >> shift) & 0xffu); };
    return {byte(0), byte(8), byte(16), 255};
}

}  // namespace

double greatestCircumradius(std::uint32_t count) {
    const double m_over_width = std::sqrt(kDepthComplexity * 16.0 * kPi / (7.0 * count));
    return kPicturePx * m_over_width / (1.0 - 2.0 * m_over_width);
}

GltfFile makeRandomTriangles(std::uint32_t count) {
    SplitMix64 random(count);
    const double greatest = greatestCircumradius(count);
    Soup soup;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 centre = randomCentre(random, greatest);
        const double radius = random.between(0.5 * greatest, greatest);
        const Axes plane = randomAxes(random);
        const Vec3 a = randomCorner(random, centre, radius, plane);
        const Vec3 b = randomCorner(random, centre, radius, plane);
        const Vec3 c = randomCorner(random, centre, radius, plane);
        soup.triangle(a, b, c, randomColor(random));
    }
    GltfFile file;
    addPixelCamera(file, kPicturePx);
    addSoup(file, soup, {{"name", "triangles"}});
    return file;
}

}  // namespace edgewise::scenes
