#include "pipeline/methods/smaa.h"

#include <algorithm>
#include <map>
#include <string>

#include "pipeline/methods/post_process.h"
#include "pipeline/methods/registry.h"
#include "pipeline/methods/smaa_textures.h"
#include "pipeline/methods/stopwatch.h"

namespace edgewise {
namespace {

SmaaSettings settingsOf(const MethodSpec& spec) {
    static const std::map<std::string, SmaaSettings> presets{
        {"low", {.threshold = 0.15f, .search_steps = 4, .diagonal_steps = 0, .corner_rounding = 1.0f}},
        {"medium", {.threshold = 0.1f, .search_steps = 8, .diagonal_steps = 0, .corner_rounding = 1.0f}},
        {"high", {.threshold = 0.1f, .search_steps = 16, .diagonal_steps = 8, .corner_rounding = 0.25f}},
        {"ultra", {.threshold = 0.05f, .search_steps = 32, .diagonal_steps = 16, .corner_rounding = 0.25f}},
    };
    SmaaSettings settings = presets.at(spec.parameter("preset"));
    settings.color_edges = spec.parameter("edges") == "color";
    settings.gamma_blend = spec.parameter("blend") == "gamma";
    return settings;
}

/// A pixel takes weights from 1 px away; those see edges as far as the search goes, and 2 px to its side; an
/// edge sees colours 2 px away.
int reachOf(const SmaaSettings& settings) {
    return std::max(2 * settings.search_steps, settings.diagonal_steps) + 8;
}

void applySmaa(const SmaaSettings& settings, ImageBuffer& image, Progress& progress,
               std::vector<StageTime>& stages) {
    Stopwatch watch;
    const SmaaEdges edges = findEdges(image, settings, progress);
    watch.book("edges", stages);
    const SmaaWeights weights = weighEdges(edges, settings, progress);
    watch.book("weights", stages);
    blendNeighbours(weights, settings, image, progress);
    watch.book("blend", stages);
}

}  // namespace

PostProcess makeSmaa(const MethodSpec& spec) {
    const SmaaSettings settings = settingsOf(spec);
    Stopwatch watch;
    smaaAreas();
    return {.reach_px = reachOf(settings),
            .apply = [settings](ImageBuffer& image, Progress& progress,
                                auto& stages) { applySmaa(settings, image, progress, stages); },
            .setup_seconds = watch.lap()};
}

MethodResult runSmaa(const MethodSpec& spec, const MethodInput& input) {
    return runOnNone(makeSmaa(spec), spec, input);
}

}  // namespace edgewise
