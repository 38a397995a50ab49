// The colours of divided pixels' pieces, and of whole pixels.
#pragma once

#include "pipeline/methods/cone_rows.h"
#include "sdf/field_scene.h"

namespace edgewise {

/// Everything that is shaded, and what came of it; one entry each, but of_pixel.
struct CellShades {
    std::vector<sdf::TravellingRay> rays;
    std::vector<sdf::SurfaceHit> hits;
    std::vector<glm::dvec4> colors;
    std::vector<std::uint32_t> sights;    ///< as FieldTracer::shade() gives them
    std::vector<std::uint32_t> of_pixel;  ///< a pixel: its own hit's place; kNoGroup: none
};

class CellShading {
  public:
    /// Refers to its arguments.
    CellShading(const sdf::RayGrid& grid, const sdf::FieldScene& scene, FieldTracer& device)
        : grid_(grid), scene_(scene), device_(device) {}

    /// Every pixel's hit and every piece at one place, patterns averaged. Gives the pieces their places.
    /// `shades`: what it holds is forgotten, its memory is used again.
    void shade(const ConeRows& rows, std::vector<EdgeCell>& cells, CellShades& shades) const;

  private:
    void meetPieces(std::vector<EdgeCell>& cells) const;
    void collect(const ConeRows& rows, std::vector<EdgeCell>& cells, CellShades& shades) const;
    template <class Visit>
    static void eachShaded(const ConeRows& rows, std::size_t pixel, EdgeCell* cell, const Visit& visit);
    std::optional<glm::dvec3> stepOf(const ConeRows& rows, std::size_t i, const sdf::SurfaceHit& hit,
                                     std::size_t before, std::size_t after) const;
    void takePattern(const ConeRows& rows, std::size_t i, sdf::SurfaceHit& hit) const;

    const sdf::RayGrid& grid_;
    const sdf::FieldScene& scene_;
    FieldTracer& device_;
};

/// The pixels' colours, where nothing is met the background's.
std::vector<glm::dvec4> blended(const ConeRows& rows, const std::vector<EdgeCell>& cells,
                                const CellShades& shades, const glm::dvec4& background);

}  // namespace edgewise
