#include "pipeline/methods/field_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "pipeline/atomic_file.h"
#include "pipeline/error.h"
#include "pipeline/write_image.h"

namespace edgewise {

glm::dvec3 heatColor(double x) {
    static const glm::dvec3 stops[]{{0, 0, 0}, {0, 0, 0.6}, {0.8, 0, 0.1}, {1, 0.8, 0}, {1, 1, 1}};
    const double at = std::clamp(x, 0.0, 1.0) * 4.0;
    const int i = std::min(static_cast<int>(at), 3);
    return glm::mix(stops[i], stops[i + 1], at - i);
}

FieldPictures::FieldPictures(const std::optional<std::filesystem::path>& folder, const PixelBox& crop)
    : folder_(folder), crop_(crop) {
    if (!active()) return;
    std::error_code error;
    std::filesystem::create_directories(*folder_, error);
    if (error) throw InputError("--dump-stages", fmt::format("{}: {}", folder_->string(), error.message()));
    sums_.resize(static_cast<std::size_t>(crop.width()) * crop.height());
}

void FieldPictures::add(const FieldWindow& window, const FieldSamples& samples) {
    if (!active()) return;
    for (std::size_t i = 0; i < window.samples(); ++i) {
        const int x = window.pixels.x0 + static_cast<int>(i % window.stride()) / window.per_side;
        const int y = window.pixels.y0 + static_cast<int>(i / window.stride()) / window.per_side;
        if (!crop_.contains(x, y)) continue;
        Sums& sums = sums_[static_cast<std::size_t>(y - crop_.y0) * crop_.width() + (x - crop_.x0)];
        sums.samples += 1.0, sums.hits += samples.surface[i] != kNone;
        sums.evaluations += samples.evaluations[i], sums.iterations += samples.iterations[i];
        sums.residual += std::abs(samples.residual[i]);
    }
}

/// `white` 0: the largest.
template <class Value>
double FieldPictures::writePicture(const std::string& name, bool colors, double white,
                                   const Value& value) const {
    if (white == 0.0)
        for (const Sums& sums : sums_) white = std::max(white, value(sums));
    ImageBuffer picture(crop_);
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        const double part = white > 0.0 ? value(sums_[i]) / white : 0.0;
        picture.rgba[i] = glm::dvec4(colors ? heatColor(part) : glm::dvec3(std::min(part, 1.0)), 1.0);
    }
    writeImage(*folder_ / name, picture, {crop_.x1, crop_.y1, 0.0, {}});
    return white;
}

void FieldPictures::finish() const {
    if (!active()) return;
    const auto evaluations = [](const Sums& s) { return s.samples > 0 ? s.evaluations / s.samples : 0.0; };
    const auto iterations = [](const Sums& s) { return s.samples > 0 ? s.iterations / s.samples : 0.0; };
    const auto residual = [](const Sums& s) { return s.hits > 0 ? 100.0 * s.residual / s.hits : 0.0; };
    std::string scales = "picture,white\n";
    scales += fmt::format("evaluations.png,{}\n", writePicture("evaluations.png", true, 0.0, evaluations));
    scales += fmt::format("iterations.png,{}\n", writePicture("iterations.png", true, 0.0, iterations));
    scales += fmt::format("residual.png,{}\n", writePicture("residual.png", false, 1.0, residual));
    writeAtomically(*folder_ / "scales.csv", scales);
    std::string rows = "x,y,evaluations,iterations,residual\n";
    for (std::size_t i = 0; i < sums_.size(); ++i)
        fmt::format_to(std::back_inserter(rows), "{},{},{},{},{}\n",
                       crop_.x0 + static_cast<int>(i % crop_.width()),
                       crop_.y0 + static_cast<int>(i / crop_.width()), evaluations(sums_[i]),
                       iterations(sums_[i]), residual(sums_[i]) / 100.0);
    writeAtomically(*folder_ / "field.csv", rows);
}

}  // namespace edgewise
