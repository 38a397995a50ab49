#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/atomic_file.h"
#include "pipeline/cli/command.h"
#include "pipeline/cli/exposure_option.h"
#include "pipeline/cli/interrupt.h"
#include "pipeline/cli/method_options.h"
#include "pipeline/cli/parse_values.h"
#include "pipeline/cli/statistics.h"
#include "pipeline/display_window.h"
#include "pipeline/error.h"
#include "pipeline/methods/post_process.h"
#include "pipeline/methods/stopwatch.h"
#include "pipeline/progress_bar.h"
#include "pipeline/read_image.h"
#include "pipeline/version.h"
#include "pipeline/write_image.h"

namespace edgewise::cli {
namespace {

struct PostArguments {
    std::string image, method, command_line;
    std::vector<std::string> outputs;
    MethodArguments making;  ///< of which --threads
    std::optional<std::string> exposure, stats;
    bool quiet = false;
};

struct PictureFile {
    ImageBuffer image;          ///< what the file holds, the whole picture's corner being 0,0
    int width = 0, height = 0;  ///< of the whole picture
};

void requireFinite(const ImageBuffer& image, const std::string& name) {
    for (int y = image.box.y0; y < image.box.y1; ++y)
        for (int x = image.box.x0; x < image.box.x1; ++x)
            for (int c = 0; c < 4; ++c)
                if (const double value = image.rgba[image.index(x, y)][c]; !std::isfinite(value))
                    throw InputError(name, fmt::format("pixel {},{} is {}, not a number", x, y, value));
}

PictureFile readPicture(const std::string& name) {
    PictureFile picture{readImage(name)};
    ImageBuffer& image = picture.image;
    requireFinite(image, name);
    image.edge.resize(image.rgba.size(), 0.0f);
    const PixelBox whole = displayWindow(name).value_or(image.box);
    const PixelBox box = image.box;
    image.box = {box.x0 - whole.x0, box.y0 - whole.y0, box.x1 - whole.x0, box.y1 - whole.y0};
    picture.width = whole.width();
    picture.height = whole.height();
    return picture;
}

void writeOutputs(const PostArguments& arguments, const PictureFile& picture, Progress& progress) {
    WriteOptions options;
    options.width = picture.width;
    options.height = picture.height;
    options.exposure_ev = readExposure(arguments.exposure);
    options.metadata = {{"version", version()},
                        {"command", arguments.command_line},
                        {"device", "cpu"},
                        {"seed", "0"}};  // nothing is drawn by chance
    std::vector<ImageWriter> writers;
    for (const std::string& output : arguments.outputs) {
        writers.emplace_back(output, picture.image.box, picture.image.aov, options);
        progress.stage("write", static_cast<std::size_t>(picture.image.box.height()));
        writers.back().write(picture.image, progress);
    }
    for (ImageWriter& writer : writers) {
        throwIfInterrupted();
        writer.finish();
    }
}

void post(const PostArguments& arguments) {
    for (const std::string& output : arguments.outputs) {
        checkOutputPath(output);
        imageFormat(output);
    }
    if (arguments.stats) checkOutputPath(*arguments.stats);
    readExposure(arguments.exposure);
    const MethodSpec method = parseMethod(arguments.method);
    if (!method.composed.empty())
        throw InputError(fmt::format("method '{}'", method.typed), "does not compose with other methods");
    const PostProcess process = makePostProcess(method);
    const ThreadLimit threads(readMethodOptions(arguments.making));
    ProgressBar progress(!arguments.quiet && isatty(STDERR_FILENO), interruptFlag());

    MethodResult result;
    PictureFile picture = readPicture(arguments.image);
    process.apply(picture.image, progress, result.stages);
    writeOutputs(arguments, picture, progress);
    result.setup_seconds = process.setup_seconds;
    if (arguments.stats) writeAtomically(*arguments.stats, statisticsJson(result));
    if (method.has("device", "vulkan"))
        spdlog::warn("'{}' ran on the CPU: it has no Vulkan form", method.name);
}

}  // namespace

void addPost(CLI::App& program, const std::string& command_line) {
    CLI::App* command = program.add_subcommand("post", "a post-process on a picture from elsewhere");
    auto arguments = std::make_shared<PostArguments>();
    arguments->command_line = command_line;
    command->add_option("IMAGE", arguments->image, ".png (sRGB) or .exr (linear)")->required();
    command
        ->add_option("--method", arguments->method,
                     "smaa or fxaa, with parameters; `edgewise methods` lists them")
        ->type_name("M")
        ->required();
    command
        ->add_option("-o,--output", arguments->outputs,
                     ".exr (float32, linear) or .png (8-bit, sRGB); repeated: the same image in each")
        ->type_name("OUT.exr|OUT.png")
        ->required()
        ->allow_extra_args(false);
    addExposureOption(*command, arguments->exposure);
    command->add_option("--threads", arguments->making.threads, "CPU threads [all]")->type_name("N");
    command->add_option("--stats", arguments->stats, "stage times, counts, memory, plan")
        ->type_name("FILE.json");
    command->add_flag("--quiet", arguments->quiet, "no progress bar, no chatter");
    command->callback([arguments] { post(*arguments); });
}

}  // namespace edgewise::cli
