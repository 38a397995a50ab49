// An SDF scene as plain data: what the loaders make and every tracer reads. World space, right-handed, +y up.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sdf/tree.h"

namespace edgewise::sdf {

/// Colours are linear Rec.709.
struct SurfaceMaterial {
    enum class Pattern { kNone, kChecker, kStripes };
    enum class Shading { kUnlit, kLambert, kBlinnPhong };
    std::string name;
    Shading shading = Shading::kLambert;
    glm::dvec3 color{0.8};
    Pattern pattern = Pattern::kNone;
    glm::dvec3 second_color{0.0};            ///< of the pattern's other half
    double pattern_size = 1.0;               ///< of a square; of a stripe and its gap
    glm::dvec3 pattern_axis{0.0, 1.0, 0.0};  ///< across stripes
    glm::dvec3 specular{0.04};               ///< Blinn-Phong's
    double shininess = 32.0;                 ///< Blinn-Phong's exponent
    double reflectance = 0.0;                ///< at normal incidence, of a mirror; Whitted
    double transmittance = 0.0;              ///< share that is refracted rather than scattered; Whitted
    double ior = 1.5;                        ///< index of refraction inside
    glm::dvec3 absorption{0.0};              ///< inside, per unit of length
    glm::dvec3 emission{0.0};
};

struct SurfaceCamera {
    std::string name;
    glm::dvec3 eye_world{0.0, 0.0, 5.0}, target_world{0.0}, up_world{0.0, 1.0, 0.0};
    bool perspective = true;
    double fovy_degrees = 45.0;
    double ymag = 1.0;  ///< orthographic: half the height of what is seen
};

struct SurfaceLight {
    enum class Type { kDirectional, kPoint };
    Type type = Type::kDirectional;
    glm::dvec3 direction_world{0.0, -1.0, 0.0};  ///< unit, the way the light travels
    glm::dvec3 position_world{0.0};
    glm::dvec3 color{1.0};
    double intensity = 1.0;  ///< as pipeline/lighting.h: lux, candela
    bool shadows = true;
};

/// What rays meet in closed form beside the field.
struct AnalyticShape {
    enum class Type { kSphere, kPlane };  ///< planes: dot(p, normal) = offset, seen from both sides
    Type type = Type::kSphere;
    glm::dvec3 center_world{0.0};
    double radius = 1.0;
    glm::dvec3 normal_world{0.0, 1.0, 0.0};
    double offset = 0.0;
    std::uint32_t material = 0;
};

/// The whole tree is one convex solid within this sphere: section 3.5 of Keinert et al. 2014.
struct ConvexBound {
    glm::dvec3 center_world{0.0};
    double radius = 1.0;
};

/// Raw GLSL: `float map(vec3 p)`.
struct GlslMap {
    std::string file;
    std::string text;
    double lipschitz = 1.0;
    bool has_albedo = false;
    double time = 0.0;  ///< iTime
};

struct FieldScene {
    std::string source;
    Tree tree;  ///< empty: `glsl` is the scene
    std::optional<GlslMap> glsl;
    std::vector<SurfaceMaterial> materials;  ///< never empty: the default one is last
    std::vector<AnalyticShape> analytic;
    std::optional<ConvexBound> convex;
    std::vector<SurfaceCamera> cameras;
    std::vector<SurfaceLight> lights;      ///< none: the default rig
    glm::dvec3 ambient{0.0};               ///< times the surface's colour; with lights of its own
    std::optional<glm::dvec3> background;  ///< linear; a flag beats it
    double far = 1000.0;                   ///< rays end here, in world units from the eye
    int reflections = 2, refractions = 8;  ///< Whitted's bounces
    bool path_traced = false;              ///< made for path:N: `none` still shades it directly
    Box bounds{{0, 0, 0}, {0, 0, 0}};  ///< of the tree's solid and analytic spheres; unbounded parts left out
    bool bound_holds =
        true;  ///< false: values change faster than the tape says; relaxation, pruning, prepass off
    std::vector<std::string> warnings;  ///< one line each
};

}  // namespace edgewise::sdf
