#include "pipeline/methods/registry.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "pipeline/device_error.h"
#include "pipeline/field_mesh.h"
#include "pipeline/methods/lottes.h"
#include "sdf/cone_trace.h"
#include "sdf/trace_settings.h"

namespace edgewise {
namespace {

#ifdef EDGEWISE_HAS_VULKAN
constexpr auto kMsaaVulkan = runMsaaVulkan, kNoneVulkan = runNoneVulkan, kNsaaVulkan = runNsaaVulkan,
               kSsaaVulkan = runSsaaVulkan;
#else
constexpr decltype(MethodEntry::run) kMsaaVulkan = nullptr, kNoneVulkan = nullptr, kNsaaVulkan = nullptr,
                                     kSsaaVulkan = nullptr;
#endif

const std::vector<std::string> kDevices{"auto", "cpu", "vulkan"};

WordChoice onOff(bool usual) {
    return {{"on", "off"}, usual ? "on" : "off"};
}

const MethodEntry* findMethod(std::string_view name) {
    const auto& registry = methodRegistry();
    const auto found =
        std::find_if(registry.begin(), registry.end(), [&](const auto& m) { return m.name == name; });
    return found == registry.end() ? nullptr : &*found;
}

[[noreturn]] void fail(std::string_view typed, const std::string& why) {
    throw InputError(fmt::format("method '{}'", typed), why);
}

const MethodEntry& requireMethod(std::string_view typed, std::string_view name) {
    if (const MethodEntry* entry = findMethod(name)) return *entry;
    std::vector<std::string> names;
    for (const MethodEntry& entry : methodRegistry()) names.push_back(entry.name);
    fail(typed, fmt::format("no method is called '{}' in this build, only {}", name, fmt::join(names, ", ")));
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (;;) {
        const std::size_t at = text.find(separator);
        parts.push_back(text.substr(0, at));
        if (at == std::string_view::npos) return parts;
        text.remove_prefix(at + 1);
    }
}

bool mayBe(const MethodEntry& entry, int number) {
    if (entry.numbers.empty()) return number >= entry.smallest && number <= entry.largest;
    return std::find(entry.numbers.begin(), entry.numbers.end(), number) != entry.numbers.end();
}

std::string numbersOf(const MethodEntry& entry) {
    if (entry.numbers.empty()) return fmt::format("a number from {} to {}", entry.smallest, entry.largest);
    if (entry.numbers.size() == 1) return fmt::format("{}, its only number", entry.numbers[0]);
    return fmt::format("one of {}", fmt::join(entry.numbers, ", "));
}

void takeNumber(std::string_view text, const MethodEntry& entry, MethodSpec& spec) {
    if (entry.number == MethodEntry::Number::kAbsent)
        fail(spec.typed, fmt::format("'{}' takes no number", entry.name));
    if (spec.number) fail(spec.typed, "has two numbers");
    int value = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = read.ec == std::errc() && read.ptr == text.data() + text.size();
    if (!whole || !mayBe(entry, value))
        fail(spec.typed, fmt::format("'{}' is not {}", text, numbersOf(entry)));
    spec.number = value;
}

std::string rangeWords(const NumberRange& range) {
    return fmt::format("{}..{}", range.low, range.high);
}

bool takeNumberParameter(std::string_view key, std::string_view text, const MethodEntry& entry,
                         const MethodSpec& spec) {
    const auto known = entry.ranges.find(std::string(key));
    if (known == entry.ranges.end()) return false;
    const NumberRange& range = known->second;
    const std::optional<double> value = numberIn(text);
    if (!value || !(*value >= range.low && *value <= range.high) ||
        (range.whole && *value != std::floor(*value)))
        fail(spec.typed, fmt::format("{} is a{} number in {}, not '{}'", key, range.whole ? " whole" : "",
                                     rangeWords(range), text));
    return true;
}

void takeParameter(std::string_view key, std::string_view value, const MethodEntry& entry, MethodSpec& spec) {
    if (takeNumberParameter(key, value, entry, spec)) {
        if (!spec.parameters.emplace(key, value).second)
            fail(spec.typed, fmt::format("{} is given twice", key));
        return;
    }
    const auto known = entry.choices.find(std::string(key));
    const bool takes_device = key == "device" && entry.name != "mesh";
    if (!takes_device && known == entry.choices.end())
        fail(spec.typed, fmt::format("'{}' has no parameter '{}'", entry.name, key));
    const std::vector<std::string>& choices = takes_device ? kDevices : known->second.words;
    if (std::find(choices.begin(), choices.end(), value) == choices.end())
        fail(spec.typed, fmt::format("{} is {}, not '{}'", key, fmt::join(choices, " or "), value));
    if (!spec.parameters.emplace(key, value).second) fail(spec.typed, fmt::format("{} is given twice", key));
}

void takeParts(std::string_view text, const MethodEntry& entry, MethodSpec& spec) {
    for (const std::string_view part : split(text, ',')) {
        const std::size_t equals = part.find('=');
        if (equals == std::string_view::npos)
            takeNumber(part, entry, spec);
        else
            takeParameter(part.substr(0, equals), part.substr(equals + 1), entry, spec);
    }
}

/// What nobody typed has its usual value.
void fillIn(const MethodEntry& entry, MethodSpec& spec) {
    for (const auto& [key, choice] : entry.choices) spec.parameters.emplace(key, choice.usual);
    for (const auto& [key, range] : entry.ranges)
        spec.parameters.emplace(key, fmt::format("{}", range.usual));
}

MethodSpec parseOne(std::string_view typed) {
    MethodSpec spec;
    spec.typed = typed;
    const std::size_t colon = typed.find_first_of(":,");
    spec.name = typed.substr(0, colon);
    const MethodEntry& entry = requireMethod(typed, spec.name);
    if (colon != std::string_view::npos) takeParts(typed.substr(colon + 1), entry, spec);
    if (entry.number == MethodEntry::Number::kRequired && !spec.number)
        fail(typed, fmt::format("needs a number, as in '{}:4'", entry.name));
    fillIn(entry, spec);
    return spec;
}

/// What stands before methods that a mesh is made for.
const MethodEntry& meshEntry() {
    static const MethodEntry entry{
        .name = "mesh",
        .summary = "SDF scenes: mesh+M is M on a mesh, within `error` of a pixel",
        .choices = {{"mesher", {{"dual", "marching-cubes", "cgal"}, MeshChoice().mesher}}},
        .ranges = {{"error", {0.001, 100, MeshChoice().error_px}}}};
    return entry;
}

/// Of "mesh+M" and "mesh:error=...+M", without what it takes.
std::optional<MeshChoice> takeMesh(std::string_view typed, std::vector<std::string_view>& parts) {
    const std::string_view first = parts.front();
    const std::size_t colon = first.find_first_of(":,");
    if (first.substr(0, colon) != "mesh") return std::nullopt;
    if (parts.size() == 1) fail(typed, "needs a method, as in 'mesh+ssaa:4'");
    MethodSpec spec;
    spec.typed = typed;
    if (colon != std::string_view::npos) takeParts(first.substr(colon + 1), meshEntry(), spec);
    fillIn(meshEntry(), spec);
    parts.erase(parts.begin());
    return MeshChoice{spec.numberOf("error"), spec.parameter("mesher")};
}

std::string describe(const MethodEntry& entry) {
    std::vector<std::string> parameters;
    if (entry.number == MethodEntry::Number::kRequired)
        parameters.push_back(entry.numbers.empty() ? fmt::format("{}..{}", entry.smallest, entry.largest)
                                                   : fmt::format("{}", fmt::join(entry.numbers, "|")));
    for (const auto& [key, choice] : entry.choices)
        parameters.push_back(fmt::format("{}={}", key, fmt::join(choice.words, "|")));
    for (const auto& [key, range] : entry.ranges)
        parameters.push_back(fmt::format("{}={}", key, rangeWords(range)));
    if (entry.name != "mesh") parameters.push_back(fmt::format("device={}", fmt::join(kDevices, "|")));
    return fmt::format("{}:{}  {}", entry.name, fmt::join(parameters, ","), entry.summary);
}

}  // namespace

namespace {

MethodEntry coneEntry(const std::string& name, const std::string& summary) {
    const sdf::ConeSettings usual;
    return {.name = name,
            .summary = summary,
            .own_box = true,
            .composes_with = "ssaa",
            .choices = {{"mask", {{"6x6", "4x8"}, "6x6"}},
                        {"weights", {{"visibility", "uniform"}, "visibility"}},
                        {"backtrace", onOff(usual.backtrace)},
                        {"shade", {{"delayed", "asap"}, "delayed"}},
                        {"sky", {{"mask", "normalize"}, "mask"}}},
            .ranges = {{"coverage", {0.1, 16, usual.coverage}},
                       {"alpha", {0.01, 1, usual.alpha}},
                       {"visible", {1, 32, double(usual.visible), true}}},
            .run_field = traceCtss};
}

}  // namespace

const std::vector<MethodEntry>& methodRegistry() {
    static const sdf::TraceSettings trace;
    static const LottesSettings lottes;
    static const std::vector<MethodEntry> registry{
        {.name = "none",
         .summary = "one sample at the pixel's centre",
         .own_box = true,
         .choices = {},
         .run = runNone,
         .run_vulkan = kNoneVulkan,
         .run_field = traceNone},
        {.name = "nsaa",
         .summary = "the exact integral of the filter over what is visible of every triangle",
         .needs_triangles = true,
         .choices = {{"visibility", {{"slab", "awj13"}, "slab"}}},
         .host_alone = {{"visibility", "awj13"}},
         .run = runNsaa,
         .run_vulkan = kNsaaVulkan},
        {.name = "ssaa",
         .summary = "K x K samples a pixel, shared by the pixels whose filter reaches them",
         .number = MethodEntry::Number::kRequired,
         .choices = {},
         .run = runSsaa,
         .run_vulkan = kSsaaVulkan,
         .run_field = traceSsaa},
        {.name = "msaa",
         .summary = "N samples a pixel at Vulkan's standard locations, one shade a triangle and pixel",
         .number = MethodEntry::Number::kRequired,
         .own_box = true,
         .needs_triangles = true,
         .numbers = {2, 4, 8, 16},
         .choices = {},
         .run = runMsaa,
         .run_vulkan = kMsaaVulkan},
        {.name = "csaa",
         .summary = "msaa:8 weighed by 24 more samples that see only what the 8 see",
         .number = MethodEntry::Number::kRequired,
         .own_box = true,
         .needs_triangles = true,
         .numbers = {32},
         .choices = {},
         .run = runCsaa},
        {.name = "fxaa",
         .summary = "FXAA 3.11 on the picture of none",
         .own_box = true,
         .choices = {{"preset",
                      {{"10", "11", "12", "13", "14", "15", "20", "21", "22", "23", "24", "25", "26", "27",
                        "28", "29", "39"},
                       "12"}}},
         .run = runFxaa,
         .run_field = traceFxaa},
        {.name = "smaa",
         .summary = "SMAA 1x on the picture of none",
         .own_box = true,
         .choices = {{"preset", {{"low", "medium", "high", "ultra"}, "high"}},
                     {"edges", {{"luma", "color"}, "luma"}},
                     {"blend", {{"linear", "gamma"}, "linear"}}},
         .run = runSmaa,
         .run_field = traceSmaa},
        {.name = "sphere",
         .summary = "SDF scenes: sphere tracing, one sample at the pixel's centre",
         .own_box = true,
         .choices = {{"relax", {{"none", "keinert", "balint", "auto"}, "auto"}},
                     {"candidate", {{"last", "screen"}, "screen"}},
                     {"prepass", onOff(trace.prepass)},
                     {"prune", onOff(trace.prune)},
                     {"convex", onOff(trace.convex)},
                     {"level-set", onOff(trace.level_set)}},
         .ranges = {{"omega", {1, 2, trace.omega}},
                    {"discontinuity", {0, 64, double(trace.discontinuity_steps), true}},
                    {"threshold", {1e-6, 1, trace.threshold}},
                    {"steps", {1, 60000, double(trace.most_steps), true}}},
         .run_field = traceSphere},
        coneEntry("ctss", "SDF: cone-traced supersampling"),
        coneEntry("ctss-r", "SDF: cone-traced supersampling that ends at the ray's own hit"),
        {.name = "ctss-x",
         .summary = "SDF: cones find what edges cross, lines divide it exactly",
         .own_box = true,
         .choices = {{"weights", {{"box", "filter"}, "box"}}},
         .run_field = traceCtssX},
        {.name = "lottes",
         .summary = "SDF: one jittered ray a pixel and frame, coverage, 11-ray reconstruction, grain",
         .own_box = true,
         .choices = {{"weights", {{"gaussian", "disk"}, "gaussian"}},
                     {"spectrum", {{"blue", "white"}, "blue"}},
                     {"coverage", onOff(lottes.coverage)}},
         .ranges = {{"distance", {0.05, 4, lottes.distance}},
                    {"scale", {0.01, 100, lottes.scale}},
                    {"grain", {0, 1, lottes.grain}}},
         .run_field = traceLottes,
         .field_on_cpu = true},
        {.name = "path",
         .summary = "SDF: path traced, N samples a pixel",
         .number = MethodEntry::Number::kRequired,
         .largest = 65536,
         .own_box = true,
         .choices = {},
         .run_field = tracePath,
         .field_on_cpu = true},
#ifdef EDGEWISE_HAS_EMBREE
        {.name = "rt",
         .summary = "N Owen-scrambled Sobol samples a pixel, traced with Embree, filtered like ssaa",
         .number = MethodEntry::Number::kRequired,
         .largest = 16384,
         .needs_triangles = true,
         .choices = {},
         .run = runRt},
#endif
#ifdef EDGEWISE_HAS_ORACLE
        {.name = "exact",
         .summary = "the oracle: exact visibility, weights to 30 digits; for small scenes and crops",
         .needs_triangles = true,
         .choices = {},
         .run = runExact},
#endif
    };
    return registry;
}

std::optional<double> numberIn(std::string_view text) {
    double value = 0.0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec != std::errc() || read.ptr != text.data() + text.size()) return std::nullopt;
    return value;
}

