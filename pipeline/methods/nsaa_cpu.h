// The stages of nsaa on the CPU, on all threads.
#pragma once

#include "pipeline/methods/nsaa_frame.h"

namespace edgewise {

class CpuStages : public NsaaStages {
  public:
    VisibleMap visibleMap(NsaaFrame& frame, const CellGrid& grid) override;
    void render(NsaaFrame& frame, const VisibleMap& map, const BandOwners& owners,
                const PixelBox& band) override;
    WeightTile weights(NsaaFrame& frame, const VisibleMap& map, const OwnerClasses& classes,
                       const PixelBox& box) override;

  protected:
    /// A tile's weights are known: shades and blends it. From any thread.
    virtual void finishTile(NsaaFrame& frame, const BandOwners& owners, WeightTile& tile) {
        frame.blendTile(tile, owners.alike.stacks);
    }

  private:
    struct TileWorker;
    void renderTile(NsaaFrame& frame, const VisibleMap& map, const BandOwners& owners,
                    const WeightTiles& tiles, std::size_t t, TileWorker& worker);
    static void fillAovs(NsaaFrame& frame, const VisibleMap& map, const BandOwners& owners,
                         std::span<const std::uint32_t> ids, TileWorker& worker);
    template <class Workers>
    static void bookTiles(NsaaFrame& frame, Workers& workers, double wall);
};

}  // namespace edgewise
