// The independent judge: the weight of every visible owner at a sample, by nested quadrature and brute force.
#pragma once

#include <glm/vec2.hpp>
#include <map>

#include "analytic/screen_triangle.h"
#include "tests/witness/gauss_kronrod.h"
#include "tests/witness/kernels.h"

namespace edgewise::witness {

struct Judgement {
    std::map<Owner, Real> weight;                ///< every owner met on a scanline, the background too
    std::map<std::vector<Owner>, Owner> stacks;  ///< what owners of several layers are: front to back
    Real error = 0;             ///< estimated absolute error of the largest deviation of any one weight
    std::size_t pieces = 0;     ///< outer intervals between events
    std::size_t scanlines = 0;  ///< scanlines evaluated
    Real of(Owner owner) const {
        const auto found = weight.find(owner);
        return found == weight.end() ? 0 : found->second;
    }
    Real sum() const;
};

/// Integrals of one kernel over the visible parts of scenes; made once a kernel.
class ScanlineQuadrature {
  public:
    /// Normalises by its own integral over the empty scene. `accuracy` is aimed at, `Judgement::error` tells
    /// what came.
    explicit ScanlineQuadrature(Kernel kernel, Real accuracy = 1e-14L);

    Judgement judge(const ScreenScene& scene, glm::dvec2 sample_px) const;
    const Kernel& kernel() const { return kernel_; }
    Estimate normaliser() const { return normaliser_; }

  private:
    Kernel kernel_;
    Real accuracy_;
    Estimate normaliser_{1, 0};
};

/// The same scene with x and y exchanged (triangles turned around so that they stay positive).
ScreenScene swapAxes(const ScreenScene& scene);

}  // namespace edgewise::witness
