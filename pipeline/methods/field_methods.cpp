// The methods that trace SDF scenes, and on which device.
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <cmath>

#include "pipeline/device_error.h"
#include "pipeline/error.h"
#include "pipeline/methods/cone_tracer.h"
#include "pipeline/methods/cone_x.h"
#include "pipeline/methods/field_frame.h"
#include "pipeline/methods/post_process.h"
#include "pipeline/methods/registry.h"
#include "sdf/field_scene.h"

namespace edgewise {
namespace {

#ifdef EDGEWISE_HAS_VULKAN
constexpr bool kHasVulkan = true;
constexpr auto kVulkanTracer = makeVulkanFieldTracer;
#else
constexpr bool kHasVulkan = false;
constexpr decltype(&makeCpuFieldTracer) kVulkanTracer = nullptr;
#endif

sdf::Relaxation relaxationOf(const std::string& name) {
    if (name == "none") return sdf::Relaxation::kNone;
    if (name == "keinert") return sdf::Relaxation::kKeinert;
    return name == "balint" ? sdf::Relaxation::kBalint : sdf::Relaxation::kAuto;
}

FieldSettings settingsOf(const MethodSpec& spec) {
    FieldSettings settings;
    sdf::TraceSettings& t = settings.trace;
    const auto isOn = [&](const char* key) { return spec.parameter(key) == "on"; };
    t.relaxation = relaxationOf(spec.parameter("relax"));
    t.omega = spec.numberOf("omega");
    t.screen_candidate = spec.parameter("candidate") == "screen";
    t.discontinuity_steps = static_cast<int>(spec.numberOf("discontinuity"));
    t.threshold = spec.numberOf("threshold");
    t.most_steps = static_cast<int>(spec.numberOf("steps"));
    t.prepass = isOn("prepass"), t.prune = isOn("prune");
    t.convex = isOn("convex"), t.level_set = isOn("level-set");
    return settings;
}

/// Of the method or of what it is composed with.
std::optional<std::string> deviceNamedBy(const MethodSpec& spec) {
    std::optional<std::string> device;
    const auto look = [&](const MethodSpec& part) {
        const auto own = part.parameters.find("device");
        if (own == part.parameters.end()) return;
        if (device && *device != own->second)
            throw InputError(fmt::format("method '{}'", spec.typed),
                             fmt::format("names two devices, {} and {}", *device, own->second));
        device = own->second;
    };
    look(spec);
    for (const MethodSpec& part : spec.composed) look(part);
    return device;
}

DeviceChoice choiceOf(const MethodSpec& spec, const MethodInput& in) {
    const std::optional<std::string> own = deviceNamedBy(spec);
    const DeviceChoice choice = own ? deviceChoice(*own) : in.options.device;
    const bool glsl = in.scene.field->glsl.has_value();
    return glsl && choice == DeviceChoice::kAuto ? DeviceChoice::kVulkan : choice;
}

MethodResult onVulkan(const MethodEntry& entry, const MethodSpec& spec, const MethodInput& in, bool asked) {
    std::string why;
    try {
        return entry.run_field(spec, in, kVulkanTracer);
    } catch (const DeviceError& error) {
        if (asked) throw;
        why = error.what();
    }
    MethodResult result = entry.run_field(spec, in, makeCpuFieldTracer);
    result.notes.push_back(fmt::format("'{}' ran on the CPU: {}", entry.name, why));
    return result;
}

MethodResult filteredPicture(const PostProcess& process, const MethodSpec& spec, const MethodInput& in,
                             const FieldTracerMaker& make) {
    return runOnPicture(process, in, [&](const MethodInput& whole) { return traceNone(spec, whole, make); });
}

sdf::ConeSettings conesOf(const MethodSpec& spec) {
    sdf::ConeSettings cones;
    cones.relaxed = spec.name == "ctss-r";
    cones.coverage = spec.numberOf("coverage");
    cones.alpha = spec.numberOf("alpha");
    cones.four_by_eight = spec.parameter("mask") == "4x8";
    cones.uniform = spec.parameter("weights") == "uniform";
    cones.backtrace = spec.parameter("backtrace") == "on";
    cones.visible = static_cast<int>(spec.numberOf("visible"));
    cones.shade_at_once = spec.parameter("shade") == "asap";
    cones.normalize_sky = spec.parameter("sky") == "normalize";
    return cones;
}

}  // namespace

MethodResult traceNone(const MethodSpec&, const MethodInput& in, const FieldTracerMaker& make) {
    return tracePixels(in, {}, make);
}

MethodResult traceSphere(const MethodSpec& spec, const MethodInput& in, const FieldTracerMaker& make) {
    return tracePixels(in, settingsOf(spec), make);
}

MethodResult traceSsaa(const MethodSpec& spec, const MethodInput& in, const FieldTracerMaker& make) {
    return traceFiltered(in, {}, *spec.number, make);
}

MethodResult traceCtss(const MethodSpec& spec, const MethodInput& in, const FieldTracerMaker& make) {
    const int per_side = spec.composed.empty() ? 1 : *spec.composed.front().number;
    const Scene scene = sceneOfCones(in);
    const MethodInput all{scene, in.camera, in.film, in.filter, in.options, in.progress};
    FieldSettings settings;
    settings.cones = conesOf(spec);
    settings.cones->coverage /= per_side;
    if (per_side == 1) return tracePixels(all, settings, coneTracerMaker(make));
    return traceFiltered(all, settings, per_side, coneTracerMaker(make));
}

MethodResult traceCtssX(const MethodSpec& spec, const MethodInput& in, const FieldTracerMaker& make) {
    const Scene scene = sceneOfCones(in);
    const MethodInput all{scene, in.camera, in.film, in.filter, in.options, in.progress};
    FieldSettings settings;
    settings.cones.emplace();
    settings.cones->relaxed = settings.cones->hard_only = true;
    // Hits float over surfaces, and the borders of their light with them: no more than outlines are off.
    settings.trace.threshold = 1.0 / 64.0;
    // Steps of the distance alone, down to where it is a hit: its place must be as good as a ray's.
    settings.cones->alpha = settings.trace.threshold / std::sqrt(2.0);
    if (spec.parameter("weights") == "box") return tracePixels(all, settings, coneXMaker(make));
    settings.keep_parts = true;
    return traceParts(all, settings, coneXMaker(make));
}

MethodResult traceFxaa(const MethodSpec& spec, const MethodInput& in, const FieldTracerMaker& make) {
    return filteredPicture(makeFxaa(spec), spec, in, make);
}

MethodResult traceSmaa(const MethodSpec& spec, const MethodInput& in, const FieldTracerMaker& make) {
    return filteredPicture(makeSmaa(spec), spec, in, make);
}

MethodResult runOnField(const MethodEntry& entry, const MethodSpec& spec, const MethodInput& in) {
    const DeviceChoice choice = choiceOf(spec, in);
    const DeviceDecision decision = decideDevice(choice, kHasVulkan && !entry.field_on_cpu);
    const bool asked = choice == DeviceChoice::kVulkan;
    tbb::task_arena arena(in.options.threads > 0 ? in.options.threads : tbb::task_arena::automatic);
    MethodResult result;
    arena.execute([&] {
        result = decision.vulkan ? onVulkan(entry, spec, in, asked)
                                 : entry.run_field(spec, in, makeCpuFieldTracer);
    });
    if (asked && !decision.vulkan)
        result.notes.push_back(fmt::format("'{}' ran on the CPU: {}", spec.name, decision.why));
    return result;
}

}  // namespace edgewise
