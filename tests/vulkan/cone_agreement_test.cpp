// The CPU's and the device's hit groups along the same cones, and what they cover.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/field_rays.h"
#include "pipeline/field_tracer.h"
#include "pipeline/load_scene.h"
#include "pipeline/methods/cone_tracer.h"
#include "pipeline/resolve_camera.h"
#include "pipeline/scene_catalog.h"
#include "pipeline/vulkan/cone_rays.h"
#include "pipeline/vulkan/field_window.h"
#include "sdf/evaluate.h"
#include "tests/vulkan/test_device.h"

namespace edgewise::vulkan {
namespace {

constexpr int kWidth = 128, kHeight = 72;

struct Picture {
    Scene scene;
    ResolvedCamera camera;
    Film film;
    Prefilter filter = makePrefilter("box", {}, {});
    RenderOptions options;
    Progress progress;
    FieldSettings settings;

    explicit Picture(Scene loaded) : scene(std::move(loaded)) {
        test::device();  // validation is on from here
        CameraOptions camera_options;
        camera_options.size = {kWidth, kHeight};
        camera = resolveCamera(scene, camera_options, film);
        settings.cones.emplace();
        scene = sceneOfCones(input());
    }
    MethodInput input() { return {scene, camera, film, filter, options, progress}; }
    FieldWindow window() const {
        FieldWindow all;
        all.pixels = film.crop;
        return all;
    }
    FieldCones cones(const FieldTracerMaker& make) { return make(input(), settings)->traceCones(window()); }
    FieldSamples samples(const FieldTracerMaker& make) {
        return coneTracerMaker(make)(input(), settings)->trace(window());
    }
};

std::size_t countOf(const FieldCones& cones, std::size_t i) {
    return cones.begin[i + 1] - cones.begin[i];
}
/// Nothing, or one surface that the ray itself meets and that fills the cone.
bool isPlain(const FieldCones& cones, std::size_t i) {
    if (countOf(cones, i) == 0) return true;
    const sdf::ConeGroup& group = cones.groups[cones.begin[i]];
    return countOf(cones, i) == 1 && group.hard && group.least <= -1.0;
}

/// The first point asked below the threshold is at most a least step behind where the ray comes below it, and
/// what backtracing makes of it at most as far before it.
double depthBound(const sdf::FieldRay& ray, const FieldSettings& settings, double t) {
    const sdf::cones::ConeRules rules = sdf::coneRules(ray, settings.trace, *settings.cones);
    return 2.0 * rules.alpha * sdf::cones::coneRadiusAt(rules, t);
}
/// What float may make of the point where a distance comes below a threshold.
double floatBound(const sdf::Tape& tape, const sdf::FieldRay& ray, double t) {
    const glm::dvec3 p = ray.origin_world + ray.direction_world * t;
    const double fall = std::abs(glm::dot(sdf::gradientAt(tape, p).gradient, ray.direction_world));
    const double moved = sdf::kFloatRounding * (glm::length(ray.origin_world) + 3.0 * t);
    return (sdf::floatErrorAt(tape, glm::vec3(p)).error + tape.lipschitz * moved) / fall +
           sdf::kFloatRounding * t;
}

struct Agreement {
    std::size_t plain = 0, complex = 0, differ = 0;
    std::size_t dips = 0;  ///< a contour before the same surface, below the threshold for less than a step
    double worst = 0.0;
};
template <class Bound>
Agreement compare(const FieldCones& a, const FieldCones& b, const Bound& bound) {
    Agreement result;
    for (std::size_t i = 0; i < a.samples(); ++i) {
        if (!isPlain(a, i) || !isPlain(b, i)) {
            ++result.complex;
            result.differ += countOf(a, i) != countOf(b, i);
            continue;
        }
        ++result.plain;
        EXPECT_EQ(countOf(a, i), countOf(b, i)) << i % kWidth << "," << i / kWidth;
        if (countOf(a, i) != 1 || countOf(b, i) != 1) continue;
        const double t = a.groups[a.begin[i]].t;
        const double share = std::abs(b.groups[b.begin[i]].t - t) / bound(a.rays[i].ray, t);
        if (share > 1.0)
            ++result.dips;
        else
            result.worst = std::max(result.worst, share);
    }
    return result;
}

void expectSameCoverage(const FieldSamples& a, const FieldSamples& b, std::size_t complex, const char* name) {
    double sum = 0.0, largest = 0.0;
    std::size_t off = 0;
    for (std::size_t i = 0; i < a.color.size(); ++i) {
        const double d = a.color[i].w - b.color[i].w;
        sum += d, largest = std::max(largest, std::abs(d)), off += d != 0.0;
    }
    const double each = complex > 0 ? sum / static_cast<double>(complex) : 0.0;
    fmt::print(
        "{}: coverage differs in {} pixels, by {:.3f} at most and {:.5f} in the mean of complex ones\n", name,
        off, largest, each);
    EXPECT_LE(std::abs(each), 1.0 / 32.0);  // a bit of the mask
    EXPECT_LE(off, complex);
}

class ConeAgreement : public test::DeviceTest, public testing::WithParamInterface<const char*> {};

TEST_P(ConeAgreement, OfGroups) {
    Picture picture(loadScene(findScene(GetParam())));
    const FieldCones cpu = picture.cones(makeCpuFieldTracer), gpu = picture.cones(makeVulkanFieldTracer);
    ASSERT_EQ(cpu.samples(), gpu.samples());
    const sdf::Tape tape = sdf::lower(picture.scene.field->tree);
    const Agreement found = compare(cpu, gpu, [&](const sdf::FieldRay& ray, double t) {
        return depthBound(ray, picture.settings, t) + floatBound(tape, ray, t);
    });
    fmt::print(
        "{}: {} plain pixels, depths within {:.3f} of their bound but for {}; of {} complex ones {} have "
        "other groups\n",
        GetParam(), found.plain, found.worst, found.dips, found.complex, found.differ);
    EXPECT_LE(found.dips, found.complex / 20);
    EXPECT_LE(found.differ, found.complex / 4);
    expectSameCoverage(picture.samples(makeCpuFieldTracer), picture.samples(makeVulkanFieldTracer),
                       found.complex, GetParam());
}
INSTANTIATE_TEST_SUITE_P(Shipped, ConeAgreement,
                         testing::Values("primitives", "random-box", "random-shape", "sparse-shape", "atrium",
                                         "wires", "thin", "gyroid"),
                         [](const auto& scene) {
                             std::string name = scene.param;
                             std::ranges::replace(name, '-', '_');
                             return name;
                         });

using ConesOnDevice = test::DeviceTest;

/// The same solid as a tree and as raw GLSL.
TEST_F(ConesOnDevice, OfRawGlslAreATreesOfTheSameSolid) {
    Scene tree = loadScene(findScene("sphere-minus-box"));
    ASSERT_TRUE(tree.field->analytic.empty());
    auto plain = std::make_shared<sdf::FieldScene>(*tree.field);
    plain->tree = {};
    plain->tree.root = plain->tree.add(sdf::Kind::kSphere, {0.8}, {}, 0);
    auto raw = std::make_shared<sdf::FieldScene>(*plain);
    raw->tree = {};
    raw->glsl = sdf::GlslMap{"ball.map.glsl",
                             "float map(vec3 p) { return length(p) - 0.8; }\n"
                             "vec3 albedo(vec3 p, vec3 n) { return vec3(1, 0, 0); }\n",
                             1.0, false, 0.0};
    Scene map = tree;
    tree.field = plain, map.field = raw;
    Picture of_tree(tree), of_map(map);
    of_map.camera = of_tree.camera, of_map.film = of_tree.film;
    const FieldCones a = of_tree.cones(makeVulkanFieldTracer), b = of_map.cones(makeVulkanFieldTracer);
    const sdf::Tape tape = sdf::lower(plain->tree);
    const Agreement found = compare(a, b, [&](const sdf::FieldRay& ray, double t) {
        return depthBound(ray, of_tree.settings, t) + floatBound(tape, ray, t);
    });
    std::size_t hits = 0;
    double worst = 1.0;
    for (std::size_t i = 0; i < b.groups.size(); ++i) {
        const sdf::SurfaceHit& hit = b.surfaces[i];
        worst = std::min(worst, glm::dot(hit.normal_world, glm::normalize(hit.p_world)));
        ASSERT_TRUE(hit.color.has_value());
        EXPECT_EQ(*hit.color, glm::dvec3(1, 0, 0));
        ++hits;
    }
    fmt::print("{} groups, {} complex pixels, {} differ; normals' least cosine {}\n", hits, found.complex,
               found.differ, worst);
    EXPECT_GT(hits, 500u);
    EXPECT_GT(found.complex, 20u);
    EXPECT_LE(found.dips, found.complex / 20);
    EXPECT_LE(found.differ, found.complex / 4);
    EXPECT_GT(worst, 0.999);
    expectSameCoverage(of_tree.samples(makeVulkanFieldTracer), of_map.samples(makeVulkanFieldTracer),
                       found.complex, "ball");
}

/// Colours of samples beyond a quarter of 8 bits.
std::size_t countDifferent(const FieldSamples& a, const FieldSamples& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.color.size(); ++i)
        count += !(glm::length(a.color[i] - b.color[i]) <= 0.25 / 255.0);
    return count;
}

/// Groups shaded as they are met: more of them, and the same picture. On the device shadows' rays have other
/// neighbours, and a tile's first step with them: borders of light move by what hits are off.
TEST_F(ConesOnDevice, ShadeAtOnceTheSamePicture) {
    for (const char* name : {"thin", "spheres-50"}) {
        Picture picture(loadScene(findScene(name)));
        const FieldSamples cpu = picture.samples(makeCpuFieldTracer),
                           gpu = picture.samples(makeVulkanFieldTracer);
        picture.settings.cones->shade_at_once = true;
        EXPECT_EQ(picture.samples(makeCpuFieldTracer).color, cpu.color) << name;
        const std::size_t differ = countDifferent(picture.samples(makeVulkanFieldTracer), gpu);
        fmt::print("{}: {} of {} samples differ on the device\n", name, differ, gpu.color.size());
        EXPECT_LE(differ, gpu.color.size() / 200) << name;
    }
}

/// Cones that pause at every group, and go on.
TEST_F(ConesOnDevice, InRoundsAreTheSameBits) {
    for (const char* name : {"thin", "spheres-50"}) {
        Picture picture(loadScene(findScene(name)));
        const FieldCones whole = picture.cones(makeVulkanFieldTracer);
        picture.settings.cones->shade_at_once = true;
        const FieldCones rounds = picture.cones(makeVulkanFieldTracer);
        EXPECT_EQ(whole.begin, rounds.begin);
        EXPECT_EQ(whole.evaluations, rounds.evaluations);
        ASSERT_EQ(whole.groups.size(), rounds.groups.size());
        std::size_t most = 0;
        for (std::size_t i = 0; i < whole.groups.size(); ++i) {
            EXPECT_EQ(whole.groups[i].t, rounds.groups[i].t);
            EXPECT_EQ(whole.groups[i].least, rounds.groups[i].least);
            EXPECT_EQ(whole.groups[i].hard, rounds.groups[i].hard);
        }
        for (std::size_t i = 0; i < whole.samples(); ++i) most = std::max(most, countOf(whole, i));
        fmt::print("{}: up to {} groups a cone\n", name, most);
        EXPECT_GT(most, 1u);
    }
}

/// Dispatches of few turns: states go on where they were.
TEST_F(ConesOnDevice, OverManyDispatchesAreTheSameBits) {
    Picture picture(loadScene(findScene("spheres-50")));
    const sdf::TraceSettings& trace = picture.settings.trace;
    const FieldShaders shaders =
        makeFieldShaders(*picture.scene.field, trace, kWidth, kHeight, true, &*picture.settings.cones);
    std::vector<GpuRay> rays;
    const sdf::RayGrid grid = rayGrid(picture.camera, picture.film, picture.scene.field->far);
    for (const sdf::TravellingRay& ray : raysOf(grid, picture.window(), 0, kHeight, 1.0))
        rays.push_back(gpuRay(ray.ray, ray.sign));
    std::vector<std::uint32_t> first;
    std::uint64_t dispatches = 0;
    for (const std::uint32_t turns : {0u, 500u, 200u}) {
        FieldTiles tiles(test::device(), shaders, true, true, turns);
        ConeRays cones(test::device(), shaders, *picture.settings.cones, tiles);
        cones.begin(rays, {0.0, 0.0, 0.0, picture.scene.field->far}, {});
        while (cones.goOn({})) {
        }
        std::vector<std::uint32_t> found;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const std::uint32_t groups = cones.states()[i].groups();
            found.push_back(groups);
            for (std::uint32_t k = 0; k < groups; ++k)
                found.push_back(cones.groups()[k * rays.size() + i].t_hard);
        }
        if (!first.empty()) {
            EXPECT_EQ(found, first);
        }
        EXPECT_GT(tiles.counts().dispatches, dispatches);
        first = found, dispatches = tiles.counts().dispatches;
    }
    EXPECT_GT(first.size(), rays.size() + 500);
}

}  // namespace
}  // namespace edgewise::vulkan
