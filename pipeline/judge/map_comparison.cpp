#include "pipeline/judge/map_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analytic/exact/owner_at.h"
#include "pipeline/judge/disk_centres.h"
#include "pipeline/judge/map_owners.h"

namespace edgewise::judge {
namespace {

using exact::Face;
using exact::Rational;
using exact::Region;

std::string nameOf(Owner owner) {
    return owner == kBackground ? "the background" : fmt::format("{}", owner);
}

std::vector<Wall> outlineOf(const Face& face) {
    std::vector<Wall> walls;
    for (const auto& cycle : face.cycles) {
        QuadPoint last = quadPoint(cycle.back());
        for (const exact::Point& corner : cycle) {
            const QuadPoint next = quadPoint(corner);
            walls.push_back(wallBetween(last, next, kBackground, face.owner));
            last = next;
        }
    }
    return walls;
}

FinePoint middleOf(const Chord& chord, bool turned) {
    const QuadReal x = (chord.x0 + chord.x1) / 2;
    return finePointNear(turned ? QuadPoint{chord.y, x} : QuadPoint{x, chord.y});
}

/// What chords along both axes say of a face, and what its sides say where these leave a doubt.
struct Inside {
    std::vector<FinePoint> clear;  ///< middles of disks
    bool surely_no_disk = false;
    QuadReal widest[2] = {0, 0};  ///< of all chords along x and along y
    QuadReal widest_middle = 0;
    FinePoint in_widest;
};

void lookAlong(bool turned, const std::vector<Wall>& walls, const Region& box, Inside& inside) {
    forChords(walls, box, [&](const Chord& chord) {
        if (chord.index % 2 == 0) return;
        QuadReal& widest = inside.widest[turned];
        widest = std::max(widest, chord.widest);
        const FinePoint middle = middleOf(chord, turned);
        const QuadReal length = chord.x1 - chord.x0;
        if (!turned && length > inside.widest_middle)
            inside.widest_middle = length, inside.in_widest = middle;
        const QuadPoint p = turned ? QuadPoint{quadPoint(middle).y, quadPoint(middle).x} : quadPoint(middle);
        if (length > kDiskPx && clearOf(walls, p, kDiskPx / 2)) inside.clear.push_back(middle);
    });
}

/// The middles of chords miss the disks at the wide end of a sliver.
void lookForCentre(const Face& face, const std::vector<Wall>& walls, const Region& box, Inside& inside) {
    const DiskCentres centres = diskCentres(face, box, kDiskPx / 2);
    inside.surely_no_disk = centres.corners.empty();
    if (inside.surely_no_disk || !centres.convex_face) return;
    const FinePoint p = finePointNear(quadPoint(meanOf(centres.corners)));
    if (clearOf(walls, quadPoint(p), kDiskPx / 2)) inside.clear.push_back(p);
}

Inside insideOf(const Face& face, const Region& box, double area_px2) {
    Inside inside;
    const std::vector<Wall> walls = outlineOf(face);
    lookAlong(false, walls, box, inside);
    lookAlong(true, exchanged(walls), exchanged(box), inside);
    inside.surely_no_disk = area_px2 < std::numbers::pi / 4 * kDiskPx * kDiskPx ||
                            inside.widest[0] < kDiskPx || inside.widest[1] < kDiskPx;
    if (inside.clear.empty() && !inside.surely_no_disk) lookForCentre(face, walls, box, inside);
    return inside;
}

/// Judges one map; the report grows with what is asked.
class Judge {
  public:
    Judge(const ScreenScene& scene, const VisibleMap& map, const Region& box, MapReport& report)
        : scene_(scene), owners_(map), box_(box), report_(report) {}

    void face(std::size_t index, const Face& face, double area_px2) {
        const Inside inside = insideOf(face, box_, area_px2);
        ++report_.faces;
        report_.tied_faces += face.tied.size() > 1;
        if (inside.clear.empty()) return smallFace(index, face, inside, area_px2);
        ++report_.faces_with_disk;
        for (const FinePoint& p : inside.clear) ask(p, owners_.at(p), face.owner);
    }

