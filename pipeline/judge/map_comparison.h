// The product's visible map against the oracle's: owners face by face, and areas.
#pragma once

#include <string>
#include <vector>

#include "analytic/exact/visible_faces.h"
#include "analytic/visible_segment.h"

namespace edgewise::judge {

/// A face that contains a disk of this diameter has to have the right owner.
inline constexpr double kDiskPx = 0x1p-30;
/// No owner's area may be off by more than this share of the box.
inline constexpr double kAreaShare = 1e-13;

struct MapReport {
    std::size_t maps = 0;                  ///< compared
    std::size_t faces = 0;                 ///< of the oracle, in the box; the background is none
    std::size_t tied_faces = 0;            ///< of several surfaces
    std::size_t faces_with_disk = 0;       ///< a disk of kDiskPx was found in them
    std::size_t small_faces = 0;           ///< none was found
    std::size_t unsure_faces = 0;          ///< those of the small ones that are not proven to have none
    double small_area_px2 = 0.0;           ///< of the small ones
    std::vector<std::size_t> small_wrong;  ///< small ones whose widest place the map gives to another owner
    double small_wrong_area_px2 = 0.0;
    std::size_t points = 0;  ///< asked: the middles of disks in the oracle's faces and in the map's pieces
    std::size_t ownership_errors = 0;  ///< points whose owners differ
    double max_area_error_px2 = 0.0;   ///< of an owner, the background included
    double area_bound_px2 = 0.0;       ///< kAreaShare of the box
    double max_area_share = 0.0;       ///< the error as a share of its box
    std::string first;                 ///< the first ownership error in words

    void add(const MapReport& other);
    bool good() const { return ownership_errors == 0 && max_area_share <= kAreaShare; }
};

/// `faces` are visibleFaces() of the opaque scene over the box or more. The map's window holds the box and
/// more at each side: a map ends a little inside its window.
///
/// Every face is cut into trapezoids along both axes. The middle of each trapezoid that no side of the face
/// approaches by kDiskPx / 2 is asked of the map. Where there is none, and area and chords leave room for a
/// disk, its middle is sought in exact arithmetic (diskCentres): found in a convex face wherever one is, but
/// for one that fits within the rounding. The other way round the map's pieces are cut, and their
/// middles are asked of the scene, by exact::ownerAt(): so the background is judged, and any other owner that
/// the map shows over a disk. Walls are held to 2^-86 px, far below the disk.
MapReport compareMaps(const ScreenScene& scene, const std::vector<exact::Face>& faces, const VisibleMap& map,
                      const exact::Region& box);

}  // namespace edgewise::judge
