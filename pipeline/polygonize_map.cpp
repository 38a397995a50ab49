#include "pipeline/polygonize_map.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "pipeline/device_error.h"
#include "pipeline/error.h"
#include "pipeline/methods/stopwatch.h"
#ifdef EDGEWISE_HAS_VULKAN
#include "pipeline/map_points.h"
#endif
#include "sdf/field_scene.h"
#include "sdf/point_mesh.h"
#include "sdf/scene_error.h"

namespace edgewise {
namespace {

/// What of a field is within a box.
class CappedField : public sdf::PointField {
  public:
    CappedField(std::shared_ptr<const sdf::PointField> field, const WorldBox& box)
        : field_(std::move(field)), middle_(0.5 * (box.low + box.high)), half_(0.5 * (box.high - box.low)) {}

    std::vector<double> values(std::span<const glm::dvec3> points) const override {
        std::vector<double> values = field_->values(points);
        for (std::size_t i = 0; i < points.size(); ++i) values[i] = std::max(values[i], toBox(points[i]));
        return values;
    }
    std::vector<glm::dvec3> colors(std::span<const glm::dvec3> points,
                                   std::span<const glm::dvec3> normals) const override {
        return field_->colors(points, normals);
    }
    double lipschitz() const override { return std::max(field_->lipschitz(), 1.0); }
    double rounding() const override { return field_->rounding(); }

  private:
    double toBox(const glm::dvec3& p) const {
        const glm::dvec3 off = glm::abs(p - middle_) - half_;
        return glm::length(glm::max(off, 0.0)) + std::min(std::max({off.x, off.y, off.z}), 0.0);
    }

    const std::shared_ptr<const sdf::PointField> field_;
    const glm::dvec3 middle_, half_;
};

std::shared_ptr<const sdf::PointField> pointsOf(const sdf::FieldScene& map) {
#ifdef EDGEWISE_HAS_VULKAN
    return makeMapPoints(map);
#else
    throw DeviceError(map.source + " is raw GLSL, and this build has no Vulkan to run it");
#endif
}

WorldBox boxOf(const Scene& scene, const sdf::PointField& field) {
    const std::optional<sdf::Box> box = sdf::boxOfPoints(field, scene.field->far);
    if (!box)
        throw InputError(scene.source,
                         "is unbounded: a mesh of it needs --box X0,Y0,Z0,X1,Y1,Z1, and --cap where it goes "
                         "on beyond");
    if (box->empty()) throw InputError(scene.source, "holds no surface");
    return {{box->low[0], box->low[1], box->low[2]}, {box->high[0], box->high[1], box->high[2]}};
}

}  // namespace

std::optional<sdf::Box> boundsOfMap(const sdf::FieldScene& map) {
    try {
        const std::optional<sdf::Box> box = sdf::boxOfPoints(*pointsOf(map), map.far);
        return box && !box->empty() ? box : std::nullopt;
    } catch (const sdf::SceneError&) {
        return std::nullopt;
    } catch (const DeviceError&) {
        return std::nullopt;
    }
}

Polygonized polygonizeMap(const Scene& scene, const PolygonizeOptions& options) {
    if (options.mesher == Mesher::kCgal)
        throw InputError("--mesher", "cgal has no raw GLSL; dual and marching-cubes have");
    Polygonized result;
    try {
        result.points = pointsOf(*scene.field);
        WorldBox box = options.box ? *options.box : boxOf(scene, *result.points);
        if (options.cap) {
            result.points = std::make_shared<CappedField>(result.points, box);
            box = withMargin(box);
        }
        result.lattice = sdf::latticeOf(box.low, box.high, options.resolution);
        requireMeshMemory(result.lattice);
        bool bound_holds = true;
        result.mesh = sdf::meshOfPoints({*result.points, result.lattice, options.mesher == Mesher::kDual,
                                         [&] {
                                             if (options.progress) checkCancelled(*options.progress);
                                         }},
                                        result.counts, bound_holds);
        if (!bound_holds)
            result.notes.push_back(
                "values change faster than its `lipschitz` says: no cell was left out, however far the "
                "surface seemed");
    } catch (const sdf::SceneError& error) {
        throw InputError(scene.source, error.what());
    }
    return result;
}

}  // namespace edgewise
