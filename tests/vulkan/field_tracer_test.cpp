// SDF scenes traced on the device: against the double evaluator, and with every switch against without.
#include "pipeline/field_tracer.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <random>

#include "pipeline/field_rays.h"
#include "pipeline/vulkan/field_rays.h"
#include "pipeline/vulkan/field_window.h"
#include "sdf/evaluate.h"
#include "tests/vulkan/test_device.h"

namespace edgewise::vulkan {
namespace {

using FieldOnDevice = test::DeviceTest;
using sdf::Kind;

/// A field, seen from z = 4 with a field of view of 45 degrees.
struct Setting {
    std::shared_ptr<sdf::FieldScene> field = std::make_shared<sdf::FieldScene>();
    Scene scene;
    ResolvedCamera camera;
    Film film;
    Prefilter filter;
    RenderOptions options;
    Progress progress;

    explicit Setting(int size) {
        test::device();  // validation is on from here
        field->source = "test", field->far = 100.0;
        field->materials.resize(3);
        camera.camera.yfov = 0.78539816339744830962;
        camera.camera.world_from_camera[3] = glm::dvec4(0, 0, 4, 1);
        camera.camera_from_world = glm::inverse(camera.camera.world_from_camera);
        film.width = film.height = size, film.crop = {0, 0, size, size};
    }
    MethodInput input() {
        scene.field = field;
        return {scene, camera, film, filter, options, progress};
    }
    FieldSamples trace(const sdf::TraceSettings& settings, MethodResult* result = nullptr) {
        FieldSettings all;
        all.trace = settings;
        const MethodInput in = input();
        const auto tracer = makeVulkanFieldTracer(in, all);
        FieldWindow window;
        window.pixels = film.crop;
        FieldSamples samples = tracer->trace(window);
        MethodResult own;
        tracer->report(result ? *result : own);
        return samples;
    }
};

void addSphereMinusBox(sdf::Tree& tree) {
    const std::uint32_t sphere = tree.add(Kind::kSphere, {1.0}, {}, 0),
                        box = tree.add(Kind::kBox, {1, 1, 1}, {}, 0);
    tree.root = tree.add(Kind::kDifference, {}, {sphere, tree.add(Kind::kTranslate, {0.6, 0.6, 0.6}, {box})});
}

void addSpheres(sdf::Tree& tree, int count, double radius) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    std::vector<std::uint32_t> children;
    for (int i = 0; i < count; ++i) {
        const double x = place(random), y = place(random), z = place(random);
        const double r = radius * (1.0 + 0.5 * place(random));
        children.push_back(tree.add(Kind::kTranslate, {x, y, z}, {tree.add(Kind::kSphere, {r}, {}, i % 3)}));
    }
    tree.root = tree.add(Kind::kSmoothUnion, {0.05}, children);
}

glm::dvec3 pointOf(Setting& s, const FieldSamples& samples, std::size_t i) {
    const std::size_t width = s.film.width;
    const sdf::FieldRay ray =
        rayGrid(s.camera, s.film, 100.0)
            .ray(glm::dvec2(static_cast<double>(i % width) + 0.5, static_cast<double>(i / width) + 0.5));
    return ray.origin_world + samples.depth[i] * ray.direction_world;
}

std::size_t hits(const FieldSamples& samples) {
    return static_cast<std::size_t>(
        std::ranges::count_if(samples.depth, [](double t) { return std::isfinite(t); }));
}

TEST_F(FieldOnDevice, ASphereIsWhereItsEquationSays) {
    Setting s(64);
    s.field->tree.root = s.field->tree.add(Kind::kSphere, {1.0}, {}, 0);
    const FieldSamples samples = s.trace({});
    std::size_t edge = 0;
    for (std::size_t i = 0; i < samples.depth.size(); ++i) {
        const glm::dvec3 d =
            glm::normalize(glm::dvec3((i % 64 + 0.5 - 32.0) / 32.0 * std::tan(M_PI / 8),
                                      (32.0 - i / 64 - 0.5) / 32.0 * std::tan(M_PI / 8), -1.0));
        const glm::dvec3 o(0, 0, 4);
        const double b = glm::dot(o, d), left = b * b - (16.0 - 1.0);
        const double pixel = std::tan(M_PI / 8) / 64.0 * 4.0;
        if (std::abs(std::sqrt(std::max(16.0 - b * b, 0.0)) - 1.0) < pixel) {
            ++edge;
            continue;
        }
        ASSERT_EQ(std::isfinite(samples.depth[i]), left > 0.0) << i;
        if (left <= 0.0) continue;
        // The hit is within the threshold of the surface, along the ray by the cosine's inverse.
        const double truth = -b - std::sqrt(left), cosine = std::sqrt(left);
        EXPECT_LE(std::abs(samples.depth[i] - truth), 0.125 * pixel / cosine * 1.01 + 1e-5) << i;
        EXPECT_NEAR(glm::length(samples.normal[i]), 1.0, 1e-6);
        EXPECT_GT(glm::dot(glm::dvec3(samples.normal[i]), glm::normalize(o + truth * d)), 0.9999);
    }
    EXPECT_LT(edge, 400u);
    EXPECT_GT(hits(samples), 600u);
}

TEST_F(FieldOnDevice, AFaceOnABoundaryOfItsPatternShowsTheCellsBelowIt) {
    constexpr double kCell = 0.25;
    Setting s(64);
    sdf::SurfaceMaterial& checker = s.field->materials[0];
    checker.shading = sdf::SurfaceMaterial::Shading::kUnlit;
    checker.color = glm::dvec3(1.0), checker.second_color = glm::dvec3(0.25);
    checker.pattern = sdf::SurfaceMaterial::Pattern::kChecker, checker.pattern_size = kCell;
    s.field->tree.root =
        s.field->tree.add(Kind::kBox, {8, 8, 2}, {}, 0);  // its face is z = 1, 3 from the eye
    const FieldSamples samples = s.trace({});
    int seen[2] = {0, 0}, wrong = 0;
    for (int i = 0; i < 64 * 64; ++i) {
        const double pixel = 3.0 * std::tan(M_PI / 8) / 32.0;
        const glm::dvec2 p((i % 64 + 0.5 - 32.0) * pixel, (32.0 - i / 64 - 0.5) * pixel);
        const glm::dvec2 within = p / kCell - glm::floor(p / kCell);
        const double margin = pixel / kCell;
        if (std::min(within.x, within.y) < margin || std::max(within.x, within.y) > 1.0 - margin) continue;
        const double level = 1.0 / kCell - 1.0;
        const bool second =
            std::abs(std::fmod(std::floor(p.x / kCell) + std::floor(p.y / kCell) + level, 2.0)) == 1.0;
        ++seen[second];
        wrong += samples.color[i].r != (second ? 0.25 : 1.0);
    }
    EXPECT_GT(std::min(seen[0], seen[1]), 500);
    EXPECT_EQ(wrong, 0);
}

TEST_F(FieldOnDevice, EveryRelaxationFindsTheSameSurface) {
    Setting s(96);
    addSphereMinusBox(s.field->tree);
    const sdf::Tape tape = lower(s.field->tree);
    std::vector<double> first;
    for (const bool prepass : {false, true})
        for (const auto relaxation : {sdf::Relaxation::kNone, sdf::Relaxation::kKeinert,
                                      sdf::Relaxation::kBalint, sdf::Relaxation::kAuto}) {
            sdf::TraceSettings settings;
            settings.relaxation = relaxation, settings.prepass = prepass;
            MethodResult result;
            const FieldSamples samples = s.trace(settings, &result);
            fmt::print("prepass {} relaxation {}: {} evaluations\n", prepass, static_cast<int>(relaxation),
                       result.counts["field_evaluations"]);
            std::size_t differ = 0;
            const double pixel = std::tan(M_PI / 8) / 96.0 * 5.0;
            for (std::size_t i = 0; i < samples.depth.size(); ++i) {
                if (std::isfinite(samples.depth[i])) {
                    EXPECT_LE(std::abs(sdf::valueAt(tape, pointOf(s, samples, i))), pixel);
                }
                if (!first.empty()) differ += std::isfinite(samples.depth[i]) != std::isfinite(first[i]);
            }
            EXPECT_LE(differ, 9u);
            if (first.empty()) first = samples.depth;
        }
}

/// A ball less many boxes, and many boxes, in a turned place: other folds.
void addBoxes(sdf::Tree& tree, Kind fold) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    std::vector<std::uint32_t> children;
    if (fold == Kind::kSmoothDifference) children.push_back(tree.add(Kind::kSphere, {1.2}, {}, 2));
    for (std::uint32_t i = 0; i < 150; ++i) {
        const double x = place(random), y = place(random), z = place(random);
        const std::uint32_t box = tree.add(Kind::kBox, {0.2, 0.1 + 0.05 * x, 0.15}, {}, i % 3);
        children.push_back(
            tree.add(Kind::kTranslate, {x, y, z}, {tree.add(Kind::kRotate, {1, 1, 0, 60 * y}, {box})}));
    }
    const bool smooth = fold == Kind::kSmoothDifference;
    const std::uint32_t all =
        tree.add(fold, smooth ? std::vector<double>{0.03} : std::vector<double>{}, children);
    tree.root = tree.add(Kind::kRotate, {0, 1, 0, 20}, {all});
}

