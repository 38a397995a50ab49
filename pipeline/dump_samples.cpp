#include "pipeline/dump_samples.h"

#include <fmt/format.h>

#include <iterator>

#include "pipeline/atomic_file.h"
#include "pipeline/dump_stages.h"
#include "pipeline/write_image.h"

namespace edgewise {

SampleDump::SampleDump(const std::optional<std::filesystem::path>& folder, const PixelBox& crop,
                       const ScreenScene& screen)
    : folder_(folder), crop_(crop) {
    if (!active()) return;
    StageDump(folder, crop).screen(screen);
    colors_ = ImageBuffer(crop);
}

void SampleDump::pixel(int x, int y, std::span<const glm::dvec2> at_px, std::span<const Owner> owners,
                       const LayerStacks& stacks) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < owners.size(); ++i) {
        fmt::format_to(std::back_inserter(rows_), "{},{},{}\n", x + at_px[i].x, y + at_px[i].y,
                       ownerText(owners[i], stacks));
        sum += ownerColor(stacks.layersOf(owners[i]).front());
    }
    colors_.rgba[colors_.index(x, y)] = glm::dvec4(sum / static_cast<double>(owners.size()), 1.0);
}

void SampleDump::finish() {
    if (rows_.empty()) return;
    writeAtomically(*folder_ / "samples.csv", "x,y,owner\n" + rows_);
    writeImage(*folder_ / "samples.png", colors_, {crop_.x1, crop_.y1, 0.0, {}});
}

}  // namespace edgewise
