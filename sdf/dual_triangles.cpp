#include "sdf/dual_triangles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

#include "sdf/dual_envelope.h"
#include "sdf/dual_placement.h"
#include "sdf/evaluate.h"
#include "sdf/mesh_embedding.h"

namespace edgewise::sdf {
namespace {

/// Of the distance between two crossings of one line: how far their middle goes off it.
constexpr double kBulge = 0.1;
constexpr int kMostMendings = 20;

/// A vertex is at its target, or, to keep the mesh from meeting itself, moved towards its loop's middle.
enum Care : std::uint8_t { kFree, kInCell, kHalfway, kMiddle, kDivided };

class Triangulation {
  public:
    Triangulation(const Lattice& lattice, const TapeAt& tape, DualComplex& complex, std::uint64_t& mended)
        : lattice_(lattice),
          tape_(tape),
          complex_(complex),
          placement_(lattice, tape, complex),
          mended_(mended),
          care_(complex.vertices.size(), kFree),
          diagonal_(complex.polygons.size(), 0xff),
          divided_(complex.polygons.size(), false),
          turned_(complex.polygons.size(), false),
          middles_(complex.polygons.size(), {kNoVertex, kNoVertex, kNoVertex, kNoVertex}) {
        mesh_.position_world = placeVertices(lattice, tape, complex);
    }

    SurfaceMesh run() {
        partTwins();
        for (int round = 0;; ++round) {
            triangulate();
            if (round == kMostMendings || !(partDiagonals() || mend())) return std::move(mesh_);
        }
    }

  private:
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
                add(p, centre, a, b, !plain || !throughFace(lattice_, mesh_.position_world, polygon, k));
            else
                add(p, centre, a, m, !plain), add(p, centre, m, b, !plain);
        }
    }

    /// All vertices in cells of one loop, and there, and none of another size.
    bool plainCells(const DualPolygon& polygon) const {
        if (polygon.mixed) return false;
        for (const std::uint32_t v : polygon.vertex) {
            const DualVertex& vertex = complex_.vertices[v];
            if (vertex.loops > 1 || !placement_.inOwnCell(vertex, mesh_.position_world[v])) return false;
        }
        return true;
    }

    double offAlong(const DualPolygon& polygon, int d) const {
        const glm::dvec3 middle =
            0.5 * (mesh_.position_world[polygon.vertex[d]] + mesh_.position_world[polygon.vertex[d + 2]]);
        return std::abs(valueAt(tape_(middle), middle));
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
        bool doubt = !plainCells(polygon) || !aroundEdge(lattice_, mesh_.position_world, polygon, d);
        for (int k = 0; k < 4 && !doubt; ++k)
            doubt |= !throughFace(lattice_, mesh_.position_world, polygon, k);
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
        mended_ += polygons.size();
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
            if (plainCells(polygon) && aroundEdge(lattice_, mesh_.position_world, polygon, other) &&
                !aroundEdge(lattice_, mesh_.position_world, polygon, 1 - other)) {
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
        if (care_[v] == kInCell && placement_.inOwnCell(vertex, place)) care_[v] = kHalfway;
        if (care_[v] == kInCell) place = placement_.heldOnSurface(vertex);
        if (care_[v] == kHalfway)
            place = 0.5 * (placement_.heldInCell(vertex, vertex.target_world) + vertex.middle_world);
        if (care_[v] >= kMiddle) place = vertex.middle_world;
    }

    const Lattice& lattice_;
    const TapeAt& tape_;
    const DualComplex& complex_;
    const DualPlacement placement_;
    std::uint64_t& mended_;
    SurfaceMesh mesh_;
    std::vector<std::uint8_t> care_, diagonal_;
    std::vector<bool> divided_, turned_, doubtful_;
    std::vector<std::array<std::uint32_t, 4>> middles_;
    std::map<std::uint32_t, std::uint32_t> hub_;  ///< of divided polygons
    std::vector<std::uint32_t> owner_;            ///< a triangle's polygon
};

}  // namespace

SurfaceMesh dualTriangles(const Lattice& lattice, const TapeAt& tape, DualComplex& complex,
                          std::uint64_t& mended) {
    return Triangulation(lattice, tape, complex, mended).run();
}

}  // namespace edgewise::sdf
