#include "paper_figures/method_views.h"

#include <fmt/format.h>

#include <algorithm>

#include "paper_figures/picture_row.h"
#include "pipeline/methods/stopwatch.h"

namespace edgewise::figures {
namespace {

constexpr double kLeastSmall = 640;  ///< px of a whole picture that is shown as it is

}  // namespace

MethodViews::MethodViews(const std::string& scene, int width, int height, int reference_side, int facts_side,
                         Progress& progress)
    : view(scene, width, height), name(scene) {
    Progress quiet;
    kinds = judge::edgeKindsOf(view.input(quiet), facts_side);
    make(fmt::format("ssaa:{}", reference_side), progress);
    auto node = made.extract(made.begin());
    node.key() = "reference";
    made.insert(std::move(node));
}

void MethodViews::make(const std::string& method, Progress& progress) {
    Stopwatch watch;
    MethodResult result = view.made(method, progress);
    made[method] = {std::move(result.image), watch.lap() - result.setup_seconds};
}

judge::KindErrors MethodViews::errorsOf(const std::string& method) const {
    return judge::errorsByKind(of(method), of("reference"), kinds);
}

std::size_t MethodViews::pixelsOf(judge::EdgeKind kind) const {
    return static_cast<std::size_t>(std::ranges::count(kinds, kind));
}

ImageBuffer partOf(const ImageBuffer& image, const PixelBox& box) {
    ImageBuffer part(box);
    for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x) part.rgba[part.index(x, y)] = image.rgba[image.index(x, y)];
    return part;
}

ImageBuffer difference(const ImageBuffer& a, const ImageBuffer& b, double gain) {
    ImageBuffer out(a.box);
    for (int y = a.box.y0; y < a.box.y1; ++y)
        for (int x = a.box.x0; x < a.box.x1; ++x)
            out.rgba[out.index(x, y)] =
                glm::dvec4(gain * glm::abs(glm::dvec3(a.rgba[a.index(x, y)] - b.rgba[b.index(x, y)])), 1.0);
    return out;
}

void Panel::draw(const ImageBuffer& image, const std::string& words, const std::string& frame,
                 Drawing& drawing) const {
    drawing.picture(corner, size, pictureOf(image, "", "").file.bytes);
    drawing.rectangle(corner, size, fmt::format("fill='none' stroke='{}' stroke-width='2'", frame));
    drawing.text(corner + glm::dvec2(size.x / 2, size.y + 14), words, "text-anchor='middle' font-size='11'");
}

void drawWhole(const MethodViews& views, const std::string& method, const Panel& panel,
               const std::vector<std::pair<PixelBox, const char*>>& parts, Drawing& drawing) {
    const ImageBuffer& image = views.of(method);
    panel.draw(image.box.width() > kLeastSmall ? shrunk(image, 2) : image, method, "#777", drawing);
    const glm::dvec2 scale = panel.size / glm::dvec2(image.box.width(), image.box.height());
    for (const auto& [box, color] : parts)
        drawing.rectangle(panel.corner + scale * glm::dvec2(box.x0, box.y0),
                          scale * glm::dvec2(box.width(), box.height()),
                          fmt::format("fill='none' stroke='{}' stroke-width='2'", color));
}

}  // namespace edgewise::figures