    /// The map's own pieces along one axis; segments along that axis are seen along the other alone.
    void pieces(bool turned) {
        const std::vector<Wall> walls = turned ? exchanged(owners_.walls()) : owners_.walls();
        forChords(walls, turned ? exchanged(box_) : box_, [&](const Chord& chord) {
            if (chord.x1 - chord.x0 <= kDiskPx) return;
            const FinePoint p = middleOf(chord, turned);
            if (!clearOf(owners_.walls(), quadPoint(p), kDiskPx / 2)) return;
            const std::optional<Owner> shown = owners_.at(p);
            const bool sure = shown && owners_.confirmed(p, *shown, turned, kDiskPx);
            ask(p, sure ? shown : std::nullopt, exact::ownerAt(scene_, exactPoint(p)));
        });
    }

    void areas(std::map<Owner, Rational> truth) {
        for (const auto& [owner, area] : owners_.areas(box_)) truth[owner] -= area;
        for (const auto& [owner, off] : truth)
            report_.max_area_error_px2 =
                std::max(report_.max_area_error_px2, std::abs(static_cast<double>(off)));
    }

  private:
    void ask(const FinePoint& p, std::optional<Owner> shown, Owner expected) {
        ++report_.points;
        if (shown == expected) return;
        if (report_.ownership_errors++ > 0) return;
        report_.first =
            fmt::format("at ({:.17g} + {:g}, {:.17g} + {:g}): {} instead of {}", p.grid.x, p.rest.x, p.grid.y,
                        p.rest.y, shown ? nameOf(*shown) : "no clear owner", nameOf(expected));
    }

    void smallFace(std::size_t index, const Face& face, const Inside& inside, double area_px2) {
        ++report_.small_faces;
        report_.small_area_px2 += area_px2;
        report_.unsure_faces += !inside.surely_no_disk;
        if (inside.widest_middle > 0 && owners_.at(inside.in_widest) == face.owner) return;
        report_.small_wrong.push_back(index);
        report_.small_wrong_area_px2 += area_px2;
    }

    const ScreenScene& scene_;
    MapOwners owners_;
    Region box_;
    MapReport& report_;
};

}  // namespace

void MapReport::add(const MapReport& o) {
    maps += o.maps, faces += o.faces, tied_faces += o.tied_faces, faces_with_disk += o.faces_with_disk;
    small_faces += o.small_faces, unsure_faces += o.unsure_faces, small_area_px2 += o.small_area_px2;
    small_wrong.insert(small_wrong.end(), o.small_wrong.begin(), o.small_wrong.end());
    small_wrong_area_px2 += o.small_wrong_area_px2;
    points += o.points;
    if (ownership_errors == 0) first = o.first;
    ownership_errors += o.ownership_errors;
    max_area_error_px2 = std::max(max_area_error_px2, o.max_area_error_px2);
    area_bound_px2 = std::max(area_bound_px2, o.area_bound_px2);
    max_area_share = std::max(max_area_share, o.max_area_share);
}

MapReport compareMaps(const ScreenScene& scene, const std::vector<Face>& faces, const VisibleMap& map,
                      const Region& region) {
    const exact::Box box{{Rational(region.x0), Rational(region.y0)},
                         {Rational(region.x1), Rational(region.y1)}};
    Rational rest = (box.high.x - box.low.x) * (box.high.y - box.low.y);
    MapReport report;
    report.maps = 1;
    const double box_px2 = static_cast<double>(rest);
    report.area_bound_px2 = kAreaShare * box_px2;
    Judge judge(scene, map, region, report);
    std::map<Owner, Rational> truth;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const Rational area = areaWithin(faces[i], box);
        if (area == 0) continue;
        truth[faces[i].owner] += area, rest -= area;
        judge.face(i, faces[i], static_cast<double>(area));
    }
    truth[kBackground] = rest;
    for (const bool turned : {false, true}) judge.pieces(turned);
    judge.areas(truth);
    report.max_area_share = report.max_area_error_px2 / box_px2;
    return report;
}

}  // namespace edgewise::judge
