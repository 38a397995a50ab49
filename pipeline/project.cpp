#include "pipeline/project.h"

#include <atomic>

#include "pipeline/clip.h"
#include "pipeline/error.h"
#include "pipeline/eye_plane.h"
#include "pipeline/facing.h"
#include "pipeline/grid_orientation.h"
#include "pipeline/huge_pages.h"
#include "pipeline/opacity.h"
#include "pipeline/runs.h"
#include "pipeline/weld.h"

namespace edgewise {
namespace {

/// The scene's distinct vertices, in eye space and on the screen.
class EyeVertices {
  public:
    EyeVertices(const Scene& scene, const glm::dmat4& camera_from_world, const ClipVolume& volume,
                const ScreenMap& map)
        : scene_(scene), first_(firstOfGeometries(scene)), table_(eyePoints(camera_from_world)) {
        outcode_.resize(table_.points().size()), p_px_.resize(table_.points().size());
        eachVertex([&](std::size_t place, const glm::dvec3& p_world) {
            const std::uint32_t id = table_.ids()[place];
            if (table_.firstPlaces()[id] != place) return;
            glm::dvec3 p = table_.points()[id];
            outcode_[id] = volume.outcode(camera_from_world, p_world, p);
            if (outcode_[id] == 0) p_px_[id] = map.toScreen(p);
        });
    }

    std::uint32_t id(std::uint32_t geometry, std::uint32_t vertex) const {
        return table_.ids()[first_[geometry] + vertex];
    }
    const glm::dvec3& eye(std::uint32_t id) const { return table_.points()[id]; }
    std::uint8_t outcode(std::uint32_t id) const { return outcode_[id]; }
    /// Where the outcode is 0.
    const glm::dvec2& px(std::uint32_t id) const { return p_px_[id]; }
    /// Of the first vertex that is there.
    const glm::dvec3& world(std::uint32_t id) const {
        const std::size_t place = table_.firstPlaces()[id];
        const auto after = std::upper_bound(first_.begin(), first_.end(), place);
        const auto geometry = static_cast<std::size_t>(after - first_.begin() - 1);
        return scene_.geometry[geometry].position_world[place - first_[geometry]];
    }
    /// Of a corner that clipping made.
    std::uint32_t idOfMade(const glm::dvec3& p_eye) { return table_.id(p_eye); }

  private:
    static std::vector<std::size_t> firstOfGeometries(const Scene& scene) {
        std::vector<std::size_t> counts;
        for (const Geometry& g : scene.geometry) counts.push_back(g.position_world.size());
        return offsetsFromCounts(counts);
    }

    /// Calls visit(place, p_world): places count through the geometries.
    template <class Visit>
    void eachVertex(const Visit& visit) const {
        for (std::size_t g = 0; g < scene_.geometry.size(); ++g) {
            const auto& p_world = scene_.geometry[g].position_world;
            forRuns(p_world.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) visit(first_[g] + i, p_world[i]);
            });
        }
    }

    ZeroedVector<glm::dvec3> eyePoints(const glm::dmat4& camera_from_world) const {
        ZeroedVector<glm::dvec3> p_eye(first_.back());
        eachVertex([&](std::size_t place, const glm::dvec3& p_world) {
            p_eye[place] = glm::dvec3(camera_from_world * glm::dvec4(p_world, 1.0));
        });
        return p_eye;
    }

    const Scene& scene_;
    std::vector<std::size_t> first_;  ///< by geometry: the place of its first vertex
    PointTable table_;
    ZeroedVector<std::uint8_t> outcode_;  ///< by id
    ZeroedVector<glm::dvec2> p_px_;       ///< by id
};

/// What becomes of a triangle.
enum class Fate : std::uint8_t {
    kGone,
    kWhole,
    kTurned,
    kClipped
};  // turned: its last two corners change places

/// What a run of triangles contributes; runs are joined in order.
struct Run {
    std::vector<ScreenTriangle> clipped;
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
          vertices_(passed(EyeVertices(scene, camera_from_world_, volume_, map_))),
          planes_(scene, camera_from_world_, map_),
          facing_(scene, camera_from_world_, map_),
          opacity_(opacityOf(scene)) {}

    ScreenScene run(ScreenPieces& pieces) {
        ScreenScene screen;
        screen.anchor_px = map_.anchorPx();
        pieces.back_facing.resize(scene_.triangle_count);
        fate_.resize(scene_.triangle_count);
        seen_.resize(groups_.planes.size());
        std::vector<Run> runs(runCount(scene_.triangle_count));
        forTriangles([&](std::size_t run, TriangleRef at, Owner owner) {
            const Fate fate = fate_[owner] = projectTriangle(at, owner, runs[run], pieces.back_facing[owner]);
            if (fate != Fate::kGone) markSeen(groups_.plane_of[owner]);
        });
        numberPlanes(screen, pieces);
        join(runs, screen, pieces);
        markSeeThrough(screen);
        return screen;
    }

