#include "pipeline/project.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "pipeline/clip.h"
#include "pipeline/error.h"
#include "pipeline/eye_plane.h"
#include "pipeline/grid_orientation.h"
#include "pipeline/opacity.h"
#include "pipeline/weld.h"

namespace edgewise {
namespace {

template <class Body>
void parallelFor(std::size_t count, const Body& body) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 2048), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
    });
}

/// The scene's distinct vertices, in eye space and on the screen.
struct EyeVertices {
    PointTable table;
    std::vector<std::size_t> first;  ///< by geometry, into ids
    std::vector<std::uint32_t> ids;
    std::vector<const glm::dvec3*> p_world;  ///< by id; of the first that is there
    std::vector<std::uint8_t> outcode;       ///< by id
    std::vector<glm::dvec2> p_px;            ///< by id; where the outcode is 0
};

EyeVertices weldVertices(const Scene& scene, const glm::dmat4& camera_from_world) {
    std::vector<std::size_t> first{0};
    for (const Geometry& g : scene.geometry) first.push_back(first.back() + g.position_world.size());
    std::vector<glm::dvec3> p_eye(first.back());
    for (std::size_t g = 0; g < scene.geometry.size(); ++g) {
        const auto& p_world = scene.geometry[g].position_world;
        parallelFor(p_world.size(), [&](std::size_t i) {
            p_eye[first[g] + i] = glm::dvec3(camera_from_world * glm::dvec4(p_world[i], 1.0));
        });
    }
    EyeVertices vertices{PointTable(p_eye.size()), std::move(first), {}, {}, {}, {}};
    vertices.ids.reserve(p_eye.size());
    std::size_t next = 0;
    for (const Geometry& g : scene.geometry)
        for (const glm::dvec3& p_world : g.position_world) {
            vertices.ids.push_back(vertices.table.id(p_eye[next++]));
            if (vertices.ids.back() == vertices.p_world.size()) vertices.p_world.push_back(&p_world);
        }
    return vertices;
}

void placeVertices(const ClipVolume& volume, const ScreenMap& map, const glm::dmat4& camera_from_world,
                   EyeVertices& vertices) {
    const auto& p_eye = vertices.table.points();
    vertices.outcode.resize(p_eye.size());
    vertices.p_px.resize(p_eye.size());
    parallelFor(p_eye.size(), [&](std::size_t i) {
        glm::dvec3 p = p_eye[i];
        vertices.outcode[i] = volume.outcode(camera_from_world, *vertices.p_world[i], p);
        if (vertices.outcode[i] == 0) vertices.p_px[i] = map.toScreen(p);
    });
}

/// What a run of triangles contributes; runs are joined in order.
struct Run {
    std::vector<ScreenTriangle> pieces;
    /// Corners that clipping made, in eye space; a piece refers to number i as kFirstMade + i until the runs
    /// are joined.
    std::vector<glm::dvec3> made;
    ProjectionCounts counts;
};

constexpr std::uint32_t kFirstMade = 0x80000000u;

class Projector {
  public:
    Projector(const Scene& scene, const ResolvedCamera& camera, const Film& film, Progress& progress)
        : scene_(scene),
          progress_(begun(progress, scene)),
          camera_from_world_(camera.camera_from_world),
          map_(makeScreenMap(camera, film)),
          volume_(camera.camera, map_),
          groups_(passed(findCoplanar(scene))),
          planes_(passed(makeEyePlanes(scene, groups_, camera.camera_from_world))),
          vertices_(passed(weldVertices(scene, camera.camera_from_world))),
          opacity_(opacityOf(scene)) {
        placeVertices(volume_, map_, camera_from_world_, vertices_);
    }

    ScreenScene run(ScreenPieces& pieces) {
        ScreenScene screen;
        makeDepth(screen, pieces);
        pieces.back_facing.assign(scene_.triangle_count, 0);
        std::vector<Run> runs(runCount(scene_));
        tbb::parallel_for(std::size_t(0), runs.size(), [&](std::size_t i) {
            projectRun(i, runs[i], pieces);
            advance(1);
        });
        join(runs, screen, pieces);
        markSeeThrough(screen);
        return screen;
    }

