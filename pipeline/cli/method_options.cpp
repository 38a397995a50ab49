#include "pipeline/cli/method_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "pipeline/cli/parse_values.h"
#include "pipeline/error.h"
#include "pipeline/plan.h"
#include "sdf/field_scene.h"

namespace edgewise::cli {
namespace {

constexpr std::array<std::string_view, 3> kDevices{"auto", "cpu", "vulkan"};
constexpr std::array<std::string_view, 2> kPrecisions{"fp64", "fp32"};
constexpr int kMaxThreads = 4096;
constexpr int kMaxFrames = 1 << 20;
constexpr int kMaxShadingSamples = 4096;
constexpr std::int64_t kMaxMemoryMib = std::int64_t{1} << 32;

/// What --no-skip takes.
std::vector<std::string> noSkipNames() {
    std::vector<std::string> names = skippableStages();
    names.push_back("all");
    return names;
}

template <typename Names>
void requireOneOf(const std::string& option, const std::string& value, const Names& names) {
    if (std::ranges::find(names, value) == names.end())
        throw InputError(option, fmt::format("'{}' is none of {}", value, fmt::join(names, ", ")));
}

ShadingChoice readShading(const std::string& text) {
    constexpr std::string_view kSamples = "samples:";
    if (text == "closest") return {ShadingMode::kClosest, 1};
    if (text == "centroid") return {ShadingMode::kCentroid, 1};
    if (text == "hit") return {ShadingMode::kHit, 1};
    if (!text.starts_with(kSamples))
        throw InputError("--shading", fmt::format("'{}' is none of closest, centroid, samples:N, hit", text));
    const std::string number = text.substr(kSamples.size());
    return {ShadingMode::kSamples,
            static_cast<int>(parseInteger("--shading", number, 1, kMaxShadingSamples))};
}

/// EXR holds float32: a colour beyond it could not be written.
glm::dvec3 readBackground(const std::string& text) {
    const glm::dvec3 color = parseTriple("--background", text);
    constexpr double kLargest = std::numeric_limits<float>::max();
    if (glm::any(glm::greaterThan(glm::abs(color), glm::dvec3(kLargest))))
        throw InputError("--background", fmt::format("'{}' is outside the range of a float32", text));
    return color;
}

}  // namespace

void addMethodOptions(CLI::App& command, MethodArguments& arguments) {
    command.add_option("--device", arguments.device, "auto takes Vulkan only when a real GPU is there")
        ->type_name("cpu|vulkan|auto")
        ->capture_default_str();
    command.add_option("--precision", arguments.precision, "arithmetic of weights")
        ->type_name("fp64|fp32")
        ->capture_default_str();
    command
        .add_option(
            "--shading", arguments.shading,
            "where a (pixel, primitive) is shaded, for every method alike; hit: sampling methods shade each "
            "sample where it lands")
        ->type_name("closest|centroid|samples:N|hit")
        ->capture_default_str();
    command
        .add_option("--background", arguments.background, "linear colour [an SDF scene's own, else 0,0,0]")
        ->type_name("R,G,B");
    command.add_option("--threads", arguments.threads, "CPU threads [all]")->type_name("N");
    command
        .add_option("--memory", arguments.memory, "ceiling for the buffers, the image is tiled to fit [1024]")
        ->type_name("MIB");
    command.add_option("--seed", arguments.seed, "of stochastic methods [0]")->type_name("N");
    command.add_option("--frames", arguments.frames, "of temporal methods; OUT is their mean [1]")
        ->type_name("N");
    command
        .add_option(
            "--no-skip", arguments.no_skip,
            fmt::format("forces what the plan leaves out: {}; repeatable", fmt::join(noSkipNames(), ", ")))
        ->type_name("NAME")
        ->allow_extra_args(false);
}

RenderOptions readMethodOptions(const MethodArguments& arguments) {
    RenderOptions options;
    requireOneOf("--device", arguments.device, kDevices);
    requireOneOf("--precision", arguments.precision, kPrecisions);
    options.device = deviceChoice(arguments.device);
    options.precision = arguments.precision == "fp32" ? Precision::kFp32 : Precision::kFp64;
    options.shading = readShading(arguments.shading);
    for (const std::string& name : arguments.no_skip) {
        requireOneOf("--no-skip", name, noSkipNames());
        options.no_skip.insert(name);
    }
    if (arguments.background) options.background = readBackground(*arguments.background);
    if (arguments.threads)
        options.threads = static_cast<int>(parseInteger("--threads", *arguments.threads, 1, kMaxThreads));
    if (arguments.memory)
        options.memory_mib =
            static_cast<std::size_t>(parseInteger("--memory", *arguments.memory, 1, kMaxMemoryMib));
    if (arguments.seed)
        options.seed = static_cast<std::uint64_t>(
            parseInteger("--seed", *arguments.seed, 0, std::numeric_limits<std::int64_t>::max()));
    if (arguments.frames)
        options.frames = static_cast<int>(parseInteger("--frames", *arguments.frames, 1, kMaxFrames));
    return options;
}

void takeBackground(const MethodArguments& arguments, const Scene& scene, RenderOptions& options) {
    if (!arguments.background && scene.field && scene.field->background)
        options.background = *scene.field->background;
}

ThreadLimit::ThreadLimit(const RenderOptions& options) {
    if (options.threads > 0)
        control_.emplace(tbb::global_control::max_allowed_parallelism,
                         static_cast<std::size_t>(options.threads));
}

void checkAbilities(const MethodArguments& arguments, const MethodSpec& method) {
    decideDevice(method, readMethodOptions(arguments));
}

}  // namespace edgewise::cli
