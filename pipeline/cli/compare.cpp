#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "pipeline/atomic_file.h"
#include "pipeline/cli/command.h"
#include "pipeline/cli/exposure_option.h"
#include "pipeline/cli/interrupt.h"
#include "pipeline/cli/result_folder.h"
#include "pipeline/cli/timing_options.h"
#include "pipeline/cli/worker_flags.h"
#include "pipeline/compare/comparison_report.h"
#include "pipeline/compare/comparison_tables.h"
#include "pipeline/compare/error_map.h"
#include "pipeline/compare/judge_row.h"
#include "pipeline/compare/kinds_tables.h"
#include "pipeline/compare/mesh_reference.h"
#include "pipeline/compare/mesh_reference_text.h"
#include "pipeline/compare/pareto_plot.h"
#include "pipeline/compare/schedule.h"
#include "pipeline/compare/svg_pdf.h"
#include "pipeline/compare/worker_process.h"
#include "pipeline/error.h"
#include "pipeline/load_scene.h"
#include "pipeline/progress_bar.h"
#include "pipeline/scene_catalog.h"
#include "pipeline/scoped_path.h"
#include "pipeline/version.h"
#include "pipeline/write_image.h"

namespace edgewise::cli {
namespace {

using compare::Comparison;
using compare::Contender;
using compare::Row;

struct CompareArguments {
    PictureArguments picture;
    FilterArguments filter;
    MethodArguments making;
    std::string folder, reference = kUsualReference, runs = kUsualRuns, command_line;
    std::vector<std::string> methods;
    std::optional<std::string> budget, exposure;
    bool resume = false, quiet = false;
};

/// Outside of [A-Za-z0-9.-] a character becomes '_'.
std::string fileName(std::string text) {
    for (char& c : text)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-') c = '_';
    return text;
}

FilterArguments filterFor(const CompareArguments& arguments, const std::string& method) {
    return takesFilter(parseMethod(method)) ? arguments.filter : FilterArguments{"box", {}, {}};
}

/// Every problem of the command line, before anything runs.
void checkMethods(const CompareArguments& arguments) {
    std::set<std::string> files;
    for (const std::string& method : arguments.methods) {
        checkAbilities(arguments.making, parseMethod(method));
        if (!files.insert(fileName(method)).second)
            throw InputError("--method", fmt::format("'{}' is named twice", method));
    }
    checkAbilities(arguments.making, parseMethod(arguments.reference));
    readFilter(arguments.filter);
    readExposure(arguments.exposure);
    readMethodOptions(arguments.making);
    findScene(arguments.picture.scene);
}

class Study {
  public:
    Study(const CompareArguments& arguments, const ResultFolder& folder, Progress& progress)
        : arguments_(arguments),
          folder_(folder),
          progress_(progress),
          mesh_folder_(emptyFolder(folder.path() / ".meshes")) {
        options_.runs = readRuns("--runs", arguments.runs);
        if (arguments.budget) options_.budget_seconds = readBudget("--budget", *arguments.budget);
        options_.scratch = folder.path();
        comparison_ = {arguments.picture.scene,
                       arguments.reference,
                       arguments.command_line,
                       version(),
                       compare::thisMachine(),
                       {},
                       {}};
        for (const std::string& method : arguments.methods) {
            const FilterArguments filter = filterFor(arguments, method);
            comparison_.rows.push_back(compare::rowOf(parseMethod(method), readFilter(filter)));
            contenders_.push_back({method, flagsOf(method, filter)});
        }
        const MethodSpec reference = parseMethod(arguments.reference);
        if (isFieldFile(findScene(arguments.picture.scene)) && wantsMesh(reference))
            meshes_.emplace(
                reference,
                [this](const std::string& method) {
                    return flagsOf(method, filterFor(arguments_, arguments_.reference));
                },
                folder_.path());
    }

    /// Errors, and what the reference's own error is beside them.
    std::string summary() const { return compare::meshReferenceWords(comparison_); }

    void run() {
        if (arguments_.resume) resume();
        makeReference(arguments_.filter);
        compare::runByTurns(
            contenders_, options_, comparison_.rows,
            [&](std::size_t i, const ImageBuffer& picture) { judge(comparison_.rows[i], picture); },
            [&](std::size_t i) { remember(i); }, progress_);
        write();
        for (const Row& row : comparison_.rows)
            if (!row.why.empty()) spdlog::warn("'{}': {}", row.method, row.why);
        if (!arguments_.quiet) fmt::print("{}", compare::kindsText(comparison_));
    }

