// --dump-stages on SDF scenes: what rays took, as data and as pictures.
#pragma once

#include "pipeline/field_tracer.h"

namespace edgewise {

/// Black, blue, red, yellow, white at quarters of 0 to 1, as linear light.
glm::dvec3 heatColor(double x);

/// Writes into the folder, of the mean over each pixel's samples:
///     evaluations.png   of the field; black is 0, white the most, between them through blue, red, yellow
///     iterations.png    when the rays ended (Figure 7 of Keinert et al. 2014)
///     residual.png      100 f at the hits, grey from 0 to 1 (Figure 9)
///     field.csv         x, y, evaluations, iterations, residual
///     scales.csv        what white is in each picture
/// Does nothing without a folder.
class FieldPictures {
  public:
    FieldPictures(const std::optional<std::filesystem::path>& folder, const PixelBox& crop);
    bool active() const { return folder_.has_value(); }
    /// Of a window's samples, those within the crop.
    void add(const FieldWindow& window, const FieldSamples& samples);
    void finish() const;

  private:
    struct Sums {
        double evaluations = 0.0, iterations = 0.0, residual = 0.0, samples = 0.0, hits = 0.0;
    };
    template <class Value>
    double writePicture(const std::string& name, bool colors, double white, const Value& value) const;

    std::optional<std::filesystem::path> folder_;
    PixelBox crop_;
    std::vector<Sums> sums_;
};

}  // namespace edgewise
