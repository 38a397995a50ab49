#include "sdf/dual_cells.h"

#include <algorithm>

#include "sdf/dual_wedges.h"
#include "sdf/mesh_feature.h"
#include "sdf/scene_error.h"

namespace edgewise::sdf {
namespace {

constexpr int kPlaces = kBrickCells * kBrickCells * kBrickCells;
constexpr int kEdgePlaces = 3 * BrickCrossings::kCorners;
/// Of a cell's side: a loop's middle is kept so far from its faces.
constexpr double kRim = 0.02;

glm::ivec3 placeOf(int n) {
    return {n % kBrickCells, n / kBrickCells % kBrickCells, n / (kBrickCells * kBrickCells)};
}

/// A part of a face that lies between two leaves' cells.
struct FacePart {
    glm::ivec3 low;
    int axis, side;  ///< across it; its length in units
};

/// Two crossed edges that the surface joins over a part of a face.
struct Segment {
    std::uint32_t a, b;
    FacePart face;
};

/// Where the border of a part of a face crosses the surface.
struct BorderCrossing {
    std::uint32_t polygon;
    bool leaving;  ///< the inside
};

class Builder {
  public:
    Builder(const MeshRequest& request, const TapeAt& tape, BrickList bricks)
        : lattice_(request.lattice), tape_(tape), wedges_(request, tape, complex_.bricks) {
        complex_.bricks = std::move(bricks);
    }

    DualComplex run() {
        requireClosed(complex_.bricks.open);
        const std::size_t count = complex_.bricks.bricks.size();
        complex_.passed.resize(count);
        polygon_at_.assign(count * kEdgePlaces, kNoVertex);
        for (std::uint32_t b = 0; b < count; ++b)
            if (!complex_.bricks.bricks[b].divided) read(b);
        for (const PlainCell& cell : plain_) takePlain(cell);
        for (const auto& [brick, cell] : mixed_) takeMixed(brick, cell);
        for (const DualPolygon& polygon : complex_.polygons)
            for (const std::uint32_t v : polygon.vertex)
                if (v == kNoVertex) fail();
        return std::move(complex_);
    }

  private:
    struct PlainCell {
        std::uint32_t brick, first_vertex;
        glm::ivec3 place;
        CellLoops loops;
    };

    void requireClosed(bool open) const {
        if (open) throw SceneError("surface", "it reaches the end of the box: the mesh would be open");
    }
    [[noreturn]] static void fail() {
        throw SceneError("surface", "it was found where bounds say that there is none");
    }

    // Edges.

    /// The brick that makes the polygon of an edge: of those around it with cells of its length, the first.
    /// kDividedBit: shorter edges are part of it.
    std::uint32_t ownerOf(const glm::ivec3& corner, int axis, int level) const {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::uint32_t owner = kNoBrick;
        for (int n = 0; n < 4; ++n) {
            glm::ivec3 at = corner;
            at[u] -= n & 1, at[v] -= n >> 1;
            const BrickList::Leaf leaf = complex_.bricks.leafAt(lattice_, at);
            if (leaf.level > level) return kDividedBit;
            if (leaf.level == level && owner == kNoBrick) owner = leaf.brick;
        }
        return owner;
    }
    std::uint32_t& polygonIn(std::uint32_t b, const glm::ivec3& place, int axis) {
        return polygon_at_[std::size_t(b) * kEdgePlaces + 3 * BrickCrossings::indexOf(place) + axis];
    }
    /// kNoVertex: the surface does not cross the edge.
    std::uint32_t polygonOf(const glm::ivec3& corner, int axis, std::uint32_t owner) {
        const Brick& brick = complex_.bricks.bricks[owner];
        return polygonIn(owner, (corner - brick.first) / brick.cellUnits(), axis);
    }
    static bool within(const glm::ivec3& place, int axis) {
        const int u = place[(axis + 1) % 3], v = place[(axis + 2) % 3];
        return u > 0 && u < kBrickCells && v > 0 && v < kBrickCells;
    }

    void addPolygons(std::uint32_t b) {
        const Brick& brick = complex_.bricks.bricks[b];
        for (int z = 0; z <= kBrickCells; ++z)
            for (int y = 0; y <= kBrickCells; ++y)
                for (int x = 0; x <= kBrickCells; ++x)
                    for (int axis = 0; axis < 3; ++axis) addPolygon(b, brick, {x, y, z}, axis);
    }
    void addPolygon(std::uint32_t b, const Brick& brick, const glm::ivec3& place, int axis) {
        const Crossing* crossing = crossings_.crossing(place, axis);
        if (!crossing) return;
        DualPolygon polygon;
        polygon.corner = brick.unitsOf(place);
        if (!within(place, axis) && ownerOf(polygon.corner, axis, brick.level) != b) return;
        polygonIn(b, place, axis) = static_cast<std::uint32_t>(complex_.polygons.size());
        polygon.axis = static_cast<std::uint8_t>(axis),
        polygon.level = static_cast<std::uint8_t>(brick.level);
        polygon.outward = crossings_.value(place) < 0.0;
        polygon.brick = b;
        polygon.crossing = {crossing->place_world, crossing->normal_world};
        polygon.made = crossing->made;
        complex_.polygons.push_back(polygon);
    }

