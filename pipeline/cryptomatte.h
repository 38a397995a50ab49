// Cryptomatte 1.2 (Friedman and Jones, SIGGRAPH 2015; Psyop's specification): who covers a pixel and by how
// much, as pairs of a hashed name and a coverage, the largest first.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analytic/pixel_weights.h"
#include "pipeline/aov_image.h"
#include "pipeline/scene.h"

namespace edgewise {

/// MurmurHash3_x86_32 (Appleby).
std::uint32_t murmurHash3(std::string_view bytes, std::uint32_t seed = 0);

/// The bits of the float32 that stands for a name: its hash, the lowest bit of the exponent flipped where
/// that is all zeros or all ones, so that it is no subnormal, infinity or NaN.
std::uint32_t cryptomatteIdBits(std::uint32_t hash);

/// Pairs a pixel keeps, and the RGBA layers that hold two each.
inline constexpr int kCryptomatteRanks = 6;
inline constexpr int kCryptomatteLayers = kCryptomatteRanks / 2;

/// One set of names: objects, or materials.
class CryptomatteLayer {
  public:
    /// By node: its name in the file, or node_INDEX. A name that an earlier node has gets _INDEX behind it.
    static CryptomatteLayer ofObjects(const Scene& scene);
    /// By material: its name, or material_INDEX; made unique likewise.
    static CryptomatteLayer ofMaterials(const Scene& scene);

    /// Adds 2 kCryptomatteRanks float channels NAME00.red, .green, .blue, .alpha, NAME01.red ... and the
    /// attributes cryptomatte/KEY/name, hash, conversion, manifest.
    void describe(AovImage& image) const;

    /// The pairs (id, coverage) of one pixel. Weights of equal id are summed in fixed point, then rounded to
    /// float32: a coverage is the integral of the filter over what is seen of the object, negative where its
    /// negative lobes prevail, never clamped. Sorted by size, equal ones by id; the background has none, so
    /// coverages sum to alpha. False: more than kCryptomatteRanks ids had a weight, and the smallest were
    /// left out.
    bool rank(const Scene& scene, std::span<const OwnerWeight> owners, std::uint32_t* channels) const;

    const std::map<std::string, std::uint32_t>& manifest() const { return manifest_; }

  private:
    std::string name_;
    std::vector<std::uint32_t> id_of_geometry_;
    std::map<std::string, std::uint32_t> manifest_;  ///< name -> id bits, of what has triangles
};

}  // namespace edgewise
