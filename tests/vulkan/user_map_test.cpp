// Raw GLSL in the styles that people publish: each traced on the device and judged by the same field written
// in C++.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "pipeline/error.h"
#include "pipeline/field_tracer.h"
#include "sdf/load_glsl_map.h"
#include "tests/vulkan/test_device.h"

namespace edgewise::vulkan {
namespace {

constexpr int kSize = 24;
constexpr double kEye = 4.0, kFar = 20.0, kHalfHeight = 0.41421356237309503;  // tan(22.5 degrees)

using Field = std::function<double(glm::dvec3)>;

FieldSamples traceMap(const std::string& text) {
    test::device();
    Scene scene;
    auto field = std::make_shared<sdf::FieldScene>(sdf::loadGlslMap(text, "a.map.glsl"));
    field->far = kFar, field->glsl->time = 0.5;
    scene.field = field;
    ResolvedCamera camera;
    camera.camera.yfov = 2.0 * std::atan(kHalfHeight);
    camera.camera.world_from_camera[3] = glm::dvec4(0, 0, kEye, 1);
    camera.camera_from_world = glm::inverse(camera.camera.world_from_camera);
    Film film;
    film.width = film.height = kSize, film.crop = {0, 0, kSize, kSize};
    const Prefilter filter;
    const RenderOptions options;
    Progress progress;
    const MethodInput input{scene, camera, film, filter, options, progress};
    FieldWindow window;
    window.pixels = film.crop;
    return makeVulkanFieldTracer(input, {})->trace(window);
}

glm::dvec3 directionOf(int x, int y) {
    const double side = 2.0 * kHalfHeight / kSize;
    return glm::normalize(glm::dvec3((x + 0.5 - kSize / 2) * side, -(y + 0.5 - kSize / 2) * side, -1.0));
}

/// The least depth where the field is below `level`, by steps that its bound allows; infinite without one.
double depthBelow(const Field& field, const glm::dvec3& direction, double level) {
    const glm::dvec3 eye(0, 0, kEye);
    double t = 0.0;
    for (int i = 0; i < 100000 && t < kFar; ++i) {
        const double value = field(eye + t * direction);
        if (value < level) return t;
        t += 0.5 * std::max(value, 1e-4);
    }
    return INFINITY;
}

/// A ray is judged where the field in double leaves no doubt: what goes deeper than a hundredth must be a
/// hit, not before the half pixel within which rays end begins, and not behind the surface; what stays two
/// half pixels away must be a miss.
void expectSameRays(const std::string& name, const std::string& text, const Field& field) {
    const FieldSamples samples = traceMap(text);
    int hits = 0, misses = 0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const double depth = samples.depth[static_cast<std::size_t>(y) * kSize + x];
            const glm::dvec3 direction = directionOf(x, y);
            constexpr double kHalfPixel = kHalfHeight / kSize;  // at a distance of 1
            if (depthBelow(field, direction, 2.0 * kHalfPixel * (kEye + 2.0)) == INFINITY) {
                EXPECT_EQ(depth, INFINITY) << name << " at " << x << "," << y;
                ++misses;
            }
            if (depthBelow(field, direction, -0.01) == INFINITY) continue;
            const double last = depthBelow(field, direction, 0.0);
            const double first = depthBelow(field, direction, kHalfPixel * last);
            constexpr double kRounding =
                1e-4;  // depthBelow's least step at most; float's is 2^-24 of 4 a step
            EXPECT_LE(depth, last + kRounding) << name << " at " << x << "," << y;
            EXPECT_GE(depth, first - kRounding) << name << " at " << x << "," << y;
            ++hits;
        }
    }
    EXPECT_GT(hits, kSize * kSize / 12) << name;
    EXPECT_GT(hits + misses, kSize * kSize / 3) << name;
}

double ball(glm::dvec3 p) {
    return glm::length(p) - 1.0;
}

using UserMap = test::DeviceTest;

