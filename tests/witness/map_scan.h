// Reads a visible map along one line and holds it against the judge's own scanline.
#pragma once

#include <string>
#include <vector>

#include "analytic/visible_segment.h"
#include "tests/witness/local_scene.h"

namespace edgewise::witness {

enum class Axes {
    kAsTheyAre,
    kExchanged
};  ///< exchanged: scan along y, so that horizontal segments count too

/// Where a scanline meets a segment of the map.
struct MapCrossing {
    Real u;
    Real slope;  ///< du/dv of the segment
    Owner left, right;
};

struct ScanVerdict {
    std::size_t scanlines = 0, crossings = 0;
    std::size_t broken = 0;         ///< places where the labels do not leave exactly one owner
    std::size_t disagreements = 0;  ///< intervals of another owner, longer than rounding explains
    Real widest_px = 0;             ///< the longest of these
    Real wrong_px2 = 0;  ///< what they come to: length times the height of the band that the line stands for
    Real worst_offset_px =
        0;              ///< the largest disagreement of all, measured across the steepest boundary beside it
    std::string first;  ///< the first thing wrong, in words
    void add(const ScanVerdict& other);
    bool good() const { return broken == 0 && disagreements == 0; }
};

class MapScan {
  public:
    /// The map around `sample_px`; the map's window must reach `radius` px around it.
    MapScan(const VisibleMap& map, glm::dvec2 sample_px, Axes axes);

    /// All crossings of the line v, by ascending u.
    std::vector<MapCrossing> cross(Real v) const;

    /// Compares the owners on the line v, |u| < radius. `scene` has the same axes as this scan.
    /// The line stands for a band `height` px high.
    void compare(const LocalScene& scene, Real v, Real height, Real radius, ScanVerdict& verdict) const;

  private:
    struct Wall {
        Real u_lo, v_lo, u_hi, v_hi;  ///< v_lo < v_hi
        Owner left, right;            ///< by u
    };
    bool exchanged_;
    std::vector<Wall> walls_;
};

/// `random_lines` scanlines at random and one between each two events, along x and along y.
ScanVerdict compareMap(const ScreenScene& scene, const VisibleMap& map, glm::dvec2 sample_px, Real radius,
                       std::uint64_t seed, int random_lines);

}  // namespace edgewise::witness
