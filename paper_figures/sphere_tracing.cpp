// Keinert et al. 2014, sections 3 and 4, on scenes that ship: what each enhancement saves or mends.
#include "paper_figures/sphere_tracing.h"

#include <fmt/format.h>

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

/// Where a scene is of a kind that the paper has a ratio of times for.
void addClaims(const std::vector<TracedScene>& scenes, const std::string& setting, const std::string& what,
               std::vector<FigureClaim>& claims) {
    for (const TracedScene& scene : scenes)
        for (const TraceRun& run : scene.runs)
            if (scene.published && run.setting == setting)
                claims.push_back(
                    {"section 4", fmt::format("times faster by {}, {}", what, scene.name),
                     fmt::format("{:.2f}", *scene.published),
                     fmt::format("{:.2f} (evaluations: {:.2f})", scene.runs[0].seconds / run.seconds,
                                 scene.ratioOf(run)),
                     "",
                     "a GPU's times on a scene that is not published; ours is of the same kind, on a CPU"});
}

}  // namespace

std::vector<FigureFile> makeSphereTracing(const FigureInput& input) {
    const SphereTracing found = measureSphereTracing(effortFor(input.quick), input.progress);
    addClaims(found.scenes, "keinert", "over-relaxation", input.claims);
    addClaims(found.convex, "convex shortcut", "the shortcut through convex solids", input.claims);
    std::vector<FigureFile> files{{"report.html", sphereTracingHtml(found)},
                                  {"results.json", sphereTracingJson(found)}};
    appendPictureFiles(found.pictures, files);
    return files;
}

}  // namespace edgewise::figures
