#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/atomic_file.h"
#include "pipeline/cli/aov_options.h"
#include "pipeline/cli/command.h"
#include "pipeline/cli/filter_options.h"
#include "pipeline/cli/interrupt.h"
#include "pipeline/cli/method_options.h"
#include "pipeline/cli/parse_values.h"
#include "pipeline/cli/picture_options.h"
#include "pipeline/cli/statistics.h"
#include "pipeline/error.h"
#include "pipeline/progress_bar.h"
#include "pipeline/version.h"
#include "pipeline/write_image.h"

namespace edgewise::cli {
namespace {

constexpr double kMaxExposureEv = 1000.0;  // 2^1000 is still a double

struct RenderArguments {
    PictureArguments picture;
    FilterArguments filter;
    MethodArguments making;
    std::string method = "nsaa";
    std::vector<std::string> outputs, aovs;
    std::optional<std::string> exposure, stats, dump_stages;
    bool explain = false, quiet = false;
    std::string command_line;
};

double readExposure(const std::optional<std::string>& text) {
    const double ev = text ? parseNumber("--exposure", *text) : 0.0;
    if (std::abs(ev) > kMaxExposureEv)
        throw InputError("--exposure", fmt::format("{} is not within +-{}", ev, kMaxExposureEv));
    return ev;
}

/// Absolute first: the part of a relative path that does not exist stays relative.
std::filesystem::path resolved(const std::string& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path));
}

void checkOutputs(const RenderArguments& arguments) {
    for (const std::string& output : arguments.outputs) {
        checkOutputPath(output);
        imageFormat(output);
    }
    if (!arguments.stats) return;
    checkOutputPath(*arguments.stats);
    for (const std::string& output : arguments.outputs)
        if (resolved(output) == resolved(*arguments.stats))
            throw InputError("--stats", fmt::format("{} is an --output too", *arguments.stats));
}

/// Refuses at once what would fill the machine's memory: the finished image is held whole, and once more in
/// its file's format.
void requireMemoryFor(const PixelBox& crop, const std::set<Aov>& aovs) {
    // RGBA, edge; five floats, raw and compressed; AOVs, held, raw and compressed
    const double bytes_per_pixel = 4 * 8 + 4 + 2 * 5 * 4 + 3 * 4 * double(aovChannelCount(aovs));
    const double needed = bytes_per_pixel * crop.width() * crop.height();
    const double machine =
        static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
    if (needed > machine)
        throw FailureError("memory",
                           fmt::format("a picture of {}x{} needs {:.0f} MiB, this machine has {:.0f}",
                                       crop.width(), crop.height(), needed / 0x1p20, machine / 0x1p20));
}

/// The folder of --dump-stages exists afterwards.
void makeDumpFolder(const RenderOptions& options) {
    if (!options.dump_dir) return;
    std::error_code error;
    std::filesystem::create_directories(*options.dump_dir, error);
    if (!std::filesystem::is_directory(*options.dump_dir, error))
        throw InputError("--dump-stages", fmt::format("{} is not a folder and cannot be made one",
                                                      options.dump_dir->string()));
}

WriteOptions makeWriteOptions(const RenderArguments& arguments, const Film& film, const MethodResult& result,
                              const RenderOptions& options) {
    WriteOptions write;
    write.width = film.width;
    write.height = film.height;
    write.exposure_ev = readExposure(arguments.exposure);
    write.metadata = {{"version", version()},
                      {"command", arguments.command_line},
                      {"device", result.device},
                      {"seed", fmt::format("{}", options.seed)}};
    return write;
}

void writeOutputs(const RenderArguments& arguments, const MethodResult& result, const WriteOptions& write) {
    for (const std::string& output : arguments.outputs) {
        throwIfInterrupted();
        writeImage(output, result.image, write);
    }
    throwIfInterrupted();
    if (arguments.stats) writeAtomically(*arguments.stats, statisticsJson(result));
}

void render(const RenderArguments& arguments) {
    checkOutputs(arguments);
    readExposure(arguments.exposure);
    const Prefilter filter = readFilter(arguments.filter);
    const MethodSpec method = parseMethod(arguments.method);
    RenderOptions options = readMethodOptions(arguments.making);
    options.aovs = readAovs(arguments.aovs, arguments.outputs);
    if (arguments.dump_stages) options.dump_dir = *arguments.dump_stages;
    checkAbilities(arguments.making, method);

    const ThreadLimit threads(options);
    ProgressBar progress(!arguments.quiet && isatty(STDERR_FILENO), interruptFlag());
    const Picture picture = loadPicture(arguments.picture, progress);
    warnOfIgnored(picture.scene);
    requireMemoryFor(picture.film.crop, options.aovs);
    makeDumpFolder(options);
    const MethodResult result =
        runMethod(method, {picture.scene, picture.camera, picture.film, filter, options, progress});
    writeOutputs(arguments, result, makeWriteOptions(arguments, picture.film, result, options));
    if (arguments.explain) fmt::print("{}", planInWords(result.plan));
}

}  // namespace

void addRender(CLI::App& program, const std::string& command_line) {
    CLI::App* command = program.add_subcommand("render", "one image");
    auto arguments = std::make_shared<RenderArguments>();
    arguments->command_line = command_line;
    addPictureOptions(*command, arguments->picture);
    command
        ->add_option("-o,--output", arguments->outputs,
                     ".exr (float32, linear) or .png (8-bit, sRGB); repeated: the same image in each")
        ->type_name("OUT.exr|OUT.png")
        ->required()
        ->allow_extra_args(false);
    command->add_option("--method", arguments->method, "`edgewise methods` lists them")
        ->type_name("M")
        ->capture_default_str();
    addFilterOptions(*command, arguments->filter);
    addMethodOptions(*command, arguments->making);
    command->add_option("--exposure", arguments->exposure, "PNG only [0]")->type_name("EV");
    command->add_option("--stats", arguments->stats, "stage times, counts, memory, plan")
        ->type_name("FILE.json");
    command
        ->add_option("--dump-stages", arguments->dump_stages, "every intermediate as data and as a picture")
        ->type_name("DIR");
    addAovOptions(*command, arguments->aovs);
    command->add_flag("--explain", arguments->explain, "print the plan in words");
    command->add_flag("--quiet", arguments->quiet, "no progress bar, no chatter");
    command->callback([arguments] { render(*arguments); });
}

}  // namespace edgewise::cli
