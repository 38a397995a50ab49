// makeMapPoints: a raw GLSL map at any points, on the device.
#include "pipeline/map_points.h"

#include <algorithm>

#include "pipeline/error.h"
#include "pipeline/vulkan/field_tiles.h"

namespace edgewise {
namespace {

using namespace vulkan;

/// iResolution of a map that no film is made of.
constexpr int kSide = 1024;
/// At once; a device that is a program on the CPU gains nothing by more.
constexpr std::size_t kMostPoints = std::size_t(1) << 19;

struct GpuPoint {
    float value, color[3];
};

class MapPoints : public sdf::PointField {
  public:
    explicit MapPoints(const sdf::FieldScene& scene)
        : shaders_(makePointShaders(scene, kSide, kSide)),
          tiles_(device_, shaders_, false, false),
          pass_(tiles_.pass("field_points", shaders_.points)),
          most_(std::min(kMostPoints,
                         FieldTiles::most(device_, shaders_, std::size_t(1) << 30, 4, sizeof(GpuPoint)))) {}

    std::vector<double> values(std::span<const glm::dvec3> points) const override {
        std::vector<double> out;
        out.reserve(points.size());
        ask(points, {}, [&](const GpuPoint& p) { out.push_back(shaders_.lipschitz * double(p.value)); });
        return out;
    }
    std::vector<glm::dvec3> colors(std::span<const glm::dvec3> points,
                                   std::span<const glm::dvec3> normals) const override {
        std::vector<glm::dvec3> out;
        if (!shaders_.user_albedo) return out;
        out.reserve(points.size());
        ask(points, normals,
            [&](const GpuPoint& p) { out.emplace_back(p.color[0], p.color[1], p.color[2]); });
        return out;
    }
    double lipschitz() const override { return shaders_.lipschitz; }
    double rounding() const override { return 0x1p-24; }

  private:
    /// `normals`: none, or one a point: colours too.
    template <class Take>
    void ask(std::span<const glm::dvec3> points, std::span<const glm::dvec3> normals,
             const Take& take) const {
        std::vector<GpuRay> rays;
        for (std::size_t begin = 0; begin < points.size(); begin += most_) {
            const std::size_t count = std::min(most_, points.size() - begin);
            rays.assign((count + kTileRays - 1) / kTileRays * kTileRays, {});
            for (std::size_t i = 0; i < count; ++i)
                for (int k = 0; k < 3; ++k) {
                    rays[i].origin[k] = static_cast<float>(points[begin + i][k]);
                    rays[i].direction[k] = normals.empty() ? 0.0f : static_cast<float>(normals[begin + i][k]);
                }
            withDeviceErrors([&] {
                grow(device_, buffers_.answers, "field points", rays.size() * sizeof(GpuPoint));
                tiles_.place(buffers_, rays);
                const auto all = static_cast<std::uint32_t>(count);
                tiles_.run("points", pass_, buffers_, {all, 0, 0, normals.empty() ? 0u : 1u, 0}, all);
            });
            for (const GpuPoint& p : buffers_.answers->read<GpuPoint>(count)) take(p);
        }
    }

    const Device device_;
    const FieldShaders shaders_;
    mutable FieldTiles tiles_;
    mutable ComputePass pass_;
    const std::size_t most_;
    mutable FieldBuffers buffers_;
};

}  // namespace

std::shared_ptr<const sdf::PointField> makeMapPoints(const sdf::FieldScene& scene) {
    return withDeviceErrors([&] { return std::make_shared<const MapPoints>(scene); });
}

}  // namespace edgewise
