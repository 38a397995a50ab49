#include "pipeline/vulkan/cone_bands.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

namespace edgewise::vulkan {

ConeBands::ConeBands(const sdf::RayGrid& grid, FieldBatches& batches, ConeRays& cones, std::size_t most,
                     double sign, bool map, std::function<bool()> cancelled, Shade shade)
    : grid_(grid),
      batches_(batches),
      cones_(cones),
      reach_(cones.reach()),
      most_(most),
      sign_(sign),
      map_(map),
      cancelled_(std::move(cancelled)),
      shade_(std::move(shade)) {}

std::size_t ConeBands::Band::sampleOf(std::size_t ray) const {
    const std::size_t across = (stride + kFieldTile - 1) / kFieldTile, tile = ray / kTileRays;
    const std::size_t column = tile % across * kFieldTile + ray % kFieldTile,
                      row = tile / across * kFieldTile + ray % kTileRays / kFieldTile;
    return column < stride && row < last - first ? row * stride + column : kNone;
}

FieldCones ConeBands::trace(const FieldWindow& window) {
    FieldCones out;
    out.begin.push_back(0);
    const std::size_t stride = window.stride(), rows = window.samples() / std::max<std::size_t>(stride, 1);
    const std::size_t tile_row = (stride + kFieldTile - 1) / kFieldTile * kFieldTile * kFieldTile;
    const std::size_t most = std::max<std::size_t>(1, most_ / tile_row) * kFieldTile;
    for (std::size_t first = 0; first < rows; first += most) {
        const std::size_t last = std::min(rows, first + most);
        Band band{first, last, stride, raysOf(grid_, window, first, last, sign_), {}};
        traceBand(band);
        add(band, out);
    }
    return out;
}

void ConeBands::traceBand(Band& band) {
    std::vector<GpuRay> asked(band.rays.size());
    tbb::parallel_for(std::size_t(0), asked.size() / kTileRays, [&](std::size_t tile) {
        for (std::size_t i = tile * kTileRays; i < (tile + 1) * kTileRays; ++i)
            asked[i] = batches_.askWithin(band.rays[i], reach_);
    });
    cones_.begin(asked, batches_.bounds(), cancelled_);
    while (cones_.goOn(cancelled_)) takeFull(band);
}

void ConeBands::takeFull(Band& band) {
    band.taken.resize(band.rays.size());
    std::vector<std::size_t> full;
    const auto states = cones_.states();
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (!cones_.full(states[i])) continue;
        const auto groups = cones_.groups();
        for (std::uint32_t k = 0; k < cones_.room(); ++k)
            band.taken[i].push_back({groups[k * states.size() + i].group()});
        full.push_back(i);
    }
    if (cones_.settings().shade_at_once) shadeTaken(band, full);
}

/// The last group of each.
void ConeBands::shadeTaken(Band& band, const std::vector<std::size_t>& rays) {
    std::vector<sdf::TravellingRay> through;
    std::vector<double> t;
    const auto states = cones_.states();
    for (const std::size_t i : rays)
        through.push_back(signedRay(band, i, states[i])), t.push_back(band.taken[i].back().group.t);
    const std::vector<glm::dvec4> colors = shade_(through, batches_.describe(through, t));
    for (std::size_t k = 0; k < rays.size(); ++k) band.taken[rays[k]].back().color = colors[k];
}

/// What cones have not paused at.
void ConeBands::shadeLast(const Band& band, FieldCones& out, std::size_t first_sample) {
    std::vector<sdf::TravellingRay> rays;
    std::vector<sdf::SurfaceHit> hits;
    std::vector<std::size_t> to;
    const auto states = cones_.states();
    for (std::size_t sample = 0; sample < band.samples(); ++sample) {
        const std::size_t ray = band.rayOf(sample), all = first_sample + sample;
        const std::uint32_t last = std::min(states[ray].groups(), out.begin[all + 1] - out.begin[all]);
        for (std::uint32_t g = out.begin[all + 1] - last; g < out.begin[all + 1]; ++g)
            rays.push_back(out.rays[all]), hits.push_back(out.surfaces[g]), to.push_back(g);
    }
    const std::vector<glm::dvec4> colors = shade_(rays, hits);
    for (std::size_t k = 0; k < to.size(); ++k) out.colors[to[k]] = colors[k];
}

