// Hard cases of depth: piercing, cyclic overlap, clipping, closed surfaces.
#include "data/generate/degenerate.h"
#include "data/generate/scene_parts.h"

namespace edgewise::scenes {
namespace {

constexpr double kHalfPi = 1.5707963267948966;

GltfFile pixelScene(double size, const Soup& soup) {
    GltfFile file;
    addPixelCamera(file, size);
    addSoup(file, soup);
    return file;
}

/// A point of the plane z = 0 turned about the middle of a 64 px picture.
Vec3 turnedAbout32(double x, double y, double z, double turns) {
    const Vec2 d = onCircle(turns);
    return {32 + d.x * (x - 32) - d.y * (y - 32), 32 + d.y * (x - 32) + d.x * (y - 32), z};
}

/// Splits a spherical triangle into 4^depth; the midpoints are the same doubles from both sides of an edge.
void addSphereTriangle(Soup& soup, Vec3 a, Vec3 b, Vec3 c, int depth, Vec3 centre, double radius) {
    if (depth == 0) {
        soup.triangle(centre + radius * a, centre + radius * b, centre + radius * c);
        return;
    }
    const Vec3 ab = normalized(a + b), bc = normalized(b + c), ca = normalized(c + a);
    addSphereTriangle(soup, a, ab, ca, depth - 1, centre, radius);
    addSphereTriangle(soup, ab, b, bc, depth - 1, centre, radius);
    addSphereTriangle(soup, ca, bc, c, depth - 1, centre, radius);
    addSphereTriangle(soup, ab, bc, ca, depth - 1, centre, radius);
}

/// A closed sphere of 512 triangles, counter-clockwise seen from outside.
void addSphere(Soup& soup, Vec3 centre, double radius) {
    for (const double x : {1.0, -1.0}) {
        for (const double y : {1.0, -1.0}) {
            for (const double z : {1.0, -1.0}) {
                const Vec3 a{x, 0, 0}, b{0, y, 0}, c{0, 0, z};
                if (x * y * z > 0)
                    addSphereTriangle(soup, a, b, c, 3, centre, radius);
                else
                    addSphereTriangle(soup, b, a, c, 3, centre, radius);
            }
        }
    }
}

GltfFile singleSidedScene(double size, const std::vector<Soup>& soups) {
    GltfFile file;
    addPixelCamera(file, size);
    const int material = addUnlitMaterial(file, "outside only", {1.0, 1.0, 1.0}, false);
    for (const Soup& soup : soups) addSoup(file, soup, material);
    return file;
}

}  // namespace

GltfFile makePiercing() {
    Soup soup;
    soup.triangle({4, 6, -20}, {60, 10, 20}, {30, 60, 0});
    soup.triangle({6, 58, 18}, {58, 52, -22}, {28, 4, 3});
    soup.triangle({2, 30, 6}, {62, 36, 5}, {40, 20, -30});
    return pixelScene(64, soup);
}

GltfFile makePiercingBook() {
    constexpr int kPages = 16;
    Soup soup;
    for (int i = 0; i < kPages; ++i) {
        const Vec2 d = onCircle((i + 0.25) / (2.0 * kPages));
        soup.quad({32 - 28 * d.x, 4, -28 * d.y}, {32 + 28 * d.x, 4, 28 * d.y}, {32 + 28 * d.x, 60, 28 * d.y},
                  {32 - 28 * d.x, 60, -28 * d.y});
    }
    return pixelScene(64, soup);
}

GltfFile makeCyclicOverlap() {
    Soup soup;
    for (int i = 0; i < 3; ++i) {
        const double turns = i / 3.0;
        soup.triangle(turnedAbout32(4, 17, 10, turns), turnedAbout32(60, 22, 20, turns),
                      turnedAbout32(4, 27, 10, turns));
    }
    return pixelScene(64, soup);
}

GltfFile makeNearPlane() {
    Soup soup;
    soup.triangle({-50, -1, -50}, {50, -1, -50},
                  {0, -1, 10});                              // a floor that passes under and behind the eye
    soup.triangle({-3, 1, 5}, {3, 1, 5}, {0, 2, 2});         // wholly behind
    soup.triangle({-2, 0.5, -1}, {-4, 2, -6}, {-5, 0, -6});  // a vertex on the near plane
    soup.triangle({0.5, 0.25, 0}, {3, 2, -6}, {2, 3, -6});   // a vertex in the plane of the eye
    soup.triangle({0, 0, 0}, {-1, 3, -8}, {1, 3, -9});       // a vertex in the eye: edge-on
    soup.triangle({-0.1, 0, -0.5}, {0.1, 0, -0.5}, {0, 0.1, -0.7});  // between the eye and the near plane
    soup.triangle({-20, 8, -60}, {20, 8, -60}, {0, 30, -140});       // through the far plane
    soup.triangle({8, 16, -40}, {1e6, 9, -40}, {1e6, 1e6, 1e6});     // far beyond any guard band, two ways
    soup.triangle({1, -0.5, 3}, {2, 0.5, -12}, {2.5, -0.25, -12});   // one vertex behind the eye
    soup.triangle({-1, -0.5, 3}, {-1.5, -0.5, 4}, {-2, 0.5, -12});   // two vertices behind the eye
    GltfFile file;
    addPerspectiveCamera(file, {.yfov = kHalfPi, .znear = 1.0, .zfar = 100.0}, Json::object());
    addSoup(file, soup);
    return file;
}

GltfFile makeDecals() {
    // A plane z = y/2 in dyadic coordinates: coplanar in the file to the last bit, seen in perspective.
    const auto on_plane = [](double x, double y) { return Vec3{x, y, 0.5 * y}; };
    const auto quad = [&](Soup& soup, double x0, double y0, double x1, double y1) {
        soup.quad(on_plane(x0, y0), on_plane(x1, y0), on_plane(x1, y1), on_plane(x0, y1));
    };
    Soup decals, base(100);
    quad(decals, -1.5, -1.25, 0.25, 0.75);
    quad(decals, -0.5, -0.5, 1.25, 1.5);
    decals.triangle(on_plane(-1.75, 1.75), on_plane(0, -1.5), on_plane(1.75, 0.125));
    quad(base, -2, -2, 2, 2);
    GltfFile file;
    const int material = addUnlitMaterial(file, "vertex colours", {1.0, 1.0, 1.0}, true);
    addPerspectiveCamera(
        file, {.yfov = 0.5 * kHalfPi, .znear = 0.5},
        {{"translation", Json::array({1.0, -1.5, 5.5})}, {"rotation", rotation({0.6, 0.8, 0}, 0.03)}});
    const Json primitives =
        Json::array({file.addPrimitive(decals.mesh(), material), file.addPrimitive(base.mesh(), material)});
    file.addNode({{"name", "decals before their base"}, {"mesh", file.addMesh(primitives)}});
    return file;
}

GltfFile makeClosedSphere() {
    Soup soup;
    addSphere(soup, {32, 32, 0}, 28);
    return singleSidedScene(64, {soup});
}

GltfFile makeTwoSpheres() {
    Soup first, second(600);
    addSphere(first, {25, 30, 0}, 20);
    addSphere(second, {39, 35, 4}, 20);
    return singleSidedScene(64, {first, second});
}

}  // namespace edgewise::scenes