TEST_F(FieldOnDevice, PruningKeepsEveryBit) {
    const auto expectSame = [](const char* name, const std::function<void(sdf::Tree&)>& build) {
        SCOPED_TRACE(name);
        Setting s(96);
        build(s.field->tree);
        sdf::TraceSettings with, without;
        without.prune = false;
        MethodResult pruned, whole;
        const FieldSamples a = s.trace(with, &pruned), b = s.trace(without, &whole);
        EXPECT_GT(hits(a), 1000u);
        EXPECT_EQ(a.depth, b.depth);
        EXPECT_EQ(a.normal, b.normal);
        EXPECT_EQ(a.residual, b.residual);
        EXPECT_EQ(a.evaluations, b.evaluations);
        EXPECT_EQ(a.surface, b.surface);
        for (std::uint32_t material = 0; material < 3; ++material)
            EXPECT_GT(std::ranges::count(a.surface, material), 10);
        const double rows = static_cast<double>(pruned.counts["listed_rows"]) / pruned.counts["lists"];
        fmt::print("{}: {:.1f} rows a list\n", name, rows);
        EXPECT_LT(rows, 75.0);
        EXPECT_EQ(whole.counts["lists"], 0u);
    };
    expectSame("300 spheres, smooth union", [](sdf::Tree& t) { addSpheres(t, 300, 0.08); });
    expectSame("150 boxes, union", [](sdf::Tree& t) { addBoxes(t, Kind::kUnion); });
    expectSame("150 boxes, smooth difference", [](sdf::Tree& t) { addBoxes(t, Kind::kSmoothDifference); });
}