void ConeBands::add(Band& band, FieldCones& out) {
    const auto states = cones_.states();
    const std::size_t samples = band.samples(), before = out.samples(), begin = out.begin.back();
    out.rays.resize(before + samples), out.evaluations.resize(before + samples);
    out.begin.resize(before + samples + 1);
    tbb::parallel_for(std::size_t(0), samples, [&](std::size_t sample) {
        const std::size_t ray = band.rayOf(sample);
        const std::size_t taken = band.taken.empty() ? 0 : band.taken[ray].size();
        out.begin[before + sample + 1] = static_cast<std::uint32_t>(
            std::min<std::size_t>(taken + states[ray].groups(), sdf::ConeHits::kMostGroups));
        out.evaluations[before + sample] = states[ray].evaluations;
        out.rays[before + sample] = signedRay(band, ray, states[ray]);
    });
    std::partial_sum(out.begin.begin() + static_cast<std::ptrdiff_t>(before), out.begin.end(),
                     out.begin.begin() + static_cast<std::ptrdiff_t>(before));
    out.groups.resize(out.begin.back()), out.surfaces.resize(out.begin.back());
    if (cones_.settings().shade_at_once) out.colors.resize(out.begin.back());
    tbb::parallel_for(std::size_t(0), states.size() / kTileRays, [&](std::size_t tile) {
        std::vector<sdf::SurfaceHit*> of_tile;
        for (std::size_t k = 0; k < kTileRays; ++k) {
            const std::size_t ray = tile * kTileRays + k, sample = band.sampleOf(ray);
            if (sample == Band::kNone) continue;
            takeGroups(band, ray, out.begin[before + sample], out);
            for (std::uint32_t g = out.begin[before + sample]; g < out.begin[before + sample + 1]; ++g) {
                out.surfaces[g] = FieldBatches::surfaceAt(out.rays[before + sample], out.groups[g].t);
                if (!cones_.settings().hard_only || out.groups[g].hard) of_tile.push_back(&out.surfaces[g]);
            }
        }
        batches_.describeTree(of_tile);
    });
    if (map_) describeMap(out, before, begin);
    if (cones_.settings().shade_at_once) shadeLast(band, out, before);
}

sdf::TravellingRay ConeBands::signedRay(const Band& band, std::size_t ray, const GpuConeState& state) const {
    sdf::TravellingRay out = band.rays[ray];
    if (sign_ == 0.0) out.sign = state.negative() ? -1.0 : 1.0;
    return out;
}

/// Beyond the most, the last one takes the last place.
void ConeBands::takeGroups(const Band& band, std::size_t ray, std::size_t first, FieldCones& out) const {
    const auto states = cones_.states();
    const auto groups = cones_.groups();
    std::size_t count = 0;
    const auto take = [&](const sdf::ConeGroup& group, const glm::dvec4& color) {
        const std::size_t at = first + std::min<std::size_t>(count++, sdf::ConeHits::kMostGroups - 1);
        out.groups[at] = group;
        if (!out.colors.empty()) out.colors[at] = color;
    };
    if (!band.taken.empty())
        for (const Band::Taken& taken : band.taken[ray]) take(taken.group, taken.color);
    for (std::uint32_t k = 0; k < states[ray].groups(); ++k)
        take(groups[k * states.size() + ray].group(), glm::dvec4(0.0));
}

void ConeBands::describeMap(FieldCones& out, std::size_t first_sample, std::size_t first_group) {
    std::vector<sdf::TravellingRay> rays;
    rays.reserve(out.groups.size() - first_group);
    for (std::size_t sample = first_sample; sample < out.samples(); ++sample)
        rays.insert(rays.end(), out.begin[sample + 1] - out.begin[sample], out.rays[sample]);
    batches_.describeMap(rays, std::span(out.surfaces).subspan(first_group));
}

}  // namespace edgewise::vulkan
