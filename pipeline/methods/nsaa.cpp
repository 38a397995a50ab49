// Non-sampled antialiasing (Auzinger et al. 2013): every pixel is the closed-form integral of the prefilter
// over the visible part of every triangle. project -> plan -> gather -> visibility -> weights -> shade and
// blend.
#include "pipeline/methods/nsaa.h"

#include "pipeline/methods/nsaa_cpu.h"
#include "pipeline/methods/registry.h"

namespace edgewise {

MethodResult runNsaa(const MethodSpec& spec, const MethodInput& input) {
    CpuStages stages;
    return NsaaFrame(input, spec.parameter("visibility") == "awj13").render(stages);
}

PixelReport pixelWeights(const MethodInput& input, int x, int y) {
    CpuStages stages;
    return NsaaFrame(input).report(stages, x, y);
}

}  // namespace edgewise