  private:
    static constexpr std::size_t kParts = 4;  // of about the same length: groups, vertices, triangles twice

    static Progress& begun(Progress& progress, const Scene& scene) {
        progress.stage("project", kParts * runCount(scene.triangle_count));
        return progress;
    }

    void advance(std::size_t runs) const {
        if (progress_.cancelled()) throw Interrupted();
        progress_.advance(runs);
    }

    template <class Part>
    Part passed(Part part) const {
        advance(runCount(scene_.triangle_count));
        return part;
    }

    /// Calls visit(run, triangle, owner).
    template <class Visit>
    void forTriangles(const Visit& visit) const {
        forRuns(scene_.triangle_count, [&](std::size_t run, std::size_t begin, std::size_t end) {
            TriangleRef at = findTriangle(scene_, static_cast<std::uint32_t>(begin));
            for (std::size_t owner = begin; owner < end; ++owner, ++at.triangle) {
                while (at.triangle == scene_.geometry[at.geometry].triangles.size())
                    at = {at.geometry + 1, 0};
                visit(run, at, static_cast<Owner>(owner));
            }
            advance(1);
        });
    }

    void markSeen(std::uint32_t plane) { std::atomic_ref(seen_[plane]).store(1, std::memory_order_relaxed); }

    /// The planes of what is seen, in their order in the file.
    void numberPlanes(ScreenScene& screen, ScreenPieces& pieces) {
        const std::vector<std::size_t> before =
            countedBefore(seen_.size(), [&](std::size_t i) { return seen_[i] != 0; });
        number_.resize(seen_.size());
        ZeroedVector<FilePlane> seen(before.back());
        forRuns(seen_.size(), [&](std::size_t run, std::size_t begin, std::size_t end) {
            auto number = static_cast<std::uint32_t>(before[run]);
            for (std::size_t i = begin; i < end; ++i)
                if (seen_[i]) seen[number] = groups_.planes[i], number_[i] = number++;
        });
        planes_.fill(seen, screen.planes, pieces.plane_normal_eye);
    }

    void markSeeThrough(ScreenScene& screen) const {
        const auto through = [](Opacity o) { return o == Opacity::kSeeThrough; };
        if (std::ranges::none_of(opacity_, through)) return;
        screen.see_through.resize(opacity_.size());
        std::ranges::transform(opacity_, screen.see_through.begin(), through);
    }

    std::array<std::uint32_t, 3> corners(TriangleRef at) const {
        const auto& corner = scene_.geometry[at.geometry].triangles[at.triangle];
        return {vertices_.id(at.geometry, corner[0]), vertices_.id(at.geometry, corner[1]),
                vertices_.id(at.geometry, corner[2])};
    }

    Fate projectTriangle(TriangleRef at, Owner owner, Run& run, std::uint8_t& back_facing) const {
        const std::uint32_t plane = groups_.plane_of[owner];
        ++run.counts.triangles;
        if (!opacity_.empty() && opacity_[owner] == Opacity::kInvisible) return gone(run.counts.invisible);
        if (plane == kNone) return gone(run.counts.no_area);
        const auto id = corners(at);
        const int side = sideSeen(at.geometry, id, owner);
        if (side == 0) return gone(run.counts.no_area);
        back_facing = side < 0;
        if (back_facing && !scene_.materials[scene_.geometry[at.geometry].material].double_sided)
            return gone(run.counts.culled);
        return emitTriangle(id, owner, run);
    }

    static Fate gone(std::size_t& count) {
        ++count;
        return Fate::kGone;
    }

    /// 1: front, -1: back, 0: the plane is seen edge-on.
    int sideSeen(std::uint32_t geometry, const std::array<std::uint32_t, 3>& id, Owner owner) const {
        const int side =
            facing_.side(geometry, vertices_.eye(id[0]), vertices_.eye(id[1]), vertices_.eye(id[2]));
        if (side != 0) return side;
        const EyePlane plane = planes_.of(groups_.planes[groups_.plane_of[owner]]);
        if (!plane.depth) return 0;
        return (plane.facing < 0.0) != (groups_.reversed[owner] != 0) ? -1 : 1;
    }