TEST_F(UserMap, StylesOfABall) {
    const std::string plain = "float map(vec3 p) { return length(p) - 1.; }\n";
    const std::pair<const char*, std::string> styles[] = {
        {"WebGL 1",
         "#ifdef GL_ES\nprecision mediump float;\n#endif\n#extension GL_OES_standard_derivatives : enable\n"
         "uniform float time;\nuniform vec2 mouse, resolution;\nvarying vec2 vUv;\n"
         "float sample(vec3 p) { return length(p) - 1; }\nfloat buffer = 0.0, shared = 1.0;\n"
         "float map(vec3 p) { float input = sample(p), filter = 1, half = 0.5; vec3 patch = vec3(0);\n"
         "  return input * filter * shared + buffer + patch.x * half; }\n"
         "void main(void) { gl_FragColor = texture2D(tex, gl_FragCoord.xy / resolution); }"},
        {"WebGL 2",
         "#version 300 es\nprecision highp float;\nuniform vec3 iResolution; uniform float iTime, zoom;\n"
         "layout(location = 0) out vec4 o;\nlayout(std140) uniform Block { float a; vec3 b; };\n"
         "uniform vec4 arr[4]; in vec2 uv;\nfloat map(vec3 p) { return length(p) - iTime * 2. + zoom + "
         "arr[1].y; }"},
        {"a mark and CRLF",
         "\xEF\xBB\xBF#version 450 core // \xC3\xA9\r\n#define F(a) \\\r\n  ((a) + \\\r\n  0.)\r\n"
         "float map(vec3 p) { return F(length(p)) - 1.; }\r\n"},
        {"CR", "// old\rfloat map(vec3 p) {\r return length(p) - 1.; }\r"},
        {"licence first", "/* mine */ #version 300 es\n" + plain},
        {"const parameter", "float map(const in highp vec3 p) { return length(p) - 1.; }"},
        {"own built-ins",
         "float round(float x) { return floor(x + .5); }\nfloat tanh(float x) { return x; }\n"
         "mat3 transpose(mat3 m) { return m; }\n"
         "float map(vec3 p) { return length(transpose(mat3(1)) * p) - 1. + tanh(0.) * round(p.x); }"},
        {"array types",
         "float[2] two(vec3 p) { return float[2](p.x, p.y); }\nconst float radii[] = float[](3., 1.);\n"
         "float map(vec3 p) { float[2] a = two(p); return length(vec3(a[0], a[1], p.z)) - radii[1]; }"},
        {"a table",
         "const int perm[12] = int[12](3, 1, 4, 1, 5, 9, 2, 6, 5, 3, 5, 8);\n"
         "float map(vec3 p) { int i = int(p.y > 9.); return length(p) - float(perm[perm[i + 2] + 3]) / 6. + "
         "float(perm[1] - 1); }"},
        {"structs, inout, switch",
         "struct Hit { float d; int id; } none;\nvoid turn(inout vec3 p, out float s) { s = p.x; p = p.yxz; "
         "}\n"
         "Hit world(vec3 p) { float s; turn(p, s); Hit h = Hit(length(p) - 2., 1);\n"
         " switch (h.id) { case 1: h.d += 1.; break; default: break; } return h; }\n"
         "float map(vec3 p) { return world(p).d; }"},
        {"globals",
         "float glow = 0.; vec4 orbitTrap;\nfloat map(vec3 p) { float d = length(p) - 1.; glow += d;\n"
         " orbitTrap = min(orbitTrap, vec4(d)); return d; }\nvec3 albedo(vec3 p, vec3 n) { return "
         "orbitTrap.xyz; }"},
        {"loops",
         "float map(vec3 p) { float d = length(p) - 1.; int n = int(3. + 0. * p.x);\n"
         " for (int i = 0; i < n; ++i) { if (i == 1) continue; d += .5; } do { n -= 1; } while (n > 0);\n"
         " while (true) { if (d > -1e9) break; } for (int i = 0;; i++) if (i > 5) break; return d - 1.; }"},
        {"our names",
         "float fieldAt(vec3 p) { return length(p); }\nfloat unite(float a, float b) { return min(a, b); }\n"
         "float trace(vec3 o, vec3 d) { return 1.; }\nfloat map(vec3 p) { return unite(fieldAt(p) - 1., "
         "1e9); }"},
        {"a whole shader",
         "vec2 scene(vec3 p) { return vec2(length(p) - 1., 2.); }\nfloat map(vec3 p) { return scene(p).x; }\n"
         "vec2 map(vec3 p, float t) { return scene(p + t); }\n"
         "vec3 env(vec3 d) { return texture(iChannel1, d).rgb * fwidth(d.x); }\n"
         "void mainImage(out vec4 c, in vec2 f) { c = vec4(env(vec3(f / iResolution.xy, iMouse.x)), 1.); }"},
        {"pasted names",
         "#define CAT(a, b) a##b\nfloat sphA(vec3 p) { return length(p) - 1.; }\n"
         "float map(vec3 p) { return CAT(sph, A)(p); }"},
        {"#line, #pragma, #if",
         "#pragma optimize(on)\n#line 90\n#if HW_PERFORMANCE == 0 || defined(NEVER)\n" + plain + "#endif"},
    };
    for (const auto& [name, text] : styles) expectSameRays(name, text, ball);
}

