#include "sdf/dual_envelope.h"

namespace edgewise::sdf {

bool throughFace(const Lattice& lattice, std::span<const glm::dvec3> x, const DualPolygon& polygon, int k) {
    const glm::dvec3 &a = x[polygon.vertex[k]], &b = x[polygon.vertex[(k + 1) % 4]];
    const int axis = sideAxis(polygon, k), other = 3 - axis - polygon.axis;
    const double plane = lattice.coordinate(axis, polygon.corner[axis]), run = b[axis] - a[axis];
    if (run == 0.0) return false;
    const glm::dvec3 at = a + (plane - a[axis]) / run * (b - a);
    const glm::ivec3 cell = polygonCell(polygon, k);
    for (const int i : {int(polygon.axis), other})
        if (at[i] < lattice.coordinate(i, cell[i]) ||
            at[i] > lattice.coordinate(i, cell[i] + (kUnits >> polygon.level)))
            return false;
    return true;
}

bool aroundEdge(const Lattice& lattice, std::span<const glm::dvec3> positions, const DualPolygon& polygon,
                int d) {
    const int u = (polygon.axis + 1) % 3, v = (polygon.axis + 2) % 3;
    const glm::dvec3 edge = lattice.corner(polygon.corner);
    const double side = lattice.step / (1 << polygon.level);
    glm::dvec3 x[4];
    for (int k = 0; k < 4; ++k) x[k] = positions[polygon.vertex[(d + k) % 4]] - edge;
    const auto turn = [&](int i, int j) { return x[i][u] * x[j][v] - x[i][v] * x[j][u]; };
    const auto passed = [&](int i, int j, int k) {
        const double a = turn(j, k), b = turn(k, i), c = turn(i, j), sum = a + b + c;
        if (!(a >= 0.0 && b >= 0.0 && c >= 0.0 && sum > 0.0)) return false;
        const double height =
            (a * x[i][polygon.axis] + b * x[j][polygon.axis] + c * x[k][polygon.axis]) / sum;
        return height >= 0.0 && height <= side;
    };
    // Where the line from vertex 0 to 2 passes the edge's half-plane towards vertex j.
    const auto withinSide = [&](int j) {
        const double a = turn(0, j), b = turn(2, j), part = a / (a - b);
        if (!(a * b < 0.0)) return false;
        const glm::dvec3 at = x[0] + part * (x[2] - x[0]);
        const double along = (at[u] * x[j][u] + at[v] * x[j][v]) / (x[j][u] * x[j][u] + x[j][v] * x[j][v]);
        const double height = at[polygon.axis] - along * x[j][polygon.axis];
        return along >= 0.0 && along <= 1.0 && height >= 0.0 && height <= (1.0 - along) * side;
    };
    return (passed(0, 1, 2) && withinSide(3)) || (passed(0, 2, 3) && withinSide(1));
}

}  // namespace edgewise::sdf
