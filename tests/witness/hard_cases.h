// What a scene really holds, counted by brute force: a random test that never met the hard case has tested
// nothing.
#pragma once

#include <cstddef>
#include <string>

#include "analytic/screen_triangle.h"

namespace edgewise::witness {

struct HardCases {
    std::size_t triangles = 0;
    std::size_t piercing_pairs = 0;         ///< overlap, and the depth difference changes sign inside
    std::size_t depth_cycles = 0;           ///< triples i over j over k over i, each pair overlapping
    std::size_t shared_sides = 0;           ///< sides used by two triangles in opposite directions
    std::size_t t_junctions = 0;            ///< corners strictly inside another triangle's side
    std::size_t coplanar_overlaps = 0;      ///< pairs of one plane that overlap
    std::size_t near_coincident_pairs = 0;  ///< overlap, planes differ by less than 1e-5 all over the overlap
    std::size_t slivers = 0;                ///< least height below 1e-3 px
    std::size_t tiny = 0;                   ///< longest side below 1e-3 px
    std::size_t huge = 0;                   ///< longest side above 1e4 px
    std::size_t horizontal = 0, vertical = 0;
    std::size_t on_pixel_borders = 0;  ///< axis-aligned sides on a pixel's border
    std::size_t through_samples = 0;   ///< axis-aligned sides in line with the samples
    std::size_t corners_on_samples = 0;
    std::size_t largest_fan = 0;  ///< sides that end at one point, most of any
    HardCases& operator+=(const HardCases& other);
};

HardCases countHardCases(const ScreenScene& scene);
std::string toString(const HardCases& cases);

}  // namespace edgewise::witness
