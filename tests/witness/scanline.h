// One horizontal line through a support: which owner is seen from where to where.
#pragma once

#include <map>
#include <vector>

#include "tests/witness/local_scene.h"

namespace edgewise::witness {

struct Run {
    Real u_lo, u_hi;
    Owner owner;  ///< a triangle, the background, or a name that Scanline gave to several layers
};

/// The line v cut to [-half_chord, half_chord], as maximal runs of one owner, by ascending u.
class Scanline {
  public:
    explicit Scanline(const LocalScene& scene) : scene_(scene) {}
    const std::vector<Run>& cut(Real v, Real half_chord);

    /// Layers from front to back, all but the last see-through, and the owner that stands for them.
    const std::map<std::vector<Owner>, Owner>& stacks() const { return stacks_; }

  private:
    struct Span {
        Real u_lo, u_hi;
        std::size_t triangle;
    };
    void collectSpans(Real v, Real half_chord);
    void collectBreaks(Real v, Real half_chord);
    void addDepthBreak(const Span& one, const Span& other, Real v);
    Owner ownerOfActive(Real u, Real v);
    Owner nameOf(const std::vector<Owner>& layers);
    void collectRuns(Real v);

    const LocalScene& scene_;
    std::vector<Span> spans_, active_;
    std::vector<Real> breaks_;
    std::vector<Run> runs_;
    std::map<std::vector<Owner>, Owner> stacks_;
};

}  // namespace edgewise::witness