double MethodSpec::numberOf(const std::string& key) const {
    return numberIn(parameter(key)).value();
}

MethodSpec parseMethod(std::string_view typed) {
    auto parts = split(typed, '+');
    const std::optional<MeshChoice> mesh = takeMesh(typed, parts);
    MethodSpec spec = parseOne(parts.front());
    spec.typed = typed;
    spec.mesh = mesh;
    for (std::size_t i = 1; i < parts.size(); ++i) spec.composed.push_back(parseOne(parts[i]));
    if (mesh && !requireMethod(typed, spec.name).run)
        fail(typed, fmt::format("'{}' traces SDF scenes, and a mesh is of triangles", spec.name));
    return spec;
}

bool takesFilter(const MethodSpec& spec) {
    // What is composed with samples is filtered like them.
    return !spec.composed.empty() || !requireMethod(spec.typed, spec.name).own_box ||
           spec.has("weights", "filter");
}

DeviceDecision decideDevice(const MethodSpec& spec, const RenderOptions& options) {
    const auto own = spec.parameters.find("device");
    const DeviceChoice choice = own == spec.parameters.end() ? options.device : deviceChoice(own->second);
    const MethodEntry& entry = requireMethod(spec.typed, spec.name);
    const bool on_host = std::ranges::any_of(
        entry.host_alone, [&](const auto& alone) { return spec.has(alone.first, alone.second); });
    return decideDevice(choice, entry.run_vulkan != nullptr && !on_host);
}

