#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>

#include "pipeline/error.h"
#include "pipeline/field_tracer.h"
#include "pipeline/methods/method.h"
#include "pipeline/resolve_camera.h"
#include "sdf/tree.h"
#include "tests/pipeline/field_pictures.h"

namespace edgewise {
namespace {

using sdf::Kind;

/// Two balls and a box on a floor, an analytic ball and three materials, seen by the default rig.
Scene fieldScene(bool perspective = true) {
    sdf::FieldScene field;
    sdf::Tree& tree = field.tree;
    const auto put = [&](std::uint32_t node, double x, double y, double z, std::uint32_t material) {
        const auto at = tree.add(Kind::kTranslate, {x, y, z}, {node});
        tree.nodes[at].material = material;
        return at;
    };
    const auto a = put(tree.add(Kind::kSphere, {0.8}), -1, 0, 0, 0);
    const auto b = put(tree.add(Kind::kBox, {1.0, 1.0, 1.0}), 1, 0, 0.3, 1);
    const auto floor = tree.add(Kind::kPlane, {0, 1, 0, -0.8});
    tree.add(Kind::kUnion, {}, {a, b, floor});
    field.materials.resize(3);
    field.materials[0].color = {0.9, 0.2, 0.1}, field.materials[1].color = {0.1, 0.3, 0.9};
    field.analytic.push_back({sdf::AnalyticShape::Type::kSphere, {0, 0.9, -0.5}, 0.4, {0, 1, 0}, 0.0, 1});
    field.source = "field";
    Scene scene;
    scene.source = "field";
    Camera camera;
    camera.world_from_camera[3] = glm::dvec4(0.2, 0.6, 5.0, 1.0);
    camera.perspective = perspective, camera.yfov = 0.8, camera.ymag = 2.0, camera.znear = 0.01;
    scene.cameras.push_back(camera);
    scene.field = std::make_shared<const sdf::FieldScene>(std::move(field));
    return scene;
}

struct Picture {
    Scene scene = fieldScene();
    Film film;
    CameraOptions camera_options;
    RenderOptions options;
    Prefilter filter = makePrefilter("gaussian", {}, {});

    MethodResult render(const std::string& method, std::optional<PixelBox> crop = {}) {
        camera_options.size = glm::ivec2(48, 40);
        const glm::dvec2 shift = film.shift_px;
        const ResolvedCamera camera = resolveCamera(scene, camera_options, film);
        film.shift_px = shift;
        if (crop) film.crop = *crop;
        Progress progress;
        options.device = DeviceChoice::kCpu;
        return runMethod(parseMethod(method), {scene, camera, film, filter, options, progress});
    }
};

bool sameBits(const glm::dvec4& a, const glm::dvec4& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}
int differing(const ImageBuffer& a, const ImageBuffer& b) {
    int count = 0;
    for (int y = b.box.y0; y < b.box.y1; ++y)
        for (int x = b.box.x0; x < b.box.x1; ++x)
            count += !sameBits(a.rgba[a.index(x, y)], b.rgba[b.index(x, y)]) ||
                     a.edge[a.index(x, y)] != b.edge[b.index(x, y)];
    return count;
}

TEST(FieldMethods, ACropHasTheBitsOfTheWhole) {
    for (const char* method : {"none", "ssaa:3", "fxaa", "smaa", "sphere:relax=balint,discontinuity=2"}) {
        const MethodResult whole = Picture().render(method);
        const MethodResult part = Picture().render(method, PixelBox{13, 9, 30, 28});
        EXPECT_EQ(differing(whole.image, part.image), 0) << method;
    }
}

TEST(FieldMethods, ThreadsAndMemoryChangeNoBit) {
    Picture one, small;
    one.options.threads = 1, small.options.memory_mib = 1;
    const MethodResult reference = Picture().render("ssaa:4");
    EXPECT_EQ(differing(reference.image, one.render("ssaa:4").image), 0);
    EXPECT_EQ(differing(reference.image, small.render("ssaa:4").image), 0);
}

TEST(FieldMethods, PruningChangesNoBitAndConesNoSurface) {
    Picture picture;
    picture.options.aovs = {Aov::kIndex};
    const MethodResult all = picture.render("sphere"), unpruned = picture.render("sphere:prune=off"),
                       plain = picture.render("sphere:prepass=off,prune=off,relax=none");
    EXPECT_EQ(differing(all.image, unpruned.image), 0);
    EXPECT_EQ(all.image.aov.words, plain.image.aov.words);
    EXPECT_GT(all.counts.at("cone_evaluations"), 0u);
    EXPECT_LT(all.counts.at("evaluations") + all.counts.at("cone_evaluations"),
              plain.counts.at("evaluations"));
}

/// Whole pixels: the film moved by one shows the neighbour's ray.
TEST(FieldMethods, AShiftMovesThePicture) {
    Picture moved;
    moved.film.shift_px = {1.0, 0.0};
    const MethodResult still = Picture().render("none"), shifted = moved.render("none");
    int same = 0, all = 0;
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x + 1 < 48; ++x, ++all) {
            const glm::dvec4 d =
                shifted.image.rgba[shifted.image.index(x, y)] - still.image.rgba[still.image.index(x + 1, y)];
            same += std::abs(d.x) + std::abs(d.y) + std::abs(d.z) < 1e-2;
        }
    EXPECT_GT(same, all * 97 / 100);
}

/// The centre ray of an orthographic camera, by hand: z 5 down to the floor of y = -0.8, the sphere, the box.
TEST(FieldMethods, DepthNormalAndIndexAreOfTheSurface) {
    for (const bool perspective : {true, false}) {
        Picture picture;
        picture.scene = fieldScene(perspective);
        picture.options.aovs = {Aov::kDepth, Aov::kNormal, Aov::kIndex};
        const MethodResult result = picture.render("none");
        std::array<int, 3> seen{};
        int sky = 0;
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 48; ++x) {
                const std::uint32_t* words = result.image.aov.pixel(result.image.index(x, y));
                const float depth = std::bit_cast<float>(words[0]);
                const float nz = std::bit_cast<float>(words[3]);
                if (words[4] == kNone) {
                    ++sky;
                    EXPECT_EQ(depth, 1e10f);
                    continue;
                }
                ++seen.at(words[4]);
                // The box's front face: z = 0.8 seen from z = 5.
                if (words[4] == 1 && nz > 0.999f && depth < 4.5f) {
                    EXPECT_NEAR(depth, 4.2f, 0.01f);
                }
            }
        EXPECT_GT(seen[0], 20);
        EXPECT_GT(seen[1], 20);
        EXPECT_GT(seen[2], 100);
        EXPECT_GT(sky, 100);
    }
}

