// The CPU's and the device's pictures of every SDF scene that ships: where do they agree, and how well?
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "data/generate/recipes.h"
#include "pipeline/field_rays.h"
#include "pipeline/field_tracer.h"
#include "pipeline/load_scene.h"
#include "pipeline/resolve_camera.h"
#include "pipeline/scene_catalog.h"
#include "sdf/evaluate.h"
#include "tests/vulkan/test_device.h"

namespace edgewise::vulkan {
namespace {

constexpr int kWidth = 96, kHeight = 54;

struct Picture {
    Scene scene;
    ResolvedCamera camera;
    Film film;
    Prefilter filter = makePrefilter("box", {}, {});
    RenderOptions options;
    Progress progress;

    explicit Picture(const std::string& name) : scene(loadScene(findScene(name))) {
        test::device();  // validation is on from here
        CameraOptions camera_options;
        camera_options.size = {kWidth, kHeight};
        camera = resolveCamera(scene, camera_options, film);
        options.background = scene.field->background.value_or(glm::dvec3(0.0));
    }
    MethodInput input() { return {scene, camera, film, filter, options, progress}; }

    template <class Make>
    FieldSamples traced(const Make& make, const FieldSettings& settings = {}, glm::dvec2 place = {0.5, 0.5}) {
        FieldWindow window;
        window.pixels = {0, 0, kWidth, kHeight};
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) window.positions_px.push_back(glm::dvec2(x, y) + place);
        const MethodInput in = input();
        return make(in, settings)->trace(window);
    }
};

constexpr std::size_t at(int x, int y) {
    return static_cast<std::size_t>(y) * kWidth + x;
}

/// Where the CPU's hit leaves its neighbours' tangent planes: silhouettes, of objects and of their parts.
class Silhouettes {
  public:
    Silhouettes(const FieldSamples& samples, const sdf::RayGrid& grid) : beside_(kWidth * kHeight, false) {
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                if (x + 1 < kWidth) compare(samples, grid, {x, y}, {x + 1, y}, true);
                if (y + 1 < kHeight) compare(samples, grid, {x, y}, {x, y + 1}, true);
                if (x + 1 < kWidth && y + 1 < kHeight) compare(samples, grid, {x, y}, {x + 1, y + 1}, false);
                if (x > 0 && y + 1 < kHeight) compare(samples, grid, {x, y}, {x - 1, y + 1}, false);
            }
    }
    bool beside(std::size_t pixel) const { return beside_[pixel]; }
    std::size_t pixels() const { return std::count(beside_.begin(), beside_.end(), true); }
    std::size_t length() const { return length_; }  ///< in sides of pixels

  private:
    /// Off by more than a pixel's side over the cosine.
    static bool jumps(const FieldSamples& s, const sdf::RayGrid& grid, glm::ivec2 a, glm::ivec2 b) {
        const std::size_t i = at(a.x, a.y), j = at(b.x, b.y);
        if (std::isfinite(s.depth[i]) != std::isfinite(s.depth[j])) return true;
        if (!std::isfinite(s.depth[i])) return false;
        const sdf::FieldRay ray = grid.ray(glm::dvec2(a) + 0.5), next = grid.ray(glm::dvec2(b) + 0.5);
        const glm::dvec3 n(s.normal[i]), p = ray.origin_world + ray.direction_world * s.depth[i];
        const double cosine = -glm::dot(n, next.direction_world);
        const double plane = glm::dot(next.origin_world - p, n) / cosine;
        const double side = 2.0 * (ray.pixel_radius + ray.pixel_slope * s.depth[i]);
        return !(cosine > 0.0) || std::abs(s.depth[j] - plane) > side / cosine;
    }
    void compare(const FieldSamples& s, const sdf::RayGrid& grid, glm::ivec2 a, glm::ivec2 b, bool side) {
        if (!jumps(s, grid, a, b) && !jumps(s, grid, b, a)) return;
        beside_[at(a.x, a.y)] = beside_[at(b.x, b.y)] = true;
        length_ += side;
    }

    std::vector<bool> beside_;
    std::size_t length_ = 0;
};

/// How far apart two hits of one ray may be that are both within the threshold: the threshold's radius and
/// what float may be off, over what the field changes along the ray.
double depthBound(const sdf::Tape& tape, const sdf::FieldRay& ray, double t, double threshold) {
    const glm::dvec3 p = ray.origin_world + ray.direction_world * t;
    const sdf::ValueAndGradient field = sdf::gradientAt(tape, p);
    const double fall = std::abs(glm::dot(field.gradient, ray.direction_world));
    const double radius = threshold * (ray.pixel_radius + ray.pixel_slope * t);
    // Of the ray's numbers and the point on it: the origin, the direction, the product and the sum.
    const double moved = sdf::kFloatRounding * (glm::length(ray.origin_world) + 3.0 * t);
    const double off = sdf::floatErrorAt(tape, glm::vec3(p)).error + tape.lipschitz * moved;
    return (tape.lipschitz * radius + off) / fall + sdf::kFloatRounding * t;
}

