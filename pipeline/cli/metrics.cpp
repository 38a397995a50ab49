#include "pipeline/judge/metrics.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>
#include <string>

#include "pipeline/cli/command.h"
#include "pipeline/cli/interrupt.h"
#include "pipeline/read_image.h"

namespace edgewise::cli {
namespace {

using Json = nlohmann::ordered_json;

struct MetricsArguments {
    std::string image, reference;
    bool json = false;
};

/// A PNG keeps no place.
bool hasPlace(const std::string& path) {
    return std::filesystem::path(path).extension() == ".exr";
}

/// Crops of different places may be meant; more often one of them is the wrong file.
void warnOfPlaces(const PixelBox& image, const PixelBox& reference) {
    if (image.x0 == reference.x0 && image.y0 == reference.y0) return;
    spdlog::warn("the data windows begin at {},{} and {},{}; they are compared corner by corner", image.x0,
                 image.y0, reference.x0, reference.y0);
}

/// "name value" a line, numbers that read back exactly.
void printInWords(const Json& metrics) {
    for (const auto& [name, value] : metrics.items())
        fmt::print("{:<10} {}\n", name, value.is_null() ? "none" : value.dump());
}

void metrics(const MetricsArguments& arguments) {
    const ImageBuffer image = readImage(arguments.image);
    throwIfInterrupted();
    const ImageBuffer reference = readImage(arguments.reference);
    throwIfInterrupted();
    const judge::ErrorMetrics error =
        judge::compareImages(image, reference, arguments.image, arguments.reference);
    throwIfInterrupted();
    if (hasPlace(arguments.image) && hasPlace(arguments.reference)) warnOfPlaces(image.box, reference.box);
    if (arguments.json)
        fmt::print("{}\n", judge::metricsJson(error).dump(2));
    else
        printInWords(judge::metricsJson(error));
}

constexpr const char* kFooter = R"(
rmse, max, bias (mean of IMAGE - REFERENCE) and psnr (dB, peak 1; none if the error is 0) are over linear R, G, B;
edge_rmse and edge_psnr the same over the pixels that REFERENCE's channel `edge` marks (none without one).
ssim (Wang's, Gaussian window, sigma 1.5, data range 1) and flip (mean LDR-FLIP, 67 pixels
a degree) are of the sRGB picture, clamped to [0, 1] and not rounded. Alpha is left out. PNGs are sRGB-decoded.)";

}  // namespace

void addMetrics(CLI::App& program) {
    CLI::App* command = program.add_subcommand("metrics", "error metrics of two images");
    auto arguments = std::make_shared<MetricsArguments>();
    command->add_option("IMAGE", arguments->image, ".exr, or .png of 8 or 16 bits")
        ->type_name("")
        ->required();
    command->add_option("REFERENCE", arguments->reference, "of the same size")->type_name("")->required();
    command->add_flag("--json", arguments->json, "as JSON; what there is none of is null");
    command->footer(kFooter);
    acceptQuiet(*command);
    command->callback([arguments] { metrics(*arguments); });
}

}  // namespace edgewise::cli
