// One horizontal line through a support: which owner is seen from where to where.
#pragma once

#include <vector>

#include "tests/witness/local_scene.h"

namespace edgewise::witness {

struct Run {
    Real u_lo, u_hi;
    Owner owner;
};

/// The line v cut to [-half_chord, half_chord], as maximal runs of one owner, by ascending u.
class Scanline {
  public:
    explicit Scanline(const LocalScene& scene) : scene_(scene) {}
    const std::vector<Run>& cut(Real v, Real half_chord);

  private:
    struct Span {
        Real u_lo, u_hi;
        std::size_t triangle;
    };
    void collectSpans(Real v, Real half_chord);
    void collectBreaks(Real v, Real half_chord);
    void addDepthBreak(const Span& one, const Span& other, Real v);
    Owner ownerOfActive(Real u, Real v);
    void collectRuns(Real v);

    const LocalScene& scene_;
    std::vector<Span> spans_, active_;
    std::vector<Real> breaks_;
    std::vector<Run> runs_;
};

}  // namespace edgewise::witness
