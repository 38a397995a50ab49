#include "pipeline/vulkan/field_shader.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "field_cones_text.h"
#include "field_field_text.h"
#include "field_finish_text.h"
#include "field_groups_text.h"
#include "field_header_text.h"
#include "field_lists_text.h"
#include "field_points_text.h"
#include "field_prune_main_text.h"
#include "field_prune_text.h"
#include "field_sdf_cone_step_text.h"
#include "field_sdf_trace_step_text.h"
#include "field_trace_state_text.h"
#include "field_trace_text.h"
#include "pipeline/vulkan/user_glsl.h"

namespace edgewise::vulkan {
namespace {

/// lavapipe stops the loops of invocations that run together, 8 of them, at 65,535 turns in all. Loops of a
/// user's map may differ from one invocation to the next: each has an eighth, with room for one evaluation
/// and its colour.
constexpr unsigned kMostUserTurns = 65535 / 8 - 2 * kUserTurns + kUserTurns;

std::string numbersText(const sdf::TraceSettings& s, const FieldShaders& made) {
    const auto flag = [](bool on) { return on ? "true" : "false"; };
    return fmt::format(
        "const int ew_relaxation = {};\n"
        "const uint ew_most_iterations = {}u, ew_discontinuity = {}u, ew_corners = {}u;\n"
        "const float ew_omega = {}, ew_threshold = {}, ew_inverse_lipschitz = {};\n"
        "const bool ew_screen_candidate = {}, ew_level_set = {}, ew_prepass = {};\n"
        "const uint ew_most_user_turns = {}u, ew_most_turns = {}u;\n",
        static_cast<int>(s.relaxation), std::max(s.most_steps, 1), std::max(s.discontinuity_steps, 0),
        made.corners(), sdf::glslNumber(s.omega), sdf::glslNumber(s.threshold),
        sdf::glslNumber(1.0 / made.lipschitz), flag(s.screen_candidate), flag(s.level_set), flag(s.prepass),
        kUserTurns, made.user_loops ? kMostUserTurns : 0xffffffffu);
}

/// The rules of coneRules(), but for the ray's own.
std::string conesText(const sdf::TraceSettings& trace, const sdf::ConeSettings& cones) {
    sdf::FieldRay unit;
    unit.pixel_radius = 1.0;
    const sdf::cones::ConeRules rules = sdf::coneRules(unit, trace, cones);
    return fmt::format(
        "const float ew_cone_scale = {}, ew_cone_alpha = {}, ew_cone_hard = {};\n"
        "const bool ew_cone_relaxed = {}, ew_cone_backtrace = {}, ew_cone_overstep = {};\n"
        "const uint ew_room = {}u;\n",
        sdf::glslNumber(rules.radius), sdf::glslNumber(rules.alpha), sdf::glslNumber(rules.hard),
        rules.relaxed, rules.backtrace, rules.overstep, groupsARound(cones));
}

bool isWord(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

/// What shared text declares: functions, constants and structs, each from a line's beginning.
std::set<std::string, std::less<>> namesDeclared(std::string_view text) {
    std::set<std::string, std::less<>> names;
    for (std::size_t at = 0; at < text.size(); at = std::min(text.find('\n', at), text.size() - 1) + 1) {
        const std::string_view line = text.substr(at, text.find('\n', at) - at);
        if (!line.starts_with("EDGEWISE_FN ") && !line.starts_with("const ") && !line.starts_with("struct "))
            continue;
        std::size_t end = std::min(line.find_first_of("(={"), line.size());
        while (end > 0 && !isWord(line[end - 1])) --end;
        std::size_t begin = end;
        while (begin > 0 && isWord(line[begin - 1])) --begin;
        names.emplace(line.substr(begin, end - begin));
    }
    return names;
}

/// Shared text as GLSL in which all names begin with ew_: a user's map may have its own of the same names.
std::string withOwnNames(std::string_view text) {
    const auto names = namesDeclared(text);
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        std::size_t end = at;
        while (end < text.size() && isWord(text[end])) ++end;
        const std::string_view word = text.substr(at, end - at);
        if (word == "real")
            result += "float";
        else if (word != "EDGEWISE_FN")
            result.append(names.contains(word) ? "ew_" : "").append(word);
        if (end < text.size()) result += text[end++];
        at = end;
    }
    return result;
}

template <class Each>
std::string arrayText(std::string_view name, std::size_t count, const Each& each) {
    std::string list;
    for (std::size_t i = 0; i < count; ++i) list += fmt::format("{}{}u", i ? ", " : "", each(i));
    return fmt::format("const uint {}[{}] = uint[]({});\n", name, count, list);
}

std::string batchesText(FieldShaders& made) {
    const std::vector<sdf::GlslBatch>& batches = made.field.batches;
    const auto fineRoom = [&](std::size_t i) { return std::min(batches[i].rows, kFieldListRows); };
    const auto coarseRoom = [&](std::size_t i) { return std::min(batches[i].rows, kFieldCoarseRows); };
    std::vector<std::uint32_t> all{0}, fine{0}, coarse{0};
    for (std::size_t i = 0; i < batches.size(); ++i) {
        all.push_back(all.back() + batches[i].rows);
        fine.push_back(fine.back() + 1 + fineRoom(i)), coarse.push_back(coarse.back() + 1 + coarseRoom(i));
    }
    made.fine_stride = fine.back();
    made.tile_stride = kFieldSegments * fine.back() + kFieldCoarseSegments * coarse.back();
    return fmt::format(
               "const uint ew_batches = {}u, ew_segments = {}u, ew_coarse = {}u;\n"
               "const uint ew_fine_stride = {}u, ew_coarse_stride = {}u, ew_tile_stride = {}u;\n"
               "uvec2 ew_range[{}];\n",
               batches.size(), kFieldSegments, kFieldCoarseSegments, fine.back(), coarse.back(),
               made.tile_stride, batches.size()) +
           arrayText("ew_all_begin", all.size(), [&](std::size_t i) { return all[i]; }) +
           arrayText("ew_fine_begin", fine.size(), [&](std::size_t i) { return fine[i]; }) +
           arrayText("ew_coarse_begin", coarse.size(), [&](std::size_t i) { return coarse[i]; }) +
           arrayText("ew_fine_room", batches.size(), fineRoom) +
           arrayText("ew_coarse_room", batches.size(), coarseRoom);
}

/// All that comes before a shader's own text, and the user's behind it.
struct FieldTexts {
    FieldShaders made;
    std::string head, user;

