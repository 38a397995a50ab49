#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/atomic_file.h"
#include "pipeline/cli/command.h"
#include "pipeline/cli/interrupt.h"
#include "pipeline/cli/parse_values.h"
#include "pipeline/cli/picture_options.h"
#include "pipeline/error.h"
#include "pipeline/json_text.h"
#include "pipeline/judge/mesh_quality.h"
#include "pipeline/load_scene.h"
#include "pipeline/polygonize_within.h"
#include "pipeline/progress_bar.h"
#include "pipeline/scene_catalog.h"
#include "pipeline/write_mesh.h"
#include "sdf/field_scene.h"

namespace edgewise::cli {
namespace {

struct PolygonizeArguments {
    std::string scene, output, mesher = "dual", command_line;
    std::optional<std::string> resolution, max_error, box, stats;
    bool cap = false, no_check = false, quiet = false;
};

WorldBox parseBox(const std::string& text) {
    std::size_t comma = 0;
    for (int n = 0; n < 3 && comma != std::string::npos; ++n) comma = text.find(',', comma + (n > 0));
    if (comma == std::string::npos)
        throw InputError("--box", fmt::format("'{}' is not X0,Y0,Z0,X1,Y1,Z1", text));
    const WorldBox box{parseTriple("--box", text.substr(0, comma)),
                       parseTriple("--box", text.substr(comma + 1))};
    for (int axis = 0; axis < 3; ++axis)
        if (!(box.low[axis] < box.high[axis])) throw InputError("--box", fmt::format("'{}' is empty", text));
    return box;
}

PolygonizeOptions optionsOf(const PolygonizeArguments& arguments) {
    PolygonizeOptions options;
    options.mesher = parseMesher(arguments.mesher);
    if (arguments.resolution)
        options.resolution =
            static_cast<int>(parseInteger("--resolution", *arguments.resolution, 4, sdf::kMostResolution));
    if (arguments.max_error) {
        const double most_off = parseNumber("--max-error", *arguments.max_error);
        options.most_off = most_off;
        if (!(most_off > 0.0))
            throw InputError("--max-error", fmt::format("'{}' is not above 0", *arguments.max_error));
        if (!arguments.resolution) options.resolution = kFirstResolution;
    }
    if (arguments.box) options.box = parseBox(*arguments.box);
    if (arguments.cap && !arguments.box) throw InputError("--cap", "it needs --box X0,Y0,Z0,X1,Y1,Z1");
    return options;
}

Polygonized meshOf(const Scene& scene, const PolygonizeOptions& options,
                   const std::optional<std::string>& amount, bool check,
                   std::optional<MeshDistance>& distance) {
    if (options.most_off) {
        MeasuredMesh measured = polygonizeWithin(*options.most_off, *amount, "--max-error", scene, options);
        distance = measured.distance;
        return std::move(measured.made);
    }
    Polygonized made = polygonize(scene, options);
    if (check) enterStage(options, fmt::format("measure {} triangles", made.mesh.triangles.size()));
    if (check) distance = measuredDistance(made, scene);
    return made;
}

nlohmann::json recordOf(const Polygonized& made, const std::optional<MeshDistance>& distance, bool check) {
    MeshQuality quality = qualityOf(made.mesh);
    if (check) quality.self_intersections = selfIntersections(made.mesh);
    quality.distance = distance;
    nlohmann::json record = jsonOf(quality);
    record["seconds"] = made.seconds;
    record["cpu_seconds"] = made.cpu_seconds;
    record["cell"] = made.lattice.step;
    record["octree"] = {
        {"nodes", made.counts.nodes}, {"pruned", made.counts.pruned}, {"bricks", made.counts.bricks}};
    record["cells"] = made.counts.cells;
    record["mended"] = made.counts.mended;
    record["collapsed"] = made.counts.collapsed;
    record["debris"] = made.counts.debris;
    record["added"] = made.counts.added;
    return record;
}

void polygonizeScene(const PolygonizeArguments& arguments) {
    checkOutputPath(arguments.output);
    if (arguments.stats) checkOutputPath(*arguments.stats);
    PolygonizeOptions options = optionsOf(arguments);
    Scene scene = loadScene(findScene(arguments.scene));
    scene.source = arguments.scene;
    warnOfIgnored(scene);
    if (scene.field && !scene.field->analytic.empty())
        spdlog::warn("{}: {} analytic shapes beside the tree are not in the mesh", scene.source,
                     scene.field->analytic.size());
    ProgressBar progress(!arguments.quiet && isatty(STDERR_FILENO), interruptFlag());
    options.progress = &progress;
    options.cap = arguments.cap;
    if (arguments.cap && scene.field && !scene.field->tree.empty()) {
        scene = cappedAt(scene, *options.box);
        options.box.reset();  // of what is left, the cap is the bounds
    }
    std::optional<MeshDistance> distance;
    const Polygonized made = meshOf(scene, options, arguments.max_error, !arguments.no_check, distance);
    wipeProgressLine();
    for (const std::string& note : made.notes) spdlog::warn("{}: {}", scene.source, note);
    writeMesh(arguments.output, made.mesh, scene, arguments.command_line);
    if (!arguments.no_check) enterStage(options, "look for self-intersections");
    const nlohmann::json record = recordOf(made, distance, !arguments.no_check);
    wipeProgressLine();
    if (arguments.stats) writeAtomically(*arguments.stats, jsonText(record, 1) + "\n");
    if (!arguments.quiet) fmt::print("{}\n", jsonText(record, 1));
}

}  // namespace

void addPolygonize(CLI::App& program, const std::string& command_line) {
    CLI::App* command = program.add_subcommand("polygonize", "a mesh of an SDF scene");
    auto arguments = std::make_shared<PolygonizeArguments>();
    arguments->command_line = command_line;
    command
        ->add_option("SCENE", arguments->scene, ".sdf.json or .map.glsl file, or a name of `edgewise scenes`")
        ->required();
    command->add_option("-o,--output", arguments->output, "positions in float32")
        ->type_name("MESH.glb")
        ->required();
    command
        ->add_option("--mesher", arguments->mesher,
                     "dual: sharp edges kept; marching-cubes; cgal: smooth surfaces alone")
        ->type_name("NAME")
        ->capture_default_str();
    command->add_option("--resolution", arguments->resolution, "cells along the box's longest side [128]")
        ->type_name("N");
    command
        ->add_option("--max-error", arguments->max_error,
                     "cells are divided until mesh and surface are nowhere found further apart; --resolution "
                     "is where it begins [64]")
        ->type_name("E");
    command
        ->add_option("--box", arguments->box,
                     "where the surface is looked for [the scene's bounds and a little more]")
        ->type_name("X0,Y0,Z0,X1,Y1,Z1");
    command->add_flag("--cap", arguments->cap, "the solid ends at the box, closed there");
    command->add_option("--stats", arguments->stats, "the mesh's quality, times and counts")
        ->type_name("FILE.json");
    command->add_flag("--no-check", arguments->no_check, "self-intersections and distances are not measured");
    command->add_flag("--quiet", arguments->quiet, "nothing is printed");
    command->callback([arguments] { polygonizeScene(*arguments); });
}

}  // namespace edgewise::cli