  private:
    static constexpr std::size_t kRunLength = 4096;
    static constexpr std::size_t kParts = 4;  // of about the same length: planes twice, vertices, triangles

    static std::size_t runCount(const Scene& scene) {
        return (scene.triangle_count + kRunLength - 1) / kRunLength;
    }

    static Progress& begun(Progress& progress, const Scene& scene) {
        progress.stage("project", kParts * runCount(scene));
        return progress;
    }

    void advance(std::size_t runs) const {
        if (progress_.cancelled()) throw Interrupted();
        progress_.advance(runs);
    }

    template <class Part>
    Part passed(Part part) const {
        advance(runCount(scene_));
        return part;
    }

    void makeDepth(ScreenScene& screen, ScreenPieces& pieces) {
        screen.anchor_px = map_.anchorPx();
        screen.planes.resize(planes_.size());
        edge_on_.assign(planes_.size(), 0);
        pieces.plane_normal_eye.resize(planes_.size());
        parallelFor(planes_.size(), [&](std::size_t i) {
            const auto depth = depthPlane(planes_[i], map_);
            if (depth) screen.planes[i] = *depth;
            edge_on_[i] = !depth;
            pieces.plane_normal_eye[i] = planes_[i].unitNormal(map_.perspective);
        });
    }

    void markSeeThrough(ScreenScene& screen) const {
        const auto through = [](Opacity o) { return o == Opacity::kSeeThrough; };
        if (std::ranges::none_of(opacity_, through)) return;
        screen.see_through.resize(opacity_.size());
        std::ranges::transform(opacity_, screen.see_through.begin(), through);
    }

    void projectRun(std::size_t number, Run& run, ScreenPieces& pieces) const {
        const std::size_t end = std::min((number + 1) * kRunLength, scene_.triangle_count);
        TriangleRef at = findTriangle(scene_, static_cast<std::uint32_t>(number * kRunLength));
        for (std::size_t owner = number * kRunLength; owner < end; ++owner, ++at.triangle) {
            while (at.triangle == scene_.geometry[at.geometry].triangles.size()) at = {at.geometry + 1, 0};
            projectTriangle(at, static_cast<Owner>(owner), run, pieces.back_facing[owner]);
        }
    }

    void projectTriangle(TriangleRef at, Owner owner, Run& run, std::uint8_t& back_facing) const {
        const Geometry& geometry = scene_.geometry[at.geometry];
        const std::uint32_t plane = groups_.plane_of[owner];
        ++run.counts.triangles;
        if (!opacity_.empty() && opacity_[owner] == Opacity::kInvisible) return void(++run.counts.invisible);
        if (plane == kNone || edge_on_[plane]) return void(++run.counts.no_area);
        back_facing = (planes_[plane].facing(map_.perspective) < 0.0) != (groups_.reversed[owner] != 0);
        if (back_facing && !scene_.materials[geometry.material].double_sided)
            return void(++run.counts.culled);
        std::array<std::uint32_t, 3> id;
        for (int k = 0; k < 3; ++k)
            id[k] = vertices_.ids[vertices_.first[at.geometry] + geometry.triangles[at.triangle][k]];
        emitTriangle(id, owner, plane, run);
    }

    void emitTriangle(const std::array<std::uint32_t, 3>& id, Owner owner, std::uint32_t plane,
                      Run& run) const {
        const auto& code = vertices_.outcode;
        const auto& px = vertices_.p_px;
        const std::uint8_t all = code[id[0]] & code[id[1]] & code[id[2]];
        const std::uint8_t any = code[id[0]] | code[id[1]] | code[id[2]];
        if (all != 0) return void(++run.counts.outside);
        const std::size_t before = run.pieces.size();
        if (any == 0)
            emitPiece({{px[id[0]], px[id[1]], px[id[2]]}, id, owner, plane}, run);
        else if (!emitClipped(id, any, owner, plane, run))
            return void(++run.counts.outside);
        const bool visible = run.pieces.size() > before;
        ++(visible ? run.counts.visible : run.counts.vanished);
        if (visible && any != 0) ++run.counts.clipped;
    }