    // Bricks.

    void read(std::uint32_t b) {
        const Brick& brick = complex_.bricks.bricks[b];
        crossings_.readValues(lattice_, brick);
        complex_.turned += wedges_.turnIn(brick, crossings_);
        crossings_.findCrossings(lattice_, brick, tape_);
        requireClosed(crossings_.open(lattice_, brick));
        addPolygons(b);
        const bool smaller_around = smallerAround(brick.first, kBrickCells * brick.cellUnits(), brick.level);
        for (int n = 0; n < kPlaces; ++n) {
            const glm::ivec3 place = placeOf(n);
            const DualCell cell{brick.unitsOf(place), brick.cellUnits()};
            if (smaller_around && onBorder(place) && smallerAround(cell.low, cell.side, brick.level))
                mixed_.push_back({b, cell});
            else if (crossings_.crosses(place))
                addPlain(b, n, place, cell);
        }
    }
    static bool onBorder(const glm::ivec3& place) {
        for (int axis = 0; axis < 3; ++axis)
            if (place[axis] == 0 || place[axis] == kBrickCells - 1) return true;
        return false;
    }
    /// Cells of higher levels share a face or an edge with a cube, which is a cell or a brick.
    bool smallerAround(const glm::ivec3& low, int side, int level) const {
        if (complex_.bricks.parts.empty()) return false;
        const int steps = side > (kUnits >> level) ? 2 : 1;  // a brick's neighbour may be divided in part
        for (int n = 0; n < 27; ++n) {
            const glm::ivec3 way(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
            if (n == 13 || (way.x != 0 && way.y != 0 && way.z != 0)) continue;
            for (int m = 0; m < (steps == 2 ? 8 : 1); ++m) {
                glm::ivec3 at;
                for (int axis = 0; axis < 3; ++axis)
                    at[axis] = way[axis] < 0   ? low[axis] - 1
                               : way[axis] > 0 ? low[axis] + side
                                               : low[axis] + (m >> axis & 1) * side / 2;
                if (complex_.bricks.leafAt(lattice_, at).level > level) return true;
            }
        }
        return false;
    }

    // Cells without smaller ones around.

    void addPlain(std::uint32_t b, int n, const glm::ivec3& place, const DualCell& cell) {
        double values[kCellCorners];
        crossings_.cellValues(place, values);
        PlainCell plain{b, static_cast<std::uint32_t>(complex_.vertices.size()), place, loopsOf(values)};
        for (int loop = 0; loop < plain.loops.count; ++loop) {
            std::array<TangentPlane, kCellEdges> planes;
            std::size_t count = 0;
            for (int edge = 0; edge < kCellEdges; ++edge) {
                if (plain.loops.loop[edge] != loop) continue;
                const Crossing& crossing = crossings_.crossing(place, edgeEnds(edge));
                planes[count++] = {crossing.place_world, crossing.normal_world};
            }
            addVertex(b, cell, std::span(planes.data(), count), plain.loops.count, false);
        }
        complex_.passed[b].set(static_cast<std::size_t>(n));
        ++complex_.cells;
        plain_.push_back(plain);
    }

    void addVertex(std::uint32_t b, const DualCell& cell, std::span<const TangentPlane> planes, int loops,
                   bool mixed) {
        DualVertex vertex;
        vertex.middle_world = glm::dvec3(0.0);
        for (const TangentPlane& plane : planes) vertex.middle_world += plane.point;
        vertex.middle_world /= static_cast<double>(planes.size());
        const double side = lattice_.step * cell.side / kUnits;
        if (mixed)
            vertex.middle_world = glm::clamp(vertex.middle_world, lattice_.corner(cell.low) + kRim * side,
                                             lattice_.corner(cell.low + cell.side) - kRim * side);
        const FeaturePoint point =
            featurePoint(tape_, planes.first(std::min<std::size_t>(planes.size(), kMostPlanes)),
                         vertex.middle_world, side);
        vertex.target_world = point.place_world, vertex.rank = static_cast<std::uint8_t>(point.rank);
        vertex.cell = cell, vertex.brick = b;
        vertex.loops = static_cast<std::uint8_t>(std::min(loops, 255)), vertex.mixed = mixed;
        complex_.vertices.push_back(vertex);
    }

    void takePlain(const PlainCell& plain) {
        const Brick& brick = complex_.bricks.bricks[plain.brick];
        const DualCell cell{brick.unitsOf(plain.place), brick.cellUnits()};
        std::array<std::uint32_t, kCellEdges> polygon{};
        for (int edge = 0; edge < kCellEdges; ++edge) {
            if (plain.loops.loop[edge] < 0) continue;
            const EdgeEnds ends = edgeEnds(edge);
            const glm::ivec3 place = plain.place + BrickCrossings::cornerOffset(ends.low);
            const glm::ivec3 corner = brick.unitsOf(place);
            const std::uint32_t owner =
                within(place, ends.axis) ? plain.brick : ownerOf(corner, ends.axis, brick.level);
            if (owner == kNoBrick || owner == kDividedBit) fail();
            polygon[edge] = polygonOf(corner, ends.axis, owner);
            if (polygon[edge] == kNoVertex) fail();
            put(polygon[edge], cell, plain.first_vertex + static_cast<std::uint32_t>(plain.loops.loop[edge]));
        }
        for (int edge = 0; edge < kCellEdges; ++edge) {
            const int next = plain.loops.next[edge];
            if (next >= 0) link({polygon[edge], polygon[next], facePart(cell, edge, next)});
        }
    }
    /// The face that two edges of a cell share and the surface passes from one to the other.
    static FacePart facePart(const DualCell& cell, int edge, int next) {
        const EdgeEnds a = edgeEnds(edge), b = edgeEnds(next);
        const int low = a.low & a.high & b.low & b.high,
                  high = (kCellCorners - 1) & ~(a.low | a.high | b.low | b.high);
        for (int axis = 0; axis < 3; ++axis) {
            FacePart part{cell.low, axis, cell.side};
            if (low >> axis & 1) {
                part.low[axis] += cell.side;
                return part;
            }
            if (high >> axis & 1) return part;
        }
        fail();
    }

    /// A cell's vertex into its places around an edge.
    void put(std::uint32_t p, const DualCell& cell, std::uint32_t vertex) {
        DualPolygon& polygon = complex_.polygons[p];
        const int u = (polygon.axis + 1) % 3, v = (polygon.axis + 2) % 3;
        constexpr int kPlace[2][2] = {{0, 3}, {1, 2}};
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j) {
                const bool has_u =
                    i == 0 ? cell.low[u] < polygon.corner[u] : cell.low[u] + cell.side > polygon.corner[u];
                const bool has_v =
                    j == 0 ? cell.low[v] < polygon.corner[v] : cell.low[v] + cell.side > polygon.corner[v];
                if (has_u && has_v) polygon.vertex[kPlace[i][j]] = vertex;
            }
        polygon.mixed |= cell.side != kUnits >> polygon.level || complex_.vertices[vertex].mixed;
    }

