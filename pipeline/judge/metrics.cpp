#include "pipeline/judge/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "pipeline/error.h"
#include "pipeline/judge/flip.h"
#include "pipeline/judge/plane.h"
#include "pipeline/judge/ssim.h"

namespace edgewise::judge {
namespace {

constexpr float kEdgeThreshold = 0.5f;  // `edge` is 0 or 1; half floats and 8 bits keep that

void requireSameSize(const PixelBox& image, const PixelBox& reference, const std::string& image_name,
                     const std::string& reference_name) {
    if (image.width() == reference.width() && image.height() == reference.height()) return;
    throw InputError(image_name, fmt::format("is {}x{} pixels, {} is {}x{}", image.width(), image.height(),
                                             reference_name, reference.width(), reference.height()));
}

[[noreturn]] void refusePixel(const ImageBuffer& image, std::size_t index, double value,
                              const std::string& name) {
    const auto width = static_cast<std::size_t>(image.box.width());
    throw InputError(name, fmt::format("pixel {},{} is {}, not a finite number",
                                       image.box.x0 + static_cast<int>(index % width),
                                       image.box.y0 + static_cast<int>(index / width), value));
}

void requireFinite(const ImageBuffer& image, const std::string& name) {
    for (std::size_t i = 0; i < image.rgba.size(); ++i)
        for (int c = 0; c < 3; ++c)
            if (!std::isfinite(image.rgba[i][c])) refusePixel(image, i, image.rgba[i][c], name);
}

void requireFiniteEdges(const ImageBuffer& image, const std::string& name) {
    for (std::size_t i = 0; i < image.edge.size(); ++i)
        if (!std::isfinite(image.edge[i])) refusePixel(image, i, image.edge[i], name);
}

/// Over some channels of some pixels.
struct ErrorSums {
    double squares = 0.0, errors = 0.0, largest = 0.0, values = 0.0;
    double edge_squares = 0.0, edge_values = 0.0;

    void add(const glm::dvec3& d, bool is_edge) {
        const double square = glm::dot(d, d);
        squares += square;
        errors += d.x + d.y + d.z;
        largest = std::max({largest, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        values += 3.0;
        if (!is_edge) return;
        edge_squares += square;
        edge_values += 3.0;
    }
    ErrorSums& operator+=(const ErrorSums& other) {
        squares += other.squares;
        errors += other.errors;
        largest = std::max(largest, other.largest);
        values += other.values;
        edge_squares += other.edge_squares;
        edge_values += other.edge_values;
        return *this;
    }
};

ErrorSums sumErrors(const ImageBuffer& image, const ImageBuffer& reference) {
    const auto width = static_cast<std::size_t>(image.box.width());
    return sumRows(image.box.height(), [&](int y) {
        ErrorSums row;
        const std::size_t begin = static_cast<std::size_t>(y) * width;
        for (std::size_t i = begin; i < begin + width; ++i)
            row.add(glm::dvec3(image.rgba[i]) - glm::dvec3(reference.rgba[i]),
                    !reference.edge.empty() && reference.edge[i] > kEdgeThreshold);
        return row;
    });
}

std::optional<double> psnr(double rmse) {
    if (rmse == 0.0) return {};
    return -20.0 * std::log10(rmse);
}

double meanFlip(const ImageBuffer& image, const ImageBuffer& reference) {
    const std::vector<double> map = flipMap(image, reference);
    const auto width = static_cast<std::size_t>(image.box.width());
    const double sum = sumRows(image.box.height(), [&](int y) {
        double row = 0.0;
        const std::size_t begin = static_cast<std::size_t>(y) * width;
        for (std::size_t i = begin; i < begin + width; ++i) row += map[i];
        return row;
    });
    return sum / static_cast<double>(map.size());
}

nlohmann::ordered_json orNull(const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

}  // namespace

ErrorMetrics compareImages(const ImageBuffer& image, const ImageBuffer& reference,
                           const std::string& image_name, const std::string& reference_name) {
    requireSameSize(image.box, reference.box, image_name, reference_name);
    requireFinite(image, image_name);
    requireFinite(reference, reference_name);
    requireFiniteEdges(reference, reference_name);
    const ErrorSums sums = sumErrors(image, reference);
    ErrorMetrics metrics;
    metrics.rmse = std::sqrt(sums.squares / sums.values);
    metrics.max = sums.largest;
    metrics.bias = sums.errors / sums.values;
    metrics.psnr = psnr(metrics.rmse);
    if (sums.edge_values > 0.0) {
        metrics.edge_rmse = std::sqrt(sums.edge_squares / sums.edge_values);
        metrics.edge_psnr = psnr(*metrics.edge_rmse);
    }
    metrics.ssim = ssim(image, reference);
    metrics.flip = meanFlip(image, reference);
    return metrics;
}

std::vector<glm::dvec3> signedErrors(const ImageBuffer& image, const ImageBuffer& reference) {
    std::vector<glm::dvec3> errors(image.rgba.size());
    tbb::parallel_for(std::size_t{0}, errors.size(), [&](std::size_t i) {
        errors[i] = glm::dvec3(image.rgba[i]) - glm::dvec3(reference.rgba[i]);
    });
    return errors;
}

nlohmann::ordered_json metricsJson(const ErrorMetrics& metrics) {
    return {{"rmse", metrics.rmse},
            {"max", metrics.max},
            {"bias", metrics.bias},
            {"psnr", orNull(metrics.psnr)},
            {"edge_rmse", orNull(metrics.edge_rmse)},
            {"edge_psnr", orNull(metrics.edge_psnr)},
            {"ssim", metrics.ssim},
            {"flip", metrics.flip}};
}

}  // namespace edgewise::judge
