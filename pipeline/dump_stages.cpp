#include "pipeline/dump_stages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "pipeline/atomic_file.h"
#include "pipeline/error.h"
#include "pipeline/write_image.h"

namespace edgewise {
namespace {

/// Values become grey: 0 is black, the largest white, by their logarithm.
void normalize(ImageBuffer& picture) {
    double largest = 0.0;
    for (const glm::dvec4& p : picture.rgba) largest = std::max(largest, p.x);
    for (glm::dvec4& p : picture.rgba) {
        const double grey = largest > 0.0 ? std::log1p(p.x) / std::log1p(largest) : 0.0;
        p = glm::dvec4(glm::dvec3(grey * grey), 1.0);
    }
}

void drawSegment(glm::dvec2 a, glm::dvec2 b, const PixelBox& band, ImageBuffer& picture) {
    const glm::dvec2 d = b - a;
    const int steps = 1 + static_cast<int>(std::min(1e5, 2.0 * std::max(std::abs(d.x), std::abs(d.y))));
    for (int i = 0; i <= steps; ++i) {
        const glm::dvec2 p = glm::floor(a + d * (static_cast<double>(i) / steps));
        if (!(std::abs(p.x) < 1e6 && std::abs(p.y) < 1e6)) continue;
        const int x = static_cast<int>(p.x), y = static_cast<int>(p.y);
        if (band.contains(x, y)) picture.rgba[picture.index(x, y)] = glm::dvec4(1.0);
    }
}

std::string pointText(const FinePoint& p, glm::dvec2 offset) {
    return fmt::format("{},{},{},{}", p.grid.x - offset.x, p.rest.x, p.grid.y - offset.y, p.rest.y);
}

}  // namespace

glm::dvec3 ownerColor(Owner owner) {
    if (owner == kBackground) return glm::dvec3(0.0);
    const std::uint64_t h = (owner + 1) * 0x9e3779b97f4a7c15ull;
    const auto channel = [h](int shift) {
        return 0.1 + 0.8 * static_cast<double>((h >> shift) & 0xff) / 255.0;
    };
    return {channel(56), channel(48), channel(40)};
}

std::string ownerText(const Owner& owner, const LayerStacks& stacks) {
    std::string text;
    for (const Owner layer : stacks.layersOf(owner)) {
        if (!text.empty()) text += '/';
        text += layer == kBackground ? "background" : fmt::format("{}", layer);
    }
    return text;
}

StageDump::StageDump(const std::optional<std::filesystem::path>& folder, const PixelBox& crop)
    : folder_(folder), crop_(crop) {
    if (!active()) return;
    std::error_code error;
    std::filesystem::create_directories(*folder_, error);
    if (error) throw InputError("--dump-stages", fmt::format("{}: {}", folder_->string(), error.message()));
    lengths_ = owners_ = counts_ = ImageBuffer(crop);
    weight_rows_.resize(counts_.rgba.size());
    gather_csv_ = "x,y,count,offset\n";
    segments_csv_ = "ax,ax_rest,ay,ay_rest,bx,bx_rest,by,by_rest,left,right\n";
}

void StageDump::write(const std::string& name, const std::string& text) const {
    writeAtomically(*folder_ / name, text);
}

void StageDump::write(const std::string& name, const ImageBuffer& picture) const {
    writeImage(*folder_ / name, picture, {crop_.x1, crop_.y1, 0.0, {}});
}

void StageDump::plan(const std::vector<PlanEntry>& entries) {
    if (!active()) return;
    std::string text = "stage,runs,why\n";
    for (const PlanEntry& e : entries)
        fmt::format_to(std::back_inserter(text), "{},{},\"{}\"\n", e.stage, e.runs, e.why);
    write("plan.csv", text);
}

void StageDump::screen(const ScreenScene& scene) {
    if (!active()) return;
    std::string text = "index,x0,y0,x1,y1,x2,y2,plane,dz_dx,dz_dy,z_anchor\n";
    for (const ScreenTriangle& t : scene.triangles) {
        const DepthPlane& z = scene.planes[t.plane];
        fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{},{}\n", t.owner, t.p_px[0].x,
                       t.p_px[0].y, t.p_px[1].x, t.p_px[1].y, t.p_px[2].x, t.p_px[2].y, t.plane, z.dz_dx,
                       z.dz_dy, z.z_anchor);
    }
    write("screen.csv", text);
}

