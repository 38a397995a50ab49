#include <algorithm>

#include "sdf/dual_cells.h"
#include "sdf/dual_debris.h"
#include "sdf/dual_triangles.h"
#include "sdf/mesh_attributes.h"
#include "sdf/mesh_check.h"
#include "sdf/mesh_refine.h"
#include "sdf/mesh_simplify.h"
#include "sdf/polygonize.h"

namespace edgewise::sdf {
namespace {

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
constexpr double kMiddlePart = 0.5, kOffPart = 0.75, kThinPart = 0.6, kSharpThinPart = 0.4;

SharpCells sharpCells(const Lattice& lattice, const DualComplex& complex) {
    SharpCells sharp(lattice, complex.bricks);
    for (const DualVertex& v : complex.vertices)
        if (v.rank > 1) sharp.addAround(v.cell.low, v.cell.side);
    return sharp;
}

std::size_t bricksOf(const std::vector<PlaceOff>& places, const Lattice& lattice, const BrickList& bricks) {
    std::vector<std::uint32_t> found;
    for (const PlaceOff& off : places)
        found.push_back(bricks.leafAt(lattice, lattice.unitAt(off.place_world)).brick);
    std::sort(found.begin(), found.end());
    return static_cast<std::size_t>(std::unique(found.begin(), found.end()) - found.begin());
}

struct Limits {
    MeshLimits middle, most, thin;
};
Limits limitsOf(const MeshRequest& request) {
    const double step = request.lattice.step;
    if (!request.most_off)
        return {{kSharpMiddle * step, kSmoothMiddle * step},
                {kSharpOff * step, kSmoothOff * step},
                {kSharpThin * step, kSmoothThin * step}};
    const auto part = [&](double of) { return MeshLimits{of, of, &*request.most_off}; };
    return {part(kMiddlePart), part(kOffPart), {kSharpThinPart, kThinPart, &*request.most_off}};
}

class DualContouring {
  public:
    DualContouring(const MeshRequest& request, MeshCounts& counts)
        : request_(request),
          tape_(request.tape, request.lattice, request.bound_holds),
          limits_(limitsOf(request)),
          counts_(counts),
          bricks_(findBricks(request.tape, request.lattice, request.bound_holds)),
          rounds_(request.most_off ? kMostLevels : kRounds),
          most_bricks_(request.most_off ? request.most_bricks
                                        : std::min(request.most_bricks, 3 * bricks_.bricks.size() / 2)) {}

    SurfaceMesh run() {
        int round = 0;
        do counts_ = {};
        while (meshBricks(round) && divideBricks(round++));
        simplify();
        return std::move(mesh_);
    }

  private:
    /// False: it is as near as it can be.
    bool meshBricks(int round) {
        DualComplex complex = dualComplex(request_, tape_, std::move(bricks_));
        counts_.turned = complex.turned;
        counts_.debris = leaveOutDebris(request_, tape_, complex);
        counts_.nodes = complex.bricks.nodes, counts_.pruned = complex.bricks.pruned;
        counts_.bricks = complex.bricks.bricks.size(), counts_.cells = complex.cells;
        mesh_ = dualTriangles(request_.lattice, tape_, complex, counts_.mended);
        const SharpCells sharp = sharpCells(request_.lattice, complex);
        off_.clear();
        const bool may_divide = round < rounds_ && complex.bricks.bricks.size() < most_bricks_;
        std::vector<glm::dvec3> left;
        counts_.added = refineMesh(mesh_, tape_, request_.lattice.step, sharp, limits_.middle,
                                   request_.most_off && may_divide ? &left : nullptr);
        if (may_divide) off_ = placesOff(mesh_, request_, tape_, complex, sharp, limits_.most);
        for (const glm::dvec3& p : left)
            off_.push_back(
                {p, complex.bricks.leafAt(request_.lattice, request_.lattice.unitAt(p)).level, 1, 1.0});
        bricks_ = std::move(complex.bricks);
        return !off_.empty();
    }
    bool divideBricks(int round) {
        if (request_.most_off && round > 0) {
            const double needed = bricksNeeded(off_, request_, bricks_);
            if (needed > static_cast<double>(most_bricks_)) {
                counts_.bricks_needed = needed;
                return false;
            }
        }
        const std::size_t all = bricks_.bricks.size(), off = bricksOf(off_, request_.lattice, bricks_);
        const bool too_many = static_cast<double>(off) > kMostOffBricks * static_cast<double>(all) ||
                              (round > 0 && all + 8 * off > most_bricks_);
        return (request_.most_off || !too_many) && divideAt(off_, request_, most_bricks_, bricks_) > 0;
    }
    void simplify() {
        const double step = request_.lattice.step;
        findMaterials(tape_, mesh_);
        counts_.collapsed = leaveOutFlat(mesh_, step);
        counts_.collapsed += thinOut(mesh_, tape_, step, limits_.thin);
        findMaterials(tape_, mesh_);
        if (request_.attributes) findNormals(tape_, mesh_);
    }

    const MeshRequest& request_;
    const TapeAt tape_;
    const Limits limits_;
    MeshCounts& counts_;
    BrickList bricks_;
    const int rounds_;
    const std::size_t most_bricks_;
    SurfaceMesh mesh_;
    std::vector<PlaceOff> off_;
};

}  // namespace

SurfaceMesh dualContouring(const MeshRequest& request, MeshCounts& counts) {
    return DualContouring(request, counts).run();
}

}  // namespace edgewise::sdf
