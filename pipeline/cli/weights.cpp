#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "pipeline/cli/command.h"
#include "pipeline/cli/filter_options.h"
#include "pipeline/cli/interrupt.h"
#include "pipeline/cli/method_options.h"
#include "pipeline/cli/parse_values.h"
#include "pipeline/cli/picture_options.h"
#include "pipeline/error.h"
#include "pipeline/field_mesh.h"
#include "pipeline/json_text.h"
#include "pipeline/methods/exact.h"
#include "pipeline/methods/nsaa.h"
#include "pipeline/progress_bar.h"
#include "pipeline/project.h"

namespace edgewise::cli {
namespace {

using Json = nlohmann::ordered_json;

struct WeightsArguments {
    PictureArguments picture;
    FilterArguments filter;
    MethodArguments making;
    std::string pixel;
    bool exact = false;
};

glm::ivec2 readPixel(const std::string& text, const Film& film) {
    const glm::dvec2 pixel = parsePair("--pixel", text);
    const bool whole = pixel == glm::floor(pixel);
    if (!whole || pixel.x < 0 || pixel.y < 0 || pixel.x >= film.width || pixel.y >= film.height)
        throw InputError(
            "--pixel", fmt::format("'{}' is no pixel of a picture of {}x{}", text, film.width, film.height));
    return pixel;
}

/// Every number reads back exactly. `layers` are the triangles in front of this one, front to back, then
/// itself: itself alone while everything is opaque.
Json ownerJson(const Scene& scene, const PixelOwner& owner) {
    const TriangleRef triangle = findTriangle(scene, owner.index);
    const Geometry& geometry = scene.geometry[triangle.geometry];
    return {{"index", owner.index},
            {"node", geometry.node},
            {"mesh", geometry.mesh},
            {"primitive", geometry.primitive},
            {"triangle", triangle.triangle},
            {"weight", owner.weight},
            {"color", {owner.color.r, owner.color.g, owner.color.b}},
            {"layers", owner.layers}};
}

Json filterJson(const Prefilter& filter) {
    return {{"name", filter.name},
            {"radius", filter.radius},
            {"sigma", filter.sigma ? Json(*filter.sigma) : Json(nullptr)}};
}

/// Beside the weights the oracle's, to 32 digits, and how many units in its last place each is off. An owner
/// that only one of them sees is listed too.
void addExact(const MethodInput& input, glm::ivec2 pixel, const PixelReport& report, Json& json) {
#ifdef EDGEWISE_HAS_ORACLE
    std::vector<std::pair<Owner, double>> product;
    for (const PixelOwner& owner : report.owners) product.emplace_back(owner.index, owner.weight);
    product.emplace_back(kBackground, report.background);
    json["exact"] = Json::array();
    for (const ExactWeight& w : exactWeights(input, pixel.x, pixel.y, product))
        json["exact"].push_back({{"index", w.owner == kBackground ? Json("background") : Json(w.owner)},
                                 {"weight", w.digits},
                                 {"difference_ulp", w.ulp_off}});
#else
    (void)input, (void)pixel, (void)report, (void)json;
    throw InputError("--exact", "this build has no oracle");
#endif
}

/// On a device only if it is asked for: making its pipelines takes longer than a pixel. A build without
/// Vulkan has refused by now.
PixelReport weighPixel(const MethodInput& input, glm::ivec2 pixel) {
#ifdef EDGEWISE_HAS_VULKAN
    if (input.options.device == DeviceChoice::kVulkan) return pixelWeightsVulkan(input, pixel.x, pixel.y);
#endif
    return pixelWeights(input, pixel.x, pixel.y);
}

void weights(const WeightsArguments& arguments) {
    const Prefilter filter = readFilter(arguments.filter);
    const RenderOptions options = readMethodOptions(arguments.making);
    checkAbilities(arguments.making, parseMethod("nsaa"));
    const ThreadLimit threads(options);
    ProgressBar quiet(false, interruptFlag());
    Picture picture = loadPicture(arguments.picture, quiet);
    warnOfIgnored(picture.scene);
    if (picture.scene.field)
        picture.scene = meshForFilm(parseMethod("nsaa"),
                                    {picture.scene, picture.camera, picture.film, filter, options, quiet})
                            .scene;
    const glm::ivec2 pixel = readPixel(arguments.pixel, picture.film);
    const PixelReport report =
        weighPixel({picture.scene, picture.camera, picture.film, filter, options, quiet}, pixel);

    Json json{{"pixel", {pixel.x, pixel.y}},     {"size", {picture.film.width, picture.film.height}},
              {"filter", filterJson(filter)},    {"weights", Json::array()},
              {"background", report.background}, {"sum", report.sum}};
    for (const PixelOwner& owner : report.owners) json["weights"].push_back(ownerJson(picture.scene, owner));
    if (arguments.exact)
        addExact({picture.scene, picture.camera, picture.film, filter, options, quiet}, pixel, report, json);
    fmt::print("{}\n", jsonText(json, 2));
}

}  // namespace

void addWeights(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("weights", "which primitives make up a pixel, with which weights (JSON)");
    auto arguments = std::make_shared<WeightsArguments>();
    addPictureOptions(*command, arguments->picture);
    command->add_option("--pixel", arguments->pixel, "column and row, from the top left")
        ->type_name("X,Y")
        ->required();
    command->add_flag("--exact", arguments->exact, "the oracle's weights beside the normal ones");
    addFilterOptions(*command, arguments->filter);
    addMethodOptions(*command, arguments->making);
    acceptQuiet(*command);
    command->callback([arguments] { weights(*arguments); });
}

}  // namespace edgewise::cli
