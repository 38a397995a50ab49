#include "paper_figures/slanted_edge.h"

#include <cmath>
#include <map>

#include "analytic/filter_properties.h"
#include "pipeline/methods/method.h"

namespace edgewise::figures {
namespace {

constexpr int kSide = 512;  ///< px of the film; the edge passes through its middle
constexpr int kMiddle = kSide / 2;

/// A world unit a pixel, y up, the film's middle at the origin. Integers, so that the edge is where it is
/// said to be.
Scene halfPlane(int p, int q) {
    const int along = kSide / p + 1, across = 4 * kSide / p;
    const auto corner = [&](int a, int b) {
        return glm::vec3(float(q * a - p * b), float(p * a + q * b), -1.0f);
    };
    Geometry plane;
    plane.position_file = {corner(along, 0), corner(-along, 0), corner(-along, across),
                           corner(along, across)};
    plane.position_world.assign(plane.position_file.begin(), plane.position_file.end());
    plane.world_from_file = glm::dmat4(1.0);
    plane.triangles = {{0, 1, 2}, {0, 2, 3}};
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].double_sided = scene.materials[0].unlit = true;
    scene.triangle_count = plane.triangles.size();
    scene.geometry.push_back(std::move(plane));
    return scene;
}

ResolvedCamera pixelCamera() {
    ResolvedCamera camera;
    camera.camera.perspective = false;
    camera.camera.xmag = camera.camera.ymag = kMiddle;
    return camera;
}

/// p rows, as wide as the edge and the support need.
PixelBox bandAround(int p, int q, double reach) {
    const int half = static_cast<int>(std::ceil(0.5 * q + (reach + 2) * std::hypot(p, q) / p));
    return {kMiddle - half, kMiddle - p / 2, kMiddle + half, kMiddle - p / 2 + p};
}

}  // namespace

SlantedEdge measureEdge(const Prefilter& filter, int p, int q, Progress& progress) {
    const Scene scene = halfPlane(p, q);
    const ResolvedCamera camera = pixelCamera();
    SlantedEdge edge;
    edge.angle = std::atan2(q, p);
    edge.spacing_px = 1 / std::hypot(p, q);
    const double reach = FilterProperties(filter).reach(edge.angle) + edge.spacing_px;
    Film film{kSide, kSide, bandAround(p, q, reach), {}, {}};
    RenderOptions options;
    options.device = DeviceChoice::kCpu;
    const MethodResult made =
        runMethod(parseMethod("nsaa"), {scene, camera, film, filter, options, progress});
    std::map<int, double> by_distance;  // 2 (p x + q y) at the sample, relative to the edge -> weight
    for (int y = film.crop.y0; y < film.crop.y1; ++y)
        for (int x = film.crop.x0; x < film.crop.x1; ++x) {
            const int twice = p * (2 * (x - kMiddle) + 1) + q * (2 * (y - kMiddle) + 1);
            if (std::abs(twice) * 0.5 * edge.spacing_px <= reach)
                by_distance[-twice] = made.image.rgba[made.image.index(x, y)].a;
        }
    for (const auto& [twice, weight] : by_distance) {
        edge.distance.push_back(0.5 * twice * edge.spacing_px);
        edge.value.push_back(weight);
    }
    return edge;
}

double measuredResponse(const SlantedEdge& edge, double f) {
    double sum = 0.0;
    for (std::size_t k = 0; k + 1 < edge.value.size(); ++k) {
        const double t = 0.5 * (edge.distance[k] + edge.distance[k + 1]);
        sum += (edge.value[k + 1] - edge.value[k]) * std::cos(2 * M_PI * f * t);
    }
    const double x = M_PI * f * edge.spacing_px;
    return x == 0.0 ? sum : sum * x / std::sin(x);
}

double responseBound(const SlantedEdge& edge, double variation, double f) {
    const double x = f * edge.spacing_px, rounding = 0x1p-52 * static_cast<double>(edge.value.size());
    if (x == 0.0) return rounding;
    const double s = std::sin(M_PI * x) / M_PI;
    return x * edge.spacing_px * variation / (2 * M_PI) * (1 / (s * s) - 1 / (x * x)) + rounding;
}

}  // namespace edgewise::figures