    int sideOf(const DualPolygon& polygon, const FacePart& face) const {
        const int u = (polygon.axis + 1) % 3, along = 3 - face.axis - polygon.axis;
        const bool up = 2 * face.low[along] + face.side > 2 * polygon.corner[along];
        if (face.axis == u) return up ? 2 : 0;
        return up ? 1 : 3;
    }
    void link(const Segment& segment) {
        DualPolygon &a = complex_.polygons[segment.a], &b = complex_.polygons[segment.b];
        const int i = sideOf(a, segment.face), j = sideOf(b, segment.face);
        a.across[i] = segment.b, a.across_side[i] = static_cast<std::uint8_t>(j);
        b.across[j] = segment.a, b.across_side[j] = static_cast<std::uint8_t>(i);
    }

    // Cells with smaller ones around: their faces are divided as their neighbours' are.

    void takeMixed(std::uint32_t b, const DualCell& cell) {
        segments_.clear();
        for (int axis = 0; axis < 3; ++axis) {
            FacePart face{cell.low, axis, cell.side};
            addSegments(face, -1);
            face.low[axis] += cell.side;
            addSegments(face, 0);
        }
        if (segments_.empty()) return;
        const std::vector<std::vector<std::uint32_t>> loops = loopsOfSegments();
        const auto first = static_cast<std::uint32_t>(complex_.vertices.size());
        for (const auto& loop : loops) {
            std::vector<TangentPlane> planes;
            for (const std::uint32_t p : loop) planes.push_back(complex_.polygons[p].crossing);
            addVertex(b, cell, planes, static_cast<int>(loops.size()), true);
        }
        for (std::size_t n = 0; n < loops.size(); ++n)
            for (const std::uint32_t p : loops[n]) put(p, cell, first + static_cast<std::uint32_t>(n));
        for (const Segment& segment : segments_) link(segment);
        const Brick& brick = complex_.bricks.bricks[b];
        const glm::ivec3 place = (cell.low - brick.first) / cell.side;
        complex_.passed[b].set(
            static_cast<std::size_t>(place.x + kBrickCells * (place.y + kBrickCells * place.z)));
        ++complex_.cells;
    }

