#include "data/generate/tori.h"

#include "data/generate/png.h"
#include "data/generate/scene_parts.h"

namespace edgewise::scenes {
namespace {

constexpr double kDegree = 0.017453292519943296;
constexpr double kTubeRadius = 0.45;

/// Quads of a grid whose rows have `stride` vertices, wrapped at `columns` and `rows`; a = around, b = along
/// the tube.
std::vector<std::uint32_t> gridTriangles(std::uint32_t columns, std::uint32_t rows, std::uint32_t stride,
                                         std::uint32_t wrap_column, std::uint32_t wrap_row) {
    std::vector<std::uint32_t> index;
    for (std::uint32_t a = 0; a < columns; ++a) {
        for (std::uint32_t b = 0; b < rows; ++b) {
            const std::uint32_t a1 = (a + 1) % wrap_column, b1 = (b + 1) % wrap_row;
            const std::uint32_t v00 = a * stride + b, v10 = a1 * stride + b, v01 = a * stride + b1,
                                v11 = a1 * stride + b1;
            index.insert(index.end(), {v00, v10, v11, v00, v11, v01});
        }
    }
    return index;
}

/// The ring lies in the plane z = 0; `tube` goes from the outer rim to +z.
void addTorusVertex(Mesh& mesh, double around_turns, double tube_turns) {
    const Vec2 a = onCircle(around_turns), b = onCircle(tube_turns);
    const Vec3 normal{a.x * b.x, a.y * b.x, b.y};
    mesh.position.push_back(Vec3{a.x, a.y, 0.0} + kTubeRadius * normal);
    mesh.normal.push_back(normal);
}

Mesh closedTorus(std::uint32_t around, std::uint32_t tube) {
    Mesh mesh;
    for (std::uint32_t a = 0; a < around; ++a) {
        for (std::uint32_t b = 0; b < tube; ++b) addTorusVertex(mesh, double(a) / around, double(b) / tube);
    }
    mesh.index = gridTriangles(around, tube, tube, around, tube);
    return mesh;
}

/// With texture coordinates, hence a seam: its positions repeat the first ones bit for bit.
Mesh texturedTorus(std::uint32_t around, std::uint32_t tube) {
    Mesh mesh;
    for (std::uint32_t a = 0; a <= around; ++a) {
        for (std::uint32_t b = 0; b <= tube; ++b) {
            addTorusVertex(mesh, double(a % around) / around, double(b % tube) / tube);
            mesh.uv.push_back({4.0 * a / around, 2.0 * b / tube});
        }
    }
    mesh.index = gridTriangles(around, tube, tube + 1, around + 1, tube + 1);
    return mesh;
}

int addCheckerTexture(GltfFile& file) {
    constexpr int kTexels = 64, kCheck = 8, kLinear = 9729, kLinearMipmapLinear = 9987, kRepeat = 10497;
    std::vector<Rgb8> texels;
    for (int y = 0; y < kTexels; ++y) {
        for (int x = 0; x < kTexels; ++x) {
            texels.push_back((x / kCheck + y / kCheck) % 2 == 0 ? Rgb8{240, 236, 224} : Rgb8{38, 70, 132});
        }
    }
    const int image = file.addImage(pngBytes(kTexels, kTexels, texels));
    return file.addTexture(
        image,
        {{"magFilter", kLinear}, {"minFilter", kLinearMipmapLinear}, {"wrapS", kRepeat}, {"wrapT", kRepeat}});
}

}  // namespace

GltfFile makeTorus(std::uint32_t around, std::uint32_t tube) {
    GltfFile file;
    const int material = file.addMaterial({{"name", "torus"},
                                           {"pbrMetallicRoughness",
                                            {{"baseColorFactor", Json::array({0.82, 0.46, 0.22, 1.0})},
                                             {"metallicFactor", 0.0},
                                             {"roughnessFactor", 0.5}}}});
    const int mesh = file.addMesh(Json::array({file.addPrimitive(closedTorus(around, tube), material)}));
    addPerspectiveCamera(file, {.yfov = 40.0 * kDegree}, {{"translation", Json::array({0.0, 0.0, 4.5})}});
    file.addNode(
        {{"name", "torus"}, {"mesh", mesh}, {"rotation", rotation({1.0, 0.25, 0.0}, -68.0 / 360.0)}});
    return file;
}

GltfFile makeTorusSequence() {
    GltfFile file;
    const Json texture = {{"index", addCheckerTexture(file)}};
    const int material = file.addMaterial(
        {{"name", "checker"},
         {"pbrMetallicRoughness",
          {{"baseColorTexture", texture}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.4}}}});
    const int mesh = file.addMesh(Json::array({file.addPrimitive(texturedTorus(96, 48), material)}));
    addPerspectiveCamera(file, {.yfov = 30.0 * kDegree, .aspect = 2.0},
                         {{"translation", Json::array({0.0, 0.0, 7.0})}});
    constexpr double kScale =
        0.62;  // neighbours' bounding spheres stay apart: 2 * 1.45 * 0.62 < |(1.45, 0.4, 1.1)|
    for (int k = 0; k < 7; ++k) {
        file.addNode({{"name", "torus " + std::to_string(k)},
                      {"mesh", mesh},
                      {"translation", Json::array({-2.5 + 1.45 * k, -0.4 + 0.4 * k, 0.2 - 1.1 * k})},
                      {"rotation", rotation({0.8, 0.6, 0.0}, (20.0 + 40.0 * k) / 360.0)},
                      {"scale", Json::array({kScale, kScale, kScale})}});
    }
    return file;
}

}  // namespace edgewise::scenes