/// Filtered by hand from a lattice's single samples: `none` with the film shifted to each.
TEST(FieldMethods, SsaaIsTheFilterOverItsSamples) {
    Picture picture;
    picture.filter = makePrefilter("box", {}, {});
    const MethodResult mean = picture.render("ssaa:2");
    std::vector<glm::dvec4> sum(mean.image.rgba.size(), glm::dvec4(0.0));
    for (const double dy : {-0.25, 0.25})
        for (const double dx : {-0.25, 0.25}) {
            Picture one;
            one.film.shift_px = {dx, dy};
            const MethodResult part = one.render("sphere:threshold=0.0625");  // half of a pixel's
            for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += 0.25 * part.image.rgba[i];
        }
    int far = 0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const glm::dvec4 d = glm::abs(sum[i] - mean.image.rgba[i]);
        far += std::max({d.x, d.y, d.z}) > 0.02;
    }
    // Cones start a silhouette's rays elsewhere within the threshold, so that a few samples differ.
    EXPECT_LE(far, 5);
}

TEST(FieldMethods, EdgesAreWhereSamplesDiffer) {
    const MethodResult result = Picture().render("ssaa:4");
    int edges = 0;
    for (const float edge : result.image.edge) edges += edge == 1.0f;
    EXPECT_GT(edges, 100);
    EXPECT_LT(edges, 48 * 40);
}

TEST(FieldMethods, ParametersThatAreNumbersAreChecked) {
    EXPECT_EQ(parseMethod("sphere:omega=1.5").numberOf("omega"), 1.5);
    for (const char* wrong : {"sphere:omega=3", "sphere:omega=nan", "sphere:steps=1.5", "sphere:threshold=0",
                              "sphere:omega=1.2,omega=1.3", "sphere:discontinuity=x", "sphere:relax=fast"})
        EXPECT_THROW(parseMethod(wrong), InputError) << wrong;
}

/// Parallel rays that all begin in the solid end where they leave it.
TEST(FieldMethods, ParallelRaysMayBeginWithinTheSolid) {
    test::FieldPicture picture = test::flatPicture(16, 16);
    picture.field->tree.root = picture.field->tree.add(sdf::Kind::kBox, {60.0, 60.0, 40.0});
    picture.options.aovs = {Aov::kDepth};
    const MethodResult made = picture.made("none");
    for (std::size_t i = 0; i < made.image.rgba.size(); ++i)  // from z = 10 to -20
        EXPECT_NEAR(std::bit_cast<float>(made.image.aov.pixel(i)[0]), 30.0, 1e-3);
}

TEST(FieldMethods, ADeviceMayBeNamedBehindAnyPart) {
    test::FieldPicture picture = test::flatPicture(8, 8);
    picture.field->tree.root = picture.field->tree.add(sdf::Kind::kSphere, {3.0});
    picture.options.device = DeviceChoice::kVulkan;
    EXPECT_EQ(picture.made("ctss+ssaa:2,device=cpu").device, "cpu");
    EXPECT_THROW(picture.made("ctss:device=vulkan+ssaa:2,device=cpu"), InputError);
}

TEST(FieldMethods, TrianglesAndFieldsHaveTheirOwnMethods) {
    Picture picture;
    picture.options.aovs = {Aov::kCryptomatte};
    EXPECT_THROW(picture.render("none"), InputError);
    Picture triangles;
    triangles.scene.field.reset();
    EXPECT_THROW(triangles.render("sphere"), InputError);
}

TEST(FieldMethods, ThePlanSaysWhatRan) {
    const MethodResult result = Picture().render("sphere:prune=off");
    std::map<std::string, PlanEntry> plan;
    for (const PlanEntry& entry : result.plan) plan[entry.stage] = entry;
    EXPECT_TRUE(plan.at("prepass").runs);
    EXPECT_FALSE(plan.at("prune").runs);
    EXPECT_FALSE(plan.at("convex").runs);
    EXPECT_TRUE(plan.at("analytic").runs);
}

}  // namespace
}  // namespace edgewise