    Fate emitTriangle(const std::array<std::uint32_t, 3>& id, Owner owner, Run& run) const {
        const std::array code{vertices_.outcode(id[0]), vertices_.outcode(id[1]), vertices_.outcode(id[2])};
        const auto any = static_cast<std::uint8_t>(code[0] | code[1] | code[2]);
        if ((code[0] & code[1] & code[2]) != 0) return gone(run.counts.outside);
        if (any == 0) {
            const int orientation =
                gridOrientation(vertices_.px(id[0]), vertices_.px(id[1]), vertices_.px(id[2]));
            if (orientation == 0) return gone(run.counts.vanished);
            ++run.counts.visible, ++run.counts.pieces;
            return orientation > 0 ? Fate::kWhole : Fate::kTurned;
        }
        const std::size_t before = run.clipped.size();
        if (!emitClipped(id, any, owner, run)) return gone(run.counts.outside);
        if (run.clipped.size() == before) return gone(run.counts.vanished);
        ++run.counts.visible, ++run.counts.clipped;
        run.counts.pieces += run.clipped.size() - before;
        return Fate::kClipped;
    }

    /// False if nothing is left of the triangle.
    bool emitClipped(const std::array<std::uint32_t, 3>& id, std::uint8_t codes, Owner owner,
                     Run& run) const {
        ClipPolygon polygon;
        for (const std::uint32_t i : id) polygon.push(refined(camera_from_world_, vertices_.world(i)), i);
        volume_.clip(polygon, codes);
        if (polygon.size < 3) return false;
        std::array<glm::dvec2, ClipPolygon::kCapacity> px;
        for (int i = 0; i < polygon.size; ++i) {
            if (polygon.vertex[i] != kNone) {
                px[i] = vertices_.px(polygon.vertex[i]);
                continue;
            }
            px[i] = map_.toScreen(polygon.eye[i].p);
            polygon.vertex[i] = kFirstMade + static_cast<std::uint32_t>(run.made.size());
            run.made.push_back(polygon.eye[i].p);
        }
        for (int i = 2; i < polygon.size; ++i)
            emitPiece({{px[0], px[i - 1], px[i]},
                       {polygon.vertex[0], polygon.vertex[i - 1], polygon.vertex[i]},
                       owner},
                      run.clipped);
        return true;
    }

    static void emitPiece(ScreenTriangle piece, std::vector<ScreenTriangle>& out) {
        const int orientation = gridOrientation(piece.p_px[0], piece.p_px[1], piece.p_px[2]);
        if (orientation != 0) out.push_back(orientation < 0 ? turned(piece) : piece);
    }

    static ScreenTriangle turned(ScreenTriangle piece) {
        std::swap(piece.p_px[1], piece.p_px[2]);
        std::swap(piece.vertex[1], piece.vertex[2]);
        return piece;
    }

    ScreenTriangle whole(TriangleRef at, Owner owner) const {
        const auto id = corners(at);
        const ScreenTriangle piece{
            {vertices_.px(id[0]), vertices_.px(id[1]), vertices_.px(id[2])}, id, owner, 0};
        return fate_[owner] == Fate::kTurned ? turned(piece) : piece;
    }

    void join(std::vector<Run>& runs, ScreenScene& screen, ScreenPieces& pieces) {
        std::vector<std::size_t> counts, clipped_next(runs.size());
        for (Run& run : runs) {
            numberMadeVertices(run);
            counts.push_back(run.counts.pieces);
            addCounts(run.counts, pieces.counts);
        }
        pieces.counts.planes = groups_.planes.size();
        std::vector<std::size_t> next = offsetsFromCounts(counts);
        screen.triangles.resize(next.back());
        pieces.first.resize(scene_.triangle_count + 1);
        pieces.first.back() = static_cast<std::uint32_t>(next.back());
        forTriangles([&](std::size_t run, TriangleRef at, Owner owner) {
            pieces.first[owner] = static_cast<std::uint32_t>(next[run]);
            if (fate_[owner] == Fate::kGone) return;
            const auto put = [&](ScreenTriangle piece) {
                piece.plane = number_[groups_.plane_of[owner]];
                screen.triangles[next[run]++] = piece;
            };
            if (fate_[owner] != Fate::kClipped) return put(whole(at, owner));
            const std::vector<ScreenTriangle>& clipped = runs[run].clipped;
            for (std::size_t& i = clipped_next[run]; i < clipped.size() && clipped[i].owner == owner; ++i)
                put(clipped[i]);
        });
    }

    void numberMadeVertices(Run& run) {
        std::vector<std::uint32_t> ids;
        for (const glm::dvec3& p : run.made) ids.push_back(vertices_.idOfMade(p));
        for (ScreenTriangle& piece : run.clipped)
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
        all.pieces += run.pieces;
    }

    const Scene& scene_;
    Progress& progress_;
    glm::dmat4 camera_from_world_;
    ScreenMap map_;
    ClipVolume volume_;
    CoplanarGroups groups_;
    EyeVertices vertices_;
    EyePlanes planes_;
    Facing facing_;
    std::vector<Opacity> opacity_;
    ZeroedVector<Fate> fate_;             ///< by owner
    ZeroedVector<std::uint8_t> seen_;     ///< by plane of the file: something of it is seen
    ZeroedVector<std::uint32_t> number_;  ///< by plane of the file, where it is seen: its place on the screen
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