TEST_F(UserMap, SmoothMinimum) {
    expectSameRays("smooth minimum",
                   "#define sat(x) clamp(x, 0., 1.)\n"
                   "float smin(float a, float b, float k) { float h = sat(.5 + .5 * (b - a) / k);\n"
                   "  return mix(b, a, h) - k * h * (1. - h); }\n"
                   "mat2 rot(float a) { return mat2(cos(a), sin(a), -sin(a), cos(a)); }\n"
                   "float map(vec3 p) { p.xy *= rot(iTime - .5); return smin(length(p) - .7, length(p - "
                   "vec3(.8, 0, 0)) - .4, .3); }",
                   [](glm::dvec3 p) {
                       const double a = glm::length(p) - 0.7,
                                    b = glm::length(p - glm::dvec3(0.8, 0, 0)) - 0.4;
                       const double h = std::clamp(0.5 + 0.5 * (b - a) / 0.3, 0.0, 1.0);
                       return b + (a - b) * h - 0.3 * h * (1.0 - h);
                   });
}

TEST_F(UserMap, FoldedFractal) {
    expectSameRays("fold",
                   "const int N = 3;\nfloat map(vec3 z) { float s = 1.; for (int i = 0; i < N; i++) {\n"
                   "  z = abs(z) - vec3(.5); if (z.x < z.y) z.xy = z.yx; z *= 1.5; s *= 1.5; }\n  return "
                   "(length(z) - 1.) / s; }",
                   [](glm::dvec3 z) {
                       double s = 1.0;
                       for (int i = 0; i < 3; ++i) {
                           z = glm::abs(z) - 0.5;
                           if (z.x < z.y) std::swap(z.x, z.y);
                           z *= 1.5, s *= 1.5;
                       }
                       return (glm::length(z) - 1.0) / s;
                   });
}

