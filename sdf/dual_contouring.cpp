#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

#include "sdf/dual_cells.h"
#include "sdf/dual_debris.h"
#include "sdf/evaluate.h"
#include "sdf/mesh_attributes.h"
#include "sdf/mesh_check.h"
#include "sdf/mesh_embedding.h"
#include "sdf/mesh_feature.h"
#include "sdf/mesh_refine.h"
#include "sdf/mesh_simplify.h"
#include "sdf/polygonize.h"

namespace edgewise::sdf {
namespace {

/// Of a cell's side: a vertex is kept so far from its cell's faces when it is moved there.
constexpr double kInside = 0.02;
/// Of a cell's side: vertices of different cells nearer than that would be the same.
constexpr double kApart = 0.05;
/// Of the distance between two crossings of one line: how far their middle goes off it.
constexpr double kBulge = 0.1;
constexpr int kMostMendings = 20;
/// Of a cell's side: edges whose middles are further off the surface are divided.
constexpr double kSharpMiddle = 0.01, kSmoothMiddle = 0.04;
/// Of a cell's side: where the mesh is further off the surface than that, cells are divided.
constexpr double kSharpOff = 0.016, kSmoothOff = 0.085;
/// Of a cell's side: vertices are left out where the mesh stays as near as that.
constexpr double kSharpThin = 0.011, kSmoothThin = 0.014;
/// Of dividing, where no distance is asked for, and until there are half as many bricks more; not at all
/// where the mesh is off in more than that part of them: smaller cells are the way then, a larger resolution.
/// Nor a second time for a few of them.
constexpr int kRounds = 2;
constexpr double kMostOffBricks = 0.2;
/// The same three of a distance that is asked for.
constexpr double kMiddlePart = 0.5, kOffPart = 0.75, kThinPart = 0.6;

/// A vertex is at its target, or, to keep the mesh from meeting itself, moved towards its loop's middle.
enum Care : std::uint8_t { kFree, kInCell, kHalfway, kMiddle, kDivided };

class DualContouring {
  public:
    DualContouring(const MeshRequest& request, BrickList bricks, MeshCounts& counts)
        : request_(request),
          lattice_(request.lattice),
          counts_(counts),
          complex_(dualComplex(request, std::move(bricks))) {
        counts_.debris = leaveOutDebris(request, complex_);
        counts_.nodes = complex_.bricks.nodes, counts_.pruned = complex_.bricks.pruned;
        counts_.bricks = complex_.bricks.bricks.size(), counts_.cells = complex_.cells;
    }

    SurfaceMesh run(const MeshLimits& middle) {
        placeVertices();
        divided_.assign(complex_.polygons.size(), false);
        turned_.assign(complex_.polygons.size(), false);
        middles_.assign(complex_.polygons.size(), {kNoVertex, kNoVertex, kNoVertex, kNoVertex});
        partTwins();
        diagonal_.assign(complex_.polygons.size(), 0xff);
        for (int round = 0;; ++round) {
            triangulate();
            if (round == kMostMendings || !(partDiagonals() || mend())) break;
        }
        const TapeAt tape(request_.tape, lattice_, complex_.bricks);
        counts_.added = refineMesh(mesh_, tape, lattice_.step, sharpCells(), middle);
        return std::move(mesh_);
    }

    const DualComplex& complex() const { return complex_; }
    SharpCells sharpCells() const {
        SharpCells sharp(lattice_, complex_.bricks);
        for (const DualVertex& v : complex_.vertices)
            if (v.rank > 1) sharp.addAround(v.cell.low, v.cell.side);
        return sharp;
    }
    BrickList takeBricks() { return std::move(complex_.bricks); }

