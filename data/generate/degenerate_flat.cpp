// Hard cases that lie flat or nearly so, under an orthographic camera at one world unit a pixel.
#include "data/generate/degenerate.h"
#include "data/generate/scene_parts.h"

namespace edgewise::scenes {
namespace {

/// The point that a pixel camera of `size` shows at (x, y), y down.
Vec3 at(double size, double x, double y, double z = 0.0) {
    return {x, size - y, z};
}

void addBackdrop(GltfFile& file, double size) {
    Soup soup(900);
    soup.quad(at(size, 1, 1, -50), at(size, size - 1, 1, -50), at(size, size - 1, size - 1, -50),
              at(size, 1, size - 1, -50));
    addSoup(file, soup, {{"name", "backdrop"}});
}

/// From (x, y) up and to the right of it: an axis-parallel rectangle.
void addBox(Soup& soup, double size, double x, double y, double width, double height, double z = 0.0) {
    soup.quad(at(size, x, y, z), at(size, x + width, y, z), at(size, x + width, y + height, z),
              at(size, x, y + height, z));
}

}  // namespace

GltfFile makeTJunctions() {
    constexpr double kSize = 64;
    Soup soup;
    addBox(soup, kSize, 4, 4, 16, 56);
    for (int i = 0; i < 7; ++i) addBox(soup, kSize, 20, 4 + 8 * i, 10, 8);
    // A slanted edge whose inner vertices round off the line: hairline gaps and overlaps of about 1e-6 px.
    const Vec3 top = at(kSize, 40.3, 3.7), bottom = at(kSize, 51.9, 59.1);
    soup.triangle(top, at(kSize, 34.0, 40.0), bottom);
    for (int i = 0; i < 7; ++i) {
        const double s = i / 7.0, t = (i + 1) / 7.0;
        soup.triangle((1 - s) * top + s * bottom, (1 - t) * top + t * bottom, at(kSize, 62.0, 20.0));
    }
    GltfFile file;
    addPixelCamera(file, kSize);
    addSoup(file, soup);
    return file;
}

GltfFile makeCoplanarDuplicates() {
    constexpr double kSize = 64;
    const auto tilted = [](double x, double y) { return at(kSize, x, y, 0.25 * x + 0.125 * y); };
    const Vec3 a = tilted(8, 8), b = tilted(56, 8), c = tilted(56, 56), d = tilted(8, 56);
    Soup soup;
    soup.quad(a, b, c, d);
    soup.quad(b, c, d, a);
    soup.triangle(tilted(2, 32), tilted(32, 2), tilted(62, 62));
    GltfFile file;
    addPixelCamera(file, kSize);
    addSoup(file, soup);
    return file;
}

GltfFile makeEqualDepth() {
    constexpr double kSize = 64;
    GltfFile file;
    addPixelCamera(file, kSize);
    for (std::uint32_t node = 0; node < 3; ++node) {
        Soup soup(10 * node);
        addBox(soup, kSize, 6 + 10 * node, 6 + 14 * node, 30, 20, 3.5);
        addSoup(file, soup, {{"name", "box " + std::to_string(node)}});
    }
    return file;
}

GltfFile makeSlivers() {
    constexpr double kSize = 64;
    GltfFile file;
    addPixelCamera(file, kSize);
    std::uint32_t colour = 0;
    for (int power = 0; power <= 5; ++power) {
        double width = 1.0;
        for (int i = 0; i < power; ++i) width /= 10.0;
        for (int turned = 0; turned < 3; ++turned) {
            // Thin about the node's own origin, where floats are dense; the node carries it to its place.
            Soup soup(colour++);
            soup.triangle({-9.0, 0.0, 0.0}, {9.0, 0.0, 0.0}, {1.0, width, 0.0});
            const Vec3 place = at(kSize, 11.5 + 20.5 * turned, 5.5 + 10.25 * power, 1.0 + colour);
            const double turns = std::array{0.0, 0.031, 0.125}[static_cast<std::size_t>(turned)];
            addSoup(file, soup,
                    {{"translation", Json::array({place.x, place.y, place.z})},
                     {"rotation", rotation({0, 0, 1}, turns)}});
        }
    }
    addBackdrop(file, kSize);
    return file;
}

GltfFile makeFan1000() {
    constexpr double kSize = 32;
    Soup soup;
    const auto rim = [](int i) {
        const Vec2 direction = onCircle(i % 1000 / 1000.0);
        return at(kSize, 16.5 + 14.0 * direction.x, 16.5 + 14.0 * direction.y);
    };
    for (int i = 0; i < 1000; ++i) soup.triangle(at(kSize, 16.5, 16.5), rim(i), rim(i + 1));
    GltfFile file;
    addPixelCamera(file, kSize);
    addSoup(file, soup);
    return file;
}

GltfFile makeZeroArea() {
    constexpr double kSize = 32;
    Soup soup;
    const Vec3 p = at(kSize, 7.25, 9.5, 5);
    soup.triangle(p, p, p);
    soup.triangle(p, p, at(kSize, 25, 20, 5));
    soup.triangle(at(kSize, 3, 16.5, 5), at(kSize, 29, 16.5, 5), at(kSize, 11, 16.5, 5));
    soup.triangle(at(kSize, 4, 4, 5), at(kSize, 28, 28, 5), at(kSize, 16, 16, 5));
    soup.triangle(at(kSize, 4, 8, 0), at(kSize, 28, 24, 0),
                  at(kSize, 16, 16, 9));  // edge-on: a line on the screen only
    addBox(soup, kSize, 4, 4, 24, 24);
    GltfFile file;
    addPixelCamera(file, kSize);
    addSoup(file, soup);
    Mesh repeated = soup.mesh();
    repeated.index = {15, 16, 16, 17, 17, 17, 15, 17, 15};
    const int material = addUnlitMaterial(file, "repeated indices", {1.0, 1.0, 1.0}, true);
    file.addNode({{"name", "repeated indices"},
                  {"mesh", file.addMesh(Json::array({file.addPrimitive(repeated, material)}))}});
    return file;
}

GltfFile makePixelEdges() {
    constexpr double kSize = 32;
    Soup soup;
    addBox(soup, kSize, 2, 2, 8, 8);         // on pixel borders
    addBox(soup, kSize, 12.5, 2.5, 8, 8);    // through sample positions
    addBox(soup, kSize, 24, 4, 1, 1);        // one pixel
    addBox(soup, kSize, 27.5, 4, 0.5, 0.5);  // a quarter of one, with a corner in the sample
    addBox(soup, kSize, 23, 8, 8, 0.0625);   // strips thinner than a pixel, the second over samples
    addBox(soup, kSize, 23, 10.46875, 8, 0.0625);
    addBox(soup, kSize, 2.5, 13, 0.0625, 4);
    soup.triangle(at(kSize, 2, 18), at(kSize, 14, 18), at(kSize, 2, 30));  // x + y = 32: through corners
    soup.triangle(at(kSize, 16.5, 18.5), at(kSize, 29.5, 18.5),
                  at(kSize, 16.5, 30.5));  // vertices on samples
    soup.triangle(at(kSize, 30.5, 31.5), at(kSize, 18.5, 31.5),
                  at(kSize, 30.5, 19.5));  // x + y = 50: through samples
    GltfFile file;
    addPixelCamera(file, kSize);
    addSoup(file, soup);
    return file;
}

GltfFile makeThinWires() {
    constexpr double kSize = 128;
    constexpr int kWires = 24;
    Soup soup;
    double width = 2.0;
    for (int i = 0; i < kWires; ++i, width *= 0.8) {
        const Vec2 d = onCircle((i + 0.37) / kWires);
        const double h = 0.5 * width, x0 = 64 + 4 * d.x, y0 = 64 + 4 * d.y, x1 = 64 + 60 * d.x,
                     y1 = 64 + 60 * d.y;
        soup.quad(at(kSize, x0 - h * d.y, y0 + h * d.x, i), at(kSize, x1 - h * d.y, y1 + h * d.x, i),
                  at(kSize, x1 + h * d.y, y1 - h * d.x, i), at(kSize, x0 + h * d.y, y0 - h * d.x, i));
    }
    for (int i = 0; i < 6; ++i) addBox(soup, kSize, 8, 24.3 + 16 * i, 112, 0.4, 40 - i);
    GltfFile file;
    addPixelCamera(file, kSize);
    addSoup(file, soup);
    return file;
}

}  // namespace edgewise::scenes
