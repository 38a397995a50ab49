// The CPU's and the device's pictures of every SDF scene that ships: where do they agree, and how well?
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "data/generate/recipes.h"
#include "pipeline/field_rays.h"
#include "pipeline/field_shading.h"
#include "pipeline/field_tracer.h"
#include "pipeline/load_scene.h"
#include "pipeline/resolve_camera.h"
#include "pipeline/scene_catalog.h"
#include "pipeline/vulkan/field_batches.h"
#include "pipeline/vulkan/field_window.h"
#include "sdf/evaluate.h"
#include "tests/vulkan/test_device.h"

namespace edgewise::vulkan {
namespace {

constexpr int kWidth = 96, kHeight = 54;
/// The device's, 64 roundings of float, for both.
constexpr double kEpsilon = 0x1p-18;

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
    FieldSamples traced(const Make& make, FieldSettings settings = {}, glm::dvec2 place = {0.5, 0.5}) {
        settings.trace.epsilon = kEpsilon;
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

glm::dvec2 middleOf(std::size_t pixel) {
    return {static_cast<double>(pixel % kWidth) + 0.5, static_cast<double>(pixel / kWidth) + 0.5};
}

/// Where hits leave their neighbours' tangent planes: silhouettes, of objects and of their parts.
class Silhouettes {
  public:
    explicit Silhouettes(const sdf::RayGrid& grid) : grid_(grid), beside_(kWidth * kHeight, false) {}
    void add(const FieldSamples& samples) {
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                if (x + 1 < kWidth) compare(samples, {x, y}, {x + 1, y}, true);
                if (y + 1 < kHeight) compare(samples, {x, y}, {x, y + 1}, true);
                if (x + 1 < kWidth && y + 1 < kHeight) compare(samples, {x, y}, {x + 1, y + 1}, false);
                if (x > 0 && y + 1 < kHeight) compare(samples, {x, y}, {x - 1, y + 1}, false);
            }
    }
    bool beside(std::size_t pixel) const { return beside_[pixel]; }
    std::size_t pixels() const { return std::count(beside_.begin(), beside_.end(), true); }
    std::size_t length() const { return length_; }  ///< in sides of pixels, of both pictures

  private:
    /// Off by more than a pixel's side over the cosine.
    bool jumps(const FieldSamples& s, glm::ivec2 a, glm::ivec2 b) const {
        const std::size_t i = at(a.x, a.y), j = at(b.x, b.y);
        if (std::isfinite(s.depth[i]) != std::isfinite(s.depth[j])) return true;
        if (!std::isfinite(s.depth[i])) return false;
        const sdf::FieldRay ray = grid_.ray(glm::dvec2(a) + 0.5), next = grid_.ray(glm::dvec2(b) + 0.5);
        const glm::dvec3 n(s.normal[i]), p = ray.origin_world + ray.direction_world * s.depth[i];
        const double cosine = -glm::dot(n, next.direction_world);
        const double plane = glm::dot(next.origin_world - p, n) / cosine;
        const double side = 2.0 * (ray.pixel_radius + ray.pixel_slope * s.depth[i]);
        return !(cosine > 0.0) || std::abs(s.depth[j] - plane) > side / cosine;
    }
    void compare(const FieldSamples& s, glm::ivec2 a, glm::ivec2 b, bool side) {
        if (!jumps(s, a, b) && !jumps(s, b, a)) return;
        beside_[at(a.x, a.y)] = beside_[at(b.x, b.y)] = true;
        length_ += side;
    }

    const sdf::RayGrid& grid_;
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

/// By how much the CPU's own colours change where the sample moves by a sixteenth of a pixel to any side, and
/// where other steps or half the threshold lead to other points of the threshold's shell. What leaves glass
/// where that touches something else begins on either side of it by that.
std::vector<double> colorMargins(Picture& picture, const FieldSamples& samples,
                                 const FieldSettings& settings) {
    std::vector<double> margins(samples.color.size(), 0.0);
    const auto add = [&](const FieldSettings& by, const glm::dvec2& shift) {
        const FieldSamples other = picture.traced(makeCpuFieldTracer, by, glm::dvec2(0.5) + shift);
        for (std::size_t i = 0; i < margins.size(); ++i)
            margins[i] = std::max(margins[i], largestDifference(samples.color[i], other.color[i]));
    };
    constexpr double kShift = 1.0 / 16.0;
    for (const glm::dvec2& shift : {glm::dvec2(-kShift, 0), {kShift, 0}, {0, -kShift}, {0, kShift}})
        add(settings, shift);
    FieldSettings classic = settings, finer = settings;
    classic.trace.relaxation = sdf::Relaxation::kNone;
    finer.trace.threshold *= 0.5;
    add(classic, {});
    add(finer, {});
    return margins;
}

/// Refraction forks at every facet: edges deep within the tree of rays are finer than any of the above shows.
bool isGlass(const Picture& picture) {
    return std::ranges::any_of(picture.scene.field->materials,
                               [](const sdf::SurfaceMaterial& m) { return m.transmittance > 0.0; });
}

Silhouettes silhouettesOf(const sdf::RayGrid& grid, const FieldSamples& cpu, const FieldSamples& gpu) {
    // What is thinner than a pixel may be met by one of the two alone.
    Silhouettes silhouettes(grid);
    silhouettes.add(cpu);
    silhouettes.add(gpu);
    return silhouettes;
}

using FieldSecondaryRays = test::DeviceTest;
class FieldAgreement : public test::DeviceTest, public testing::WithParamInterface<std::string> {};

TEST_P(FieldAgreement, OfDepth) {
    Picture picture(GetParam());
    const double threshold = FieldSettings().trace.threshold;
    const FieldSamples cpu = picture.traced(makeCpuFieldTracer), gpu = picture.traced(makeVulkanFieldTracer);
    const sdf::RayGrid grid = rayGrid(picture.camera, picture.film, picture.scene.field->far);
    const sdf::Tape tape = sdf::lower(picture.scene.field->tree);
    const Silhouettes silhouettes = silhouettesOf(grid, cpu, gpu);
    std::size_t differ = 0, hits = 0;
    double worst = 0.0;
    for (std::size_t i = 0; i < cpu.depth.size(); ++i) {
        if (cpu.depth[i] == gpu.depth[i])
            continue;  // nothing, or closed forms, which are the host's for both
        const bool both = std::isfinite(cpu.depth[i]) && std::isfinite(gpu.depth[i]);
        hits += both;
        const double bound = both ? depthBound(tape, grid.ray(middleOf(i)), cpu.depth[i], threshold) : 0.0;
        const double share = both ? std::abs(gpu.depth[i] - cpu.depth[i]) / bound : HUGE_VAL;
        if (silhouettes.beside(i)) {
            differ += share > 1.0;
            continue;
        }
        EXPECT_LE(share, 1.0) << i % kWidth << "," << i / kWidth << ": " << cpu.depth[i] << " "
                              << gpu.depth[i];
        worst = std::max(worst, share);
    }
    fmt::print(
        "{}: {} depths of the field within {:.3f} of their bound; {} pixels beside silhouettes {} sides "
        "long, of which {} differ\n",
        GetParam(), hits, worst, silhouettes.pixels(), silhouettes.length() / 2, differ);
    EXPECT_LE(differ, silhouettes.length() / 2);
}

/// With a narrow threshold, so that both shade the same point. A colour that moves by more than kEdge is at
/// an edge of a shadow, a pattern or a mirrored thing; half a step of an 8-bit picture is what nobody sees.
TEST_P(FieldAgreement, OfColour) {
    constexpr double kEdge = 4.0 / 255.0, kHalfStep = 0.5 / 255.0;
    Picture picture(GetParam());
    FieldSettings settings;
    settings.trace.threshold = 0x1p-8;
    const FieldSamples cpu = picture.traced(makeCpuFieldTracer, settings),
                       gpu = picture.traced(makeVulkanFieldTracer, settings);
    const sdf::RayGrid grid = rayGrid(picture.camera, picture.film, picture.scene.field->far);
    const Silhouettes silhouettes = silhouettesOf(grid, cpu, gpu);
    const std::vector<double> margins = colorMargins(picture, cpu, settings);
    std::size_t edges = 0, compared = 0, differ = 0;
    double worst = 0.0;
    for (std::size_t i = 0; i < cpu.depth.size(); ++i) {
        if (silhouettes.beside(i)) continue;
        if (margins[i] > kEdge) {
            ++edges;
            continue;
        }
        ++compared;
        const double share = largestDifference(cpu.color[i], gpu.color[i]) / (2.0 * margins[i] + kHalfStep);
        differ += share > 1.0;
        if (share <= 1.0) worst = std::max(worst, share);
    }
    fmt::print(
        "{}: {} colours within {:.3f} of their bound, but for {}; {} pixels beside edges of colour alone\n",
        GetParam(), compared, worst, differ, edges);
    EXPECT_GT(compared, 1000u);
    EXPECT_LE(differ, isGlass(picture) ? edges / 20 : 0u);
}

/// Asks the device, and then the CPU of the same rays: within half a pixel, or they differ.
class BothTracers : public RayBatches {
  public:
    BothTracers(RayBatches& device, const sdf::SceneTracer& cpu) : device_(device), cpu_(cpu) {}
    std::vector<sdf::SurfaceHit> nearest(std::span<const sdf::TravellingRay> rays) override {
        std::vector<sdf::SurfaceHit> hits = device_.nearest(rays);
        for (std::size_t i = 0; i < rays.size(); ++i) compare(rays[i], hits[i]);
        return hits;
    }
    std::vector<char> occluded(std::span<const sdf::TravellingRay> rays) override {
        return device_.occluded(rays);
    }
    std::vector<double> depths(std::span<const sdf::TravellingRay> rays) override {
        return device_.depths(rays);
    }
    std::vector<sdf::SurfaceHit> describe(std::span<const sdf::TravellingRay> rays,
                                          std::span<const double> depths) override {
        return device_.describe(rays, depths);
    }
    std::size_t asked = 0, differ = 0;

  private:
    void compare(const sdf::TravellingRay& ray, const sdf::SurfaceHit& hit) {
        const sdf::SurfaceHit truth = cpu_.nearest(ray.ray, ray.sign);
        ++asked;
        const double radius = ray.ray.pixel_radius + ray.ray.pixel_slope * truth.t;
        const bool same = truth.hit == hit.hit && (!truth.hit || std::abs(truth.t - hit.t) <= radius);
        if (same) return;
        ++differ;
    }
    RayBatches& device_;
    const sdf::SceneTracer& cpu_;
};

TEST_F(FieldSecondaryRays, MeetWhatTheCpuSaysOfThem) {
    for (const char* name : {"jewel", "convex"}) {
        Picture picture(name);
        const sdf::FieldScene& scene = *picture.scene.field;
        sdf::TraceSettings settings;
        settings.epsilon = kEpsilon, settings.threshold = 0x1p-8;
        const sdf::Tape tape = sdf::lower(scene.tree);
        const sdf::SceneTracer cpu(scene, tape, settings);
        const FieldShaders shaders = makeFieldShaders(scene, settings, kWidth, kHeight, true);
        FieldTiles tiles(test::device(), shaders, settings.prepass, true);
        FieldRays rays(test::device(), shaders, settings, tiles);
        FieldBatches device(scene, tape, shaders, settings, &rays, {}, 1 << 20, {});
        BothTracers both(device, cpu);
        const sdf::Shader shader(fieldShading(picture.input(), settings, false), cpu);
        FieldWindow window;
        window.pixels = {0, 0, kWidth, kHeight};
        const auto first = raysOf(rayGrid(picture.camera, picture.film, scene.far), window, 0, kHeight, 1.0);
        sdf::RayCounts counts;
        shadeWavefront(shader, both, first, device.nearest(first), counts);
        fmt::print("{}: {} of {} secondary rays differ\n", name, both.differ, both.asked);
        EXPECT_GT(both.asked, 5000u);
        EXPECT_LE(both.differ, both.asked / 1000);  // those that graze an edge
    }
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
