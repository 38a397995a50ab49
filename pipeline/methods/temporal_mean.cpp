#include "pipeline/methods/temporal_mean.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace edgewise {
namespace {

double rootOfMean(double sum, std::size_t pixels) {
    return pixels == 0 ? 0.0 : std::sqrt(sum / (3.0 * static_cast<double>(pixels)));
}

}  // namespace

void TemporalMean::add(std::span<const glm::dvec4> frame) {
    sum_.resize(frame.size()), squares_.resize(frame.size()), even_.resize(frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i) {
        sum_[i] += frame[i];
        squares_[i] += frame[i] * frame[i];
        if (frames_ % 2 == 0) even_[i] += frame[i];
    }
    ++frames_;
}

glm::dvec3 TemporalMean::deviation(std::size_t pixel) const {
    if (frames_ < 2) return glm::dvec3(0.0);
    const double n = static_cast<double>(frames_);
    const glm::dvec3 mean(sum_[pixel] / n), square(squares_[pixel] / n);
    return glm::sqrt(glm::max(square - mean * mean, glm::dvec3(0.0)) * (n / (n - 1.0)));
}

double TemporalMean::deviation() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < sum_.size(); ++i) {
        const glm::dvec3 one = deviation(i);
        sum += dot(one, one);
    }
    return rootOfMean(sum, sum_.size());
}

double TemporalMean::deviationOfMean() const {
    if (frames_ < 2) return 0.0;
    const double odd = static_cast<double>(frames_ / 2), even = static_cast<double>(frames_) - odd;
    double sum = 0.0;
    for (std::size_t i = 0; i < sum_.size(); ++i) {
        const glm::dvec3 half = glm::dvec3(even_[i] / even - (sum_[i] - even_[i]) / odd) * 0.5;
        sum += dot(half, half);
    }
    return rootOfMean(sum, sum_.size());
}

}  // namespace edgewise
