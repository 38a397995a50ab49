// SDF scenes that are made by numbers: many random parts, and widths in pixels. As the text of a .sdf.json.
#pragma once

#include <cstdint>
#include <string>

namespace edgewise::scenes {

/// So many boxes, turned at random, in a layer over the ground; they may pierce each other.
std::string makeRandomBoxes(std::uint32_t count);
/// Boxes, balls, tori, capsules, cylinders, cones, octahedra, prisms likewise.
std::string makeRandomShapes(std::uint32_t count);
/// Few shapes, far apart, over a wide ground.
std::string makeSparseShapes();

/// Balls within a larger one, united smoothly from left to right.
std::string makeSmoothSpheres(std::uint32_t count);

/// White wires on black, unlit, in the plane z = 0, facing the camera: there a pixel is 2 * 10 tan(20 deg) /
/// 720 wide. Widths are a geometric sequence from 0.05 to 1 px: of slanted wires on the left, of a fan on the
/// right, of rings below.
std::string makeWires();

}  // namespace edgewise::scenes