  private:
    struct Reference {
        compare::ReferencePicture made;
        std::string png;
        compare::MadeOfMeshes of_meshes;  ///< where it is
    };

    void makeOfMeshes(const FilterArguments& filter, Reference& reference, Row& row) {
        const auto typed = [](const std::optional<std::string>& text) {
            return text ? nlohmann::json(*text) : nlohmann::json();
        };
        reference.of_meshes = meshes_->make(
            {{"name", filter.name}, {"radius", typed(filter.radius)}, {"sigma", typed(filter.sigma)}}, row,
            progress_);
        for (const std::string& note : row.notes) spdlog::warn("{}", note);
        reference.made.picture = reference.of_meshes.finest;
        comparison_.mesh_reference = meshes_->facts();
    }

    std::vector<std::string> flagsOf(const std::string& method, const FilterArguments& filter) const {
        std::vector<std::string> flags = workerFlags(arguments_.picture, filter, arguments_.making, method);
        flags.push_back("--meshes=" + mesh_folder_.path().string());
        return flags;
    }

    static std::string keyOf(const FilterArguments& filter) {
        return filter.name + " " + filter.radius.value_or("") + " " + filter.sigma.value_or("");
    }

    /// Made once a filter.
    const Reference& makeReference(const FilterArguments& filter) {
        const auto [found, fresh] = references_.try_emplace(keyOf(filter));
        if (!fresh) return found->second;
        auto flags = flagsOf(arguments_.reference, filter);
        if (references_.size() == 1) flags.push_back("--warn");
        Row row;
        Reference& reference = found->second;
        if (meshes_) {
            makeOfMeshes(filter, reference, row);
        } else {
            reference.made = compare::referenceOf({arguments_.reference, flags}, folder_.path(), row,
                                                  progress_, {true, references_.size() == 1});
            if (reference.made.error) comparison_.reference_error = reference.made.error;
        }
        size_ = row.size;
        if (references_.size() == 1) writeKinds(reference.made);
        reference.png = fileName(fmt::format("reference-{}.png", filter.name));
        writePicture(reference.made.picture, fileName("reference-" + filter.name), row.device);
        return reference;
    }

    void writeKinds(const compare::ReferencePicture& made) {
        if (made.kinds.empty()) return;
        kinds_png_ = "edge-kinds.png";
        WriteOptions options;
        options.width = size_.x, options.height = size_.y;
        writeImage(folder_ / kinds_png_, judge::edgeKindPicture(made.kinds, made.picture.box), options);
    }

    void writePicture(const ImageBuffer& picture, const std::string& name, const std::string& device) {
        WriteOptions options;
        options.width = size_.x, options.height = size_.y;
        options.exposure_ev = readExposure(arguments_.exposure);
        options.metadata = {{"version", version()},
                            {"command", arguments_.command_line},
                            {"device", device},
                            {"seed", arguments_.making.seed.value_or("0")}};
        writeImage(folder_ / (name + ".exr"), picture, options);
        writeImage(folder_ / (name + ".png"), picture, options);
    }

    void judge(Row& row, const ImageBuffer& picture) {
        const Reference& made = makeReference(filterFor(arguments_, row.method));
        const compare::ReferencePicture& reference = made.made;
        const ImageBuffer& truth = reference.picture;
        if (meshes_) compare::judgeOnMesh(row, picture, meshes_->facts(), made.of_meshes);
        const std::string name = fileName(row.method);
        compare::judgeRow(row, picture, reference);
        writePicture(picture, name, row.device);
        row.exr = name + ".exr", row.png = name + ".png";
        row.signed_map = name + ".signed.png", row.absolute_map = name + ".absolute.png";
        writeAtomically(folder_ / row.signed_map, compare::signedErrorMap(picture, truth));
        writeAtomically(folder_ / row.absolute_map, compare::absoluteErrorMap(picture, truth));
    }

    std::filesystem::path memoryOf(std::size_t i) const {
        return folder_ / ("." + fileName(contenders_[i].method) + ".row");
    }
    /// What a row and its pictures depend on.
    std::string keyOf(std::size_t i) const {
        std::string key =
            fmt::format("{} {} {}", version(), arguments_.reference, readExposure(arguments_.exposure));
        for (const std::string& word : contenders_[i].arguments) key += " " + word;
        return oneLine(key);
    }

