#include "tests/property/shrink.h"

#include <cmath>
#include <set>

namespace edgewise::property {
namespace {

constexpr int kFloatBits = 24;

/// x with at most `bits` bits of its mantissa.
float roundedTo(int bits, float x) {
    if (bits == 0 || x == 0) return 0;
    int exponent = 0;
    const double mantissa = std::frexp(double(x), &exponent);
    return float(std::ldexp(std::nearbyint(std::ldexp(mantissa, bits)), exponent - bits));
}

class Shrinker {
  public:
    Shrinker(WorldScene scene, const Fails& fails, int budget)
        : scene_(std::move(scene)), fails_(fails), budget_(budget) {}

    WorldScene run() {
        bool changed = true;
        while (changed) {
            changed = dropTriangles();
            changed = joinNodes() || changed;
            changed = flatten() || changed;
            changed = roundPositions() || changed;
        }
        return std::move(scene_);
    }

  private:
    /// Takes the candidate if it fails as well.
    bool take(WorldScene candidate) {
        if (budget_ <= 0 || candidate.triangles.empty()) return false;
        --budget_;
        if (!fails_(candidate)) return false;
        scene_ = std::move(candidate);
        return true;
    }

    bool dropTriangles() {
        bool changed = false;
        for (std::size_t size = scene_.triangles.size(); size > 0; size /= 2)
            for (std::size_t begin = 0; begin < scene_.triangles.size();) {
                WorldScene less = scene_;
                const std::size_t end = std::min(begin + size, less.triangles.size());
                less.triangles.erase(less.triangles.begin() + std::ptrdiff_t(begin),
                                     less.triangles.begin() + std::ptrdiff_t(end));
                if (take(std::move(less)))
                    changed = true;
                else
                    begin += size;
            }
        return changed;
    }

    bool joinNodes() {
        if (scene_.triangles.front().node == scene_.triangles.back().node) return false;
        WorldScene joined = scene_;
        for (WorldTriangle& t : joined.triangles) t.node = 0;
        return take(std::move(joined));
    }

    /// Plain scenes first: one depth for all, or one a triangle; no perspective.
    bool flatten() {
        bool changed = false;
        for (const bool all : {true, false}) {
            WorldScene flat = scene_;
            for (WorldTriangle& t : flat.triangles)
                for (glm::vec3& p : t.p_world) p.z = all ? 0 : t.p_world[0].z;
            changed = depthBits(flat) < depthBits(scene_) && take(std::move(flat)) ? true : changed;
        }
        WorldScene straight = scene_;
        straight.lens = Lens::kOrthographic;
        return (scene_.lens != straight.lens && take(std::move(straight))) || changed;
    }

    static int depthBits(const WorldScene& scene) {
        int bits = 0;
        for (const WorldTriangle& t : scene.triangles)
            for (const glm::vec3& p : t.p_world) bits += significantBits(p.z);
        return bits;
    }

    /// Corners that coincide move together first, then each alone.
    bool roundPositions() {
        bool changed = false;
        for (const bool together : {true, false})
            for (std::size_t i = 0; i < scene_.triangles.size(); ++i)
                for (std::size_t k = 0; k < 3; ++k)
                    for (int axis = 0; axis < 3; ++axis)
                        changed = roundCoordinate(i, k, axis, together) || changed;
        return changed;
    }

    bool roundCoordinate(std::size_t triangle, std::size_t corner, int axis, bool together) {
        const glm::vec3 old = scene_.triangles[triangle].p_world[corner];
        for (int bits = 0; bits < significantBits(old[axis]); ++bits) {
            const float rounded = roundedTo(bits, old[axis]);
            WorldScene candidate = scene_;
            if (together) {
                for (WorldTriangle& t : candidate.triangles)
                    for (glm::vec3& p : t.p_world)
                        if (p == old) p[axis] = rounded;
            } else {
                candidate.triangles[triangle].p_world[corner][axis] = rounded;
            }
            if (take(std::move(candidate))) return true;
        }
        return false;
    }

    WorldScene scene_;
    const Fails& fails_;
    int budget_;
};

}  // namespace

int significantBits(float x) {
    for (int bits = 0; bits < kFloatBits; ++bits)
        if (roundedTo(bits, x) == x) return bits;
    return kFloatBits;
}

WorldScene shrink(WorldScene scene, const Fails& fails, int budget) {
    return Shrinker(std::move(scene), fails, budget).run();
}

}  // namespace edgewise::property