void StageDump::gather(const CellGrid& grid, const IdLists& lists) {
    if (!active()) return;
    for (std::size_t i = 0; i < grid.size(); ++i) {
        const Cell cell = grid.cell(i);
        const std::size_t count = lists.offsets[i + 1] - lists.offsets[i];
        fmt::format_to(std::back_inserter(gather_csv_), "{},{},{},{}\n", cell.min.x, cell.min.y, count,
                       lists.offsets[i]);
        const int x0 = std::max(crop_.x0, static_cast<int>(cell.min.x)),
                  x1 = std::min(crop_.x1, static_cast<int>(cell.max.x));
        const int y0 = std::max(crop_.y0, static_cast<int>(cell.min.y)),
                  y1 = std::min(crop_.y1, static_cast<int>(cell.max.y));
        for (int y = y0; y < y1; ++y)
            for (int x = x0; x < x1; ++x) lengths_.rgba[lengths_.index(x, y)].x = static_cast<double>(count);
    }
}

void StageDump::segments(const VisibleMap& map, const PixelBox& band, glm::dvec2 offset_px) {
    if (!active()) return;
    for (int y = band.y0; y < band.y1; ++y) {
        const auto row = static_cast<std::size_t>(y + static_cast<int>(offset_px.y) - map.row_begin);
        std::size_t next = map.row_offset[row];
        Owner owner = kBackground;
        for (int x = band.x0; x < band.x1; ++x) {
            for (; next < map.row_offset[row + 1] && map.rows[next].x_px <= x + 0.5 + offset_px.x; ++next)
                owner = map.rows[next].owner;
            owners_.rgba[owners_.index(x, y)] = glm::dvec4(0.5 * ownerColor(owner), 1.0);
        }
    }
    for (const VisibleSegment& s : map.segments) {
        fmt::format_to(std::back_inserter(segments_csv_), "{},{},{},{}\n", pointText(s.a, offset_px),
                       pointText(s.b, offset_px), ownerText(s.left, map.stacks),
                       ownerText(s.right, map.stacks));
        drawSegment(s.a.grid - offset_px, s.b.grid - offset_px, band, owners_);
    }
}

void StageDump::weights(const WeightTile& tile, const LayerStacks& stacks) {
    if (!active()) return;
    const std::lock_guard lock(mutex_);
    std::size_t pixel = 0;
    for (int y = tile.box.y0; y < tile.box.y1; ++y) {
        for (int x = tile.box.x0; x < tile.box.x1; ++x, ++pixel) {
            const std::size_t i = counts_.index(x, y);
            counts_.rgba[i].x = static_cast<double>(tile.offset[pixel + 1] - tile.offset[pixel]);
            for (std::size_t e = tile.offset[pixel]; e < tile.offset[pixel + 1]; ++e)
                fmt::format_to(std::back_inserter(weight_rows_[i]), "{},{},{},{}\n", x, y,
                               ownerText(tile.entries[e].owner, stacks),
                               std::ldexp(static_cast<double>(tile.entries[e].weight), -kWeightBits));
        }
    }
}

void StageDump::finish() {
    if (!active()) return;
    std::string weights = "x,y,owner,weight\n";
    for (const std::string& row : weight_rows_) weights += row;
    normalize(lengths_), normalize(counts_);
    write("gather.csv", gather_csv_), write("gather.png", lengths_);
    write("segments.csv", segments_csv_), write("segments.png", owners_);
    write("weights.csv", weights), write("weights.png", counts_);
}

}  // namespace edgewise
