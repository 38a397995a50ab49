#include "pipeline/gltf_transform.h"

#include <tiny_gltf.h>
#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace edgewise {
namespace {

double largestOf(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// 2^-e with largest * 2^-e in [0.5, 1): scaling by it is exact.
double powerOfTwoBelow(double largest) {
    if (largest == 0.0) return 1.0;
    int exponent = 0;
    std::frexp(largest, &exponent);
    return std::ldexp(1.0, std::clamp(-exponent, -1022, 1022));
}

glm::dvec3 scaledToOne(const glm::dvec3& v) {
    return v * powerOfTwoBelow(largestOf(v));
}

glm::dquat rotationOf(const std::vector<double>& q) {
    // Divided by the largest part first: the squared length can neither overflow nor vanish.
    const double largest = std::max({std::abs(q[0]), std::abs(q[1]), std::abs(q[2]), std::abs(q[3])});
    return glm::normalize(glm::dquat(q[3] / largest, q[0] / largest, q[1] / largest, q[2] / largest));
}

}  // namespace

glm::dmat4 localTransform(const tinygltf::Node& node) {
    glm::dmat4 local(1.0);
    if (!node.matrix.empty()) {
        for (int i = 0; i < 16; ++i) local[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
        return local;
    }
    if (!node.rotation.empty()) local = glm::mat4_cast(rotationOf(node.rotation));
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        if (!node.scale.empty()) local[axis] *= node.scale[i];
        if (!node.translation.empty()) local[3][axis] = node.translation[i];
    }
    return local;
}

bool isFinite(const glm::dmat4& matrix) {
    for (int i = 0; i < 16; ++i)
        if (!std::isfinite(matrix[i / 4][i % 4])) return false;
    return true;
}

bool flipsWinding(const glm::dmat4& m) {
    const glm::dvec3 x = scaledToOne(m[0]), y = scaledToOne(m[1]), z = scaledToOne(m[2]);
    return glm::dot(x, glm::cross(y, z)) < 0.0;
}

glm::dmat3 tangentTransform(const glm::dmat4& m) {
    const glm::dmat3 linear(m);
    return linear *
           powerOfTwoBelow(std::max({largestOf(linear[0]), largestOf(linear[1]), largestOf(linear[2])}));
}

glm::dmat3 normalTransform(const glm::dmat4& m) {
    const glm::dmat3 a = tangentTransform(m);
    const double sign = flipsWinding(m) ? -1.0 : 1.0;
    return glm::dmat3(glm::cross(a[1], a[2]), glm::cross(a[2], a[0]), glm::cross(a[0], a[1])) * sign;
}

std::optional<glm::dvec3> unitVector(const glm::dvec3& v) {
    if (largestOf(v) == 0.0) return std::nullopt;
    return glm::normalize(scaledToOne(v));
}

std::optional<glm::dmat4> rigidTransform(const glm::dmat4& m) {
    const glm::dvec3 back = scaledToOne(m[2]), up = scaledToOne(m[1]);
    if (largestOf(back) == 0.0 || largestOf(up) == 0.0) return std::nullopt;
    const glm::dvec3 z = glm::normalize(back);
    const glm::dvec3 side = glm::cross(up, z);
    if (largestOf(side) == 0.0) return std::nullopt;
    const glm::dvec3 x = glm::normalize(side);
    return glm::dmat4(glm::dvec4(x, 0.0), glm::dvec4(glm::cross(z, x), 0.0), glm::dvec4(z, 0.0), m[3]);
}

}  // namespace edgewise
