#include "data/generate/flat_patterns.h"

#include "data/generate/png.h"
#include "data/generate/scene_parts.h"

namespace edgewise::scenes {
namespace {

constexpr double kPatternPx = 1024.0;
constexpr std::uint32_t kRings = 125, kRingQuads = 80, kPaletteTexels = 128;
constexpr std::uint32_t kColumns = 101, kRows = 100;

int addRingPalette(GltfFile& file) {
    constexpr int kNearest = 9728, kClampToEdge = 33071;
    std::vector<Rgb8> texels;
    for (std::uint32_t k = 0; k < kPaletteTexels; ++k) {
        texels.push_back(k % 2 == 0 ? Rgb8{255, 255, 255} : Rgb8{0, 0, 0});
    }
    const int image = file.addImage(pngBytes(static_cast<int>(kPaletteTexels), 1, texels));
    return file.addTexture(
        image,
        {{"magFilter", kNearest}, {"minFilter", kNearest}, {"wrapS", kClampToEdge}, {"wrapT", kClampToEdge}});
}

double ringRadius(std::uint32_t k) {
    return 0.5 * kPatternPx * std::sqrt((k + 1.0) / (kRings + 1.0));
}

/// Inner and outer vertices alternate; both radii are the same doubles as the neighbouring rings'.
void addRing(Mesh& mesh, std::uint32_t ring) {
    const auto first = static_cast<std::uint32_t>(mesh.position.size());
    for (std::uint32_t q = 0; q < kRingQuads; ++q) {
        const Vec2 direction = onCircle(static_cast<double>(q) / kRingQuads);
        for (const std::uint32_t k : {ring, ring + 1}) {
            const double r = ringRadius(k), centre = 0.5 * kPatternPx;
            mesh.position.push_back({centre + r * direction.x, centre + r * direction.y, 0.0});
            mesh.uv.push_back({(ring + 0.5) / kPaletteTexels, 0.5});
        }
        const std::uint32_t inner = first + 2 * q, next = first + 2 * ((q + 1) % kRingQuads);
        mesh.index.insert(mesh.index.end(), {inner, inner + 1, next + 1, inner, next + 1, next});
    }
}

/// On a grid of 2^-13 px, which float holds everywhere in the picture, measured from either side.
double logLine(std::uint32_t i, std::uint32_t count) {
    const double line_px = kPatternPx * binaryLog(1.0 + i) / binaryLog(1.0 + count);
    return std::floor(line_px * 0x1p13 + 0.5) * 0x1p-13;
}

Mesh logGridVertices() {
    Mesh mesh;
    for (std::uint32_t j = 0; j <= kRows; ++j) {
        for (std::uint32_t i = 0; i <= kColumns; ++i) {
            mesh.position.push_back({logLine(i, kColumns), kPatternPx - logLine(j, kRows), 0.0});
        }
    }
    return mesh;
}

std::vector<std::uint32_t> cellTriangles(std::uint32_t parity) {
    std::vector<std::uint32_t> index;
    for (std::uint32_t j = 0; j < kRows; ++j) {
        for (std::uint32_t i = 0; i < kColumns; ++i) {
            if ((i + j) % 2 != parity) continue;
            const std::uint32_t top = j * (kColumns + 1) + i, bottom = top + kColumns + 1;
            index.insert(index.end(), {bottom, bottom + 1, top + 1, bottom, top + 1, top});
        }
    }
    return index;
}

}  // namespace

GltfFile makeZonePlate() {
    GltfFile file;
    Mesh mesh;
    for (std::uint32_t ring = 0; ring < kRings; ++ring) addRing(mesh, ring);
    file.use("KHR_materials_unlit");
    const int material = file.addMaterial({{"name", "rings"},
                                           {"pbrMetallicRoughness",
                                            {{"baseColorTexture", {{"index", addRingPalette(file)}}},
                                             {"metallicFactor", 0.0},
                                             {"roughnessFactor", 1.0}}},
                                           {"extensions", {{"KHR_materials_unlit", Json::object()}}}});
    addPixelCamera(file, kPatternPx);
    file.addNode(
        {{"name", "zone-plate"}, {"mesh", file.addMesh(Json::array({file.addPrimitive(mesh, material)}))}});
    return file;
}

GltfFile makeLogGrid() {
    GltfFile file;
    const Json attributes = file.addAttributes(logGridVertices());
    Json primitives = Json::array();
    for (const std::uint32_t parity : {0u, 1u}) {
        const double level = parity == 0 ? 1.0 : 0.0;
        primitives.push_back({{"attributes", attributes},
                              {"indices", file.addIndices(cellTriangles(parity))},
                              {"material", addUnlitMaterial(file, parity == 0 ? "white" : "black",
                                                            {level, level, level}, false)}});
    }
    addPixelCamera(file, kPatternPx);
    file.addNode({{"name", "log-grid"}, {"mesh", file.addMesh(std::move(primitives))}});
    return file;
}

}  // namespace edgewise::scenes