    static int levelOf(int side) {
        int level = 0;
        while (kUnits >> level > side) ++level;
        return level;
    }

    void addSegments(const FacePart& face, int beyond) {
        glm::ivec3 other = face.low;
        other[face.axis] += beyond;
        if (complex_.bricks.leafAt(lattice_, other).level <= levelOf(face.side)) return addPart(face);
        const int half = face.side / 2;
        for (int n = 0; n < 4; ++n) {
            FacePart part{face.low, face.axis, half};
            part.low[(face.axis + 1) % 3] += (n & 1) * half;
            part.low[(face.axis + 2) % 3] += (n >> 1) * half;
            addSegments(part, beyond);
        }
    }

    void addPart(const FacePart& face) {
        const int u = (face.axis + 1) % 3, v = (face.axis + 2) % 3;
        glm::ivec3 at_u = face.low, at_v = face.low;
        at_u[u] += face.side, at_v[v] += face.side;
        border_.clear();
        bool whole = cross(face.low, u, face.side, false);
        whole &= cross(at_u, v, face.side, false);
        whole &= cross(at_v, u, face.side, true);
        whole &= cross(face.low, v, face.side, true);
        const std::size_t count = border_.size();
        if (count % 2 != 0) fail();
        const bool joined = count == 4 && whole && insidesJoined(face);
        for (std::size_t n = 0; n < count; ++n) {
            if (!border_[n].leaving) continue;
            const BorderCrossing& other = border_[joined ? (n + 1) % count : (n + count - 1) % count];
            if (other.leaving) fail();
            segments_.push_back({border_[n].polygon, other.polygon, face});
        }
    }
    /// Crossings of an edge, or of those that are part of it, in order. False: it is divided.
    bool cross(const glm::ivec3& corner, int axis, int side, bool backwards) {
        const std::uint32_t owner = ownerOf(corner, axis, levelOf(side));
        if (owner == kDividedBit) {
            glm::ivec3 middle = corner;
            middle[axis] += side / 2;
            cross(backwards ? middle : corner, axis, side / 2, backwards);
            cross(backwards ? corner : middle, axis, side / 2, backwards);
            return false;
        }
        if (owner == kNoBrick) return true;
        const std::uint32_t p = polygonOf(corner, axis, owner);
        if (p != kNoVertex) border_.push_back({p, complex_.polygons[p].outward != backwards});
        return true;
    }
    /// As mesh_cell decides it.
    bool insidesJoined(const FacePart& face) const {
        const int u = (face.axis + 1) % 3, v = (face.axis + 2) % 3;
        double value[4];
        for (int n = 0; n < 4; ++n) {
            glm::ivec3 corner = face.low;
            if (n == 1 || n == 2) corner[u] += face.side;
            if (n >= 2) corner[v] += face.side;
            value[n] = wedges_.valueAt(corner);
        }
        const double first = value[0] * value[2], second = value[1] * value[3];
        return value[0] < 0.0 ? first > second : second > first;
    }

    /// Closed ways over the segments: each crossed edge has two.
    std::vector<std::vector<std::uint32_t>> loopsOfSegments() const {
        std::vector<std::vector<std::uint32_t>> loops;
        std::vector<bool> used(segments_.size(), false);
        for (std::size_t first = 0; first < segments_.size(); ++first) {
            if (used[first]) continue;
            used[first] = true;
            loops.push_back({segments_[first].a});
            for (std::uint32_t at = segments_[first].b; at != segments_[first].a;) {
                loops.back().push_back(at);
                std::size_t next = 0;
                while (next < segments_.size() &&
                       (used[next] || (segments_[next].a != at && segments_[next].b != at)))
                    ++next;
                if (next == segments_.size()) fail();
                used[next] = true;
                at = segments_[next].a == at ? segments_[next].b : segments_[next].a;
            }
        }
        return loops;
    }

    const Lattice& lattice_;
    const TapeAt& tape_;
    DualComplex complex_;
    const WedgeCorners wedges_;
    BrickCrossings crossings_;
    std::vector<std::uint32_t> polygon_at_;  ///< by brick, corner and axis
    std::vector<PlainCell> plain_;
    std::vector<std::pair<std::uint32_t, DualCell>> mixed_;
    std::vector<Segment> segments_;
    std::vector<BorderCrossing> border_;
};

}  // namespace

DualComplex dualComplex(const MeshRequest& request, const TapeAt& tape, BrickList bricks) {
    return Builder(request, tape, std::move(bricks)).run();
}

}  // namespace edgewise::sdf
