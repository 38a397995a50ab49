#include "pipeline/cli/strips.h"

#include <algorithm>
#include <string_view>

namespace edgewise::cli {
namespace {

/// Strips end between the blocks of 16 rows that EXR compresses, and between the cells of visibility.
constexpr int kRowStep = 16;

/// The scene is the same in every strip.
bool countsTheScene(std::string_view count) {
    return count == "triangles" || count == "screen_triangles" || count == "pieces";
}

/// Frames, and how far they are apart: of the strip where they are farthest.
bool tellsTheWorst(std::string_view count) {
    return count == "frames" || count.starts_with("temporal_deviation");
}

void addSeconds(const StageTime& stage, std::vector<StageTime>& all) {
    const auto known = std::ranges::find(all, stage.name, &StageTime::name);
    if (known == all.end())
        all.push_back(stage);
    else
        known->seconds += stage.seconds;
}

}  // namespace

std::size_t bytesPerPixel(const std::set<Aov>& aovs) {
    return sizeof(glm::dvec4) + sizeof(float) + sizeof(std::uint32_t) * aovChannelCount(aovs);
}

std::vector<PixelBox> stripsOf(const PixelBox& crop, const RenderOptions& options) {
    if (options.dump_dir) return {crop};
    const double row_bytes = static_cast<double>(bytesPerPixel(options.aovs)) * crop.width();
    const double fitting = 0.5 * 0x1p20 * static_cast<double>(options.memory_mib) / row_bytes;
    const int blocks = static_cast<int>(std::clamp(fitting / kRowStep, 1.0, 1.0 + crop.height()));
    std::vector<PixelBox> strips;
    for (int y = crop.y0; y < crop.y1; y += blocks * kRowStep)
        strips.push_back({crop.x0, y, crop.x1, std::min(y + blocks * kRowStep, crop.y1)});
    return strips;
}

void addStrip(const MethodResult& strip, MethodResult& all) {
    for (const StageTime& stage : strip.stages) addSeconds(stage, all.stages);
    for (const auto& [name, count] : strip.counts)
        all.counts[name] = countsTheScene(name)  ? count
                           : tellsTheWorst(name) ? std::max(all.counts[name], count)
                                                 : all.counts[name] + count;
    all.setup_seconds += strip.setup_seconds;
    for (const std::string& note : strip.notes)
        if (std::ranges::find(all.notes, note) == all.notes.end()) all.notes.push_back(note);
    all.device = strip.device;
    all.plan = strip.plan;
}

}  // namespace edgewise::cli