  private:
    const TapeView& tapeOf(std::uint32_t brick) const { return complex_.bricks.bricks[brick].tape; }
    double sideOf(const DualCell& cell) const { return lattice_.step * cell.side / kUnits; }
    bool inOwnCell(const DualVertex& v, const glm::dvec3& p) const {
        const glm::dvec3 low = lattice_.corner(v.cell.low), high = lattice_.corner(v.cell.low + v.cell.side);
        for (int axis = 0; axis < 3; ++axis)
            if (!(p[axis] >= low[axis] && p[axis] <= high[axis])) return false;
        return true;
    }

    /// On the way from the loop's middle to the target, the last place well within the cell.
    glm::dvec3 heldInCell(const DualVertex& v, const glm::dvec3& target) const {
        const glm::dvec3 low = lattice_.corner(v.cell.low), high = lattice_.corner(v.cell.low + v.cell.side);
        const double rim = kInside * sideOf(v.cell);
        const glm::dvec3 from = glm::clamp(v.middle_world, low + rim, high - rim), way = target - from;
        double part = 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            if (target[axis] > high[axis] - rim)
                part = std::min(part, (high[axis] - rim - from[axis]) / way[axis]);
            if (target[axis] < low[axis] + rim)
                part = std::min(part, (low[axis] + rim - from[axis]) / way[axis]);
        }
        return from + std::max(part, 0.0) * way;
    }

    /// A vertex may be in the cell next to its own where the surface has none of its own: a sharp edge that
    /// just looks in. Two in one place would be one.
    void placeVertices() {
        care_.assign(complex_.vertices.size(), kFree);
        std::map<std::tuple<int, int, int>, std::vector<glm::dvec3>> taken;
        mesh_.position_world.resize(complex_.vertices.size());
        for (std::size_t n = 0; n < complex_.vertices.size(); ++n) {
            DualVertex& v = complex_.vertices[n];
            if (!inOwnCell(v, v.target_world)) {
                glm::ivec3 at;
                bool may = freeBeside(v, at);
                auto& others = taken[{at.x, at.y, at.z}];
                for (const glm::dvec3& other : others)
                    may &= glm::distance(other, v.target_world) > kApart * sideOf(v.cell);
                if (may)
                    others.push_back(v.target_world);
                else
                    v.target_world = heldOnSurface(v);
            }
            mesh_.position_world[n] = v.target_world;
        }
    }
    /// Whether a vertex belongs into a cell of its own one's size beside it that the surface does not pass;
    /// `at`: which one.
    bool freeBeside(const DualVertex& v, glm::ivec3& at) const {
        at = glm::ivec3(glm::floor((v.target_world - lattice_.low_world) / lattice_.step * double(kUnits)));
        const BrickList::Leaf leaf = complex_.bricks.leafAt(lattice_, at);
        at = at / v.cell.side * v.cell.side;
        const glm::ivec3 off = glm::abs(at - v.cell.low) / v.cell.side;
        if (v.mixed || kUnits >> leaf.level != v.cell.side || std::max({off.x, off.y, off.z}) > 1)
            return false;
        if (leaf.brick == kNoBrick) return true;
        const glm::ivec3 place = (at - complex_.bricks.bricks[leaf.brick].first) / v.cell.side;
        return !complex_.passed[leaf.brick][static_cast<std::size_t>(
            place.x + kBrickCells * (place.y + kBrickCells * place.z))];
    }
    glm::dvec3 heldOnSurface(const DualVertex& v) const {
        const glm::dvec3 held = heldInCell(v, v.target_world), moved = onSurface(tapeOf(v.brick), held);
        return inOwnCell(v, moved) ? moved : heldInCell(v, moved);
    }