std::string refusal(const std::string& text) {
    try {
        traceMap(text);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "taken";
}

TEST_F(UserMap, FaultsNameTheFilesLineAndTheRule) {
    const std::string textures =
        ": a map has no textures or images; only functions that it does not call may use them";
    EXPECT_EQ(refusal("float map(vec3 p) {\n return p.y - texture(iChannel0, p.xz).x; }"),
              "a.map.glsl: line 2: texture" + textures);
    EXPECT_EQ(refusal("uniform sampler2D t;\nfloat h(vec2 p) {\n return texture2D(t, p).x; }\n"
                      "float map(vec3 p) { return h(p.xy); }"),
              "a.map.glsl: line 3: texture2D" + textures);
    EXPECT_EQ(refusal("float map(vec3 p) {\n if (p.x > 0.) barrier();\n return 1.; }"),
              "a.map.glsl: line 2: barrier: a map is a function of its position alone: it shares no memory");
    EXPECT_EQ(refusal("float map(vec3 p) { return\n gl_FragCoord.x; }"),
              "a.map.glsl: line 2: gl_FragCoord: a map is a function of its position alone: it has no "
              "fragments and no "
              "stages");
    EXPECT_EQ(refusal("float f(vec3 p);\nfloat g(vec3 p) { return f(p); }\nfloat f(vec3 p) { return g(p); }\n"
                      "float map(vec3 p) { return f(p); }")
                  .substr(22),
              "calls itself, which GLSL does not allow");
    EXPECT_EQ(refusal("\nfloat f(vec3 p);\nfloat map(vec3 p) { return f(p); }"),
              "a.map.glsl: line 2: f is declared and called, and has no body");
    EXPECT_EQ(refusal("float map(vec3 p[2]) { return 1.; }"),
              "a.map.glsl: line 1: map is not `float map(vec3 p)`");
    EXPECT_EQ(refusal("#line 500 7\nfloat map(vec3 p) {\n return q; }"),
              "a.map.glsl: line 3: 'q' : undeclared identifier");
    EXPECT_EQ(refusal("// a \\\nfloat b;\n#define A(x) \\\n  (x)\nfloat map(vec3 p) {\n return A(1.) +; }"),
              "a.map.glsl: line 6: syntax error, unexpected SEMICOLON");
}

TEST_F(UserMap, LoopsOfColoursAreCountedToo) {
    EXPECT_NE(
        refusal("float map(vec3 p) { return length(p) - 1.; }\nvec3 albedo(vec3 p, vec3 n) {\n for (;;);\n "
                "return n; }")
            .find("line 3: a loop without end"),
        std::string::npos);
}

TEST_F(UserMap, WhatGrowsWithoutEndIsALimit) {
    const std::string words = "with its macros replaced the text has more than 250000 words and signs";
    std::string objects = "#define A0 p.x +\n", calls = "#define D0(x) ((x) + (x))\n",
                functions = "float f0(vec3 p) { return p.x * p.y; }\n";
    for (int i = 1; i < 40; ++i) {
        objects += fmt::format("#define A{} A{} A{} A{}\n", i, i - 1, i - 1, i - 1);
        calls += fmt::format("#define D{}(x) D{}(D{}(x))\n", i, i - 1, i - 1);
        functions += fmt::format("float f{0}(vec3 p) {{ return f{1}(p) + f{1}(p.yzx); }}\n", i, i - 1);
    }
    const std::string at_41 = "a.map.glsl: line 41: ";
    EXPECT_EQ(refusal(objects + "float map(vec3 p) { return A39 0.; }"), at_41 + words);
    EXPECT_EQ(refusal(calls + "float map(vec3 p) { return D39(p.x); }"), at_41 + words);
    EXPECT_EQ(refusal(objects + "#if A39 0\n#endif\nfloat map(vec3 p) { return 1.; }"), at_41 + words);
    std::string passed = "1.";
    for (int i = 0; i < 30; ++i) passed = "AP(T, " + passed + ")";
    EXPECT_EQ(
        refusal("#define T(x) x x\n#define AP(f, x) f(f(x))\nfloat map(vec3 p) { return " + passed + "; }"),
        "a.map.glsl: line 3: " + words);
    EXPECT_NE(refusal(functions + "float map(vec3 p) { return f39(p); }").find("the map is too long: "),
              std::string::npos);
    EXPECT_NE(refusal("float a[2000000];\nfloat map(vec3 p) { a[int(p.x)] = p.y; return a[int(p.y)]; }")
                  .find("the map's arrays take 2e+06 words of 4 bytes, more than"),
              std::string::npos);
    EXPECT_EQ(
        refusal("float map(vec3 p) { return " + std::string(300, '(') + "1." + std::string(300, ')') + "; }"),
        "a.map.glsl: line 1: brackets nest deeper than 250");
}

}  // namespace
}  // namespace edgewise::vulkan
