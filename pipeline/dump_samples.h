// --dump-stages of sampling methods: what every sample sees as data (CSV) and as a picture (PNG).
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "analytic/layer_stacks.h"
#include "analytic/screen_triangle.h"
#include "pipeline/image_buffer.h"

namespace edgewise {

/// Writes into its folder:
///     screen.csv     the screen triangles, as StageDump does
///     samples.csv    where each sample lies, px, and its owner
///     samples.png    a pixel's mean over its samples of the owners' false colours
/// Does nothing without a folder. Bands add to the same files.
class SampleDump {
  public:
    SampleDump(const std::optional<std::filesystem::path>& folder, const PixelBox& crop,
               const ScreenScene& screen);

    bool active() const { return folder_.has_value(); }
    /// A pixel's samples; `at_px` from its corner.
    void pixel(int x, int y, std::span<const glm::dvec2> at_px, std::span<const Owner> owners,
               const LayerStacks& stacks);
    /// Writes what pixels gave, if any did.
    void finish();

  private:
    std::optional<std::filesystem::path> folder_;
    PixelBox crop_;
    std::string rows_;
    ImageBuffer colors_;
};

}  // namespace edgewise
