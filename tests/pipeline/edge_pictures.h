// Small pictures of solids that end in a straight edge, with each pixel's coverage in closed form.
#pragma once

#include <cmath>
#include <functional>

#include "tests/pipeline/field_pictures.h"

namespace edgewise::test {

inline constexpr int kSide = 24;
inline constexpr double kHardX = 0.5 / 64.0;  ///< a ray of ctss-x has hit where the distance is below

/// A line through the picture: a solid lies where at(q) < 0; q in pixels, y down.
struct Edge {
    glm::dvec2 n;
    double c = 0.0;
    double at(const glm::dvec2& q) const { return glm::dot(n, q) + c; }
};
inline Edge edgeAt(double degrees, double offset) {
    const double angle = glm::radians(degrees);
    const glm::dvec2 n(std::cos(angle), std::sin(angle));
    return {n, offset - glm::dot(n, glm::dvec2(0.5 * kSide))};
}

/// Of a pixel, the part within the edge: the corners' triangles by inclusion and exclusion.
inline double boxShare(const glm::dvec2& n, double at_centre) {
    const double a = std::abs(n.x), b = std::abs(n.y), c = 0.5 * (a + b) - at_centre;
    const auto triangle = [&](double s) { return s > 0.0 ? s * s / (2.0 * a * b) : 0.0; };
    return triangle(c) - triangle(c - a) - triangle(c - b) + triangle(c - a - b);
}
/// Of an area from positions up to 32 px, over the 2 a b that triangles are divided by: some ten roundings.
inline constexpr double kRounding = 10.0 * 0x1p-52 * 32.0 / (2.0 * 0.1);
inline double boxShare(const Edge& edge, int x, int y) {
    return boxShare(edge.n, edge.at({x + 0.5, y + 0.5}));
}

/// A node turned and put so that its local x = 0 is on the edge, its inner side -x.
inline std::uint32_t onEdge(sdf::Tree& tree, std::uint32_t node, const Edge& edge, double z = 0.0) {
    const double degrees = glm::degrees(std::atan2(-edge.n.y, edge.n.x));
    const double offset = -edge.at(glm::dvec2(0.5 * kSide));
    const auto turned = tree.add(sdf::Kind::kRotate, {0, 0, 1, degrees}, {node});
    return tree.add(sdf::Kind::kTranslate, {offset * edge.n.x, -offset * edge.n.y, z}, {turned});
}
/// A wall with front and back at z = -4 and 4, its side on the edge.
inline std::uint32_t wallOn(sdf::Tree& tree, const Edge& edge, double z = 0.0) {
    const auto box = tree.add(sdf::Kind::kBox, {100, 100, 8});
    return onEdge(tree, tree.add(sdf::Kind::kTranslate, {-50, 0, 0}, {box}), edge, z);
}

inline FieldPicture wallPicture(const Edge& edge) {
    FieldPicture picture = flatPicture(kSide, kSide);
    wallOn(picture.field->tree, edge);
    picture.field->tree.root = static_cast<std::uint32_t>(picture.field->tree.nodes.size() - 1);
    picture.field->materials[0] = unlitWhite();
    return picture;
}

inline double redOf(const MethodResult& result, int x, int y) {
    return result.image.rgba[result.image.index(x, y)].x;
}
inline void forPixels(const std::function<void(int, int)>& pixel, int margin = 0) {
    for (int y = margin; y < kSide - margin; ++y)
        for (int x = margin; x < kSide - margin; ++x) pixel(x, y);
}

}  // namespace edgewise::test
