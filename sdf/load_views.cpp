#include "sdf/load_views.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "sdf/json_reader.h"
#include "sdf/nearest_name.h"
#include "sdf/number_rules.h"
#include "sdf/records.h"

namespace edgewise::sdf {
namespace {

SurfaceMaterial readMaterial(const Json& object, const std::string& path, const std::string& name) {
    const Record record = Record::read(object, path, materialRecord(), {"name"});
    using Shading = SurfaceMaterial::Shading;
    constexpr Shading kShadings[] = {Shading::kLambert, Shading::kBlinnPhong, Shading::kUnlit};
    SurfaceMaterial m;
    m.name = name;
    m.shading = kShadings[record.choice("shading")];
    m.pattern = static_cast<SurfaceMaterial::Pattern>(record.choice("pattern"));
    record.take("color", m.color), record.take("second_color", m.second_color);
    record.take("pattern_size", m.pattern_size), record.take("pattern_axis", m.pattern_axis);
    m.pattern_axis = glm::normalize(m.pattern_axis);
    record.take("specular", m.specular), record.take("shininess", m.shininess);
    record.take("reflectance", m.reflectance), record.take("transmittance", m.transmittance);
    record.take("ior", m.ior), record.take("absorption", m.absorption), record.take("emission", m.emission);
    if (m.reflectance + m.transmittance > 1.0)
        refuse(path, fmt::format("reflectance and transmittance must not exceed 1 together, not {}",
                                 m.reflectance + m.transmittance));
    return m;
}

std::string nameOf(const Json& object, const std::string& path) {
    requireObject(object, path);
    if (!object.contains("name")) refuse(path + ".name", "must be given");
    return readText(object["name"], path + ".name");
}

/// Calls one(object, path) for each of a list.
template <class One>
void each(const Json& document, const char* key, One&& one) {
    const auto list = document.find(key);
    if (list == document.end()) return;
    if (!list->is_array()) refuse(key, fmt::format("must be a list, not {}", list->type_name()));
    for (std::size_t i = 0; i < list->size(); ++i) one((*list)[i], fmt::format("{}[{}]", key, i));
}

SurfaceCamera readCamera(const Json& object, const std::string& path) {
    const Record record = Record::read(object, path, cameraRecord());
    SurfaceCamera camera;
    camera.perspective = record.variant == 0;
    record.take("name", camera.name);
    record.take("eye", camera.eye_world), record.take("target", camera.target_world);
    record.take("up", camera.up_world);
    record.take("fovy", camera.fovy_degrees), record.take("ymag", camera.ymag);
    requireView(camera, path);
    return camera;
}

SurfaceLight readLight(const Json& object, const std::string& path) {
    const Record record = Record::read(object, path, lightRecord());
    SurfaceLight light;
    light.type = static_cast<SurfaceLight::Type>(record.variant);
    record.take("direction", light.direction_world), record.take("position", light.position_world);
    light.direction_world = glm::normalize(light.direction_world);
    record.take("color", light.color), record.take("intensity", light.intensity);
    record.take("shadows", light.shadows);
    return light;
}

AnalyticShape readAnalytic(const Json& object, const std::string& path,
                           const std::vector<SurfaceMaterial>& materials) {
    const Record record = Record::read(object, path, analyticRecord());
    AnalyticShape shape;
    shape.type = static_cast<AnalyticShape::Type>(record.variant);
    record.take("center", shape.center_world), record.take("radius", shape.radius);
    record.take("normal", shape.normal_world), record.take("offset", shape.offset);
    shape.normal_world = glm::normalize(shape.normal_world);
    std::string material;
    record.take("material", material);
    shape.material = object.contains("material") ? findMaterial(materials, material, path + ".material")
                                                 : static_cast<std::uint32_t>(materials.size() - 1);
    return shape;
}

void readOwn(const Json& document, FieldScene& scene) {
    const Record record = Record::read(document, "", sceneRecord(),
                                       {"tree", "materials", "analytic", "convex", "cameras", "lights"});
    record.take("ambient", scene.ambient), record.take("far", scene.far);
    record.take("reflections", scene.reflections), record.take("refractions", scene.refractions);
    record.take("path_traced", scene.path_traced);
    if (record.has("background")) record.take("background", scene.background.emplace());
}

}  // namespace

void requireView(const SurfaceCamera& camera, const std::string& path) {
    const glm::dvec3 view = camera.target_world - camera.eye_world;
    if (!(glm::length(view) >= kSmallest)) refuse(path, "eye and target must be apart");
    const double sine = glm::length(glm::cross(glm::normalize(view), glm::normalize(camera.up_world)));
    if (!(sine >= kSmallest)) refuse(path + ".up", "must not point along the view");
}

std::vector<SurfaceMaterial> readMaterials(const Json& document) {
    std::vector<SurfaceMaterial> materials;
    const auto add = [&](const Json& object, const std::string& path, const std::string& name) {
        for (const SurfaceMaterial& other : materials)
            if (other.name == name) refuse(path + ".name", fmt::format("'{}' is there twice", name));
        materials.push_back(readMaterial(object, path, name));
    };
    const auto list = document.find("materials");
    if (list != document.end() && list->is_object()) {
        for (const auto& [name, object] : list->items()) {
            const std::string path = "materials." + name;
            requireObject(object, path);
            if (object.contains("name")) refuse(path, "has its name already");
            add(object, path, name);
        }
    } else {
        each(document, "materials",
             [&](const Json& object, const std::string& path) { add(object, path, nameOf(object, path)); });
    }
    materials.push_back({.name = "default"});
    return materials;
}

std::uint32_t findMaterial(const std::vector<SurfaceMaterial>& materials, const std::string& name,
                           const std::string& path) {
    std::vector<std::string_view> names;
    for (std::uint32_t i = 0; i < materials.size(); ++i) {
        if (materials[i].name == name) return i;
        names.push_back(materials[i].name);
    }
    refuse(path, fmt::format("no material is called '{}'{}", name, didYouMean(name, names)));
}

void readViews(const Json& document, FieldScene& scene) {
    readOwn(document, scene);
    each(document, "cameras", [&](const Json& object, const std::string& path) {
        scene.cameras.push_back(readCamera(object, path));
    });
    each(document, "lights", [&](const Json& object, const std::string& path) {
        scene.lights.push_back(readLight(object, path));
    });
    each(document, "analytic", [&](const Json& object, const std::string& path) {
        scene.analytic.push_back(readAnalytic(object, path, scene.materials));
    });
    if (const auto convex = document.find("convex"); convex != document.end()) {
        const Record record = Record::read(*convex, "convex", convexRecord());
        ConvexBound& bound = scene.convex.emplace();
        record.take("center", bound.center_world), record.take("radius", bound.radius);
    }
}

}  // namespace edgewise::sdf