/// lavapipe's limit: a tiny budget of turns a dispatch gives the same bits.
TEST_F(FieldOnDevice, ManyDispatchesMakeTheSamePicture) {
    Setting s(32);
    addSpheres(s.field->tree, 200, 0.1);
    const MethodInput in = s.input();
    FieldWindow window;
    window.pixels = s.film.crop;
    std::vector<GpuRay> rays;
    for (const sdf::TravellingRay& ray : raysOf(rayGrid(in.camera, in.film, 100.0), window, 0, 32, 1.0))
        rays.push_back(gpuRay(ray.ray, ray.sign));
    sdf::TraceSettings settings;
    const FieldShaders shaders = makeFieldShaders(*s.field, settings, 32, 32, true);
    std::vector<float> first;
    std::uint64_t dispatches = 0;
    for (const std::uint32_t turns : {0u, 500u, 200u}) {
        FieldTiles tiles(test::device(), shaders, settings.prepass, turns == 500, turns);
        FieldRays tracer(test::device(), shaders, settings, tiles);
        const FieldAnswers answers = tracer.trace(rays, {0, 0, 0, 3});
        std::vector<float> t;
        for (std::size_t i = 0; i < rays.size(); ++i)
            t.push_back(answers.states[i].hit() ? answers.hits[i].t : -1.0f);
        if (!first.empty()) {
            EXPECT_EQ(t, first);
        }
        EXPECT_GT(tracer.counts().dispatches, dispatches);
        first = t, dispatches = tracer.counts().dispatches;
    }
}

