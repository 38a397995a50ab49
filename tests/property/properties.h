// What holds of every picture, whatever the scene.
#pragma once

#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "analytic/prefilter.h"
#include "tests/property/random_world.h"

namespace edgewise::property {

/// One question: a scene, the pixels to look at, the kernel, and the seed of what the property picks at
/// random.
struct Trial {
    WorldScene scene;
    PixelBox box;
    Prefilter filter;
    std::uint64_t seed;
};

struct Violation {
    std::string what;
    glm::ivec2 pixel;
    std::string filter = {};  ///< empty: the trial's
};

/// Not asked: the scene gave no occasion, such as a split that float32 cannot hold.
struct Outcome {
    bool asked = true;
    std::optional<Violation> wrong;
};

struct Property {
    std::string name;
    Outcome (*check)(const Trial&);
    int slowness = 1;  ///< scenes of others in the time of one of this one's
};

inline void PrintTo(const Property& property, std::ostream* out) {
    *out << property.name;
}

/// The box kernel's weights in all pixels are the oracle's rationals, within the bound of the docstrings.
Outcome ownersAreTheOracles(const Trial& trial);
/// The trial's kernel's weights of a few pixels are the oracle's 30 digits, within the same bound.
Outcome weightsAreTheOracles(const Trial& trial);
/// Weights sum to exactly 2^60, labels chain along the border, and positive kernels give no weight below 0 by
/// more than roundings.
Outcome weightsSumToOne(const Trial& trial);
/// Moved by whole cells the picture has the same bits; by whole pixels it is the same but for roundings, for
/// other cells may name another owner along a few roundings of their border. [E16]
Outcome wholePixelsDoNotShow(const Trial& trial);
/// A triangle cut in two at the middle of a side keeps its weights but for roundings.
Outcome splittingATriangleDoesNotShow(const Trial& trial);
/// Triangles in another order, those of equal planes but for that, keep their weights but for roundings.
Outcome orderDoesNotShow(const Trial& trial);
/// Double-sided triangles wound the other way give the same bits.
Outcome windingDoesNotShow(const Trial& trial);
/// Other threads and crops give the same bits.
Outcome threadsAndCropsDoNotShow(const Trial& trial);
/// Triangles of one node that are coplanar in the file, by rational arithmetic, share one depth plane.
Outcome coplanarTrianglesShareAPlane(const Trial& trial);
/// The depth plane of a triangle has its corners' depths, but for the rounding of its three coefficients.
Outcome planesPassThroughTheirCorners(const Trial& trial);
/// What the planner leaves out changes weights by roundings only.
Outcome omissionsDoNotShow(const Trial& trial);

const std::vector<Property>& allProperties();

}  // namespace edgewise::property
