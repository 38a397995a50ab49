// The methods of this build. A new method is declared here and listed in registry.cpp.
#pragma once

#include "pipeline/methods/method.h"

namespace edgewise {

const std::vector<MethodEntry>& methodRegistry();

/// The whole of the text as one number.
std::optional<double> numberIn(std::string_view text);

/// The entry's Vulkan form. Where the device fails and nobody `asked` for it by name, the CPU's form and a
/// note.
MethodResult runOnDevice(const MethodEntry& entry, const MethodSpec& spec, const MethodInput& input,
                         bool asked);

MethodResult runCsaa(const MethodSpec& spec, const MethodInput& input);
MethodResult runExact(const MethodSpec& spec, const MethodInput& input);  ///< with the oracle
MethodResult runFxaa(const MethodSpec& spec, const MethodInput& input);
MethodResult runMsaa(const MethodSpec& spec, const MethodInput& input);
MethodResult runMsaaVulkan(const MethodSpec& spec, const MethodInput& input);  ///< with Vulkan
MethodResult runNone(const MethodSpec& spec, const MethodInput& input);
MethodResult runNoneVulkan(const MethodSpec& spec, const MethodInput& input);  ///< with Vulkan
MethodResult runNsaa(const MethodSpec& spec, const MethodInput& input);
MethodResult runNsaaVulkan(const MethodSpec& spec, const MethodInput& input);  ///< with Vulkan
MethodResult runSmaa(const MethodSpec& spec, const MethodInput& input);
MethodResult runRt(const MethodSpec& spec, const MethodInput& input);  ///< with Embree
MethodResult runSsaa(const MethodSpec& spec, const MethodInput& input);
MethodResult runSsaaVulkan(const MethodSpec& spec, const MethodInput& input);  ///< with Vulkan

// On SDF scenes.
MethodResult traceNone(const MethodSpec& spec, const MethodInput& input, const FieldTracerMaker& make);
MethodResult traceLottes(const MethodSpec& spec, const MethodInput& input, const FieldTracerMaker& make);
MethodResult tracePath(const MethodSpec& spec, const MethodInput& input, const FieldTracerMaker& make);
MethodResult traceSphere(const MethodSpec& spec, const MethodInput& input, const FieldTracerMaker& make);
MethodResult traceSsaa(const MethodSpec& spec, const MethodInput& input, const FieldTracerMaker& make);
MethodResult traceCtss(const MethodSpec& spec, const MethodInput& input, const FieldTracerMaker& make);
MethodResult traceCtssX(const MethodSpec& spec, const MethodInput& input, const FieldTracerMaker& make);
MethodResult traceFxaa(const MethodSpec& spec, const MethodInput& input, const FieldTracerMaker& make);
MethodResult traceSmaa(const MethodSpec& spec, const MethodInput& input, const FieldTracerMaker& make);
/// The same with the device that suits the method and the scene.
MethodResult runOnField(const MethodEntry& entry, const MethodSpec& spec, const MethodInput& input);

}  // namespace edgewise
