// The prefilter kernels of the contract: definition, support, normalisation. Integral 1 over the support.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace edgewise {

enum class KernelKind { kBox, kDisk, kTent, kCone, kGaussian, kGaussianSeparable, kCubic, kLanczos, kPoly };

struct KernelTable;

struct Prefilter {
    KernelKind kind = KernelKind::kGaussian;
    std::string name;             ///< as the user names it: "gaussian", "bc:0.2,0.4"
    double radius = 2.0;          ///< R, pixels: half width of the square, or radius of the disk
    std::optional<double> sigma;  ///< Gaussian kernels only
    double b = 0.0, c = 0.0;      ///< the cubic family
    std::vector<double> poly;     ///< c_k of (r/R)^(2k)
    /// A separable kernel's factor as polynomials, made by makePrefilter(); without it evaluate() and
    /// PixelWeights make their own.
    std::shared_ptr<const KernelTable> table;
    bool radial() const {
        return kind == KernelKind::kDisk || kind == KernelKind::kCone || kind == KernelKind::kGaussian ||
               kind == KernelKind::kPoly;
    }
};

/// The filter that the contract's name, --radius and --sigma describe.
/// Throws std::invalid_argument with the rule that was broken (unknown name, R <= 0 or not finite, a sigma
/// given to another filter, a poly with integral <= 0, lobes so strong that a weight could reach 8, ...).
Prefilter makePrefilter(std::string_view name, std::optional<double> radius, std::optional<double> sigma);

/// The kernel's value at (x, y) px from the sample, 0 outside the support.
double evaluate(const Prefilter& filter, double x, double y);

/// One line a kernel, for `edgewise filters`: name, formula, defaults.
std::vector<std::string> describePrefilters();

}  // namespace edgewise
