// K x K samples a pixel, shared by the pixels whose filter reaches them; each (pixel, owner) is shaded once.
#include "pipeline/methods/registry.h"
#include "pipeline/methods/sampled_frame.h"

namespace edgewise {

MethodResult runSsaa(const MethodSpec& spec, const MethodInput& in) {
    SampledFrame frame(in, latticePattern(*spec.number), SampleWeights(in.filter, *spec.number));
    return runSampledCpu(frame);
}

}  // namespace edgewise
