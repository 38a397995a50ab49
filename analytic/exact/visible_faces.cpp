#include "analytic/exact/visible_faces.h"

#include <CGAL/Env_surface_data_traits_3.h>
#include <CGAL/Env_triangle_traits_3.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/envelope_3.h>

#include <algorithm>

namespace edgewise::exact {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Kernel::FT;
using TriangleTraits = CGAL::Env_triangle_traits_3<Kernel>;
using Traits = CGAL::Env_surface_data_traits_3<TriangleTraits, Owner>;
using Diagram = CGAL::Envelope_diagram_2<Traits>;

/// The lazy number is evaluated first: its double approximation was once off by 1e-8.
template <class Lazy>
Rational toRational(const Lazy& number) {
    const auto& value = number.exact();
    Rational out;
    if constexpr (requires { value.mpq(); })
        mpq_set(out.backend().data(), value.mpq());
    else if constexpr (requires { value.backend().data(); })
        mpq_set(out.backend().data(), value.backend().data());
    else
        mpq_set(out.backend().data(), value.get_mpq_t());
    return out;
}

/// Where the triangle's depth plane, which is the scene's definition of depth, lies over a corner.
Kernel::Point_3 lifted(const ScreenScene& scene, const ScreenTriangle& t, std::size_t k) {
    const DepthPlane& z = scene.planes[t.plane];
    const Number x(t.p_px[k].x), y(t.p_px[k].y);
    const Number depth = Number(z.dz_dx) * (x - Number(scene.anchor_px.x)) +
                         Number(z.dz_dy) * (y - Number(scene.anchor_px.y)) + Number(z.z_anchor);
    return {x, y, depth};
}

template <class Circulator>
std::vector<Point> cycleOf(Circulator first) {
    std::vector<Point> cycle;
    Circulator edge = first;
    do {
        const auto& p = edge->target()->point();
        cycle.push_back({toRational(p.x()), toRational(p.y())});
    } while (++edge != first);
    return cycle;
}

void findBounds(Face& face) {
    face.low = face.high = face.cycles.front().front();
    for (const auto& cycle : face.cycles)
        for (const Point& p : cycle) {
            face.low = {std::min(face.low.x, p.x), std::min(face.low.y, p.y)};
            face.high = {std::max(face.high.x, p.x), std::max(face.high.y, p.y)};
        }
}

/// CGAL's cycles have the face at their left in a frame whose y goes up: positive in its x and y, and these
/// are the pixels' own numbers.
Face faceOf(const Diagram::Face& from) {
    Face face;
    for (auto surface = from.surfaces_begin(); surface != from.surfaces_end(); ++surface)
        face.tied.push_back(surface->data());
    std::ranges::sort(face.tied);
    face.tied.erase(std::unique(face.tied.begin(), face.tied.end()), face.tied.end());
    face.owner = face.tied.front();
    for (auto outer = from.outer_ccbs_begin(); outer != from.outer_ccbs_end(); ++outer)
        face.cycles.push_back(cycleOf(*outer));
    for (auto inner = from.inner_ccbs_begin(); inner != from.inner_ccbs_end(); ++inner)
        face.cycles.push_back(cycleOf(*inner));
    findBounds(face);
    return face;
}

}  // namespace

bool meets(const ScreenTriangle& t, const Region& region) {
    const auto [x0, x1] = std::minmax({t.p_px[0].x, t.p_px[1].x, t.p_px[2].x});
    const auto [y0, y1] = std::minmax({t.p_px[0].y, t.p_px[1].y, t.p_px[2].y});
    return x0 <= region.x1 && x1 >= region.x0 && y0 <= region.y1 && y1 >= region.y0;
}

std::vector<Face> visibleFaces(const ScreenScene& scene, const Region& region) {
    std::vector<Traits::Surface_3> surfaces;
    for (const ScreenTriangle& t : scene.triangles)
        if (meets(t, region))
            surfaces.emplace_back(
                TriangleTraits::Surface_3(lifted(scene, t, 0), lifted(scene, t, 1), lifted(scene, t, 2)),
                t.owner);
    Diagram diagram;
    CGAL::upper_envelope_3(surfaces.begin(), surfaces.end(), diagram);
    std::vector<Face> faces;
    for (auto face = diagram.faces_begin(); face != diagram.faces_end(); ++face)
        if (face->number_of_surfaces() > 0) faces.push_back(faceOf(*face));
    return faces;
}

Rational area(const Face& face) {
    Rational twice = 0;
    for (const auto& cycle : face.cycles)
        for (std::size_t i = 0; i < cycle.size(); ++i) {
            const Point &a = cycle[i], &b = cycle[(i + 1) % cycle.size()];
            twice += a.x * b.y - a.y * b.x;
        }
    return twice / 2;
}

}  // namespace edgewise::exact
