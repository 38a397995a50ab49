// Generated GLSL on the device: its values against the double evaluator's, within what float may be off.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "pipeline/vulkan/compile_glsl.h"
#include "pipeline/vulkan/compute_pass.h"
#include "pipeline/vulkan/pass_graph.h"
#include "sdf/evaluate.h"
#include "sdf/glsl_text.h"
#include "tests/sdf/random_tree.h"
#include "tests/vulkan/test_device.h"

namespace edgewise::vulkan {
namespace {

using GlslOnDevice = test::DeviceTest;
using sdf::Kind;
using sdf::Tree;

struct Answer {
    float value;
    std::uint32_t material;
    float local[3];
};

/// Every row of every batch, and where each batch's begin and end.
std::vector<std::uint32_t> allRows(const sdf::GlslField& field, std::string& ranges) {
    std::vector<std::uint32_t> items;
    ranges = "uvec2 ew_range[] = uvec2[](";
    for (const sdf::GlslBatch& batch : field.batches) {
        ranges += fmt::format("{}uvec2({}, {})", items.empty() ? "" : ", ", items.size(),
                              items.size() + batch.rows);
        for (std::uint32_t row = 0; row < batch.rows; ++row) items.push_back(row);
    }
    ranges += ");\n";
    return items;
}

std::vector<Answer> evaluate(const sdf::GlslField& field, const std::vector<glm::vec3>& points,
                             bool uniform_table = false) {
    std::string ranges;
    std::vector<std::uint32_t> items = allRows(field, ranges);
    auto table = field.table;
    if (items.empty()) ranges.clear(), items.push_back(0), table.push_back({});
    const std::string text =
        std::string(
            "#version 460\nlayout(local_size_x = 64) in;\n"
            "layout(std430, binding = 0) readonly buffer A { float points[]; };\n"
            "layout(std430, binding = 1) writeonly buffer B { uint answers[]; };\n") +
        (uniform_table
             ? fmt::format("layout(std140, binding = 2) uniform C {{ uvec4 ew_table[{}]; }};\n", table.size())
             : "layout(std430, binding = 2) readonly buffer C { uvec4 ew_table[]; };\n") +
        "layout(std430, binding = 3) readonly buffer D { uint ew_items[]; };\n"
        "layout(push_constant) uniform P { uint count; };\nuint ew_turns = 0;\n" +
        ranges + field.text +
        "void main() {\n    uint i = gl_GlobalInvocationID.x;\n    if (i >= count) return;\n"
        "    vec3 p = vec3(points[3 * i], points[3 * i + 1], points[3 * i + 2]), q;\n"
        "    uint material = winnerAt(p, q);\n    answers[5 * i] = floatBitsToUint(fieldAt(p));\n"
        "    answers[5 * i + 1] = material;\n"
        "    for (int k = 0; k < 3; ++k) answers[5 * i + 2 + k] = floatBitsToUint(q[k]);\n}\n";
    const Device& device = test::device();
    const std::vector<std::uint32_t> words = compileGlsl(text);
    ComputePass pass(device, {"field", words},
                     BufferSlots(4, uniform_table ? std::optional<int>(2) : std::nullopt), 4);
    const Buffer in = bufferOf(device, "points", points), rows = bufferOf(device, "items", items),
                 numbers = bufferOf(device, "table", table);
    PassGraph graph(device);
    const Resource out = graph.buffer("answers", [&] { return points.size() * sizeof(Answer); });
    const auto count = static_cast<std::uint32_t>(points.size());
    graph.add("field",
              {.reads = {}, .writes = {out}, .record = [&](const PassContext& c) {
                   pass.dispatch(c.commands, {in, c[out], numbers, rows}, Groups::covering(count, 64), count);
               }});
    graph.run({out});
    const auto answers = graph[out].read<Answer>(points.size());
    return {answers.begin(), answers.end()};
}

std::vector<glm::vec3> randomPoints(sdf::RandomTree& random, std::size_t count) {
    std::vector<glm::vec3> points(count);
    for (glm::vec3& p : points)
        for (int k = 0; k < 3; ++k) p[k] = static_cast<float>(random.number(-2.0, 2.0));
    return points;
}

struct Seen {
    std::size_t points = 0, unsure = 0, materials_differ = 0;
    double worst = 0.0;  ///< error as a part of its bound
};

void expectAgreement(const sdf::Tape& tape, const std::vector<glm::vec3>& points,
                     const std::vector<Answer>& answers, Seen& seen) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        const sdf::RunningError bound = sdf::floatErrorAt(tape, points[i]);
        const double truth = sdf::valueAt(tape, glm::dvec3(points[i]));
        ++seen.points;
        if (!(bound.error < 0.01)) {
            ++seen.unsure;
            continue;
        }
        for (const double value : {double(answers[i].value), double(sdf::valueAt(tape, points[i]))}) {
            EXPECT_LE(std::abs(value - truth), bound.error) << "point " << i;
            seen.worst = std::max(seen.worst, std::abs(value - truth) / bound.error);
        }
        glm::dvec3 local;
        seen.materials_differ +=
            answers[i].material != sdf::winnerAt(tape, glm::dvec3(points[i]), local).material;
    }
}

