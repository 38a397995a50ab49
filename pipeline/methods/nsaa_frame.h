// The frame around the devices' stages: the projected scene, the plan, the bands, shading, AOVs, dumps, the
// result.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "pipeline/aov.h"
#include "pipeline/bands.h"
#include "pipeline/dump_stages.h"
#include "pipeline/methods/nsaa.h"
#include "pipeline/methods/stopwatch.h"
#include "pipeline/plan.h"
#include "pipeline/shade_groups.h"

namespace edgewise {

/// What the owners of a map's weights are.
struct MapOwners {
    MapOwners(const OwnerClasses& triangles, const VisibleMap& map)
        : classes(triangles.ofMap(map.stacks, stacks)) {}
    LayerStacks stacks;
    OwnerClasses classes;
};

/// Those that shade alike as one, for the picture; and each by itself, for the AOVs.
struct BandOwners {
    BandOwners(const OwnerClasses& triangles, const VisibleMap& map, bool apart) : alike(triangles, map) {
        if (apart) each.emplace(OwnerClasses{}, map);
    }
    MapOwners alike;
    std::optional<MapOwners> each;
};

class NsaaFrame;

/// The stages from gather to blend, as one device makes them.
class NsaaStages {
  public:
    virtual ~NsaaStages() = default;

    /// Gather and visibility of the grid's cells.
    virtual VisibleMap visibleMap(NsaaFrame& frame, const CellGrid& grid) = 0;

    /// Weights, shade and blend of a band into the frame's image; `map` is the last that visibleMap() gave.
    virtual void render(NsaaFrame& frame, const VisibleMap& map, const BandOwners& owners,
                        const PixelBox& band) = 0;

    /// The weights of a box, likewise.
    virtual WeightTile weights(NsaaFrame& frame, const VisibleMap& map, const OwnerClasses& classes,
                               const PixelBox& box) = 0;
};

/// One picture. Members are for the stages.
class NsaaFrame {
  public:
    explicit NsaaFrame(const MethodInput& in, bool by_edges = false);

    MethodResult render(NsaaStages& stages);
    PixelReport report(NsaaStages& stages, int x, int y);
    /// The visible map of each band from the top, and the band.
    void forEachBand(NsaaStages& stages,
                     const std::function<void(const VisibleMap& map, const PixelBox& band)>& visit);

    using Offsets = std::span<const glm::dvec2>;
    glm::dvec2 offset() const { return in.film.debug_offset_px; }

    /// The mean of whole stacks: their layers' opacities belong together.
    Shade shade(std::span<const Owner> layers, glm::dvec2 sample_px, Offsets offsets,
                Shading::Memo& memo) const;
    Shade shade(std::span<const Owner> layers, glm::dvec2 sample_px, Offsets offsets) const {
        return shade(layers, sample_px, offsets, memos_.local());
    }
    /// Blends the tile into the image.
    void blendTile(const WeightTile& tile, const LayerStacks& stacks);
    void bookSeconds(const std::string& name, double seconds);
    /// Throws FailureError where --memory does not suffice.
    Bands cutIntoBands(const PixelBox& crop);
    /// The triangles of the grid's cells, each list in ascending order.
    IdLists gatherOnHost(const CellGrid& grid);
    /// Where no host asks for them.
    void dropLists() { crop_lists_.reset(); }

    const MethodInput& in;
    MethodResult result;
    Stopwatch watch;
    ScreenPieces pieces;
    ScreenScene screen;
    Shading shading;
    Plan plan;
    AovPass aov;
    StageDump dump;
    VisibilityCounts visibility_counts;
    std::map<std::string, std::uint64_t> counts;

  private:
    struct TileShades {
        Shading::Groups groups;
        std::vector<Shade> by_entry;  ///< where known() has none
    };
    VisibleMap visibleMapOf(NsaaStages& stages, const PixelBox& box);
    void renderBand(NsaaStages& stages, const VisibleMap& map, const PixelBox& band);
    void reportOwner(std::span<const Owner> layers, FixedWeight fixed, glm::dvec2 sample, Offsets offsets,
                     PixelReport& out) const;
    Shade shadeTriangle(Owner owner, glm::dvec2 sample_px, Shading::Memo& memo) const;
    Shade shadeAt(std::span<const Owner> layers, glm::dvec2 sample_px, Shading::Memo& memo) const;
    const Shade* known(Owner owner) const;
    void shadeTile(const WeightTile& tile, const LayerStacks& stacks, TileShades& shades);
    std::size_t residentBytes() const;
    void fillCounts(std::size_t bands);

    Shade background_;
    std::size_t open_boundaries_ = 0;
    std::optional<IdLists> crop_lists_;  ///< what the bands were cut by, until a band is the whole crop
    mutable tbb::enumerable_thread_specific<Shading::Memo> memos_;
    tbb::enumerable_thread_specific<TileShades> tile_shades_;
};

/// Says how far the picture is where it is made in several bands.
std::string nameOf(const PixelBox& band, const PixelBox& crop);

/// The grid of cells that the supports of a box's samples look at.
CellGrid cellsAround(const PixelBox& box, glm::dvec2 offset_px, const Prefilter& filter);

}  // namespace edgewise
