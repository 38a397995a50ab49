#include "paper_figures/drawing.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "pipeline/compare/base64.h"
#include "pipeline/html_text.h"

namespace edgewise::figures {

Drawing::Drawing(double width, double height, const std::string& label)
    : width_(width), height_(height), label_(label) {}

void Drawing::polygon(std::span<const glm::dvec2> corners, std::string_view style) {
    body_ += "<polygon points='";
    for (const glm::dvec2& p : corners) body_ += fmt::format("{:.2f},{:.2f} ", p.x, p.y);
    body_ += fmt::format("' {}/>\n", style);
}

void Drawing::rectangle(glm::dvec2 corner, glm::dvec2 size, std::string_view style) {
    body_ += fmt::format("<rect x='{:.2f}' y='{:.2f}' width='{:.2f}' height='{:.2f}' {}/>\n", corner.x,
                         corner.y, size.x, size.y, style);
}

void Drawing::line(glm::dvec2 a, glm::dvec2 b, std::string_view style) {
    body_ +=
        fmt::format("<path d='M{:.2f} {:.2f}L{:.2f} {:.2f}' fill='none' {}/>\n", a.x, a.y, b.x, b.y, style);
}

void Drawing::arrow(glm::dvec2 from, glm::dvec2 to, std::string_view color) {
    constexpr double kHead = 7.0, kHalfWidth = 3.5;
    const glm::dvec2 along = (to - from) / glm::length(to - from), across(-along.y, along.x);
    const glm::dvec2 neck = to - kHead * along;
    line(from, neck, fmt::format("stroke='{}' stroke-width='1.5'", color));
    const glm::dvec2 head[]{to, neck + kHalfWidth * across, neck - kHalfWidth * across};
    polygon(head, fmt::format("fill='{}'", color));
}

void Drawing::circle(glm::dvec2 middle, double radius, std::string_view style) {
    body_ +=
        fmt::format("<circle cx='{:.2f}' cy='{:.2f}' r='{:.2f}' {}/>\n", middle.x, middle.y, radius, style);
}

void Drawing::text(glm::dvec2 at, const std::string& words, std::string_view style) {
    body_ += fmt::format("<text x='{:.2f}' y='{:.2f}' {}>{}</text>\n", at.x, at.y, style, escapedHtml(words));
}

void Drawing::picture(glm::dvec2 corner, glm::dvec2 size, const std::string& png) {
    body_ += fmt::format(
        "<image x='{:.2f}' y='{:.2f}' width='{:.2f}' height='{:.2f}' style='image-rendering:pixelated' "
        "preserveAspectRatio='none' href='data:image/png;base64,{}'/>\n",
        corner.x, corner.y, size.x, size.y,
        compare::base64({reinterpret_cast<const unsigned char*>(png.data()), png.size()}));
}

void Drawing::beginClip(glm::dvec2 corner, glm::dvec2 size) {
    const std::string id = fmt::format("inside{}", ++clips_);
    body_ += fmt::format(
        "<clipPath id='{0}'><rect x='{1:.2f}' y='{2:.2f}' width='{3:.2f}' height='{4:.2f}'/></clipPath><g "
        "clip-path='url(#{0})'>\n",
        id, corner.x, corner.y, size.x, size.y);
}

std::string Drawing::svg() const {
    return fmt::format(
               "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}' "
               "font-family='sans-serif' font-size='12' fill='#333' role='img' aria-label='{2}'><rect "
               "width='{0}' height='{1}' fill='#fff'/>\n",
               width_, height_, escapedHtml(label_)) +
           body_ + "</svg>\n";
}

}  // namespace edgewise::figures
