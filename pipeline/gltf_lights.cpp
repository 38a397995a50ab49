#include "pipeline/gltf_lights.h"

#include <numbers>

#include "pipeline/gltf_ignored.h"
#include "pipeline/gltf_transform.h"

namespace edgewise {
namespace {

constexpr const char* kExtension = "KHR_lights_punctual";

std::optional<GltfElement> lightList(const GltfElement& root) {
    const auto extension = root.extension(kExtension);
    return extension ? extension->find("lights") : std::nullopt;
}

void checkAtLeastZero(const GltfElement& light, const char* key) {
    if (light.numberOr(key, 0.0) < 0.0)
        light.need(key).fail(fmt::format("{} is negative", light.need(key).number()));
}

/// 0 <= inner < outer <= pi/2, which a file may have rounded to float32.
void checkCone(const GltfElement& spot) {
    constexpr double kRightAngle = std::numbers::pi / 2;
    const double inner = spot.numberOr("innerConeAngle", 0.0);
    const double outer = spot.numberOr("outerConeAngle", kRightAngle / 2);
    if (!(inner >= 0.0 && inner < outer && static_cast<float>(outer) <= static_cast<float>(kRightAngle)))
        spot.fail(fmt::format("its cones of {} and {} are not 0 <= inner < outer <= pi/2", inner, outer));
}

void checkLight(const GltfElement& light) {
    light.object().need("type").string();
    if (const auto name = light.find("name")) name->string();
    if (const auto color = light.find("color")) {
        light.moderatesIf("color", 3);
        for (std::size_t i = 0; i < 3; ++i)
            if (!(color->at(i).number() >= 0.0))
                color->at(i).fail(fmt::format("{} is negative", color->at(i).number()));
    }
    light.moderateIf("intensity");
    light.moderateIf("range");
    checkAtLeastZero(light, "intensity");
    if (const auto range = light.find("range"); range && !(range->number() > 0.0))
        range->fail(fmt::format("{} is not above 0", range->number()));
    if (light.need("type").string() == "spot") {
        const auto spot = light.find("spot");
        if (spot) checkCone(spot->object());
    }
}

std::optional<Light::Type> typeOf(const GltfElement& from) {
    const std::string type = from.need("type").string();
    if (type == "directional") return Light::Type::kDirectional;
    if (type == "point") return Light::Type::kPoint;
    if (type == "spot") return Light::Type::kSpot;
    return std::nullopt;
}

Light readLight(const GltfElement& from, Light::Type type) {
    Light light;
    light.type = type;
    if (const auto name = from.find("name")) light.name = name->string();
    if (const auto color = from.find("color"))
        for (int i = 0; i < 3; ++i) light.color[i] = color->at(static_cast<std::size_t>(i)).number();
    light.intensity = from.numberOr("intensity", 1.0);
    if (const auto range = from.find("range")) light.range = range->number();
    if (const auto spot = from.find("spot"); spot && type == Light::Type::kSpot) {
        light.inner_cone_angle = spot->numberOr("innerConeAngle", light.inner_cone_angle);
        light.outer_cone_angle = spot->numberOr("outerConeAngle", light.outer_cone_angle);
    }
    return light;
}

}  // namespace

void checkLights(const GltfElement& root) {
    const auto list = lightList(root);
    if (list) list->array();
    const std::size_t count = list ? list->size() : 0;
    for (std::size_t i = 0; i < count; ++i) checkLight(list->at(i));
    root.each("nodes", [&](const GltfElement& node) {
        if (const auto extension = node.extension(kExtension))
            extension->need("light").reference(count, "lights");
    });
}

void addLight(const GltfElement& root, const PlacedNode& placed, Scene& scene) {
    const GltfElement node = root.need("nodes").at(static_cast<std::size_t>(placed.node));
    const auto extension = node.extension(kExtension);
    if (!extension) return;
    const GltfElement from =
        lightList(root)->at(static_cast<std::size_t>(extension->need("light").integer()));
    const auto type = typeOf(from);
    if (!type) return countIgnored(scene, "lights of an unknown type");
    Light light = readLight(from, *type);
    light.node = static_cast<std::uint32_t>(placed.node);
    light.position_world = glm::dvec3(placed.world_from_node[3]);
    if (const auto backward = unitVector(glm::dvec3(placed.world_from_node[2])))
        light.direction_world = -*backward;
    else if (*type != Light::Type::kPoint)
        node.fail("its light has no direction: the z axis of the node vanishes");
    scene.lights.push_back(light);
}

}  // namespace edgewise
