// Pixels that are one colour or divided into parts, through a prefilter in closed form.
#pragma once

#include "pipeline/field_tracer.h"
#include "pipeline/methods/polygon_weights.h"

namespace edgewise {

class PartFilter {
  public:
    explicit PartFilter(const Prefilter& filter);

    /// Pixels this far around one reach into its support.
    int marginPx() const { return margin_px_; }
    /// Colours and `edge` of the box's pixels; the window has the margin. The same bits for every window.
    void apply(const FieldWindow& window, const FieldSamples& samples, const PixelBox& box,
               ImageBuffer& image) const;

  private:
    const Prefilter& filter_;
    std::vector<PixelShare> square_;  ///< of the square (0, 0): what it weighs in the pixels around
    int margin_px_ = 0;
};

}  // namespace edgewise
