// The other end of compare/worker_process: makes one method's pictures, as often as it is asked.
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "pipeline/cli/command.h"
#include "pipeline/cli/filter_options.h"
#include "pipeline/cli/interrupt.h"
#include "pipeline/cli/method_options.h"
#include "pipeline/cli/picture_options.h"
#include "pipeline/cli/statistics.h"
#include "pipeline/compare/raw_image.h"
#include "pipeline/compare/worker_process.h"
#include "pipeline/error.h"
#include "pipeline/field_mesh.h"
#include "pipeline/json_text.h"
#include "pipeline/judge/edge_kinds.h"
#include "pipeline/judge/silhouette.h"
#include "pipeline/methods/edge_classes.h"
#include "pipeline/methods/stopwatch.h"
#include "pipeline/progress_bar.h"

namespace edgewise::cli {
namespace {

using Json = nlohmann::json;

struct WorkerArguments {
    PictureArguments picture;
    FilterArguments filter;
    MethodArguments making;
    std::string method;
    std::string meshes;  ///< a MeshStore's folder; empty: none
    bool warns = false;
};

class Worker {
  public:
    explicit Worker(const WorkerArguments& arguments)
        : arguments_(arguments),
          filter_(readFilter(arguments.filter)),
          method_(parseMethod(arguments.method)),
          options_(readMethodOptions(arguments.making)),
          threads_(options_),
          progress_(false, interruptFlag()) {}

    Json answer(const Json& request) {
        const std::string what = request.at("do");
        if (what == "open") return open();
        if (what == "run") return run();
        if (what == "edges") return edges();
        if (what == "kinds") return kinds();
        if (what == "check") return check(request);
        if (what == "filter") return refilter(request.at("filter"));
        if (what == "silhouette") return silhouette();
        compare::writeRaw(compare::pathFrom(request.at("path")), made_.image);
        return Json::object();
    }

  private:
    Json open() {
        picture_ = loadPicture(arguments_.picture, progress_);
        takeBackground(arguments_.making, picture_->scene, options_);
        if (arguments_.warns) warnOfIgnored(picture_->scene);
        if (picture_->scene.field && wantsMesh(method_)) mesh_ = makeMesh();
        return Json::object();
    }

    FieldMesh makeMesh() {
        if (arguments_.meshes.empty()) return meshForFilm(method_, input());
        const MeshStore store(arguments_.meshes);
        return meshForFilm(method_, input(), &store);
    }

    Json run() {
        made_ = {};
        Stopwatch watch;
        made_ = mesh_ ? runOnMesh(method_, *mesh_, inputOf(picture_->film))
                      : runMethod(method_, inputOf(picture_->film));
        const double seconds = watch.lap() - made_.setup_seconds;
        if (mesh_) addMeshReport(mesh_->report, made_);
        throwIfInterrupted();
        Json reply = Json::parse(statisticsJson(made_));
        reply["seconds"] = seconds;
        reply["size"] = {picture_->film.width, picture_->film.height};
        return reply;
    }

    Json refilter(const Json& filter) {
        const auto typed = [&](const char* key) {
            const Json& value = filter.at(key);
            return value.is_null() ? std::nullopt : std::optional(value.get<std::string>());
        };
        filter_ = readFilter({filter.at("name"), typed("radius"), typed("sigma")});
        return Json::object();
    }

    /// Of the field and of its mesh.
    Json silhouette() {
        const judge::SilhouetteDistance distance = judge::silhouetteDistance(
            judge::fieldMask(input()),
            judge::triangleMask(mesh_.value().scene, picture_->camera, picture_->film), picture_->film.crop);
        const auto px = [](double x) { return std::min(x, judge::kFarthestContourPx); };
        return {{"there", px(distance.first_to_second_px)},
                {"back", px(distance.second_to_first_px)},
                {"mean", px(distance.mean_px)}};
    }

    /// A digit a pixel.
    template <class Classes>
    static Json classesJson(const Classes& classes) {
        std::string digits;
        for (const auto one : classes) digits += static_cast<char>('0' + static_cast<int>(one));
        throwIfInterrupted();
        return {{"classes", digits}};
    }
    Json edges() {
        return classesJson(edgeClasses({mesh_ ? mesh_->scene : picture_->scene, picture_->camera,
                                        picture_->film, filter_, options_, progress_}));
    }
    /// None but of an SDF scene.
    Json kinds() {
        constexpr int kLattice = 8;  // as fine as what ssaa:8 tells of a pixel
        if (!picture_->scene.field) return {{"classes", ""}};
        return classesJson(judge::edgeKindsOf(inputOf(picture_->film), kLattice));
    }

    /// The picture by another method, on some rows.
    Json check(const Json& request) {
        Film film = picture_->film;
        film.crop.y0 = request.at("rows")[0], film.crop.y1 = request.at("rows")[1];
        made_ = runMethod(parseMethod(request.at("method").get<std::string>()), inputOf(film));
        throwIfInterrupted();
        return Json::object();
    }

    MethodInput inputOf(const Film& film) {
        return {picture_->scene, picture_->camera, film, filter_, options_, progress_};
    }

    MethodInput input() { return inputOf(picture_->film); }

    const WorkerArguments& arguments_;
    Prefilter filter_;
    MethodSpec method_;
    RenderOptions options_;
    ThreadLimit threads_;
    ProgressBar progress_;
    std::optional<Picture> picture_;
    std::optional<FieldMesh> mesh_;  ///< made once: what it takes is set-up of every run
    MethodResult made_;
};

/// What the other end cannot have seen is told there, with the status that the program would end with.
Json failure(const std::exception& error, int status) {
    return {{"error", error.what()}, {"status", status}};
}

void serve(const WorkerArguments& arguments) {
    std::optional<Worker> worker;
    for (std::string line; std::getline(std::cin, line);) {
        Json reply;
        try {
            if (!worker) worker.emplace(arguments);
            reply = worker->answer(Json::parse(line));
        } catch (const InputError& error) {
            reply = failure(error, 2);
        } catch (const Interrupted&) {
            throw;
        } catch (const std::bad_alloc&) {
            reply = failure(std::runtime_error("memory: not enough for this picture"), 1);
        } catch (const std::exception& error) {
            reply = failure(error, 1);
        }
        std::cout << jsonText(reply) << std::endl;
    }
}

}  // namespace

void addCompareWorker(CLI::App& program) {
    CLI::App* command = program.add_subcommand("compare-worker", "one method of compare")->group("");
    auto arguments = std::make_shared<WorkerArguments>();
    addPictureOptions(*command, arguments->picture);
    addFilterOptions(*command, arguments->filter);
    addMethodOptions(*command, arguments->making);
    command->add_option("--method", arguments->method)->required();
    command->add_option("--meshes", arguments->meshes);
    command->add_flag("--warn", arguments->warns);
    command->callback([arguments] { serve(*arguments); });
}

}  // namespace edgewise::cli