    /// Where the surface passes a face twice between the same two vertices, the two sides get vertices of
    /// their own between them: else four triangles would have one edge.
    void partTwins() {
        struct Side {
            std::uint32_t low, high, polygon;
            int k;
        };
        std::vector<Side> sides;
        sides.reserve(4 * complex_.polygons.size());
        for (std::uint32_t p = 0; p < complex_.polygons.size(); ++p) {
            const DualPolygon& polygon = complex_.polygons[p];
            for (int k = 0; k < 4; ++k) {
                const std::uint32_t a = polygon.vertex[k], b = polygon.vertex[(k + 1) % 4];
                if (a != b) sides.push_back({std::min(a, b), std::max(a, b), p, k});
            }
        }
        const auto less = [](const Side& x, const Side& y) {
            return std::tie(x.low, x.high, x.polygon, x.k) < std::tie(y.low, y.high, y.polygon, y.k);
        };
        std::sort(sides.begin(), sides.end(), less);
        for (std::size_t begin = 0, end; begin < sides.size(); begin = end) {
            for (end = begin; end < sides.size() && sides[end].low == sides[begin].low &&
                              sides[end].high == sides[begin].high;)
                ++end;
            if (end - begin > 2)
                for (std::size_t n = begin; n < end; ++n) addMiddle(sides[n].polygon, sides[n].k);
        }
    }

    /// A vertex on the face between two of a polygon's cells, for it and for its neighbour there.
    void addMiddle(std::uint32_t p, int k) {
        if (middles_[p][k] != kNoVertex) return;
        const DualPolygon& polygon = complex_.polygons[p];
        const std::uint32_t q = polygon.across[k];
        const DualPolygon& other = complex_.polygons[q];
        const auto middle = static_cast<std::uint32_t>(mesh_.position_world.size());
        mesh_.position_world.push_back(0.5 * (polygon.crossing.point + other.crossing.point));
        if (oneLine(polygon, other)) {
            // Into the face, away from its border.
            const int along = 3 - sideAxis(polygon, k) - polygon.axis;
            const double off = kBulge * glm::distance(polygon.crossing.point, other.crossing.point);
            mesh_.position_world.back()[along] += k == 1 || k == 2 ? off : -off;
        }
        middles_[p][k] = middle;
        middles_[q][polygon.across_side[k]] = middle;
    }

    /// Both edges are parts of a larger cell's.
    static bool oneLine(const DualPolygon& a, const DualPolygon& b) {
        const int u = (a.axis + 1) % 3, v = (a.axis + 2) % 3;
        return a.axis == b.axis && a.corner[u] == b.corner[u] && a.corner[v] == b.corner[v];
    }

