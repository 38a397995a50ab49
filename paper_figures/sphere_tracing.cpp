// Keinert et al. 2014, sections 3 and 4, on scenes that ship: what each enhancement saves or mends.
#include "paper_figures/sphere_tracing.h"

#include "paper_figures/sphere_tracing_measure.h"

namespace edgewise::figures {
namespace {

SphereTracingEffort effortFor(bool quick) {
    SphereTracingEffort effort;
    effort.quick = quick;
    effort.scenes = {"city",   "jewel",    "path-room",  "primitives",       "thin",  "blob",
                     "gyroid", "menger-3", "spheres-50", "sphere-minus-box", "atrium"};
    effort.candidate_scenes = {"thin", "city"};
    effort.jump_scenes = {"blob", "primitives"};
    effort.pruning_scenes = {"spheres-1000", "city", "random-box"};
    if (!quick) return effort;
    effort.width = 128, effort.height = 72, effort.runs = 1, effort.pruning_side = 32;
    effort.picture_width = 64, effort.picture_height = 36;
    effort.scenes = {"jewel", "thin", "blob"};
    effort.candidate_scenes = {"thin"}, effort.jump_scenes = {"blob"}, effort.pruning_scenes = {"spheres-50"};
    return effort;
}

}  // namespace

std::vector<FigureFile> makeSphereTracing(const FigureInput& input) {
    const SphereTracing found = measureSphereTracing(effortFor(input.quick), input.progress);
    std::vector<FigureFile> files{{"report.html", sphereTracingHtml(found)},
                                  {"results.json", sphereTracingJson(found)}};
    appendPictureFiles(found.pictures, files);
    return files;
}

}  // namespace edgewise::figures
