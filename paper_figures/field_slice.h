// A field on the plane z = 0, and rays in it step by step: what drawings of sphere tracing are made of.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "paper_figures/drawing.h"
#include "sdf/trace_settings.h"
#include "sdf/tree.h"

namespace edgewise::figures {

struct SliceRay {
    glm::dvec2 origin{0.0}, direction{1.0, 0.0};  ///< direction: unit
    double t_min = 0.01, t_max = 20.0;
    double pixel_slope = 0.004;  ///< half a pixel's side at t = 1
    double sign = 1.0;           ///< -1: from within
    glm::dvec2 at(double t) const { return origin + t * direction; }
};

/// One evaluation of the field along a ray.
struct MarchStep {
    double t = 0.0, radius = 0.0;  ///< radius: of the unbounding sphere there
    bool relaxed = false;          ///< the ray took a longer step than the last sphere's radius to get there
    bool failed = false;           ///< it may have passed a surface, and is taken back
};

struct March {
    std::vector<MarchStep> steps;
    double t = 0.0;            ///< where the ray ends
    double candidate_t = 0.0;  ///< the point nearest to a surface in pixels
    bool hit = false;
};

/// By the text that traces pictures (sdf_trace_step), a ray of the whole pixel's threshold.
March marchAlong(const sdf::Tape& field, const SliceRay& ray, sdf::Relaxation relaxation, double omega,
                 int most_steps);

/// The part of the plane that a panel of a drawing shows, y up.
struct SlicePanel {
    glm::dvec2 corner, size;  ///< of the drawing
    glm::dvec2 low;           ///< of the plane: the panel's lower left corner
    double scale = 80.0;      ///< of the drawing a unit
    glm::dvec2 at(glm::dvec2 p) const {
        return {corner.x + scale * (p.x - low.x), corner.y + size.y - scale * (p.y - low.y)};
    }
};

/// What is solid in grey, with its outline.
void drawSolid(const SlicePanel& panel, const sdf::Tape& field, Drawing& drawing);

double valueOn(const sdf::Tape& field, glm::dvec2 p);
/// Unit, outwards.
glm::dvec2 normalOn(const sdf::Tape& field, glm::dvec2 p);

/// Balls in the plane: middle and radius of each.
struct SliceBall {
    glm::dvec2 middle;
    double radius;
};
sdf::Tape ballsField(const std::vector<SliceBall>& balls);

}  // namespace edgewise::figures
