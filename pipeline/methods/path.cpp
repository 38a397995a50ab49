// N paths a pixel through an SDF scene, at Owen-scrambled Sobol positions in the pixel; their mean.
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "pipeline/field_rays.h"
#include "pipeline/field_shading.h"
#include "pipeline/methods/registry.h"
#include "pipeline/methods/stopwatch.h"
#include "pipeline/path_sampler.h"
#include "sdf/path_tracer.h"
#include "sdf/scene_trace.h"

namespace edgewise {

MethodResult tracePath(const MethodSpec& spec, const MethodInput& in, FieldTracerMaker) {
    const sdf::FieldScene& scene = requireTree(spec.name, in.scene);
    MethodResult result;
    Stopwatch watch;
    const sdf::TraceSettings trace;
    const sdf::Tape tape = loweredTree(scene);
    const sdf::SceneTracer surfaces(scene, tape, trace);
    const sdf::PathTracer paths(fieldShading(in, trace, true), scene.analytic, surfaces);
    const sdf::RayGrid grid = rayGrid(in.camera, in.film, scene.far);
    result.setup_seconds = watch.lap();
    result.image = ImageBuffer(in.film.crop);
    tbb::enumerable_thread_specific<sdf::RayCounts> counts;
    in.progress.stage("paths", in.film.crop.height());
    tbb::parallel_for(in.film.crop.y0, in.film.crop.y1, [&](int y) {
        for (int x = in.film.crop.x0; x < in.film.crop.x1; ++x) {
            checkCancelled(in.progress);
            PixelPathSampler sampler(x, y, in.options.seed);
            glm::dvec4 sum(0.0);
            for (int s = 0; s < *spec.number; ++s) {
                sampler.start(s);
                const sdf::FieldRay ray = grid.ray(glm::dvec2(x, y) + sampler.position());
                sum += paths.radiance(ray, sampler, counts.local(), surfaces.signAt(ray.origin_world));
            }
            result.image.rgba[result.image.index(x, y)] = sum / static_cast<double>(*spec.number);
        }
        in.progress.advance(1);
    });
    watch.book("paths", result.stages);
    sdf::RayCounts all;
    for (const sdf::RayCounts& one : counts) all += one;
    countRays(all, result.counts);
    return result;
}

}  // namespace edgewise
