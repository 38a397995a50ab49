#include "pipeline/judge/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "pipeline/judge/plane.h"

namespace edgewise::judge {
namespace {

using std::numbers::pi;

/// Of the formula below, the exponents and knees of the paper's section 4.
constexpr double kColorPower = 0.7, kKnee = 0.4, kKneeValue = 0.95, kFeaturePower = 0.5;
/// Width of the human edge detector, from peak to trough, in degrees.
constexpr double kDetectorWidth = 0.082;

/// CIE XYZ of linear Rec.709 with its white (1, 1, 1) at D65; a row for X, Y and Z.
constexpr std::array<std::array<double, 3>, 3> kXyzFromRgb{
    {{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
     {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
     {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}}};

/// XYZ over the white's.
glm::dmat3 whiteXyzFromRgb() {
    glm::dmat3 matrix;
    for (int row = 0; row < 3; ++row) {
        const auto& of_row = kXyzFromRgb[static_cast<std::size_t>(row)];
        const double white = of_row[0] + of_row[1] + of_row[2];
        for (int column = 0; column < 3; ++column)
            matrix[column][row] = of_row[static_cast<std::size_t>(column)] / white;
    }
    return matrix;
}

const glm::dmat3 kWhiteXyzFromRgb = whiteXyzFromRgb();
const glm::dmat3 kRgbFromWhiteXyz = glm::inverse(kWhiteXyzFromRgb);

/// Luminance, red-green, blue-yellow: the paper's YCxCz without its scales and offset, which cancel, since
/// between there and back stand normalised filters alone.
using Opponent = std::array<Plane, 3>;

Opponent opponentColors(const ImageBuffer& image) {
    const Plane empty(image.box.width(), image.box.height());
    Opponent planes{empty, empty, empty};
    tbb::parallel_for(std::size_t{0}, image.rgba.size(), [&](std::size_t i) {
        const glm::dvec3 xyz = kWhiteXyzFromRgb * glm::clamp(glm::dvec3(image.rgba[i]), 0.0, 1.0);
        planes[0].values[i] = xyz.y;
        planes[1].values[i] = xyz.x - xyz.y;
        planes[2].values[i] = xyz.y - xyz.z;
    });
    return planes;
}

glm::dvec3 rgbOfOpponent(double luminance, double red_green, double blue_yellow) {
    return kRgbFromWhiteXyz * glm::dvec3(luminance + red_green, luminance, luminance - blue_yellow);
}

/// A term a sqrt(pi/b) exp(-pi^2 d^2 / b) of a contrast sensitivity, d in degrees (table 1).
struct Sensitivity {
    double a, b;
};
constexpr Sensitivity kLuminance{1.0, 0.0047}, kRedGreen{1.0, 0.0053};
constexpr std::array<Sensitivity, 2> kBlueYellow{{{34.1, 0.04}, {13.5, 0.025}}};

/// Standard deviation in pixels.
double sigmaOf(const Sensitivity& term) {
    return std::sqrt(term.b / (2.0 * pi * pi)) * kFlipPixelsPerDegree;
}

/// Three standard deviations of the widest, for all of them.
int sensitivityRadius() {
    return static_cast<int>(std::ceil(3.0 * sigmaOf(kBlueYellow[0])));
}

Plane blurred(const Plane& plane, const Sensitivity& term) {
    const Taps taps = normalized(gaussianTaps(sigmaOf(term), sensitivityRadius()));
    return filtered(plane, taps, taps);
}

/// Its kernel is the sum of two Gaussians, normalised together: each weighs what it sums to.
Plane blurredBlueYellow(const Plane& plane) {
    std::array<double, 2> weight{};
    for (std::size_t t = 0; t < 2; ++t) {
        double sum = 0.0;
        for (const double tap : gaussianTaps(sigmaOf(kBlueYellow[t]), sensitivityRadius())) sum += tap;
        weight[t] = kBlueYellow[t].a * std::sqrt(pi / kBlueYellow[t].b) * sum * sum;
    }
    const double all = weight[0] + weight[1];
    Plane out = blurred(plane, kBlueYellow[0]);
    const Plane other = blurred(plane, kBlueYellow[1]);
    for (std::size_t i = 0; i < out.values.size(); ++i)
        out.values[i] = (weight[0] * out.values[i] + weight[1] * other.values[i]) / all;
    return out;
}

double labCurve(double t) {
    constexpr double kDelta = 6.0 / 29.0;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
}

/// L*a*b* with chroma scaled by L*/100: colours look more colourful the lighter they are (Hunt).
glm::dvec3 huntLab(const glm::dvec3& rgb) {
    const glm::dvec3 xyz = kWhiteXyzFromRgb * rgb;
    const double fx = labCurve(xyz.x), fy = labCurve(xyz.y), fz = labCurve(xyz.z);
    const double lightness = 116.0 * fy - 16.0, hunt = 0.01 * lightness;
    return {lightness, hunt * 500.0 * (fx - fy), hunt * 200.0 * (fy - fz)};
}

/// HyAB: lightness by the city, chroma as the crow flies.
double colorDistance(const glm::dvec3& p, const glm::dvec3& q) {
    return std::abs(p.x - q.x) + std::hypot(p.y - q.y, p.z - q.z);
}

/// [0, 1] of a HyAB distance.
double colorError(double distance) {
    static const double largest =
        std::pow(colorDistance(huntLab({0.0, 1.0, 0.0}), huntLab({0.0, 0.0, 1.0})), kColorPower);
    const double error = std::pow(distance, kColorPower), knee = kKnee * largest;
    if (error < knee) return kKneeValue / knee * error;
    return kKneeValue + (1.0 - kKneeValue) * (error - knee) / (largest - knee);
}

/// The colours that the eye resolves, as huntLab.
struct SeenColors {
    Plane luminance, red_green, blue_yellow;
    glm::dvec3 at(std::size_t i) const {
        const glm::dvec3 rgb = rgbOfOpponent(luminance.values[i], red_green.values[i], blue_yellow.values[i]);
        return huntLab(glm::clamp(rgb, 0.0, 1.0));
    }
};

SeenColors seenColors(const Opponent& planes) {
    return {blurred(planes[0], kLuminance), blurred(planes[1], kRedGreen), blurredBlueYellow(planes[2])};
}

double detectorSigma() {
    return 0.5 * kDetectorWidth * kFlipPixelsPerDegree;
}

int detectorRadius() {
    return static_cast<int>(std::ceil(3.0 * detectorSigma()));
}

/// Positive taps sum to 1, negative ones to -1.
Taps balanced(Taps taps) {
    double positive = 0.0, negative = 0.0;
    for (const double tap : taps) (tap > 0.0 ? positive : negative) += std::abs(tap);
    for (double& tap : taps) tap /= tap > 0.0 ? positive : negative;
    return taps;
}

/// A Gaussian's derivative: the first finds edges, the second points.
Taps derivativeTaps(int order) {
    const double sigma = detectorSigma();
    const int radius = detectorRadius();
    Taps taps = gaussianTaps(sigma, radius);
    for (int i = -radius; i <= radius; ++i)
        taps[static_cast<std::size_t>(i + radius)] *= order == 1 ? -i : i * i / (sigma * sigma) - 1.0;
    return balanced(taps);
}

/// The length of (derivative across, derivative down) at each pixel.
Plane featureStrength(const Plane& luminance, int order) {
    const Taps smooth = normalized(gaussianTaps(detectorSigma(), detectorRadius()));
    const Taps derivative = derivativeTaps(order);
    Plane across = filtered(luminance, derivative, smooth);
    const Plane down = filtered(luminance, smooth, derivative);
    tbb::parallel_for(std::size_t{0}, across.values.size(), [&](std::size_t i) {
        across.values[i] = std::hypot(across.values[i], down.values[i]);
    });
    return across;
}

struct Features {
    Plane edges, points;
};

Features features(const Plane& luminance) {
    return {featureStrength(luminance, 1), featureStrength(luminance, 2)};
}

/// In [0, 1].
double featureError(const Features& image, const Features& reference, std::size_t i) {
    const double edge = std::abs(image.edges.values[i] - reference.edges.values[i]);
    const double point = std::abs(image.points.values[i] - reference.points.values[i]);
    return std::pow(std::max(edge, point) / std::numbers::sqrt2, kFeaturePower);
}

}  // namespace

std::vector<double> flipMap(const ImageBuffer& image, const ImageBuffer& reference) {
    const Opponent image_planes = opponentColors(image), reference_planes = opponentColors(reference);
    const SeenColors image_colors = seenColors(image_planes), reference_colors = seenColors(reference_planes);
    const Features image_features = features(image_planes[0]);
    const Features reference_features = features(reference_planes[0]);
    std::vector<double> map(image.rgba.size());
    tbb::parallel_for(std::size_t{0}, map.size(), [&](std::size_t i) {
        const double color = colorError(colorDistance(image_colors.at(i), reference_colors.at(i)));
        map[i] = std::pow(color, 1.0 - featureError(image_features, reference_features, i));
    });
    return map;
}

}  // namespace edgewise::judge
