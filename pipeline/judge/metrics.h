// How far a picture is from its reference: the numbers of `edgewise compare` and `edgewise metrics`.
#pragma once

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/image_buffer.h"

namespace edgewise::judge {

/// rmse, max, bias and psnr are over linear R, G and B in double; alpha is left out. The error of a channel
/// of a pixel is d = image - reference.
struct ErrorMetrics {
    double rmse = 0.0;                           ///< root of the mean of d^2
    double max = 0.0;                            ///< largest |d|
    double bias = 0.0;                           ///< mean of d
    std::optional<double> psnr;                  ///< dB, peak 1: -20 log10(rmse); none if rmse is 0
    std::optional<double> edge_rmse, edge_psnr;  ///< the same where the reference's `edge` is set; none if
                                                 ///< nowhere, or without the channel (`edge` is empty)
    double ssim = 1.0;                           ///< of the sRGB picture, see ssim.h
    double flip = 0.0;                           ///< mean of flipMap()
};

/// The names stand for the pictures in messages. The same bits for any number of threads. Throws InputError
/// if the sizes differ (where the boxes lie does not matter), or naming the first pixel in which R, G, B or
/// the reference's `edge` is not finite.
ErrorMetrics compareImages(const ImageBuffer& image, const ImageBuffer& reference,
                           const std::string& image_name = "image",
                           const std::string& reference_name = "reference");

/// image - reference of each pixel, rows from the top, linear. The sizes agree.
std::vector<glm::dvec3> signedErrors(const ImageBuffer& image, const ImageBuffer& reference);

/// The object `error` of results.json; what there is none of is null.
nlohmann::ordered_json metricsJson(const ErrorMetrics& metrics);

}  // namespace edgewise::judge
