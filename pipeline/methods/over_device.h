// What makes samples of a device's cones.
#pragma once

#include <memory>
#include <utility>

#include "pipeline/field_tracer.h"

namespace edgewise {

/// All but trace() is the device's.
class OverDevice : public FieldTracer {
  public:
    FieldCones traceCones(const FieldWindow& window) override { return device_->traceCones(window); }
    std::vector<glm::dvec4> shade(std::span<const sdf::TravellingRay> rays,
                                  std::span<const sdf::SurfaceHit> hits,
                                  std::vector<std::uint32_t>* sights) override {
        return device_->shade(rays, hits, sights);
    }
    RayBatches& batches() override { return device_->batches(); }

  protected:
    explicit OverDevice(std::unique_ptr<FieldTracer> device) : device_(std::move(device)) {}

    std::unique_ptr<FieldTracer> device_;
};

}  // namespace edgewise
