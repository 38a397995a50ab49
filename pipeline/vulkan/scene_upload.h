// What shading on the device reads of a scene: flat tables, and the buffers that hold them. What a scene does
// not use is not in them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "analytic/layer_stacks.h"
#include "pipeline/shade.h"
#include "pipeline/vulkan/buffer.h"
#include "pipeline/vulkan/layouts.h"

namespace edgewise::vulkan {

/// What a picture's shading starts from; only read while the tables are made.
struct ShadedScene {
    const Scene& scene;
    const ResolvedCamera& camera;
    const Film& film;
    const ScreenScene& screen;
    const ScreenPieces& pieces;
    const Shading& shading;
    const std::vector<std::optional<Shade>>& constant;  ///< Plan::constant
    glm::dvec3 background{0.0};
    bool points = false;  ///< entries come with ShadingPoints
};

/// Records and streams of layouts.glsl.
struct ShadeTables {
    std::uint32_t uses = 0;  ///< kUsesTable ...
    ShadeFrame frame{};
    std::vector<OwnerRecord> owners;
    std::vector<double> table;  ///< 4 a colour that cannot vary
    std::vector<SurfaceRecord> surfaces;
    std::vector<MaterialRecord> materials;
    std::vector<MapRecord> maps;
    std::vector<LevelRecord> levels;
    std::vector<LightRecord> lights;
    std::vector<double> positions, attributes, plane_normals;
    std::vector<std::vector<glm::vec4>> banks;  ///< of texels; all but the last are full
    std::size_t most_turns = 0;                 ///< of loops, for one layer
};

ShadeTables makeShadeTables(const ShadedScene& from);

/// Why the device cannot shade this scene, in words; nullopt: it can.
std::optional<std::string> whyNotShaded(const ShadeTables& tables, const DeviceTraits& traits);

/// The tables in device memory, by binding of shade.comp.
class SceneUpload {
  public:
    SceneUpload(const Device& device, const ShadeTables& tables);

    /// Where the scene has none, a buffer that no invocation reads.
    const Buffer& at(int binding) const { return buffers_[binding] ? *buffers_[binding] : nothing_; }
    std::size_t bytes() const;

  private:
    std::array<std::optional<Buffer>, kShadeBindings> buffers_;
    Buffer nothing_;
};

/// The stacks of one map as shade.comp reads them.
struct StackTables {
    explicit StackTables(const LayerStacks& stacks);
    std::vector<std::uint32_t> first, layers;
};

}  // namespace edgewise::vulkan
