#include "data/generate/sdf_scenes.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "data/generate/portable_math.h"

namespace edgewise::scenes {
namespace {

using Json = nlohmann::ordered_json;

/// To 4 decimals, so that the text is short and the same everywhere.
double rounded(double x) {
    return std::floor(x * 1e4 + 0.5) / 1e4;
}
Json vector(double x, double y, double z) {
    return {rounded(x), rounded(y), rounded(z)};
}

constexpr const char* kPalette[] = {"brick", "sand", "moss", "sea", "plum", "chalk"};

Json materials() {
    return {{"brick", {{"color", {0.62, 0.16, 0.10}}}},
            {"sand", {{"color", {0.80, 0.58, 0.28}}}},
            {"moss", {{"color", {0.22, 0.45, 0.14}}}},
            {"sea", {{"color", {0.08, 0.35, 0.52}}}},
            {"plum", {{"color", {0.34, 0.13, 0.38}}}},
            {"chalk", {{"color", {0.82, 0.80, 0.76}}}},
            {"ground",
             {{"color", {0.55, 0.55, 0.52}},
              {"pattern", "checker"},
              {"second_color", {0.32, 0.33, 0.34}},
              {"pattern_size", 1.0}}}};
}

Json scene(const std::string& title, Json camera, double far) {
    Json json{{"$schema", "sdf.schema.json"}, {"title", title}};
    json["background"] = {0.45, 0.62, 0.85};
    json["far"] = far;
    json["ambient"] = {0.16, 0.18, 0.22};
    json["cameras"] = Json::array({std::move(camera)});
    json["lights"] = {{{"direction", {-0.5, -0.8, -0.35}}, {"color", {1.0, 0.96, 0.88}}, {"intensity", 2.4}},
                      {{"direction", {0.7, -0.3, -0.6}}, {"intensity", 0.4}, {"shadows", false}}};
    json["materials"] = materials();
    return json;
}

Json cameraAt(const Json& eye, const Json& target, double fovy) {
    return {{"name", "main"}, {"eye", eye}, {"target", target}, {"fovy", fovy}};
}

Json ground() {
    return {{"type", "plane"}, {"normal", {0, 1, 0}}, {"offset", 0}, {"material", "ground"}};
}

void turnAtRandom(SplitMix64& random, Json& node) {
    const Axes axes = randomAxes(random);
    node["rotate"] = {{"axis", vector(axes.u.x, axes.u.y, axes.u.z)},
                      {"degrees", rounded(random.between(0.0, 360.0))}};
}

Json randomBox(SplitMix64& random) {
    const double x = random.between(0.3, 1.2), y = random.between(0.3, 1.2), z = random.between(0.3, 1.2);
    return {{"type", "box"}, {"size", vector(x, y, z)}};
}

/// About a unit across.
Json randomShape(SplitMix64& random) {
    const double a = rounded(random.between(0.3, 0.6)), b = rounded(random.between(0.1, 0.25));
    switch (random.next() % 8) {
        case 0:
            return {{"type", "sphere"}, {"radius", a}};
        case 1:
            return {{"type", "torus"}, {"major", a}, {"minor", b}};
        case 2:
            return {{"type", "capsule"}, {"from", {0, -a, 0}}, {"to", {0, a, 0}}, {"radius", b}};
        case 3:
            return {{"type", "cylinder"}, {"radius", a}, {"height", rounded(4 * b)}};
        case 4:
            return {{"type", "cone"}, {"bottom", a}, {"top", b}, {"height", rounded(2 * a)}};
        case 5:
            return {{"type", "octahedron"}, {"radius", rounded(1.3 * a)}};
        case 6:
            return {{"type", "hex-prism"}, {"inradius", a}, {"height", rounded(3 * b)}};
        default:
            return randomBox(random);
    }
}

template <class Make>
Json scattered(SplitMix64& random, std::uint32_t count, double half_width, double top, Make make) {
    Json nodes = Json::array({ground()});
    for (std::uint32_t i = 0; i < count; ++i) {
        Json node = make(random);
        turnAtRandom(random, node);
        const double x = random.between(-half_width, half_width), y = random.between(0.2, top),
                     z = random.between(-half_width, half_width);
        node["at"] = vector(x, y, z);
        node["material"] = kPalette[random.next() % 6];
        nodes.push_back(std::move(node));
    }
    return {{"type", "union"}, {"children", std::move(nodes)}};
}

std::string textOf(const Json& json) {
    return json.dump(1) + "\n";
}

constexpr double kWirePixel = 2.0 * 10.0 * 0.36397023426620236135 / 720.0;  // tan(20 degrees)

Json wire(double x0, double y0, double x1, double y1, double width_px) {
    // As many digits as it takes: a radius may be 2.5e-4.
    return {{"type", "capsule"},
            {"from", vector(x0, y0, 0.0)},
            {"to", vector(x1, y1, 0.0)},
            {"radius", std::floor(0.5 * width_px * kWirePixel * 1e9 + 0.5) / 1e9}};
}

/// 0.05 to 1 in twelve steps: 20^(1/12) each.
double wireWidth(int i) {
    double width = 0.05;
    for (int k = 0; k < i; ++k) width *= 1.2835688421125162;
    return std::floor(width * 1e4 + 0.5) / 1e4;
}

}  // namespace

std::string makeRandomBoxes(std::uint32_t count) {
    SplitMix64 random(count);
    Json json = scene("Random boxes", cameraAt({9, 7, 11}, {0, 1, 0}, 38), 80);
    json["tree"] = scattered(random, count, 6.0, 3.2, randomBox);
    return textOf(json);
}

std::string makeRandomShapes(std::uint32_t count) {
    SplitMix64 random(count);
    Json json = scene("Random shapes", cameraAt({8, 6, 10}, {0, 1, 0}, 38), 80);
    json["tree"] = scattered(random, count, 5.0, 3.0, randomShape);
    return textOf(json);
}

std::string makeSparseShapes() {
    SplitMix64 random(11);
    Json json = scene("Few shapes, far apart", cameraAt({14, 7, 24}, {0, 1, 0}, 36), 200);
    json["tree"] = scattered(random, 14, 14.0, 3.5, [](SplitMix64& r) {
        Json node = randomShape(r);
        node["scale"] = 1.8;
        return node;
    });
    return textOf(json);
}

std::string makeSmoothSpheres(std::uint32_t count) {
    SplitMix64 random(count);
    const bool many = count > 200;
    const double low = many ? 0.09 : 0.25, high = many ? 0.24 : 0.55;
    Json nodes = Json::array();
    for (std::uint32_t i = 0; i < count; ++i) {
        Vec3 p;
        do p = {random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
        while (dot(p, p) > 1.0);
        const double radius = rounded(random.between(low, high));
        const int color = p.y > 0.35 ? 1 : (p.y > -0.2 ? 0 : (p.y > -0.6 ? 4 : 3));
        nodes.push_back({{"type", "sphere"},
                         {"radius", radius},
                         {"at", vector(2.0 * p.x, 2.0 * p.y, 2.0 * p.z)},
                         {"material", kPalette[color]}});
    }
    Json json =
        scene(std::to_string(count) + " spheres, united smoothly", cameraAt({4, 3, 6}, {0, 0, 0}, 36), 40);
    json["tree"] = {
        {"type", "smooth-union"}, {"smoothness", many ? 0.08 : 0.2}, {"children", std::move(nodes)}};
    return textOf(json);
}

std::string makeWires() {
    Json nodes = Json::array();
    for (int i = 0; i <= 12; ++i) {
        const double width = wireWidth(i), x = -5.6 + 0.42 * i;
        nodes.push_back(wire(x, -1.2, x + 0.35, 3.2, width));
        // Slopes in equal steps from a common point.
        nodes.push_back(wire(0.7, 1.0, 5.6, 1.0 + 0.34 * (i - 6), width));
        nodes.push_back({{"type", "torus"},
                         {"major", 0.36},
                         {"minor", nodes.back()["radius"]},
                         {"rotate", {{"axis", {1, 0, 0}}, {"degrees", 90}}},
                         {"at", vector(-5.4 + 0.9 * i, -2.4, 0.0)}});
    }
    Json json{{"$schema", "sdf.schema.json"},
              {"title", "Wires from 0.05 to 1 px wide at 1280 x 720"},
              {"background", {0, 0, 0}},
              {"far", 40}};
    json["cameras"] = Json::array({cameraAt({0, 0, 10}, {0, 0, 0}, 40)});
    json["materials"] = {{"white", {{"color", {1, 1, 1}}, {"shading", "unlit"}}}};
    json["tree"] = {{"type", "union"}, {"material", "white"}, {"children", std::move(nodes)}};
    return textOf(json);
}

}  // namespace edgewise::scenes
