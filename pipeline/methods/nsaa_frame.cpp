#include "pipeline/methods/nsaa_frame.h"

#include <fmt/format.h>

#include <cmath>

#include "analytic/open_boundaries.h"
#include "pipeline/blend.h"
#include "pipeline/composite.h"
#include "pipeline/gather.h"
#include "pipeline/methods/aov_report.h"

namespace edgewise {
namespace {

/// Supports end R from a sample; a pixel more keeps the window's own cuts out of every support.
double reachOf(const Prefilter& filter) {
    return filter.radius + 1.0;
}

Window windowOf(const PixelBox& box, glm::dvec2 offset_px, double reach) {
    return {static_cast<int>(std::floor(box.x0 + offset_px.x - reach)),
            static_cast<int>(std::floor(box.y0 + offset_px.y - reach)),
            static_cast<int>(std::ceil(box.x1 + offset_px.x + reach)),
            static_cast<int>(std::ceil(box.y1 + offset_px.y + reach))};
}

}  // namespace

CellGrid cellsAround(const PixelBox& box, glm::dvec2 offset_px, const Prefilter& filter) {
    return CellGrid(windowOf(box, offset_px, reachOf(filter)));
}

std::string nameOf(const PixelBox& band, const PixelBox& crop) {
    if (band.height() == crop.height()) return "weights";
    return fmt::format("weights to row {} of {}", band.y1 - crop.y0, crop.height());
}

NsaaFrame::NsaaFrame(const MethodInput& input, bool by_edges)
    : in(input),
      screen(project(in.scene, in.camera, in.film, pieces, in.progress)),
      shading(in.scene, in.camera, in.film, screen, pieces),
      aov(in.options.aovs, in.scene, in.camera, in.film, screen, pieces, shading),
      dump(in.options.dump_dir, in.film.crop),
      background_{in.options.background, 0.0} {
    watch.book("project", result.stages);
    checkCancelled(in.progress);
    in.progress.stage("plan", 0);
    plan = makePlan(in.scene, screen, pieces, shading, in.options);
    plan.visibility.film_offset_px = offset();
    if (by_edges) planByEdges(screen, plan);
    watch.book("plan", result.stages);
    dump.screen(screen);
    dump.plan(plan.entries);
}

MethodResult NsaaFrame::render(NsaaStages& stages) {
    result.image = ImageBuffer(in.film.crop);
    aov.begin(result.image);
    std::size_t band_count = 0;
    forEachBand(stages, [&](const VisibleMap& map, const PixelBox& band) {
        renderBand(stages, map, band);
        ++band_count;
    });
    aov.samplePoints(in.progress, result.image);
    if (aov.pointSamples()) watch.book("aov", result.stages);
    dump.finish();
    result.plan = plan.entries;
    if (in.options.shading.mode == ShadingMode::kHit)
        result.notes.emplace_back("nsaa has no samples that hit: shaded at the closest point");
    fillCounts(band_count);
    return std::move(result);
}

void NsaaFrame::forEachBand(NsaaStages& stages,
                            const std::function<void(const VisibleMap& map, const PixelBox& band)>& visit) {
    Bands bands = cutIntoBands(in.film.crop);
    for (auto band = bands.next(); band; band = bands.next()) {
        checkCancelled(in.progress);
        const std::uint64_t before = visibility_counts.pieces;
        visit(visibleMapOf(stages, *band), *band);
        bands.made(visibility_counts.pieces - before);
    }
}

PixelReport NsaaFrame::report(NsaaStages& stages, int x, int y) {
    plan.classes.representative.clear();
    const PixelBox box{x, y, x + 1, y + 1};
    cutIntoBands(box);  // throws where --memory does not suffice
    const VisibleMap map = visibleMapOf(stages, box);
    const MapOwners owners(plan.classes, map);
    const WeightTile tile = stages.weights(*this, map, owners.classes, box);
    PixelReport out;
    FixedWeight sum = 0;
    for (std::size_t e = 0; e < tile.entries.size(); ++e) {
        const OwnerWeight& entry = tile.entries[e];
        sum += entry.weight;
        reportOwner(owners.stacks.layersOf(entry.owner), entry.weight,
                    glm::dvec2(x + 0.5, y + 0.5) + offset(), tile.points.of(e), out);
    }
    out.sum = std::ldexp(static_cast<double>(sum), -kWeightBits);
    return out;
}

VisibleMap NsaaFrame::visibleMapOf(NsaaStages& stages, const PixelBox& box) {
    const CellGrid grid = cellsAround(box, offset(), in.filter);
    VisibleMap map = stages.visibleMap(*this, grid);
    counts["segments"] += map.segments.size();
    counts["stacks"] += map.stacks.size();
    if (plan.visibility.cell.by_edges) {
        open_boundaries_ += openBoundaries(map, grid.px);
        watch.book("check", result.stages);
    }
    return map;
}

void NsaaFrame::renderBand(NsaaStages& stages, const VisibleMap& map, const PixelBox& band) {
    const BandOwners owners(plan.classes, map, aov.weighs() && !plan.classes.representative.empty());
    dump.segments(map, band, offset());
    stages.render(*this, map, owners, band);
}

void NsaaFrame::reportOwner(std::span<const Owner> layers, FixedWeight fixed, glm::dvec2 sample,
                            Offsets offsets, PixelReport& out) const {
    Shading::Memo memo;
    requireShadable(layers, sample - offset());
    const double weight = std::ldexp(static_cast<double>(fixed), -kWeightBits);
    const auto add = [&](std::size_t k, double share, const glm::dvec3& color) {
        out.owners.push_back({layers[k], weight * share, color, {layers.begin(), layers.begin() + k + 1}});
    };
    const auto shade = [&](Owner o) {
        return offsets.size() > 1 ? shading.mean(o, sample, offsets)
                                  : shadeTriangle(o, offsets.empty() ? sample : sample + offsets[0], memo);
    };
    out.background += weight * throughLayers(layers, shade, add);
}

Shade NsaaFrame::shadeTriangle(Owner owner, glm::dvec2 sample_px, Shading::Memo& memo) const {
    if (!plan.constant.empty() && plan.constant[owner]) return *plan.constant[owner];
    return shading.closest(owner, sample_px, memo);
}

Shade NsaaFrame::shadeAt(std::span<const Owner> layers, glm::dvec2 sample_px, Shading::Memo& memo) const {
    requireShadable(layers, sample_px - offset());
    return composite(
        layers, [&](Owner o) { return shadeTriangle(o, sample_px, memo); }, in.options.background);
}

Shade NsaaFrame::shade(std::span<const Owner> layers, glm::dvec2 sample_px, Offsets offsets,
                       Shading::Memo& memo) const {
    const auto constant = [&](Owner o) {
        return o == kBackground || (!plan.constant.empty() && plan.constant[o]);
    };
    if (offsets.empty() || std::all_of(layers.begin(), layers.end(), constant))
        return shadeAt(layers, sample_px, memo);
    Shade sum{glm::dvec3(0.0), 0.0};
    for (const glm::dvec2& offset : offsets) {
        const Shade one = shadeAt(layers, sample_px + offset, memo);
        sum.color += one.color, sum.alpha += one.alpha;
    }
    const auto count = static_cast<double>(offsets.size());
    return {sum.color / count, sum.alpha / count};
}

/// An entry's shade that no sample decides. What ends a view is there whole: of other alphas composite()
/// makes 1.
const Shade* NsaaFrame::known(Owner owner) const {
    if (owner == kBackground) return &background_;
    if (isStack(owner) || plan.constant.empty()) return nullptr;
    const std::optional<Shade>& constant = plan.constant[owner];
    return constant && constant->alpha == 1.0 ? &*constant : nullptr;
}

/// The other entries' shades: single triangles that have no points go in groups.
void NsaaFrame::shadeTile(const WeightTile& tile, const LayerStacks& stacks, TileShades& shades) {
    Shading::Memo& memo = memos_.local();
    const bool points = !tile.points.end.empty();
    shades.by_entry.resize(tile.entries.size());
    shades.groups.begin(tile.entries.size());
    forEachEntry(tile, offset(), [&](std::size_t e, glm::dvec2 sample) {
        const Owner& owner = tile.entries[e].owner;
        if (known(owner)) return;
        if (isStack(owner) || (points && !tile.points.of(e).empty()))
            shades.by_entry[e] = shade(stacks.layersOf(owner), sample, tile.points.of(e), memo);
        else
            shades.by_entry[e].alpha = 1.0, shades.groups.add(owner, sample, static_cast<std::uint32_t>(e));
    });
    shades.groups.finish(shading, shades.by_entry);
}

void NsaaFrame::blendTile(const WeightTile& tile, const LayerStacks& stacks) {
    TileShades& shades = tile_shades_.local();
    shadeTile(tile, stacks, shades);
    const auto shadeOf = [&](std::size_t e) -> const Shade& {
        const Shade* shade = known(tile.entries[e].owner);
        return shade ? *shade : shades.by_entry[e];
    };
    blend(tile, shadeOf, result.image);
}

void NsaaFrame::bookSeconds(const std::string& name, double seconds) {
    for (StageTime& known : result.stages)
        if (known.name == name) return void(known.seconds += seconds);
    result.stages.push_back({name, seconds});
}

/// What stays as long as the picture is made: the image, the scene on the screen, the plan's tables.
std::size_t NsaaFrame::residentBytes() const {
    const auto bytes = [](const auto& items) { return items.size() * sizeof(items[0]); };
    return result.image.bytes() + bytes(screen.triangles) + bytes(screen.planes) + bytes(pieces.first) +
           bytes(pieces.back_facing) + bytes(pieces.plane_normal_eye) + bytes(plan.constant) +
           bytes(plan.classes.representative);
}

/// The other buffers share what --memory leaves.
Bands NsaaFrame::cutIntoBands(const PixelBox& crop) {
    checkCancelled(in.progress);
    in.progress.stage("gather", 0);
    const CellGrid grid = cellsAround(crop, offset(), in.filter);
    requireLattice(grid, in.options.memory_mib << 20);
    crop_lists_ = gather(screen, grid);
    const IdLists& lists = *crop_lists_;
    counts["cell_triangle_pairs"] = lists.ids.size();
    const std::size_t limit = in.options.memory_mib << 20;
    if (residentBytes() >= limit)
        throw FailureError("--memory", fmt::format("the image and the projected triangles alone need {} MiB",
                                                   (residentBytes() >> 20) + 1));
    watch.book("gather", result.stages);
    return Bands(crop, grid, lists, reachOf(in.filter), offset(), limit - residentBytes());
}

IdLists NsaaFrame::gatherOnHost(const CellGrid& grid) {
    const std::optional<IdLists> known = std::exchange(crop_lists_, std::nullopt);
    const bool whole = known && known->offsets.size() == grid.size() + 1;
    return whole ? *std::move(known) : gather(screen, grid);
}

void NsaaFrame::fillCounts(std::size_t bands) {
    counts["triangles"] = in.scene.triangle_count;
    counts["screen_triangles"] = screen.triangles.size();
    counts["bands"] = bands;
    counts["cells_swept"] = visibility_counts.cells;
    counts["cells_certified"] = visibility_counts.certified;
    counts["slabs"] = visibility_counts.slabs;
    counts["depth_lines"] = visibility_counts.depth_lines;
    counts["exact_depths"] = visibility_counts.exact_depth;
    counts["hidden_pairs"] = visibility_counts.hidden;
    if (plan.visibility.cell.by_edges) counts["open_boundaries"] = open_boundaries_;
    if (open_boundaries_ > 0)
        result.notes.push_back(fmt::format(
            "visibility=awj13 left {} boundaries of owners open: triangles pierce others, or touch "
            "them where they share no vertices",
            open_boundaries_));
    result.counts = counts;
    reportAovs(aov, result);
}

}  // namespace edgewise
