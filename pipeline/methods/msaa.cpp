// The standard sample locations, which weigh alike; each (pixel, owner) is shaded once.
#include "pipeline/methods/registry.h"
#include "pipeline/methods/sampled_frame.h"

namespace edgewise {

MethodResult runMsaa(const MethodSpec& spec, const MethodInput& in) {
    SampledFrame frame(in, standardPattern(*spec.number), SampleWeights::equal(*spec.number));
    return runSampledCpu(frame);
}

}  // namespace edgewise
