// A drawing in words of geometry, as one <svg> that stands by itself.
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <string_view>

#include "paper_figures/figure.h"

namespace edgewise::figures {

/// Lengths and places are the SVG's pixels; styles are attributes, as "fill='#fff' stroke='#333'".
class Drawing {
  public:
    /// `label`: for those who do not see it.
    Drawing(double width, double height, const std::string& label);

    void polygon(std::span<const glm::dvec2> corners, std::string_view style);
    void rectangle(glm::dvec2 corner, glm::dvec2 size, std::string_view style);
    void line(glm::dvec2 a, glm::dvec2 b, std::string_view style);
    void arrow(glm::dvec2 from, glm::dvec2 to, std::string_view color);
    void circle(glm::dvec2 middle, double radius, std::string_view style);
    void text(glm::dvec2 at, const std::string& words, std::string_view style = "");
    /// A PNG over a rectangle, its pixels square.
    void picture(glm::dvec2 corner, glm::dvec2 size, const std::string& png);
    /// What is drawn until endClip() is cut to a rectangle.
    void beginClip(glm::dvec2 corner, glm::dvec2 size);
    void endClip() { body_ += "</g>\n"; }
    /// Whole elements.
    void raw(const std::string& elements) { body_ += elements; }

    std::string svg() const;

  private:
    double width_, height_;
    std::string label_, body_;
    int clips_ = 0;
};

}  // namespace edgewise::figures
