// --aov on SDF scenes: of the sample at the pixel's centre.
#pragma once

#include "pipeline/field_tracer.h"
#include "sdf/ray_grid.h"

namespace edgewise {

/// depth and normal as aov_names.h says; index: the material. Throws InputError for what counts triangles.
class FieldAov {
  public:
    explicit FieldAov(const MethodInput& in);
    bool active() const { return !in_.options.aovs.empty(); }
    void begin(ImageBuffer& image) const;
    /// From sample `i`, at the pixel's centre.
    void pixel(int x, int y, const FieldSamples& samples, std::size_t i, ImageBuffer& image) const;

  private:
    const MethodInput in_;
    sdf::RayGrid grid_;
};

/// Those of the whole crop, for methods whose own rays lie elsewhere. Nothing without --aov.
void traceFieldAovs(const MethodInput& in, const FieldTracerMaker& make, ImageBuffer& image);

}  // namespace edgewise