    void remember(std::size_t i) const {
        writeAtomically(memoryOf(i), keyOf(i) + "\n" + compare::rowToText(comparison_.rows[i]));
    }

    void resume() {
        for (std::size_t i = 0; i < contenders_.size(); ++i) {
            std::ifstream file(memoryOf(i));
            std::string key, text;
            if (!std::getline(file, key) || !std::getline(file, text) || key != keyOf(i)) continue;
            Row row = compare::rowFromText(text);
            const bool whole = row.status == compare::RowStatus::kOk &&
                               std::filesystem::exists(folder_ / row.exr) &&
                               std::filesystem::exists(folder_ / row.png);
            if (whole) comparison_.rows[i] = std::move(row);
        }
    }

    void write() {
        const std::string svg = compare::paretoSvg(comparison_);
        writeAtomically(folder_ / "results.json", compare::comparisonJson(comparison_));
        writeAtomically(folder_ / "results.csv", compare::comparisonCsv(comparison_));
        writeAtomically(folder_ / "table.tex", compare::comparisonLatex(comparison_));
        writeAtomically(folder_ / "pareto.svg", svg);
        writeAtomically(folder_ / "pareto.pdf", compare::svgPdf(svg, "pareto.pdf"));
        writeAtomically(folder_ / "report.html",
                        compare::comparisonHtml(comparison_, folder_.path(),
                                                references_.at(keyOf(arguments_.filter)).png, kinds_png_));
    }

    const CompareArguments& arguments_;
    const ResultFolder& folder_;
    Progress& progress_;
    const ScopedPath mesh_folder_;  ///< meshes are made once for all workers
    compare::ScheduleOptions options_;
    Comparison comparison_;
    std::vector<Contender> contenders_;
    std::map<std::string, Reference> references_;
    std::optional<compare::MeshReferenceMaker> meshes_;  ///< the reference is a mesh's
    glm::ivec2 size_{0};
    std::string kinds_png_;
};

void runCompare(const CompareArguments& arguments) {
    checkMethods(arguments);
    const ResultFolder folder(arguments.folder);
    ProgressBar progress(!arguments.quiet && isatty(STDERR_FILENO), interruptFlag());
    try {
        Study study(arguments, folder, progress);
        study.run();
        if (!arguments.quiet) fmt::print("{}", study.summary());
    } catch (const compare::WorkerFailure& failure) {
        throwIfInterrupted();
        throwAsOurs(failure, "compare");
    }
    throwIfInterrupted();
    if (!arguments.quiet) fmt::print("{}\n", (folder / "report.html").string());
}

}  // namespace

void addCompare(CLI::App& program, const std::string& command_line) {
    CLI::App* command =
        program.add_subcommand("compare", "error against run time for several methods, with a report");
    auto arguments = std::make_shared<CompareArguments>();
    arguments->command_line = command_line;
    addPictureOptions(*command, arguments->picture);
    command
        ->add_option(
            "-o,--output", arguments->folder,
            "results.json, results.csv, table.tex, report.html, pareto.svg, pareto.pdf, pictures; of "
            "SDF scenes errors by kinds of edges too")
        ->type_name("DIR")
        ->required();
    command->add_option("--method", arguments->methods, "repeated; `edgewise methods` lists them")
        ->type_name("M")
        ->required()
        ->allow_extra_args(false);
    const CLI::Option* reference =
        command
            ->add_option("--reference", arguments->reference,
                         fmt::format("what errors are against [{}; SDF scenes: {}]", kUsualReference,
                                     kUsualFieldReference))
            ->type_name("M");
    addFilterOptions(*command, arguments->filter);
    addMethodOptions(*command, arguments->making);
    addExposureOption(*command, arguments->exposure);
    command->add_option("--budget", arguments->budget, "a method, all its runs [none]")->type_name("SECONDS");
    command->add_option("--runs", arguments->runs, "timed runs a method, after one that is not")
        ->type_name("N")
        ->capture_default_str();
    command->add_flag("--resume", arguments->resume, "keep the rows that DIR has of the same command");
    command->add_flag("--quiet", arguments->quiet, "no progress bar, no chatter");
    command->callback([arguments, reference] {
        if (reference->count() == 0 && isFieldFile(findScene(arguments->picture.scene)))
            arguments->reference = kUsualFieldReference;
        runCompare(*arguments);
    });
}

}  // namespace edgewise::cli