    /// Polygons along one line of a larger cell's may have two vertices across in common, or a diagonal where
    /// others have a side: they get hubs of their own. False: there are none.
    bool partDiagonals() {
        struct Line {
            std::uint32_t low, high, polygon;  ///< kNoVertex: a side
        };
        std::vector<Line> lines;
        for (std::uint32_t p = 0; p < complex_.polygons.size(); ++p) {
            const DualPolygon& polygon = complex_.polygons[p];
            if (!polygon.mixed) continue;
            const auto add = [&](int i, int j, std::uint32_t of) {
                const auto [low, high] = std::minmax(polygon.vertex[i % 4], polygon.vertex[j % 4]);
                lines.push_back({low, high, of});
            };
            const bool pair = !divided_[p] && !hasMiddle(p) && polygon.isSide(0) && polygon.isSide(1) &&
                              polygon.isSide(2) && polygon.isSide(3);
            if (pair) add(diagonal_[p], diagonal_[p] + 2, p);
            for (int k = 0; k < 4; ++k)
                if (polygon.isSide(k)) add(k, k + 1, kNoVertex);
        }
        std::sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) {
            return std::tie(a.low, a.high, a.polygon) < std::tie(b.low, b.high, b.polygon);
        });
        bool found = false;
        for (std::size_t begin = 0, end; begin < lines.size(); begin = end) {
            for (end = begin; end < lines.size() && lines[end].low == lines[begin].low &&
                              lines[end].high == lines[begin].high;)
                ++end;
            for (std::size_t n = begin; end - begin > 1 && n < end; ++n)
                if (lines[n].polygon != kNoVertex) divided_[lines[n].polygon] = found = true;
        }
        return found;
    }

    bool hasMiddle(std::uint32_t p) const {
        return std::any_of(middles_[p].begin(), middles_[p].end(),
                           [](std::uint32_t m) { return m != kNoVertex; });
    }

    void triangulate() {
        mesh_.triangles.clear(), owner_.clear(), doubtful_.clear();
        for (std::uint32_t p = 0; p < complex_.polygons.size(); ++p)
            divided_[p] || hasMiddle(p) ? addFan(p) : addPair(p);
    }

    void add(std::uint32_t p, std::uint32_t a, std::uint32_t b, std::uint32_t c, bool doubt) {
        if (!complex_.polygons[p].outward) std::swap(b, c);
        mesh_.triangles.push_back({a, b, c});
        owner_.push_back(p), doubtful_.push_back(doubt);
    }

    void addFan(std::uint32_t p) {
        const DualPolygon& polygon = complex_.polygons[p];
        const auto hub = hub_.try_emplace(p, static_cast<std::uint32_t>(mesh_.position_world.size()));
        if (hub.second) mesh_.position_world.push_back(polygon.crossing.point);
        const std::uint32_t centre = hub.first->second;
        const bool plain = plainCells(polygon);
        for (int k = 0; k < 4; ++k) {
            if (!polygon.isSide(k)) continue;
            const std::uint32_t a = polygon.vertex[k], b = polygon.vertex[(k + 1) % 4], m = middles_[p][k];
            if (m == kNoVertex)
                add(p, centre, a, b, !plain || !throughFace(polygon, k));
            else
                add(p, centre, a, m, !plain), add(p, centre, m, b, !plain);
        }
    }

    /// All vertices in cells of one loop, and there, and none of another size.
    bool plainCells(const DualPolygon& polygon) const {
        if (polygon.mixed) return false;
        for (const std::uint32_t v : polygon.vertex) {
            const DualVertex& vertex = complex_.vertices[v];
            if (vertex.loops > 1 || !inOwnCell(vertex, mesh_.position_world[v])) return false;
        }
        return true;
    }

    /// Whether the side's line passes the face between its cells: Ju and Udeshi 2006's first condition.
    bool throughFace(const DualPolygon& polygon, int k) const {
        const glm::dvec3 &a = mesh_.position_world[polygon.vertex[k]],
                         &b = mesh_.position_world[polygon.vertex[(k + 1) % 4]];
        const int axis = sideAxis(polygon, k), other = 3 - axis - polygon.axis;
        const double plane = lattice_.coordinate(axis, polygon.corner[axis]), run = b[axis] - a[axis];
        if (run == 0.0) return false;
        const glm::dvec3 at = a + (plane - a[axis]) / run * (b - a);
        const glm::ivec3 cell = polygonCell(polygon, k);
        for (const int i : {int(polygon.axis), other})
            if (at[i] < lattice_.coordinate(i, cell[i]) ||
                at[i] > lattice_.coordinate(i, cell[i] + (kUnits >> polygon.level)))
                return false;
        return true;
    }

    /// Whether both triangles stay within the polygon's envelope, the tetrahedra of its edge and its sides:
    /// for the diagonal from vertex `d`. The edge passes one of them, and the diagonal the triangle of the
    /// edge and the fourth vertex.
    bool aroundEdge(const DualPolygon& polygon, int d) const {
        const int u = (polygon.axis + 1) % 3, v = (polygon.axis + 2) % 3;
        const glm::dvec3 edge = lattice_.corner(polygon.corner);
        const double side = lattice_.step / (1 << polygon.level);
        glm::dvec3 x[4];
        for (int k = 0; k < 4; ++k) x[k] = mesh_.position_world[polygon.vertex[(d + k) % 4]] - edge;
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
            const double along =
                (at[u] * x[j][u] + at[v] * x[j][v]) / (x[j][u] * x[j][u] + x[j][v] * x[j][v]);
            const double height = at[polygon.axis] - along * x[j][polygon.axis];
            return along >= 0.0 && along <= 1.0 && height >= 0.0 && height <= (1.0 - along) * side;
        };
        return (passed(0, 1, 2) && withinSide(3)) || (passed(0, 2, 3) && withinSide(1));
    }

    double offAlong(const DualPolygon& polygon, int d) const {
        const glm::dvec3 middle =
            0.5 * (mesh_.position_world[polygon.vertex[d]] + mesh_.position_world[polygon.vertex[d + 2]]);
        return std::abs(valueAt(tapeOf(polygon.brick), middle));
    }

    /// The diagonal nearer to the surface; of two as near, the shorter one.
    std::uint8_t betterDiagonal(const DualPolygon& polygon) const {
        const double first = offAlong(polygon, 0), second = offAlong(polygon, 1);
        if (std::abs(first - second) > 1e-9 * lattice_.step) return second < first;
        const auto length = [&](int d) {
            return glm::distance(mesh_.position_world[polygon.vertex[d]],
                                 mesh_.position_world[polygon.vertex[d + 2]]);
        };
        return length(1) < length(0);
    }

    void addPair(std::uint32_t p) {
        const DualPolygon& polygon = complex_.polygons[p];
        for (int k = 0; k < 4; ++k)
            if (!polygon.isSide(k)) {
                const auto at = [&](int n) { return polygon.vertex[(k + n) % 4]; };
                return add(p, at(1), at(2), at(3), true);
            }
        if (diagonal_[p] == 0xff) diagonal_[p] = betterDiagonal(polygon);
        const int d = diagonal_[p];
        bool doubt = !plainCells(polygon) || !aroundEdge(polygon, d);
        for (int k = 0; k < 4 && !doubt; ++k) doubt |= !throughFace(polygon, k);
        const auto at = [&](int k) { return polygon.vertex[(d + k) % 4]; };
        add(p, at(0), at(1), at(2), doubt), add(p, at(0), at(2), at(3), doubt);
    }

    /// Looks for triangles that meet, and takes more care of their polygons. False: there are none.
    bool mend() {
        const auto pairs = meetingPairs(mesh_.position_world, mesh_.triangles, doubtful_);
        if (pairs.empty()) return false;
        std::vector<std::uint32_t> polygons;
        for (const auto& [a, b] : pairs) polygons.push_back(owner_[a]), polygons.push_back(owner_[b]);
        std::sort(polygons.begin(), polygons.end());
        polygons.erase(std::unique(polygons.begin(), polygons.end()), polygons.end());
        counts_.mended += polygons.size();
        std::vector<std::uint32_t> moved;
        for (const std::uint32_t p : polygons) takeCare(p, moved);
        std::sort(moved.begin(), moved.end());
        moved.erase(std::unique(moved.begin(), moved.end()), moved.end());
        for (const std::uint32_t v : moved) move(v);
        return true;
    }

    void takeCare(std::uint32_t p, std::vector<std::uint32_t>& moved) {
        const DualPolygon& polygon = complex_.polygons[p];
        if (!turned_[p] && !divided_[p] && !hasMiddle(p)) {
            turned_[p] = true;
            const auto other = static_cast<std::uint8_t>(1 - diagonal_[p]);
            if (plainCells(polygon) && aroundEdge(polygon, other) && !aroundEdge(polygon, 1 - other)) {
                diagonal_[p] = other;
                return;
            }
        }
        for (const std::uint32_t v : polygon.vertex) moved.push_back(v);
        bool all_middle = true;
        for (const std::uint32_t v : polygon.vertex) all_middle &= care_[v] >= kMiddle;
        if (!all_middle) return;
        divided_[p] = true;
        for (int k = 0; k < 4; ++k)
            if (polygon.isSide(k)) addMiddle(p, k);
    }

    void move(std::uint32_t v) {
        const DualVertex& vertex = complex_.vertices[v];
        glm::dvec3& place = mesh_.position_world[v];
        if (care_[v] < kDivided) care_[v] = static_cast<std::uint8_t>(care_[v] + 1);
        if (care_[v] == kInCell && inOwnCell(vertex, place)) care_[v] = kHalfway;
        if (care_[v] == kInCell) place = heldOnSurface(vertex);
        if (care_[v] == kHalfway)
            place = 0.5 * (heldInCell(vertex, vertex.target_world) + vertex.middle_world);
        if (care_[v] >= kMiddle) place = vertex.middle_world;
    }

    const MeshRequest& request_;
    const Lattice& lattice_;
    MeshCounts& counts_;
    DualComplex complex_;
    SurfaceMesh mesh_;
    std::vector<std::uint8_t> care_, diagonal_;
    std::vector<bool> divided_, turned_, doubtful_;
    std::vector<std::array<std::uint32_t, 4>> middles_;
    std::map<std::uint32_t, std::uint32_t> hub_;  ///< of divided polygons
    std::vector<std::uint32_t> owner_;            ///< a triangle's polygon
};

