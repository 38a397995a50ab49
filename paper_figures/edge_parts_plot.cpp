#include "paper_figures/edge_parts_plot.h"

#include <fmt/format.h>

#include <algorithm>

namespace edgewise::figures {
namespace {

constexpr double kLeft = 90, kTop = 12, kWordsBelowWhole = 24, kLongestWhole = 700;

std::string wordsOf(const MethodViews& views, const PartColumn& column, const PixelBox& box) {
    if (!column.error) return column.title;
    judge::KindError error;
    const ImageBuffer part = partOf(views.of(column.method), box);
    for (const auto& [kind, of] : judge::errorsByKind(part, views.of("reference"), views.kinds).by_kind)
        error += of;
    const std::optional<double> psnr = error.psnr();
    return column.title + (psnr ? fmt::format(", {:.1f} dB", *psnr) : ", exact");
}

ImageBuffer pictureOf(const MethodViews& views, const PartColumn& column, const PixelBox& box) {
    const ImageBuffer part = partOf(views.of(column.method), box);
    return column.error ? difference(part, partOf(views.of("reference"), box), kErrorGain) : part;
}

}  // namespace

std::vector<EdgePart> edgeParts(const MethodViews& views, glm::ivec2 size) {
    const Film& film = views.view.film;
    if (film.width < size.x || film.height < size.y) return {};
    std::vector<EdgePart> parts;
    std::vector<PixelBox> boxes;
    for (const EdgeKind kind : kEdgeKinds) {
        if (views.pixelsOf(kind) == 0) continue;
        boxes.push_back(partOfKind(views.kinds, film, kind, size, boxes));
        parts.push_back({kind, boxes.back()});
    }
    return parts;
}

std::string edgePartsSvg(const MethodViews& views, const std::vector<EdgePart>& parts,
                         const std::string& whole, const std::vector<PartColumn>& columns) {
    PanelGrid grid;
    const double row = static_cast<double>(columns.size()) * (grid.width + PanelGrid::kGap) - PanelGrid::kGap,
                 width = std::min(row, kLongestWhole),
                 height = width * views.view.film.height / views.view.film.width;
    grid.left = kLeft, grid.top = kTop + height + kWordsBelowWhole;
    Drawing drawing(kLeft + row + 20, grid.at(0, static_cast<int>(parts.size())).corner.y + PanelGrid::kWords,
                    "Kinds of edges by several methods");
    std::vector<std::pair<PixelBox, const char*>> framed;
    for (const EdgePart& part : parts) framed.emplace_back(part.box, judge::colorOf(part.kind));
    drawWhole(views, whole, {{kLeft, kTop}, {width, height}}, framed, drawing);
    for (std::size_t j = 0; j < parts.size(); ++j) {
        const char* color = judge::colorOf(parts[j].kind);
        for (std::size_t i = 0; i < columns.size(); ++i)
            grid.at(static_cast<int>(i), static_cast<int>(j))
                .draw(pictureOf(views, columns[i], parts[j].box), wordsOf(views, columns[i], parts[j].box),
                      color, drawing);
        drawing.text(grid.at(0, static_cast<int>(j)).corner + glm::dvec2(-8, grid.height / 2),
                     judge::nameOf(parts[j].kind),
                     fmt::format("text-anchor='end' font-size='12' fill='{}'", color));
    }
    return drawing.svg();
}

}  // namespace edgewise::figures