/// Bands under --memory: the same bits.
TEST_F(FieldOnDevice, LittleMemoryMakesTheSamePicture) {
    Setting s(96);
    addSpheres(s.field->tree, 60, 0.1);
    MethodResult large, small;
    const FieldSamples a = s.trace({}, &large);
    s.options.memory_mib = 1;
    const FieldSamples b = s.trace({}, &small);
    EXPECT_EQ(a.depth, b.depth);
    EXPECT_EQ(a.color, b.color);
    EXPECT_GT(small.counts["dispatches"], 5 * large.counts["dispatches"]);
}

/// A parallel camera and a moved film: a plane through the origin, tilted about the y axis.
TEST_F(FieldOnDevice, OrthographicRaysAndShiftsMeetAPlaneWhereTheyShould) {
    Setting s(32);
    s.camera.camera.perspective = false, s.camera.camera.ymag = 1.0;
    s.film.shift_px = {0.25, -0.5};
    s.field->tree.root = s.field->tree.add(Kind::kPlane, {0.6, 0.0, 0.8, 0.0}, {}, 0);
    sdf::TraceSettings settings;
    settings.discontinuity_steps = 12, settings.level_set = true;
    const FieldSamples samples = s.trace(settings);
    for (std::size_t i = 0; i < samples.depth.size(); ++i) {
        const double x = (i % 32 + 0.5 + 0.25 - 16.0) / 16.0;
        // Twelve steps leave 0.2^12 of the threshold, the rest is float's.
        EXPECT_NEAR(samples.depth[i], 4.0 + 0.75 * x, 1e-5) << i;
        EXPECT_NEAR(samples.normal[i].x, 0.6, 1e-3);
    }
}

/// Equation 3 moves hits to where the field is what the pixel permits: a step leaves 1 - slope cosine.
TEST_F(FieldOnDevice, DiscontinuityStepsEvenTheFieldOut) {
    Setting s(64);
    s.field->tree.root = s.field->tree.add(Kind::kPlane, {0.0, 0.6, 0.8, 0.0}, {}, 0);
    const auto spread = [&](int steps) {
        sdf::TraceSettings settings;
        settings.discontinuity_steps = steps, settings.threshold = 1.0;
        const FieldSamples samples = s.trace(settings);
        double sum = 0.0;
        for (std::size_t i = 0; i < samples.depth.size(); ++i) {
            EXPECT_TRUE(std::isfinite(samples.depth[i]));
            sum += std::abs(samples.residual[i] - std::tan(M_PI / 8) / 64.0 * samples.depth[i]);
        }
        return sum;
    };
    EXPECT_LT(spread(3), 0.1 * spread(0));
}

/// Past an edge with few steps: the last point is in the air, the candidate is not taken unless it is near.
TEST_F(FieldOnDevice, TheCandidateLeavesNoGhostSilhouette) {
    Setting s(96);
    const std::uint32_t sphere = s.field->tree.add(Kind::kSphere, {1.0}, {}, 0),
                        floor = s.field->tree.add(Kind::kPlane, {0, 1, 0, -1.2}, {}, 0);
    s.field->tree.root = s.field->tree.add(Kind::kUnion, {}, {sphere, floor});
    const sdf::Tape tape = lower(s.field->tree);
    const auto ghosts = [&](bool screen) {
        sdf::TraceSettings settings;
        settings.relaxation = sdf::Relaxation::kNone, settings.prepass = false;
        settings.most_steps = 16, settings.screen_candidate = screen;
        const FieldSamples samples = s.trace(settings);
        std::size_t count = 0;
        for (std::size_t i = 0; i < samples.depth.size(); ++i)
            count += std::isfinite(samples.depth[i]) &&
                     std::abs(sdf::valueAt(tape, pointOf(s, samples, i))) > 0.01 * samples.depth[i];
        return count;
    };
    const std::size_t last = ghosts(false), candidate = ghosts(true);
    fmt::print("{} hits in the air by the last point, {} by the candidate\n", last, candidate);
    EXPECT_GT(last, 50u);
    EXPECT_EQ(candidate, 0u);
}