    std::vector<std::uint32_t> compile(const std::vector<std::string_view>& bodies) const {
        std::string text = head;
        for (const std::string_view body : bodies) text += body;
        return compileWithUserGlsl(text + "#undef fieldAt\n" + user, made.file);
    }
};

std::string tableText(const FieldShaders& made) {
    return made.uniform_table ? fmt::format(
                                    "#define EW_TABLE_BLOCK layout(std140, binding = {}) uniform\n"
                                    "#define EW_TABLE_LENGTH {}\n",
                                    kFieldTableBinding, made.field.table.size())
                              : fmt::format(
                                    "#define EW_TABLE_BLOCK layout(std430, binding = {}) readonly buffer\n"
                                    "#define EW_TABLE_LENGTH\n",
                                    kFieldTableBinding);
}

FieldTexts textsOf(const sdf::FieldScene& scene, const sdf::TraceSettings& settings, int width, int height,
                   const FieldTextRules& rules) {
    FieldTexts texts;
    FieldShaders& made = texts.made;
    if (scene.glsl) {
        UserGlsl user = prepareUserGlsl(*scene.glsl, width, height);
        made.user_loops = user.has_loops, made.user_albedo = user.has_albedo;
        made.lipschitz = scene.glsl->lipschitz;
        texts.user = std::move(user.text);
    } else {
        const sdf::Tape tape = lower(scene.tree);
        made.field = sdf::glslText(tape, rules.batches);
        made.lipschitz = tape.lipschitz;
    }
    const std::size_t table_bytes = made.field.table.size() * sizeof made.field.table.front();
    made.uniform_table = table_bytes > 0 && table_bytes <= rules.uniform_bytes;
    const bool batches = !made.field.batches.empty();
    std::string& head = texts.head;
    head = "#version 460\n" + numbersText(settings, made) + tableText(made);
    head += kField_header;
    if (batches) head += batchesText(made) + std::string(kField_lists);
    head += batches ? "#define EW_ROWS_AT(tile, t) ew_rowsAt(tile, t)\n#define EW_ALL_ROWS ew_allRows()\n"
                    : "#define EW_ROWS_AT(tile, t)\n#define EW_ALL_ROWS\n";
    if (scene.glsl)  // undefined again before the user's text, which may have a function of that name
        head += "#define fieldAt ew_map\nfloat map(vec3 p);\nfloat fieldAt(vec3 p) { return map(p); }\n";
    else
        head += made.field.text;
    head += made.user_albedo ? "vec3 albedo(vec3 p, vec3 n);\n"
                               "vec3 ew_albedoAt(vec3 p, vec3 n) {\n"
                               "    ew_user_turns = 0u;\n"
                               "    return albedo(p, n);\n"
                               "}\n"
                               "#define EW_ALBEDO(p, n) ew_albedoAt(p, n)\n"
                             : "#define EW_ALBEDO(p, n) vec3(0.0)\n";
    head += kField_field;
    made.file = scene.glsl ? scene.glsl->file : scene.source;
    return texts;
}

/// A CPU's compiler takes seconds for a thousand instructions of straight-line code, once, and runs it
/// several times as fast as rows of a table.
constexpr std::size_t kStraightInstructions = 513;

}  // namespace

FieldTextRules textRulesFor(const DeviceTraits& traits) {
    if (traits.real_gpu) return {};
    // lavapipe reads a storage buffer's elements one invocation after the other, a uniform buffer's in vector
    // code; on a GPU invocations that read different rows of a uniform buffer wait for each other.
    return {.batches = {.least_instructions = kStraightInstructions},
            .uniform_bytes = traits.max_uniform_bytes};
}

FieldShaders makeFieldShaders(const sdf::FieldScene& scene, const sdf::TraceSettings& settings, int width,
                              int height, bool prune, const sdf::ConeSettings* cones,
                              const FieldTextRules& rules) {
    FieldTexts texts = textsOf(scene, settings, width, height, rules);
    FieldShaders& made = texts.made;
    const std::string trace_step = withOwnNames(kField_sdf_trace_step);
    made.trace = texts.compile({trace_step, kField_trace_state, kField_trace});
    made.finish = texts.compile({trace_step, kField_trace_state, kField_finish});
    if (cones)
        made.groups =
            texts.compile({conesText(settings, *cones), withOwnNames(kField_sdf_cone_step), kField_groups});
    if (settings.prepass || prune) made.cones = texts.compile({kField_cones});
    if (!made.field.batches.empty() && prune)
        made.prune = texts.compile({kField_prune, made.field.prune_text, kField_prune_main});
    return std::move(made);
}

FieldShaders makePointShaders(const sdf::FieldScene& scene, int width, int height) {
    FieldTexts texts = textsOf(scene, {}, width, height, {});
    texts.made.points = texts.compile({kField_points});
    return std::move(texts.made);
}

}  // namespace edgewise::vulkan
