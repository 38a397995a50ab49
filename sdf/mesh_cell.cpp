#include "sdf/mesh_cell.h"

namespace edgewise::sdf {
namespace {

struct Face {
    std::array<int, 4> corners, edges;  ///< edges[i]: between corners i and i + 1
};
constexpr std::array<Face, kCellFaces> kFaces = [] {
    std::array<Face, kCellFaces> faces{};
    for (int f = 0; f < kCellFaces; ++f) {
        faces[f].corners = faceCorners(f);
        for (int i = 0; i < 4; ++i)
            faces[f].edges[i] = edgeBetween(faces[f].corners[i], faces[f].corners[(i + 1) % 4]);
    }
    return faces;
}();

/// Of a face whose signs alternate.
bool insidesJoined(const Face& face, const double (&values)[kCellCorners]) {
    const double a = values[face.corners[0]] * values[face.corners[2]];
    const double b = values[face.corners[1]] * values[face.corners[3]];
    return values[face.corners[0]] < 0.0 ? a > b : b > a;
}

/// On a face the surface leaves by the edge where its border passes outwards and comes by one where it passes
/// inwards: of the same inside part, or, where insides are joined, of the same outside part.
void linkFace(const Face& face, const double (&values)[kCellCorners],
              std::array<std::int8_t, kCellEdges>& next) {
    int crossings = 0;
    std::array<bool, 4> inside;
    for (int i = 0; i < 4; ++i) inside[i] = values[face.corners[i]] < 0.0;
    for (int i = 0; i < 4; ++i) crossings += inside[i] != inside[(i + 1) % 4];
    if (crossings == 0) return;
    const int step = crossings == 4 && insidesJoined(face, values) ? 1 : 3;
    for (int i = 0; i < 4; ++i) {
        if (!inside[i] || inside[(i + 1) % 4]) continue;
        int j = (i + step) % 4;
        while (inside[j] || !inside[(j + 1) % 4]) j = (j + step) % 4;
        next[face.edges[i]] = static_cast<std::int8_t>(face.edges[j]);
    }
}

}  // namespace

CellLoops loopsOf(const double (&values)[kCellCorners]) {
    CellLoops loops;
    loops.loop.fill(-1), loops.next.fill(-1), loops.first.fill(-1);
    for (const Face& face : kFaces) linkFace(face, values, loops.next);
    for (int edge = 0; edge < kCellEdges; ++edge) {
        if (loops.next[edge] < 0 || loops.loop[edge] >= 0) continue;
        loops.first[loops.count] = static_cast<std::int8_t>(edge);
        for (int at = edge; loops.loop[at] < 0; at = loops.next[at])
            loops.loop[at] = static_cast<std::int8_t>(loops.count);
        ++loops.count;
    }
    return loops;
}

}  // namespace edgewise::sdf
