// N paths a pixel through an SDF scene, at Owen-scrambled Sobol positions in the pixel; their mean.
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "pipeline/field_rays.h"
#include "pipeline/field_shading.h"
#include "pipeline/methods/color_spread.h"
#include "pipeline/methods/field_aov.h"
#include "pipeline/methods/registry.h"
#include "pipeline/methods/stopwatch.h"
#include "pipeline/path_sampler.h"
#include "sdf/path_tracer.h"
#include "sdf/scene_trace.h"

namespace edgewise {
namespace {

class PathPicture {
  public:
    PathPicture(const MethodInput& in, const sdf::FieldScene& scene, int samples)
        : in_(in),
          samples_(samples),
          tape_(loweredTree(scene)),
          surfaces_(scene, tape_, trace_),
          shading_(fieldShading(in, trace_, true)),
          paths_(shading_, scene.analytic, surfaces_),
          grid_(rayGrid(in.camera, in.film, scene.far)) {}
    PathPicture(const PathPicture&) = delete;

    /// `edge`: 1 where first surfaces differ by themselves, whatever lights them: paths' colours are noise.
    void pixel(int x, int y, sdf::RayCounts& counts, ImageBuffer& image) const {
        PixelPathSampler sampler(x, y, in_.options.seed);
        glm::dvec4 sum(0.0);
        ColorSpread spread;
        for (int s = 0; s < samples_; ++s) {
            sampler.start(s);
            const sdf::FieldRay ray = grid_.ray(glm::dvec2(x, y) + sampler.position());
            const double sign = surfaces_.signAt(ray.origin_world);
            const sdf::SurfaceHit hit = surfaces_.nearest(ray, sign);
            sum += paths_.radiance(ray, hit, sampler, counts, sign);
            spread.add(ownColor({ray, sign}, hit));
        }
        image.rgba[image.index(x, y)] = sum / static_cast<double>(samples_);
        image.edge[image.index(x, y)] = spread.edge();
    }

  private:
    glm::dvec3 ownColor(const sdf::TravellingRay& way, const sdf::SurfaceHit& hit) const {
        if (!hit.hit) return shading_.background;
        const sdf::SurfacePoint point = surfacePoint(shading_, way, hit);
        return point.color + point.material->emission;
    }

    const MethodInput& in_;
    const int samples_;
    const sdf::TraceSettings trace_;
    const sdf::Tape tape_;
    const sdf::SceneTracer surfaces_;
    const sdf::ShadingSettings shading_;
    const sdf::PathTracer paths_;
    const sdf::RayGrid grid_;
};

}  // namespace

MethodResult tracePath(const MethodSpec& spec, const MethodInput& in, const FieldTracerMaker& make) {
    MethodResult result;
    Stopwatch watch;
    const PathPicture picture(in, requireTree(spec.name, in.scene), *spec.number);
    result.setup_seconds = watch.lap();
    const PixelBox& crop = in.film.crop;
    result.image = ImageBuffer(crop);
    if (!in.options.aovs.empty()) {
        traceFieldAovs(in, make, result.image);
        watch.book("aov", result.stages);
    }
    tbb::enumerable_thread_specific<sdf::RayCounts> counts;
    in.progress.stage("paths", crop.height());
    tbb::parallel_for(crop.y0, crop.y1, [&](int y) {
        for (int x = crop.x0; x < crop.x1; ++x) {
            checkCancelled(in.progress);
            picture.pixel(x, y, counts.local(), result.image);
        }
        in.progress.advance(1);
    });
    watch.book("paths", result.stages);
    sdf::RayCounts all;
    for (const sdf::RayCounts& one : counts) all += one;
    countRays(all, result.counts);
    if (in.options.dump_dir) result.notes.emplace_back("'path' has no stages to dump");
    return result;
}

}  // namespace edgewise
