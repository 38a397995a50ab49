// The shaders that trace a scene's field: shaders/field/ put together around its generated or raw GLSL.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/vulkan/device_traits.h"
#include "sdf/cone_trace.h"
#include "sdf/field_scene.h"
#include "sdf/glsl_text.h"
#include "sdf/tape.h"
#include "sdf/trace_settings.h"

namespace edgewise::vulkan {

/// Segments of a tile's depths that have lists of their own, and longer ones that those are made from.
inline constexpr std::uint32_t kFieldSegments = 32, kFieldCoarseSegments = 4;
/// Rows of their lists; where more count, all do.
inline constexpr std::uint32_t kFieldListRows = 128, kFieldCoarseRows = 512;

/// Of a batch's rows, in every shader of a field.
inline constexpr int kFieldTableBinding = 5;

struct FieldShaders {
    /// SPIR-V; prune: empty without batches; groups: without ConeSettings; points: of makePointShaders()
    /// alone.
    std::vector<std::uint32_t> trace, finish, cones, prune, groups, points;
    sdf::GlslField field;  ///< empty text: a raw map
    std::string file;      ///< for messages
    bool user_loops = false, user_albedo = false;
    double lipschitz = 1.0;
    bool uniform_table = false;                      ///< the field's table is a uniform buffer
    std::uint32_t fine_stride = 0, tile_stride = 0;  ///< words of a fine segment's lists, of all of a tile's
    /// Evaluations after a hit that find a map's slope; trees have theirs in closed form.
    std::uint32_t corners() const { return field.text.empty() ? 4 : 0; }
    /// Of an evaluation, at most, in a dispatch's turns of loops.
    std::uint32_t turnsOfEvaluation() const { return field.rows() + 1; }
};

/// How a field's text suits a device.
struct FieldTextRules {
    sdf::BatchRule batches;         ///< what becomes a table with a loop
    std::size_t uniform_bytes = 0;  ///< a table of at most so many bytes is a uniform buffer
};
FieldTextRules textRulesFor(const DeviceTraits& traits);

/// Throws InputError for GLSL that does not compile.
FieldShaders makeFieldShaders(const sdf::FieldScene& scene, const sdf::TraceSettings& settings, int width,
                              int height, bool prune, const sdf::ConeSettings* cones = nullptr,
                              const FieldTextRules& rules = {});

/// What asks for values at points, and for nothing else. Throws the same.
FieldShaders makePointShaders(const sdf::FieldScene& scene, int width, int height);

/// Groups that a ray has room for before it pauses.
inline std::uint32_t groupsARound(const sdf::ConeSettings& cones) {
    return cones.shade_at_once ? 1 : 4;
}

}  // namespace edgewise::vulkan