TEST_F(GlslOnDevice, AgreesWithDoubleWithinRunningErrors) {
    constexpr std::uint64_t kSeed = 20240611;
    sdf::RandomTree random(kSeed);
    std::set<Kind> kinds;
    Seen seen;
    for (int i = 0; i < 120; ++i) {
        const Tree tree = random.make(i % 4);
        for (const sdf::Node& node : tree.nodes) kinds.insert(node.kind);
        const sdf::Tape tape = lower(tree);
        const std::vector<glm::vec3> points = randomPoints(random, 200);
        SCOPED_TRACE(fmt::format("seed {} tree {}", kSeed, i));
        expectAgreement(tape, points, evaluate(glslText(tape), points), seen);
    }
    fmt::print("seed {}: {} points, {} of unsure value, worst {:.2f} of its bound, {} other materials\n",
               kSeed, seen.points, seen.unsure, seen.worst, seen.materials_differ);
    for (const sdf::KindInfo& info : sdf::kindInfos()) EXPECT_TRUE(kinds.contains(info.kind)) << info.name;
    EXPECT_LT(seen.unsure, seen.points / 20);
    EXPECT_LT(seen.materials_differ, seen.points / 1000);
}

/// Batches: the loop's bits are those of the straight line.
TEST_F(GlslOnDevice, LoopsHaveTheBitsOfStraightLines) {
    sdf::RandomTree random(5);
    for (const Kind fold : {Kind::kUnion, Kind::kSmoothUnion, Kind::kIntersection, Kind::kDifference,
                            Kind::kSmoothDifference, Kind::kSmoothIntersection}) {
        Tree tree;
        std::vector<std::uint32_t> children;
        for (std::uint32_t i = 0; i < 50; ++i) {
            const std::uint32_t box =
                tree.add(Kind::kBox, {random.number(0.1, 1), random.number(0.1, 1), 0.5}, {}, i % 7);
            children.push_back(tree.add(Kind::kTranslate, {random.number(-1, 1), 0.5, random.number(-1, 1)},
                                        {tree.add(Kind::kRotate, {1, 0, 0, random.number(0, 90)}, {box})}));
        }
        const bool smooth = fold == Kind::kSmoothUnion || fold == Kind::kSmoothDifference ||
                            fold == Kind::kSmoothIntersection;
        const std::uint32_t inner =
            tree.add(fold, smooth ? std::vector<double>{0.2} : std::vector<double>{}, children);
        tree.root = tree.add(Kind::kTranslate, {0.1, 0.2, 0.3}, {inner});
        const sdf::Tape tape = lower(tree);
        const std::vector<glm::vec3> points = randomPoints(random, 1000);
        const sdf::GlslField looped = glslText(tape);
        ASSERT_EQ(looped.batches.size(), 1u);
        const std::vector<Answer> line = evaluate(glslText(tape, {.least_rows = 1000}), points);
        for (const bool uniform_table : {false, true}) {
            const std::vector<Answer> loop = evaluate(looped, points, uniform_table);
            for (std::size_t i = 0; i < points.size(); ++i) {
                ASSERT_EQ(loop[i].value, line[i].value);
                ASSERT_EQ(loop[i].material, line[i].material);
                ASSERT_TRUE(std::equal(loop[i].local, loop[i].local + 3, line[i].local));
            }
        }
    }
}

}  // namespace
}  // namespace edgewise::vulkan