std::string messageOf(const std::function<void()>& work) {
    try {
        work();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "nothing";
}

FieldSamples traceMap(const std::string& text, int size = 32) {
    Setting s(size);
    s.field->glsl = sdf::GlslMap{"some.map.glsl", text, 1.0, false, 0.0};
    return s.trace({});
}

TEST_F(FieldOnDevice, RawGlslAsPublished) {
    const FieldSamples samples = traceMap(
        "#version 300 es\n#ifdef GL_ES\nprecision highp float;\n#endif\nuniform float iTime;\n"
        "uniform sampler2D iChannel0;\nout vec4 fragColor;\n#define R(p, a) p = cos(a) * p + sin(a) * "
        "vec2(p.y, -p.x)\n"
        "#define LOOP(n) for (int i = 0; i < n; i++)\nconst int N = 3;\nfloat ew(float x) { return x; }\n"
        "float opSmooth(float a, float b, float k) { float h = clamp(.5 + .5*(b - a)/k, 0., 1.);\n"
        " return mix(b, a, h) - k*h*(1. - h); }\n"
        "float fieldAt(vec3 p) { return length(p) - 1.; }\n"
        "float map(in vec3 pos)\n{\n  vec3 q = mod(pos + 1e3 * 2., 2e3); q = pos;\n  R(q.xz, iTime);\n  "
        "float d = fieldAt(q);\n"
        "  LOOP(N) d = opSmooth(d, length(q - vec3(float(i) * .1, 1., 0.)) - .2, .1);\n"
        "  int n = 0; while (n < 3) ++n; do n--; while (n > 0);\n  return ew(d);\n}\n"
        "vec3 albedo(vec3 p, vec3 n) { return vec3(1, 0, 0); }\n"
        "void mainImage(out vec4 c, in vec2 f) { c = texture(iChannel0, f / iResolution.xy) * dFdx(f.x); }\n"
        "void main() { mainImage(fragColor, gl_FragCoord.xy); }\n");
    EXPECT_GT(hits(samples), 150u);
    const glm::dvec4 middle = samples.color[16 * 32 + 16];
    EXPECT_GT(middle.x, 0.1);
    EXPECT_EQ(middle.y, 0.0);
}

TEST_F(FieldOnDevice, WhatIsWrongWithRawGlslIsOneLine) {
    const auto said = [](const std::string& text) { return messageOf([&] { traceMap(text); }); };
    EXPECT_EQ(said("float mop(vec3 p) { return 1.0; }"), "some.map.glsl: there is no `float map(vec3 p)`");
    EXPECT_EQ(said("\nvec2 map(vec3 p) { return vec2(1.0); }"),
              "some.map.glsl: line 2: map is not `float map(vec3 p)`");
    EXPECT_EQ(said("// a comment\nfloat map(vec3 p) {\n  return length(q) - 1.0;\n}")
                  .find("some.map.glsl: line 3: 'q' : undeclared identifier"),
              0u);
    for (const char* broken :
         {"float map(vec3 p) { return 1.0 }", "float map(vec3 p) { return length(p;", "}{",
          "float map(vec3 p) {", "#if\nfloat map(vec3 p) { return 1.0; }", "float map(vec3 p);",
          "#error no\nfloat map(vec3 p) { return 1.; }", "float map(vec3 p) { return map(p); }",
          "float map(vec3 p) { return texture(iChannel0, p.xy).x; }", ""}) {
        const std::string message = said(broken);
        fmt::print("{}\n", message);
        EXPECT_EQ(message.find("some.map.glsl: "), 0u) << broken << " -> " << message;
        EXPECT_EQ(message.find('\n'), message.npos);
    }
    EXPECT_NE(said("float map(vec3 p) {\n  float d = 1.;\n  while (true)\n  d *= .999;\n  return d;\n}")
                  .find("line 3: a loop without end"),
              std::string::npos);
    EXPECT_NE(said("#define FOREVER for (;;)\nfloat map(vec3 p) {\n  float d = 1.;\n  FOREVER d *= .9;\n  "
                   "return d;\n}")
                  .find("line 4: a loop without end"),
              std::string::npos);
    EXPECT_NE(said("float map(vec3 p) { return sqrt(p.x - 10.0); }").find("is not a number"),
              std::string::npos);
    EXPECT_NE(said("float map(vec3 p) { return 1.0 / (p.x * 0.0); }").find("is not a number"),
              std::string::npos);
}

TEST_F(FieldOnDevice, LinesAreTheUsersBehindMacrosOfManyLines) {
    const std::string text =
        "/* two\nlines */ #define F(a) \\\n  (a + \\\n  1.0)\n"
        "struct S { float d; int id; };\nconst vec2 K[2] = vec2[](vec2(1), vec2(2));\n"
        "S shared_(vec3 p) { return S(length(p) - K[0].x, 1); }\n"
        "float map(vec3 p) {\r\n  float buffer = F(\n 0.0);\n  return shared_(p).d * buffer";
    EXPECT_GT(hits(traceMap(text + ";\n}\n")), 150u);
    EXPECT_EQ(messageOf([&] { traceMap(text + " * nope;\n}\n"); }).find("some.map.glsl: line 11: 'nope'"),
              0u);
    std::string chain = "float map(vec3 p) { float d = p.x";
    for (int i = 0; i < 4900; ++i) chain += "+1.";
    EXPECT_EQ(messageOf([&] { traceMap(chain + "; return d; }"); }), "nothing");
    for (int i = 0; i < 20000; ++i) chain += "+1.";
    EXPECT_NE(messageOf([&] { traceMap(chain + "; return d; }"); }).find("line 1: a statement has more than"),
              std::string::npos);
    EXPECT_NE(messageOf([&] { traceMap("float map(vec3 p) " + std::string(100000, '{')); }), "nothing");
}

/// Loops of many turns a call: more than a dispatch may take in all, counted and split.
TEST_F(FieldOnDevice, LongLoopsAreSplitAndNotCutOff) {
    const std::string loops =
        "float map(vec3 p) { float d = 0.; for (int i = 0; i < 60; ++i) "
        "for (int j = 0; j < 60; ++j) d += 1.; return d - 3600. + length(p) - 1.; }";
    const FieldSamples slow = traceMap(loops),
                       quick = traceMap("float map(vec3 p) { return length(p) - 1.; }");
    EXPECT_EQ(hits(slow), hits(quick));
    EXPECT_GT(hits(slow), 150u);
}

TEST(FieldRates, DISABLED_Measure) {
    const auto measure = [](const char* name, const auto& build, bool prune) {
        Setting s(256);
        build(s.field->tree);
        FieldSettings all;
        all.trace.prune = prune;
        const MethodInput in = s.input();
        const auto tracer = makeVulkanFieldTracer(in, all);
        FieldWindow window;
        window.pixels = s.film.crop;
        for (int run = 0; run < 2; ++run) {
            const auto start = std::chrono::steady_clock::now();
            tracer->trace(window);
            const double seconds =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            MethodResult result;
            tracer->report(result);
            fmt::print("{} prune {}: {:.3f} s, set-up {:.2f} s", name, prune, seconds, result.setup_seconds);
            for (const StageTime& t : result.stages) fmt::print(", {} {:.3f}", t.name, t.seconds / (run + 1));
            for (const auto& [key, count] : result.counts) fmt::print(", {} {}", key, count / (run + 1));
            fmt::print("\n");
        }
    };
    measure(
        "sphere-minus-box", [](sdf::Tree& t) { addSphereMinusBox(t); }, true);
    for (const bool prune : {true, false}) {
        measure(
            "50 spheres", [](sdf::Tree& t) { addSpheres(t, 50, 0.15); }, prune);
        measure(
            "1000 spheres", [](sdf::Tree& t) { addSpheres(t, 1000, 0.05); }, prune);
    }
}

}  // namespace
}  // namespace edgewise::vulkan
