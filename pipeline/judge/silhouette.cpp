#include "pipeline/judge/silhouette.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <memory>

#include "pipeline/cell_grid.h"
#include "pipeline/field_rays.h"
#include "pipeline/field_shading.h"
#include "pipeline/gather.h"
#include "pipeline/project.h"
#include "pipeline/shading_text.h"
#include "sdf/field_of_all.h"
#include "sdf/scene_trace.h"

namespace edgewise::judge {
namespace {

constexpr int kBisections = 12, kDirections = 32;
/// Pixels beyond the film that are asked too: contours leave it.
constexpr int kAround = 16;
constexpr double kRingsPx[] = {0.01, 0.02, 0.04, 0.06, 0.09, 0.13, 0.18, 0.25,
                               0.35, 0.5,  0.7,  1.0,  1.5,  2.0,  3.0,  kFarthestContourPx};

/// The mask at `from` is not what it is at `to`.
glm::dvec2 change(const FilmMask& mask, glm::dvec2 from, glm::dvec2 to) {
    const bool first = mask(from);
    for (int n = 0; n < kBisections; ++n) {
        const glm::dvec2 middle = 0.5 * (from + to);
        (mask(middle) == first ? from : to) = middle;
    }
    return 0.5 * (from + to);
}

class FieldView {
  public:
    explicit FieldView(const MethodInput& in)
        : field_(sdf::fieldOfAll(*in.scene.field, glm::dvec3(in.camera.camera.world_from_camera[3]))),
          tape_(loweredTree(field_)),
          grid_(rayGrid(in.camera, in.film, field_.far)),
          tracer_(field_, tape_, trustedSettings(field_, {})),
          sign_(grid_.perspective ? tracer_.signAt(grid_.eye_world) : 1.0) {}
    bool operator()(const glm::dvec2& p_px) const { return tracer_.nearest(grid_.ray(p_px), sign_).hit; }

  private:
    const sdf::FieldScene field_;
    const sdf::Tape tape_;
    const sdf::RayGrid grid_;
    const sdf::SceneTracer tracer_;
    const double sign_;
};

class TriangleView {
  public:
    TriangleView(const Scene& scene, const ResolvedCamera& camera, const Film& film)
        : screen_(project(scene, camera, film)),
          cells_(Window{-kAround, -kAround, film.width + kAround, film.height + kAround}),
          lists_(gather(screen_, cells_)) {}

    bool operator()(const glm::dvec2& p_px) const {
        const std::size_t cell = cells_.index(cells_.columnOf(p_px.x), cells_.rowOf(p_px.y));
        for (std::size_t i = lists_.offsets[cell]; i < lists_.offsets[cell + 1]; ++i)
            if (holds(screen_.triangles[lists_.ids[i]], p_px)) return true;
        return false;
    }

  private:
    static bool holds(const ScreenTriangle& t, const glm::dvec2& p) {
        for (int k = 0; k < 3; ++k)
            if (f64::sideOf(t.p_px[k], t.p_px[(k + 1) % 3], p) < 0.0) return false;
        return true;
    }

    const ScreenScene screen_;
    const CellGrid cells_;
    const IdLists lists_;
};

/// By rows, so that the order does not depend on threads.
std::vector<glm::dvec2> joined(const std::vector<std::vector<glm::dvec2>>& rows) {
    std::vector<glm::dvec2> all;
    for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
    return all;
}

struct Farthest {
    double px = 0.0, sum_px = 0.0;
    glm::dvec2 where_px{0.0};
};

Farthest farthest(const std::vector<glm::dvec2>& from, const FilmMask& to) {
    std::vector<double> distance(from.size());
    tbb::parallel_for(std::size_t(0), from.size(),
                      [&](std::size_t i) { distance[i] = distanceToContour(to, from[i]); });
    Farthest out;
    for (std::size_t i = 0; i < from.size(); ++i) {
        out.sum_px += distance[i];
        if (distance[i] > out.px) out.px = distance[i], out.where_px = from[i];
    }
    return out;
}

}  // namespace

FilmMask fieldMask(const MethodInput& input) {
    const auto view = std::make_shared<const FieldView>(input);
    return [view](const glm::dvec2& p_px) { return (*view)(p_px); };
}

FilmMask triangleMask(const Scene& triangles, const ResolvedCamera& camera, const Film& film) {
    const auto view = std::make_shared<const TriangleView>(triangles, camera, film);
    return [view](const glm::dvec2& p_px) { return (*view)(p_px); };
}

std::vector<glm::dvec2> contourPoints(const FilmMask& mask, const PixelBox& box) {
    const std::size_t width = static_cast<std::size_t>(box.width());
    std::vector<std::vector<char>> seen(box.height(), std::vector<char>(width));
    const auto centre = [&](std::size_t x, int y) {
        return glm::dvec2(box.x0 + static_cast<double>(x) + 0.5, box.y0 + y + 0.5);
    };
    tbb::parallel_for(0, box.height(), [&](int y) {
        for (std::size_t x = 0; x < width; ++x) seen[y][x] = mask(centre(x, y));
    });
    std::vector<std::vector<glm::dvec2>> rows(box.height());
    tbb::parallel_for(0, box.height(), [&](int y) {
        for (std::size_t x = 0; x < width; ++x) {
            if (x + 1 < width && seen[y][x] != seen[y][x + 1])
                rows[y].push_back(change(mask, centre(x, y), centre(x + 1, y)));
            if (y + 1 < box.height() && seen[y][x] != seen[y + 1][x])
                rows[y].push_back(change(mask, centre(x, y), centre(x, y + 1)));
        }
    });
    return joined(rows);
}

double distanceToContour(const FilmMask& mask, const glm::dvec2& p_px) {
    const bool here = mask(p_px);
    for (const double radius : kRingsPx) {
        double nearest = HUGE_VAL;
        for (int n = 0; n < kDirections; ++n) {
            const double angle = 2.0 * glm::pi<double>() * n / kDirections;
            const glm::dvec2 there = p_px + radius * glm::dvec2(std::cos(angle), std::sin(angle));
            if (mask(there) != here)
                nearest = std::min(nearest, glm::distance(p_px, change(mask, p_px, there)));
        }
        if (nearest <= radius) return nearest;
    }
    return HUGE_VAL;
}

SilhouetteDistance silhouetteDistance(const FilmMask& first, const FilmMask& second, const PixelBox& box) {
    const std::vector<glm::dvec2> a = contourPoints(first, box), b = contourPoints(second, box);
    const Farthest there = farthest(a, second), back = farthest(b, first);
    SilhouetteDistance out;
    out.first_to_second_px = there.px, out.second_to_first_px = back.px;
    out.first_points = a.size(), out.second_points = b.size();
    if (!a.empty() || !b.empty())
        out.mean_px = (there.sum_px + back.sum_px) / static_cast<double>(a.size() + b.size());
    out.worst_px = there.px >= back.px ? there.where_px : back.where_px;
    return out;
}

}  // namespace edgewise::judge
