#include "analytic/prefilter.h"

#include <charconv>
#include <cmath>
#include <stdexcept>

#include "analytic/kernel_table.h"
#include "analytic/transcendental.h"

namespace edgewise {
namespace {

struct Known {
    std::string_view name;
    KernelKind kind;
    double radius, b, c;
    std::string_view line;
};

constexpr Known kKnown[] = {
    {"box", KernelKind::kBox, 0.5, 0, 0, "box: constant on the square [-R, R]^2; R 0.5"},
    {"disk", KernelKind::kDisk, 0.5, 0, 0, "disk: constant on r < R (the NSAA paper's 'box'); R 0.5"},
    {"tent", KernelKind::kTent, 1, 0, 0, "tent: (1 - |x|/R)(1 - |y|/R); R 1"},
    {"cone", KernelKind::kCone, 1, 0, 0, "cone: 1 - r/R (the NSAA paper's 'tent'); R 1"},
    {"gaussian", KernelKind::kGaussian, 2, 0, 0, "gaussian: exp(-r^2/(2 s^2)) on r < R; R 2, s R/3"},
    {"gaussian-separable", KernelKind::kGaussianSeparable, 2, 0, 0,
     "gaussian-separable: exp(-r^2/(2 s^2)) on the square [-R, R]^2; R 2, s R/3"},
    {"bspline", KernelKind::kCubic, 2, 1, 0,
     "bspline: cubic family, (B, C) = (1, 0), support [-R, R]^2; R 2"},
    {"mitchell", KernelKind::kCubic, 2, 1.0 / 3.0, 1.0 / 3.0,
     "mitchell: cubic family, (B, C) = (1/3, 1/3), support [-R, R]^2; R 2"},
    {"catmull-rom", KernelKind::kCubic, 2, 0, 0.5,
     "catmull-rom: cubic family, (B, C) = (0, 1/2), support [-R, R]^2; R 2"},
    {"bc", KernelKind::kCubic, 2, 0, 0, "bc:B,C: cubic family with your own (B, C), support [-R, R]^2; R 2"},
    {"lanczos", KernelKind::kLanczos, 3, 0, 0, "lanczos: sinc(x) sinc(x/R), tensor product; R 3"},
    {"poly", KernelKind::kPoly, 2, 0, 0, "poly:c0,c1,...: sum c_k (r/R)^(2k) on r < R (AGJ12's family); R 2"},
};

constexpr std::size_t kMostPolyCoefficients = 32;
constexpr double kMostPolyCancellation = 256.0;
/// Below the screen's grid or beyond its guard band a support means nothing; smaller sigmas leave doubles'
/// range.
constexpr double kLeastRadius = 0x1p-32, kMostRadius = 0x1p20, kLeastSigmaToRadius = 0x1p-30;
constexpr double kMostLanczosRadius = 256.0;  // its table has four intervals a pixel
/// Fixed point 2^-60 in 63 bits holds less than 8. With A = int |W|: a weight is at most (1 + A)/2, a fan
/// term, which lies in a half disk, A/2, and a strip term sup |K| int |k| <= (1 + sqrt A)/2 sqrt A: for A =
/// 12 all are below 7.8.
constexpr double kMostAbsoluteIntegral = 12.0;

std::string quoted(std::string_view text) {
    std::string quote(1, '\'');
    quote.append(text);
    quote.push_back('\'');
    return quote;
}

[[noreturn]] void refuse(std::string_view name, const std::string& why) {
    throw std::invalid_argument("filter " + quoted(name) + ": " + why);
}

const Known& find(std::string_view name, std::string_view stem) {
    std::string names;
    for (const Known& known : kKnown) {
        if (known.name == stem) return known;
        names +=
            (names.empty() ? "" : ", ") + std::string(known.line.substr(0, known.line.find_first_of(" :")));
        if (known.name == "bc") names += ":B,C";
        if (known.name == "poly") names += ":c0,c1,...";
    }
    refuse(name, "unknown; the filters are " + names);
}

double parseNumber(std::string_view name, std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        refuse(name, quoted(text).append(" is not a finite number"));
    return value;
}

std::vector<double> parseNumbers(std::string_view name, std::string_view list) {
    std::vector<double> numbers;
    while (true) {
        const std::size_t comma = list.find(',');
        numbers.push_back(parseNumber(name, list.substr(0, comma)));
        if (comma == std::string_view::npos) return numbers;
        list.remove_prefix(comma + 1);
    }
}

void takeParameters(Prefilter& filter, std::string_view stem, std::string_view name) {
    const std::size_t colon = name.find(':');
    const bool wants = stem == "bc" || stem == "poly";
    if (!wants && colon != std::string_view::npos) refuse(name, std::string(stem) + " takes no parameters");
    if (!wants) return;
    if (colon == std::string_view::npos)
        refuse(name, "parameters are missing: " + std::string(stem) + ":...");
    const std::vector<double> numbers = parseNumbers(name, name.substr(colon + 1));
    if (stem == "poly") {
        filter.poly = numbers;
        return;
    }
    if (numbers.size() != 2) refuse(name, "bc takes two numbers, B and C");
    filter.b = numbers[0];
    filter.c = numbers[1];
}

double positive(std::string_view name, const char* what, double value) {
    if (!(value > 0.0) || !std::isfinite(value))
        refuse(name, std::string(what) + " must be positive and finite");
    return value;
}

/// int of the poly over its disk, over 2 pi R^2.
double polyIntegral(const std::vector<double>& c) {
    double sum = 0.0;
    for (std::size_t k = 0; k < c.size(); ++k) sum += c[k] / static_cast<double>(2 * k + 2);
    return sum;
}

void checkPoly(const Prefilter& filter) {
    if (filter.poly.size() > kMostPolyCoefficients) refuse(filter.name, "more than 32 coefficients");
    const double integral = polyIntegral(filter.poly);
    double absolute = 0.0;
    for (std::size_t k = 0; k < filter.poly.size(); ++k)
        absolute += std::abs(filter.poly[k]) / static_cast<double>(2 * k + 2);
    if (!(integral > 0.0)) refuse(filter.name, "its integral is not positive");
    if (!(absolute < kMostPolyCancellation * integral))
        refuse(filter.name, "its coefficients cancel to less than 1/256 of their size");
}

/// int |W| over int W decides how large a weight can be.
void checkLobes(const Prefilter& filter) {
    double absolute = 1.0;
    if (filter.table) absolute = filter.table->l1 * filter.table->l1;
    if (filter.kind == KernelKind::kPoly) {
        absolute = 0.0;
        constexpr int kSteps = 4096;
        for (int i = 0; i < kSteps; ++i) {
            const double q = (i + 0.5) / kSteps;
            double value = 0.0;
            for (std::size_t k = filter.poly.size(); k-- > 0;) value = value * q + filter.poly[k];
            absolute += std::abs(value) / (2.0 * kSteps);
        }
        absolute /= polyIntegral(filter.poly);
    }
    if (!(absolute < kMostAbsoluteIntegral))
        refuse(filter.name, "its negative lobes are too strong: int |W| must be below 12 int W");
}

double radialValue(const Prefilter& f, double r2) {
    const double R2 = f.radius * f.radius;
    if (!(r2 < R2)) return 0.0;
    const double area = M_PI * R2;
    if (f.kind == KernelKind::kDisk) return 1.0 / area;
    if (f.kind == KernelKind::kCone) return 3.0 / area * (1.0 - f64::sqrt(r2) / f.radius);
    if (f.kind == KernelKind::kGaussian) {
        const double s = f.sigma.value_or(f.radius / 3.0), inverse = 0.5 / (s * s);
        return f64::expNegative(r2 * inverse) / (area * f64::phi1(R2 * inverse));
    }
    double value = 0.0;
    for (std::size_t k = f.poly.size(); k-- > 0;) value = value * (r2 / R2) + f.poly[k];
    return value / (2.0 * area * polyIntegral(f.poly));
}

}  // namespace

Prefilter makePrefilter(std::string_view name, std::optional<double> radius, std::optional<double> sigma) {
    const std::string_view stem = name.substr(0, name.find(':'));
    const Known& known = find(name, stem);
    Prefilter filter;
    filter.kind = known.kind;
    filter.name = name;
    filter.b = known.b;
    filter.c = known.c;
    takeParameters(filter, stem, name);
    filter.radius = positive(name, "the radius", radius.value_or(known.radius));
    if (filter.radius < kLeastRadius || filter.radius > kMostRadius)
        refuse(name, "the radius must lie in [2^-32, 2^20] px");
    if (known.kind == KernelKind::kLanczos && filter.radius > kMostLanczosRadius)
        refuse(name, "the radius must be at most 256");
    const bool gaussian = known.kind == KernelKind::kGaussian || known.kind == KernelKind::kGaussianSeparable;
    if (sigma && !gaussian) refuse(name, "takes no sigma");
    if (gaussian) filter.sigma = positive(name, "sigma", sigma.value_or(filter.radius / 3.0));
    if (gaussian && *filter.sigma < kLeastSigmaToRadius * filter.radius)
        refuse(name, "sigma must be at least 2^-30 R");
    if (filter.kind == KernelKind::kPoly) checkPoly(filter);
    if (!filter.radial()) filter.table = std::make_shared<KernelTable>(makeKernelTable(filter));
    checkLobes(filter);
    return filter;
}

double evaluate(const Prefilter& filter, double x, double y) {
    if (filter.radial()) return radialValue(filter, x * x + y * y);
    if (filter.table) return kernelAt(*filter.table, x) * kernelAt(*filter.table, y);
    const KernelTable table = makeKernelTable(filter);
    return kernelAt(table, x) * kernelAt(table, y);
}

std::vector<std::string> describePrefilters() {
    std::vector<std::string> lines;
    for (const Known& known : kKnown) lines.emplace_back(known.line);
    return lines;
}

}  // namespace edgewise
