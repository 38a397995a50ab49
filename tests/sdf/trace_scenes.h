// Small scenes that rays are traced through, and pictures' worth of rays.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <random>
#include <string>
#include <vector>

#include "sdf/sphere_trace.h"
#include "sdf/tree.h"

namespace edgewise::sdf {

struct TraceScene {
    std::string name;
    Tree tree;
    glm::dvec3 eye, target;
    double far = 100.0;
};

inline std::uint32_t placed(Tree& tree, std::uint32_t node, const glm::dvec3& at) {
    return tree.add(Kind::kTranslate, {at.x, at.y, at.z}, {node});
}
inline std::uint32_t floorAt(Tree& tree, double y) {
    return tree.add(Kind::kPlane, {0, 1, 0, y});
}

inline Tree primitivesTree() {
    Tree tree;
    std::vector<std::uint32_t> parts{floorAt(tree, -1.0)};
    parts.push_back(placed(tree, tree.add(Kind::kSphere, {0.8}), {-2, -0.2, 0}));
    parts.push_back(placed(tree, tree.add(Kind::kBox, {1.2, 1.4, 1.2}), {0, -0.3, 0}));
    parts.push_back(placed(tree, tree.add(Kind::kTorus, {0.7, 0.25}), {2, -0.75, 0}));
    parts.push_back(placed(tree, tree.add(Kind::kCone, {0.7, 0.1, 1.6}), {-1, -0.2, -2}));
    parts.push_back(placed(tree, tree.add(Kind::kCylinder, {0.5, 1.5}), {1, -0.25, -2}));
    tree.add(Kind::kUnion, {}, parts);
    return tree;
}

inline Tree cityTree() {
    Tree tree;
    std::vector<std::uint32_t> parts{floorAt(tree, 0.0)};
    std::mt19937 random(7);
    std::uniform_real_distribution<double> height(0.5, 4.0), width(0.4, 0.9);
    for (int x = -5; x < 5; ++x)
        for (int z = -5; z < 5; ++z) {
            const double h = height(random), w = width(random);
            parts.push_back(placed(tree, tree.add(Kind::kBox, {w, h, w}), {x + 0.5, 0.5 * h, z + 0.5}));
        }
    tree.add(Kind::kUnion, {}, parts);
    return tree;
}

inline Tree jewelTree() {
    Tree tree;
    const auto body = tree.add(Kind::kDodecahedron, {1.0});
    const auto cut = tree.add(Kind::kIntersection, {}, {body, tree.add(Kind::kSphere, {1.15})});
    const auto ring = placed(tree, tree.add(Kind::kTorus, {1.6, 0.08}), {0, -0.3, 0});
    tree.add(Kind::kUnion, {}, {floorAt(tree, -1.1), cut, ring});
    return tree;
}

inline Tree blobTree() {
    Tree tree;
    const auto blob = tree.add(Kind::kDisplace, {0.1, 6, 6, 6}, {tree.add(Kind::kSphere, {1.0})});
    tree.add(Kind::kUnion, {}, {blob, floorAt(tree, -1.3)});
    return tree;
}

inline Tree gyroidTree() {
    Tree tree;
    const auto sheet = tree.add(Kind::kGyroid, {0.7, 0.08});
    tree.add(Kind::kIntersection, {}, {sheet, tree.add(Kind::kSphere, {1.2})});
    return tree;
}

inline Tree mengerTree() {
    Tree tree;
    const auto sponge = tree.add(Kind::kMenger, {2.0, 3.0});
    tree.add(Kind::kUnion, {}, {sponge, floorAt(tree, -1.2)});
    return tree;
}

inline Tree spheresTree(int count, double smoothness = 0.05) {
    Tree tree;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> at(-1.0, 1.0), radius(0.3, 1.0);
    const double scale = 0.9 / std::cbrt(double(count));
    std::vector<std::uint32_t> parts;
    for (int i = 0; i < count; ++i) {
        const auto ball = tree.add(Kind::kSphere, {scale * radius(random)});
        const double x = at(random), y = at(random), z = at(random);
        parts.push_back(placed(tree, ball, {x, y, z}));
    }
    tree.add(Kind::kSmoothUnion, {smoothness}, parts);
    return tree;
}

inline Tree thinTree() {
    Tree tree;
    std::vector<std::uint32_t> parts{floorAt(tree, -1.0)};
    for (int i = 0; i < 12; ++i) {
        const double x = -1.5 + 0.27 * i;
        parts.push_back(tree.add(Kind::kCapsule, {x, -1, 0.1 * i, x + 0.2, 1, -0.1 * i, 0.002 * (i + 1)}));
    }
    tree.add(Kind::kUnion, {}, parts);
    return tree;
}

inline std::vector<TraceScene> traceScenes() {
    return {{"primitives", primitivesTree(), {0.5, 1.5, 5}, {0, -0.3, -0.5}},
            {"city", cityTree(), {5.5, 4.5, 7}, {0, 0.8, 0}},
            {"jewel", jewelTree(), {1.5, 1.2, 3.5}, {0, -0.1, 0}},
            {"blob", blobTree(), {0, 0.8, 3.2}, {0, -0.1, 0}},
            {"gyroid", gyroidTree(), {1.2, 1.0, 2.6}, {0, 0, 0}},
            {"menger", mengerTree(), {1.8, 1.4, 2.9}, {0, -0.1, 0}},
            {"spheres-50", spheresTree(50, 0.1), {1.5, 1.0, 3.2}, {0, 0, 0}},
            {"thin", thinTree(), {0.3, 0.6, 4}, {0, -0.1, 0}}};
}

/// Square pictures with a vertical field of view of 45 degrees, row by row.
inline std::vector<FieldRay> pictureRays(const TraceScene& scene, int size) {
    const glm::dvec3 along = glm::normalize(scene.target - scene.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(along, glm::dvec3(0, 1, 0))),
                     up = glm::cross(right, along);
    const double side = 2.0 * std::tan(0.5 * 0.785398163397448) / size;
    std::vector<FieldRay> rays;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double u = (x + 0.5 - 0.5 * size) * side, v = (0.5 * size - y - 0.5) * side;
            FieldRay ray;
            ray.origin_world = scene.eye;
            ray.direction_world = glm::normalize(along + u * right + v * up);
            ray.t_min = 0.01, ray.t_max = scene.far, ray.pixel_slope = 0.5 * side;
            rays.push_back(ray);
        }
    return rays;
}

}  // namespace edgewise::sdf
