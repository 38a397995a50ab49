#include "sdf/dual_cells.h"

#include "sdf/mesh_feature.h"
#include "sdf/scene_error.h"

namespace edgewise::sdf {
namespace {

constexpr int kPlaces = kBrickCells * kBrickCells * kBrickCells;

glm::ivec3 placeOf(int n) {
    return {n % kBrickCells, n / kBrickCells % kBrickCells, n / (kBrickCells * kBrickCells)};
}
int indexOf(const glm::ivec3& in) {
    return in.x + kBrickCells * (in.y + kBrickCells * in.z);
}
std::uint32_t brickAt(const Lattice& lattice, const BrickList& bricks, const glm::ivec3& cell) {
    const glm::ivec3 count = lattice.bricks(), brick = cell / kBrickCells;
    return bricks.at[brick.x + std::size_t(count.x) * (brick.y + std::size_t(count.y) * brick.z)];
}

bool onFace(int edge, int face) {
    const EdgeEnds ends = edgeEnds(edge);
    const int bit = 1 << face / 2, at = (face & 1) << face / 2;
    return (ends.low & bit) == at && (ends.high & bit) == at;
}

/// The edge to which the surface goes on over a face, from another of its edges.
int partnerOf(const CellLoops& loops, int edge, int face) {
    if (const int next = loops.next[edge]; next >= 0 && onFace(next, face)) return next;
    for (int e = 0; e < kCellEdges; ++e)
        if (loops.next[e] == edge && onFace(e, face)) return e;
    return -1;
}

class Builder {
  public:
    explicit Builder(const MeshRequest& request) : request_(request), lattice_(request.lattice) {}

    DualComplex run() {
        complex_.bricks = findBricks(request_.tape, lattice_, request_.bound_holds);
        requireClosed(complex_.bricks.open);
        const std::size_t count = complex_.bricks.bricks.size();
        complex_.cell_at.assign(count * kPlaces, -1);
        polygon_at_.assign(count * kPlaces * 3, kNoVertex);
        for (std::size_t b = 0; b < count; ++b) read(static_cast<std::uint32_t>(b));
        for (DualPolygon& polygon : complex_.polygons) takeVertices(polygon);
        for (DualPolygon& polygon : complex_.polygons) takeNeighbours(polygon);
        complex_.cells = complex_.cell.size();
        return std::move(complex_);
    }

  private:
    void requireClosed(bool open) const {
        if (open) throw SceneError("surface", "it reaches the end of the box: the mesh would be open");
    }

    void read(std::uint32_t b) {
        const Brick& brick = complex_.bricks.bricks[b];
        crossings_.read(lattice_, brick);
        requireClosed(crossings_.open(lattice_, brick));
        for (int n = 0; n < kPlaces; ++n) {
            const glm::ivec3 place = placeOf(n);
            addPolygons(b, n, place);
            if (crossings_.crosses(place)) addCell(b, n, place);
        }
    }

    void addPolygons(std::uint32_t b, int n, const glm::ivec3& place) {
        for (int axis = 0; axis < 3; ++axis) {
            const Crossing* crossing = crossings_.crossing(place, axis);
            if (!crossing) continue;
            polygon_at_[(std::size_t(b) * kPlaces + n) * 3 + axis] =
                static_cast<std::uint32_t>(complex_.polygons.size());
            DualPolygon polygon;
            polygon.corner = complex_.bricks.bricks[b].first + place;
            polygon.axis = static_cast<std::uint8_t>(axis);
            polygon.outward = crossings_.value(place) < 0.0;
            polygon.brick = b;
            polygon.crossing = {crossing->place_world, crossing->normal_world};
            complex_.polygons.push_back(polygon);
        }
    }

    void addCell(std::uint32_t b, int n, const glm::ivec3& place) {
        double values[kCellCorners];
        crossings_.cellValues(place, values);
        DualCell cell;
        cell.loops = loopsOf(values);
        cell.first_vertex = static_cast<std::uint32_t>(complex_.vertices.size());
        for (int loop = 0; loop < cell.loops.count; ++loop) addVertex(b, place, cell.loops, loop);
        complex_.cell_at[std::size_t(b) * kPlaces + n] = static_cast<std::int32_t>(complex_.cell.size());
        complex_.cell.push_back(cell);
    }

    void addVertex(std::uint32_t b, const glm::ivec3& place, const CellLoops& loops, int loop) {
        std::array<TangentPlane, kCellEdges> planes;
        std::size_t count = 0;
        DualVertex vertex;
        vertex.middle_world = glm::dvec3(0.0);
        for (int edge = 0; edge < kCellEdges; ++edge) {
            if (loops.loop[edge] != loop) continue;
            const Crossing& crossing = crossings_.crossing(place, edgeEnds(edge));
            planes[count++] = {crossing.place_world, crossing.normal_world};
            vertex.middle_world += crossing.place_world;
        }
        vertex.middle_world /= static_cast<double>(count);
        const Brick& brick = complex_.bricks.bricks[b];
        const FeaturePoint point =
            featurePoint(brick.tape, std::span(planes.data(), count), vertex.middle_world, lattice_.step);
        vertex.target_world = point.place_world, vertex.rank = static_cast<std::uint8_t>(point.rank);
        vertex.cell = brick.first + place, vertex.brick = b;
        vertex.loops = static_cast<std::uint8_t>(loops.count);
        complex_.vertices.push_back(vertex);
    }

    void takeVertices(DualPolygon& polygon) {
        for (int k = 0; k < 4; ++k)
            polygon.vertex[k] =
                complex_.find(lattice_, polygonCell(polygon, k))->vertexOf(polygonEdge(polygon, k));
    }

    void takeNeighbours(DualPolygon& polygon) {
        for (int k = 0; k < 4; ++k) {
            const glm::ivec3 at = polygonCell(polygon, k);
            const CellLoops& loops = complex_.find(lattice_, at)->loops;
            const EdgeEnds edge =
                edgeEnds(partnerOf(loops, polygonEdge(polygon, k), polygonFace(polygon, k)));
            const glm::ivec3 corner = at + BrickCrossings::cornerOffset(edge.low);
            const std::uint32_t brick = brickAt(lattice_, complex_.bricks, corner);
            polygon.across[k] =
                polygon_at_[(std::size_t(brick) * kPlaces + indexOf(corner % kBrickCells)) * 3 + edge.axis];
        }
    }

    const MeshRequest& request_;
    const Lattice& lattice_;
    DualComplex complex_;
    BrickCrossings crossings_;
    std::vector<std::uint32_t> polygon_at_;
};

}  // namespace

const DualCell* DualComplex::find(const Lattice& lattice, const glm::ivec3& at) const {
    for (int axis = 0; axis < 3; ++axis)
        if (at[axis] < 0 || at[axis] >= lattice.cells[axis]) return nullptr;
    const std::uint32_t brick = brickAt(lattice, bricks, at);
    if (brick == kNoBrick) return nullptr;
    const std::int32_t index = cell_at[std::size_t(brick) * kPlaces + indexOf(at % kBrickCells)];
    return index < 0 ? nullptr : &cell[static_cast<std::size_t>(index)];
}

DualComplex dualComplex(const MeshRequest& request) {
    return Builder(request).run();
}

}  // namespace edgewise::sdf
