// Numbers of nodes that lowering and boxes share.
#pragma once

#include <array>
#include <limits>

#include "sdf/tree.h"

namespace edgewise::sdf {

/// The rows of the inverse of a rotation node's matrix (Rodrigues), from {axis, degrees}.
using RotationRows = std::array<double, 9>;
RotationRows rotationRows(const std::vector<double>& numbers);

/// The largest singular value of x -> R(rate y) x within `radius` of the axis: a shear by s = rate radius
/// after a rotation has (s + sqrt(s^2 + 4)) / 2.
double twistBound(double degrees_per_unit, double radius);

/// The given radius, or the farthest corner of the child's box from the y axis. Throws SceneError for a child
/// without bounds there.
double twistRadius(const Tree& tree, const Node& twist);
double twistRadius(const Node& twist, const Box& child);

/// 1 + |amplitude| * the largest frequency: by what a displacement's values are divided, for a child of
/// bound 1.
double displacementBound(const std::vector<double>& numbers);

/// A repetition's cells. Axes without copies have spacing 1 and count 0.
struct Repetition {
    std::array<double, 3> spacing{1.0, 1.0, 1.0}, count{},
        margin{};  ///< margin: of the child's box from the walls
    double least_margin = std::numeric_limits<double>::infinity();
    Box box{};           ///< of the child
    bool walls = false;  ///< the child is not even: the next cell's copy may be the nearer one
};
/// Throws SceneError for a child that reaches beyond its cell.
Repetition repetitionOf(const Tree& tree, const Node& repeat);
Repetition repetitionOf(const Tree& tree, const Node& repeat, const Box& child);

}  // namespace edgewise::sdf
