// One sample at the pixel's centre: the front-most owner's colour there.
#include <tbb/parallel_for.h>

#include "pipeline/composite.h"
#include "pipeline/dump_samples.h"
#include "pipeline/methods/aov_report.h"
#include "pipeline/methods/point_samples.h"
#include "pipeline/methods/registry.h"
#include "pipeline/methods/stopwatch.h"
#include "pipeline/shade.h"

namespace edgewise {

namespace {

void dumpSamples(const MethodInput& in, const ScreenScene& screen, const SampledOwners& sampled) {
    const PixelBox& crop = in.film.crop;
    SampleDump dump(in.options.dump_dir, crop, screen);
    if (!dump.active()) return;
    const glm::dvec2 centre(0.5);
    for (int y = crop.y0; y < crop.y1; ++y)
        for (int x = crop.x0; x < crop.x1; ++x) {
            const std::size_t i = static_cast<std::size_t>(y - crop.y0) * crop.width() + (x - crop.x0);
            dump.pixel(x, y, {&centre, 1}, {&sampled.owner[i], 1}, sampled.stacks);
        }
    dump.finish();
}

}  // namespace

MethodResult runNone(const MethodSpec&, const MethodInput& in) {
    MethodResult result;
    Stopwatch watch;
    ScreenPieces pieces;
    const ScreenScene screen = project(in.scene, in.camera, in.film, pieces, in.progress);
    const Shading shading(in.scene, in.camera, in.film, screen, pieces);
    watch.book("project", result.stages);
    checkCancelled(in.progress);
    in.progress.stage("visibility", 0);
    const PointSampler sampler(screen, in.film.crop, 1);
    const SampledOwners sampled = sampler.sample(in.film.crop);
    watch.book("visibility", result.stages);
    dumpSamples(in, screen, sampled);
    checkCancelled(in.progress);
    result.image = ImageBuffer(in.film.crop);
    const AovPass aov(in.options.aovs, in.scene, in.camera, in.film, screen, pieces, shading);
    aov.begin(result.image);
    aov.points(sampled, result.image);
    in.progress.stage("shade", in.film.crop.height());
    tbb::parallel_for(in.film.crop.y0, in.film.crop.y1, [&](int y) {
        for (int x = in.film.crop.x0; x < in.film.crop.x1; ++x) {
            const std::size_t i = result.image.index(x, y);
            const auto layers = sampled.stacks.layersOf(sampled.owner[i]);
            requireShadable(layers, {x, y});
            const Shade seen = composite(
                layers,
                [&](Owner o) {
                    return shading.atPoint(o, {x + 0.5, y + 0.5});
                },
                in.options.background);
            result.image.rgba[i] = glm::dvec4(seen.color, seen.alpha);
            const OwnerWeight whole{sampled.owner[i], FixedWeight{1} << kWeightBits};
            if (aov.weighs()) aov.pixel(x, y, {&whole, 1}, sampled.stacks, result.image);
        }
        in.progress.advance(1);
    });
    watch.book("shade", result.stages);
    result.counts = {{"triangles", in.scene.triangle_count},
                     {"pieces", screen.triangles.size()},
                     {"samples", sampled.owner.size()},
                     {"exact_depths", sampler.exactDepths()}};
    reportAovs(aov, result);
    return result;
}

}  // namespace edgewise
