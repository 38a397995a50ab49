// --dump-stages: every intermediate of the analytic pipeline as data (CSV) and as a picture (PNG).
#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "pipeline/cell_grid.h"
#include "pipeline/image_buffer.h"
#include "pipeline/methods/method.h"
#include "pipeline/weights.h"

namespace edgewise {

/// A colour that tells a triangle from its neighbours; the background is black.
glm::dvec3 ownerColor(Owner owner);
/// The layers of a stack front to back, joined by slashes.
std::string ownerText(const Owner& owner, const LayerStacks& stacks);

/// Collects what the stages hand over and writes, into its folder:
///     plan.csv       stage, runs, why
///     screen.csv     the screen triangles: index, vertices, depth plane
///     gather.csv     cells: position, list length, list offset      gather.png    list lengths, brighter is
///     longer segments.csv   line ends and owners                           segments.png  segments over the
///     owners weights.csv    pixel, owner, weight                           weights.png   owners a pixel,
///     brighter is more
/// Does nothing without a folder. Bands add to the same files.
class StageDump {
  public:
    StageDump(const std::optional<std::filesystem::path>& folder, const PixelBox& crop);

    bool active() const { return folder_.has_value(); }
    void plan(const std::vector<PlanEntry>& entries);
    void screen(const ScreenScene& scene);
    void gather(const CellGrid& grid, const IdLists& lists);
    void segments(const VisibleMap& map, const PixelBox& band, glm::dvec2 offset_px);
    /// From any thread; `stacks` names the tile's owners of several layers.
    void weights(const WeightTile& tile, const LayerStacks& stacks);
    /// Writes all files.
    void finish();

  private:
    void write(const std::string& name, const std::string& text) const;
    void write(const std::string& name, const ImageBuffer& picture) const;

    std::optional<std::filesystem::path> folder_;
    std::mutex mutex_;
    std::string gather_csv_, segments_csv_;
    std::vector<std::string> weight_rows_;  ///< one a pixel: their order does not depend on threads
    ImageBuffer lengths_, owners_, counts_;
    PixelBox crop_;
};

}  // namespace edgewise