    /// False if nothing is left of the triangle.
    bool emitClipped(const std::array<std::uint32_t, 3>& id, std::uint8_t codes, Owner owner,
                     std::uint32_t plane, Run& run) const {
        ClipPolygon polygon;
        for (const std::uint32_t i : id) polygon.push(refined(camera_from_world_, *vertices_.p_world[i]), i);
        volume_.clip(polygon, codes);
        if (polygon.size < 3) return false;
        std::array<glm::dvec2, ClipPolygon::kCapacity> px;
        for (int i = 0; i < polygon.size; ++i) {
            if (polygon.vertex[i] != kNone) {
                px[i] = vertices_.p_px[polygon.vertex[i]];
                continue;
            }
            px[i] = map_.toScreen(polygon.eye[i].p);
            polygon.vertex[i] = kFirstMade + static_cast<std::uint32_t>(run.made.size());
            run.made.push_back(polygon.eye[i].p);
        }
        for (int i = 2; i < polygon.size; ++i)
            emitPiece({{px[0], px[i - 1], px[i]},
                       {polygon.vertex[0], polygon.vertex[i - 1], polygon.vertex[i]},
                       owner,
                       plane},
                      run);
        return true;
    }

    static void emitPiece(ScreenTriangle piece, Run& run) {
        const int orientation = gridOrientation(piece.p_px[0], piece.p_px[1], piece.p_px[2]);
        if (orientation == 0) return;
        if (orientation < 0) {
            std::swap(piece.p_px[1], piece.p_px[2]);
            std::swap(piece.vertex[1], piece.vertex[2]);
        }
        run.pieces.push_back(piece);
    }

    void join(std::vector<Run>& runs, ScreenScene& screen, ScreenPieces& pieces) {
        std::size_t total = 0;
        for (const Run& run : runs) total += run.pieces.size();
        screen.triangles.reserve(total);
        for (Run& run : runs) {
            numberMadeVertices(run);
            screen.triangles.insert(screen.triangles.end(), run.pieces.begin(), run.pieces.end());
            addCounts(run.counts, pieces.counts);
        }
        pieces.counts.pieces = total;
        pieces.counts.planes = planes_.size();
        pieces.first.assign(scene_.triangle_count + 1, 0);
        for (const ScreenTriangle& piece : screen.triangles) ++pieces.first[piece.owner + 1];
        for (std::size_t i = 0; i < scene_.triangle_count; ++i) pieces.first[i + 1] += pieces.first[i];
    }

    void numberMadeVertices(Run& run) {
        std::vector<std::uint32_t> ids;
        for (const glm::dvec3& p : run.made) ids.push_back(vertices_.table.id(p));
        for (ScreenTriangle& piece : run.pieces)
            for (std::uint32_t& id : piece.vertex)
                if (id >= kFirstMade) id = ids[id - kFirstMade];
    }

    static void addCounts(const ProjectionCounts& run, ProjectionCounts& all) {
        all.triangles += run.triangles;
        all.no_area += run.no_area;
        all.culled += run.culled;
        all.invisible += run.invisible;
        all.outside += run.outside;
        all.vanished += run.vanished;
        all.visible += run.visible;
        all.clipped += run.clipped;
    }

    const Scene& scene_;
    Progress& progress_;
    glm::dmat4 camera_from_world_;
    ScreenMap map_;
    ClipVolume volume_;
    CoplanarGroups groups_;
    std::vector<EyePlane> planes_;
    EyeVertices vertices_;
    std::vector<std::uint8_t> edge_on_;
    std::vector<Opacity> opacity_;
};

}  // namespace

ScreenScene project(const Scene& scene, const ResolvedCamera& camera, const Film& film, ScreenPieces& pieces,
                    Progress& progress) {
    pieces = {};
    return Projector(scene, camera, film, progress).run(pieces);
}

ScreenScene project(const Scene& scene, const ResolvedCamera& camera, const Film& film,
                    ScreenPieces& pieces) {
    Progress silent;
    return project(scene, camera, film, pieces, silent);
}

ScreenScene project(const Scene& scene, const ResolvedCamera& camera, const Film& film) {
    ScreenPieces pieces;
    return project(scene, camera, film, pieces);
}

}  // namespace edgewise