MethodResult runOnDevice(const MethodEntry& entry, const MethodSpec& spec, const MethodInput& input,
                         bool asked) {
    std::string why;
    try {
        return entry.run_vulkan(spec, input);
    } catch (const DeviceError& error) {
        if (asked) throw;
        why = error.what();
    }
    MethodResult result = entry.run(spec, input);
    result.notes.push_back(fmt::format("'{}' ran on the CPU: {}", entry.name, why));
    return result;
}

namespace {

void requireComposition(const MethodEntry& entry, const MethodSpec& spec) {
    for (const MethodSpec& other : spec.composed)
        if (other.name != entry.composes_with || spec.composed.size() > 1)
            fail(spec.typed, fmt::format("'{}' does not compose with {}", spec.name,
                                         entry.composes_with.empty() ? "other methods" : other.typed));
}

MethodResult runOnTriangles(const MethodEntry& entry, const MethodSpec& spec, const MethodInput& input) {
    if (!entry.run) fail(spec.typed, "traces SDF scenes, and this one is of triangles");
    const DeviceDecision decision = decideDevice(spec, input.options);
    tbb::task_arena arena(input.options.threads > 0 ? input.options.threads : tbb::task_arena::automatic);
    MethodResult result;
    const bool asked = input.options.device == DeviceChoice::kVulkan || spec.has("device", "vulkan");
    arena.execute(
        [&] { result = decision.vulkan ? runOnDevice(entry, spec, input, asked) : entry.run(spec, input); });
    if (asked && !decision.vulkan)
        result.notes.push_back(fmt::format("'{}' ran on the CPU: {}", spec.name, decision.why));
    return result;
}

}  // namespace