double largestDifference(const glm::dvec4& a, const glm::dvec4& b) {
    const glm::dvec4 d = glm::abs(a - b);
    return std::max({d.x, d.y, d.z});
}

/// By how much the CPU's own colours change where the hit moves as far as the threshold lets it: to either
/// side, and along the ray.
std::vector<double> colorMargins(Picture& picture, const FieldSamples& samples, double threshold) {
    std::vector<double> margins(samples.color.size(), 0.0);
    const auto add = [&](const FieldSamples& other) {
        for (std::size_t i = 0; i < margins.size(); ++i)
            margins[i] = std::max(margins[i], largestDifference(samples.color[i], other.color[i]));
    };
    const double shift = 0.5 * threshold;
    for (const glm::dvec2& place : {glm::dvec2(-shift, 0), {shift, 0}, {0, -shift}, {0, shift}})
        add(picture.traced(makeCpuFieldTracer, {}, glm::dvec2(0.5) + place));
    FieldSettings finer;
    finer.trace.threshold = 0.5 * threshold;
    add(picture.traced(makeCpuFieldTracer, finer));
    return margins;
}

class FieldAgreement : public test::DeviceTest, public testing::WithParamInterface<std::string> {};

TEST_P(FieldAgreement, OfDepthAndColour) {
    Picture picture(GetParam());
    const FieldSettings settings;
    const double threshold = settings.trace.threshold;
    const FieldSamples cpu = picture.traced(makeCpuFieldTracer), gpu = picture.traced(makeVulkanFieldTracer);
    const sdf::RayGrid grid = rayGrid(picture.camera, picture.film, picture.scene.field->far);
    const sdf::Tape tape = sdf::lower(picture.scene.field->tree);
    const Silhouettes silhouettes(cpu, grid);
    const std::vector<double> margins = colorMargins(picture, cpu, threshold);
    // A colour that moves by more than this is at an edge of a shadow, a pattern or a mirrored thing; half a
    // step of an 8-bit picture is what nobody sees.
    constexpr double kEdge = 4.0 / 255.0, kHalfStep = 0.5 / 255.0;

    std::size_t differ = 0, color_edges = 0, hits = 0;
    double worst_depth = 0.0, worst_color = 0.0;
    for (std::size_t i = 0; i < cpu.depth.size(); ++i) {
        const sdf::FieldRay ray =
            grid.ray({static_cast<double>(i % kWidth) + 0.5, static_cast<double>(i / kWidth) + 0.5});
        const bool both = std::isfinite(cpu.depth[i]) && std::isfinite(gpu.depth[i]);
        const bool neither = !std::isfinite(cpu.depth[i]) && !std::isfinite(gpu.depth[i]);
        hits += both;
        // Closed forms are the host's for both.
        const double share = both && cpu.depth[i] == gpu.depth[i] ? 0.0 :
            both ? std::abs(gpu.depth[i] - cpu.depth[i]) / depthBound(tape, ray, cpu.depth[i], threshold)
                 : neither ? 0.0
                           : HUGE_VAL;
        if (silhouettes.beside(i)) {
            differ += share > 1.0;
            continue;
        }
        EXPECT_LE(share, 1.0) << i % kWidth << "," << i / kWidth << ": " << cpu.depth[i] << " "
                              << gpu.depth[i];
        worst_depth = std::max(worst_depth, share);
        if (margins[i] > kEdge) {
            ++color_edges;
            continue;
        }
        const double color = largestDifference(cpu.color[i], gpu.color[i]) / (2.0 * margins[i] + kHalfStep);
        EXPECT_LE(color, 1.0) << i % kWidth << "," << i / kWidth << ": " << cpu.color[i].x << " "
                              << gpu.color[i].x << " margin " << margins[i];
        worst_color = std::max(worst_color, color);
    }
    fmt::print(
        "{:16} {} hits; depth within {:.3f} of its bound, colour {:.3f}; {} pixels beside silhouettes {} "
        "sides long, of which {} differ; {} pixels beside edges of colour\n",
        GetParam(), hits, worst_depth, worst_color, silhouettes.pixels(), silhouettes.length(), differ,
        color_edges);
    EXPECT_LE(differ, silhouettes.length());
}

std::vector<std::string> sceneNames() {
    std::vector<std::string> names;
    for (const scenes::Recipe& recipe : scenes::sdfRecipes()) names.push_back(recipe.name);
    return names;
}
std::string caseName(const testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    std::ranges::replace(name, '-', '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(Shipped, FieldAgreement, testing::ValuesIn(sceneNames()), caseName);

}  // namespace
}  // namespace edgewise::vulkan
