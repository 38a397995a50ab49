#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/atomic_file.h"
#include "pipeline/cli/aov_options.h"
#include "pipeline/cli/command.h"
#include "pipeline/cli/exposure_option.h"
#include "pipeline/cli/filter_options.h"
#include "pipeline/cli/interrupt.h"
#include "pipeline/cli/method_options.h"
#include "pipeline/cli/picture_options.h"
#include "pipeline/cli/result_folder.h"
#include "pipeline/cli/statistics.h"
#include "pipeline/cli/strips.h"
#include "pipeline/error.h"
#include "pipeline/field_mesh.h"
#include "pipeline/progress_bar.h"
#include "pipeline/version.h"
#include "pipeline/write_image.h"

namespace edgewise::cli {
namespace {

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

/// Refuses at once what no machine like this could hold, in whatever strips it is made: a stated limit.
void requireMemoryFor(const PixelBox& crop, const std::set<Aov>& aovs) {
    const double needed = double(bytesPerPixel(aovs)) * crop.width() * crop.height();
    const double machine =
        static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
    if (needed > machine)
        throw FailureError("memory",
                           fmt::format("a picture of {}x{} needs {:.0f} MiB, this machine has {:.0f}",
                                       crop.width(), crop.height(), needed / 0x1p20, machine / 0x1p20));
}

WriteOptions makeWriteOptions(const RenderArguments& arguments, const Film& film, const std::string& device,
                              const RenderOptions& options) {
    WriteOptions write;
    write.width = film.width;
    write.height = film.height;
    write.exposure_ev = readExposure(arguments.exposure);
    write.metadata = {{"version", version()},
                      {"command", arguments.command_line},
                      {"device", device},
                      {"seed", fmt::format("{}", options.seed)}};
    return write;
}

/// The outputs, each a writer from the first strip on.
class Outputs {
  public:
    Outputs(const RenderArguments& arguments, const MethodInput& input)
        : arguments_(arguments), input_(input) {}

    void write(const MethodResult& strip) {
        if (writers_.empty()) open(strip);
        for (ImageWriter& writer : writers_) {
            input_.progress.stage("write", static_cast<std::size_t>(strip.image.box.height()));
            writer.write(strip.image, input_.progress);
        }
    }

    void finish() {
        for (ImageWriter& writer : writers_) {
            throwIfInterrupted();
            writer.finish();
        }
    }

  private:
    void open(const MethodResult& strip) {
        const WriteOptions options = makeWriteOptions(arguments_, input_.film, strip.device, input_.options);
        for (const std::string& output : arguments_.outputs)
            writers_.emplace_back(output, input_.film.crop, strip.image.aov, options);
    }

    const RenderArguments& arguments_;
    const MethodInput& input_;
    std::vector<ImageWriter> writers_;
};

/// Makes and writes the picture; gives all of the result but the image.
MethodResult makePicture(const RenderArguments& arguments, const MethodSpec& method,
                         const MethodInput& input) {
    Outputs outputs(arguments, input);
    MethodResult all;
    std::optional<FieldMesh> mesh;  // one for all strips
    if (input.scene.field && wantsMesh(method)) mesh = meshForFilm(method, input);
    for (const PixelBox& strip : stripsOf(input.film.crop, input.options)) {
        Film film = input.film;
        film.crop = strip;
        const MethodInput part{input.scene, input.camera, film, input.filter, input.options, input.progress};
        const MethodResult made = mesh ? runOnMesh(method, *mesh, part) : runMethod(method, part);
        outputs.write(made);
        addStrip(made, all);
    }
    outputs.finish();
    if (mesh) addMeshReport(mesh->report, all);
    return all;
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
    takeBackground(arguments.making, picture.scene, options);
    requireMemoryFor(picture.film.crop, options.aovs);
    std::optional<ResultFolder> dump;  // gone where nothing was dumped
    if (arguments.dump_stages) dump.emplace(*arguments.dump_stages, "--dump-stages");
    const MethodResult result = makePicture(
        arguments, method, {picture.scene, picture.camera, picture.film, filter, options, progress});
    throwIfInterrupted();
    if (arguments.stats) writeAtomically(*arguments.stats, statisticsJson(result));
    for (const std::string& note : result.notes) spdlog::warn("{}", note);
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
    addExposureOption(*command, arguments->exposure);
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