bool wantsMesh(const MethodSpec& spec) {
    return spec.mesh || requireMethod(spec.typed, spec.name).needs_triangles;
}

MethodResult runOnMesh(const MethodSpec& spec, const FieldMesh& mesh, const MethodInput& input) {
    const MethodEntry& entry = requireMethod(spec.typed, spec.name);
    requireComposition(entry, spec);
    MethodSpec on_cpu = spec;
    on_cpu.parameters.erase("device");
    RenderOptions options = input.options;
    options.device = DeviceChoice::kCpu;
    MethodResult result = runOnTriangles(
        entry, on_cpu, {mesh.scene, input.camera, input.film, input.filter, options, input.progress});
    if (decideDevice(spec, input.options).vulkan)
        result.notes.push_back(
            fmt::format("'{}' ran on the CPU: surfaces of SDF scenes are shaded there", spec.name));
    return result;
}

void addMeshReport(const MeshReport& report, MethodResult& result) {
    result.mesh = report;
    result.setup_seconds += report.seconds;
    result.notes.push_back(wordsOf(report));
}

MethodResult runMethod(const MethodSpec& spec, const MethodInput& input) {
    const MethodEntry& entry = requireMethod(spec.typed, spec.name);
    requireComposition(entry, spec);
    if (!input.scene.field) return runOnTriangles(entry, spec, input);
    if (!wantsMesh(spec)) return runOnField(entry, spec, input);
    const FieldMesh mesh = meshForFilm(spec, input);
    MethodResult result = runOnMesh(spec, mesh, input);
    addMeshReport(mesh.report, result);
    return result;
}

std::vector<std::string> describeMethods() {
    std::vector<std::string> lines;
    for (const MethodEntry& entry : methodRegistry()) lines.push_back(describe(entry));
    lines.push_back(describe(meshEntry()));
    return lines;
}

}  // namespace edgewise