std::size_t bricksOf(const std::vector<PlaceOff>& places, const Lattice& lattice, const BrickList& bricks) {
    std::vector<std::uint32_t> found;
    for (const PlaceOff& off : places)
        found.push_back(bricks.leafAt(lattice, lattice.unitAt(off.place_world)).brick);
    std::sort(found.begin(), found.end());
    return static_cast<std::size_t>(std::unique(found.begin(), found.end()) - found.begin());
}

}  // namespace

SurfaceMesh dualContouring(const MeshRequest& request, MeshCounts& counts) {
    const double step = request.lattice.step;
    MeshLimits middle{kSharpMiddle * step, kSmoothMiddle * step}, most{kSharpOff * step, kSmoothOff * step},
        thin{kSharpThin * step, kSmoothThin * step};
    if (request.most_off) {
        const double most_off = *request.most_off;
        middle = {kMiddlePart * most_off, kMiddlePart * most_off};
        most = {kOffPart * most_off, kOffPart * most_off};
        thin = {kThinPart * most_off, kThinPart * most_off};
    }
    BrickList bricks = findBricks(request.tape, request.lattice, request.bound_holds);
    const int rounds = request.most_off ? kMostLevels : kRounds;
    const std::size_t most_bricks =
        request.most_off ? request.most_bricks : std::min(request.most_bricks, 3 * bricks.bricks.size() / 2);
    SurfaceMesh mesh;
    for (int round = 0;; ++round) {
        counts = {};
        DualContouring contouring(request, std::move(bricks), counts);
        mesh = contouring.run(middle);
        std::vector<PlaceOff> off;
        if (round < rounds && contouring.complex().bricks.bricks.size() < most_bricks)
            off = placesOff(mesh, request, contouring.complex(), contouring.sharpCells(), most);
        bricks = contouring.takeBricks();
        const std::size_t all = bricks.bricks.size(), off_bricks = bricksOf(off, request.lattice, bricks);
        const bool too_many = static_cast<double>(off_bricks) > kMostOffBricks * static_cast<double>(all) ||
                              (round > 0 && all + 8 * off_bricks > most_bricks);
        if (!request.most_off && too_many) break;
        if (divideAt(off, request, most_bricks, bricks) == 0) break;
    }
    const TapeAt tape(request.tape, request.lattice, bricks);
    findMaterials(tape, mesh);
    counts.collapsed = leaveOutFlat(mesh, step);
    counts.collapsed += thinOut(mesh, tape, step, thin);
    findMaterials(tape, mesh);
    if (request.attributes) findNormals(tape, mesh);
    return mesh;
}

}  // namespace edgewise::sdf
