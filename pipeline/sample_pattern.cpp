#include "pipeline/sample_pattern.h"

#include <array>
#include <cassert>
#include <span>

#include "pipeline/screen_map.h"

namespace edgewise {
namespace {

/// Sixteenths of a pixel (Vulkan specification, Multisampling, "Standard sample locations").
struct Sixteenths {
    int x, y;
};
constexpr std::array<Sixteenths, 2> kTwo{{{12, 12}, {4, 4}}};
constexpr std::array<Sixteenths, 4> kFour{{{6, 2}, {14, 6}, {2, 10}, {10, 14}}};
constexpr std::array<Sixteenths, 8> kEight{
    {{9, 5}, {7, 11}, {13, 9}, {5, 3}, {3, 13}, {1, 7}, {11, 15}, {15, 1}}};
constexpr std::array<Sixteenths, 16> kSixteen{{{9, 9},
                                               {7, 5},
                                               {5, 10},
                                               {12, 7},
                                               {3, 6},
                                               {10, 13},
                                               {13, 11},
                                               {11, 3},
                                               {6, 14},
                                               {8, 1},
                                               {4, 2},
                                               {2, 12},
                                               {0, 8},
                                               {15, 4},
                                               {14, 15},
                                               {1, 0}}};

std::span<const Sixteenths> standardLocations(int samples) {
    switch (samples) {
        case 2:
            return kTwo;
        case 4:
            return kFour;
        case 8:
            return kEight;
        default:
            assert(samples == 16);
            return kSixteen;
    }
}

}  // namespace

double sampleOffsetPx(int a, int per_side) {
    return roundToGrid((a + 0.5) / per_side);
}

SamplePattern latticePattern(int per_side) {
    SamplePattern pattern{per_side, per_side, {}, per_side, true};
    for (int b = 0; b < per_side; ++b)
        for (int a = 0; a < per_side; ++a)
            pattern.at_px.emplace_back(sampleOffsetPx(a, per_side), sampleOffsetPx(b, per_side));
    return pattern;
}

SamplePattern standardPattern(int samples) {
    SamplePattern pattern{samples, 1, {}, 16, false};
    for (const Sixteenths& at : standardLocations(samples))
        pattern.at_px.emplace_back(at.x / 16.0, at.y / 16.0);
    return pattern;
}

}  // namespace edgewise
