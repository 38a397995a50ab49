#include "tests/fuzz/scene_from_bytes.h"

#include <cmath>

#include "tests/witness/scene_builder.h"

namespace edgewise::fuzz {
namespace {

using witness::SceneBuilder;

class Bytes {
  public:
    explicit Bytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
    bool empty() const { return at_ >= bytes_.size(); }
    std::uint8_t next() { return empty() ? 0 : bytes_[at_++]; }

  private:
    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
};

/// The low five bits choose a lattice point, the high three a way to leave it.
double coordinate(std::uint8_t byte, double step) {
    const double lattice = kSamplePx + (double(byte & 31) - 16) * step;
    switch (byte >> 5) {
        case 1:
            return lattice + kGridPx;
        case 2:
            return lattice - kGridPx;
        case 3:
            return kSamplePx + (lattice - kSamplePx) * 0x1p10;
        case 4:
            return kSamplePx + (lattice - kSamplePx) * 0x1p-12;
        default:
            return lattice;
    }
}

double depth(std::uint8_t byte) {
    return double(byte & 15) / 8 + (byte & 64 ? 0x1p-40 : 0);
}

void addTriangle(SceneBuilder& builder, Bytes& bytes, double step, double apart) {
    const std::uint8_t how = bytes.next();
    double c[6], z[3];
    for (double& value : c) value = coordinate(bytes.next(), step);
    for (double& value : z) value = depth(bytes.next());
    const auto& planes = builder.scene().planes;
    if (how % 4 == 0 || planes.empty()) {
        builder.add({{{c[0], c[1], z[0]}, {c[2], c[3], z[1]}, {c[4], c[5], z[2]}}});
        return;
    }
    auto plane = static_cast<std::uint32_t>((how >> 2) % planes.size());
    if (how % 4 == 1) {
        DepthPlane near = planes[plane];
        near.dz_dx += apart * (z[0] - 1);
        near.dz_dy += apart * (z[1] - 1);
        near.z_anchor += apart * (z[2] - 1);
        plane = builder.addPlane(near);
    }
    builder.addOnPlane({{{c[0], c[1]}, {c[2], c[3]}, {c[4], c[5]}}}, plane);
}

}  // namespace

ScreenScene sceneFromBytes(std::span<const std::uint8_t> input) {
    Bytes bytes(input);
    const double step = std::ldexp(1.0, -(bytes.next() % 5));
    const double apart = std::ldexp(1.0, -(bytes.next() % 56));
    SceneBuilder builder({kSamplePx, kSamplePx});
    for (std::size_t k = 0; k < kMostTriangles && !bytes.empty(); ++k)
        addTriangle(builder, bytes, step, apart);
    return builder.scene();
}

}  // namespace edgewise::fuzz
