#include "paper_figures/compared_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/compare/judge_row.h"
#include "pipeline/compare/mesh_reference.h"
#include "pipeline/error.h"
#include "pipeline/load_scene.h"
#include "pipeline/scene_catalog.h"
#include "pipeline/scoped_path.h"
#include "pipeline/version.h"

namespace edgewise::figures {
namespace {

/// For everything but the image, MiB: the program's default.
constexpr double kUsualMemory = 1024.0;
constexpr double kBytesPerPixel = sizeof(glm::dvec4) + sizeof(float);

struct Truth {
    compare::ReferencePicture picture;
    std::optional<compare::MeshReference> meshes;
    compare::MeshReferenceMaker::Made of_meshes;
};

/// Meshes are made once for all workers.
std::vector<std::string> argumentsWith(const ScopedPath& meshes, const ComparedPicture& picture,
                                       const std::string& method) {
    std::vector<std::string> arguments = workerArguments(picture, method);
    arguments.push_back("--meshes=" + meshes.path().string());
    return arguments;
}

Truth truthOf(const ComparedPicture& picture, const std::string& reference, const ScopedPath& meshes_at,
              const std::filesystem::path& scratch, Progress& progress,
              const compare::ReferenceWishes& wishes) {
    Truth truth;
    compare::Row own;
    const auto arguments = [&](const std::string& method) {
        return argumentsWith(meshes_at, picture, method);
    };
    const MethodSpec method = parseMethod(reference);
    if (!isFieldFile(findScene(picture.scene)) || !wantsMesh(method)) {
        truth.picture =
            compare::referenceOf({reference, arguments(reference)}, scratch, own, progress, wishes);
        return truth;
    }
    compare::MeshReferenceMaker meshes(method, arguments, scratch, picture.most_meshes);
    truth.of_meshes = meshes.make(
        {{"name", picture.filter}, {"radius", fmt::format("{}", picture.radius)}, {"sigma", nullptr}}, own,
        progress);
    truth.picture.picture = truth.of_meshes.finest;
    truth.meshes = meshes.facts();
    return truth;
}

}  // namespace

std::vector<std::string> workerArguments(const ComparedPicture& picture, const std::string& method) {
    const double image_mib = kBytesPerPixel * picture.width * picture.height / 0x1p20;
    return {"compare-worker",
            picture.scene,
            fmt::format("--size={}x{}", picture.width, picture.height),
            "--filter=" + picture.filter,
            fmt::format("--radius={}", picture.radius),
            "--device=" + picture.device,
            fmt::format("--memory={:.0f}", std::ceil(kUsualMemory + image_mib)),
            "--method=" + method};
}

std::vector<std::string> knownOf(const std::vector<std::string>& methods, std::vector<std::string>& notes) {
    std::vector<std::string> known;
    for (const std::string& method : methods) try {
            parseMethod(method);
            known.push_back(method);
        } catch (const InputError& error) {
            if (std::ranges::find(notes, error.what()) == notes.end()) notes.push_back(error.what());
        }
    return known;
}

namespace {

struct Contest {
    std::vector<compare::Contender> contenders;
    std::vector<compare::Row> rows;

    /// `meshes`, if any: made once for all workers.
    Contest(const ComparedPicture& picture, const std::vector<std::string>& methods,
            const ScopedPath* meshes = nullptr) {
        findScene(picture.scene);
        const Prefilter filter = makePrefilter(picture.filter, picture.radius, {});
        for (const std::string& method : methods) {
            contenders.push_back({method, meshes ? argumentsWith(*meshes, picture, method)
                                                 : workerArguments(picture, method)});
            rows.push_back(compare::rowOf(parseMethod(method), filter));
        }
    }
};

}  // namespace

compare::Comparison compareOn(const ComparedPicture& picture, const std::string& reference,
                              const std::vector<std::string>& methods,
                              const compare::ScheduleOptions& schedule, Progress& progress,
                              const compare::ReferenceWishes& wishes) {
    const ScopedPath meshes_at = emptyFolder(schedule.scratch / ".meshes");
    Contest contest(picture, methods, &meshes_at);
    const Truth truth = truthOf(picture, reference, meshes_at, schedule.scratch, progress, wishes);
    compare::runByTurns(
        contest.contenders, schedule, contest.rows,
        [&](std::size_t i, const ImageBuffer& image) {
            compare::judgeRow(contest.rows[i], image, truth.picture);
            if (truth.meshes) compare::judgeOnMesh(contest.rows[i], image, *truth.meshes, truth.of_meshes);
        },
        [](std::size_t) {}, progress);
    return {picture.scene,           reference,           "",          version(), compare::thisMachine(),
            std::move(contest.rows), truth.picture.error, truth.meshes};
}

std::vector<compare::Row> timesOn(const ComparedPicture& picture, const std::vector<std::string>& methods,
                                  compare::ScheduleOptions schedule, Progress& progress) {
    Contest contest(picture, methods);
    schedule.pictures = false;
    compare::runByTurns(
        contest.contenders, schedule, contest.rows, [](std::size_t, const ImageBuffer&) {},
        [](std::size_t) {}, progress);
    return std::move(contest.rows);
}

}  // namespace edgewise::figures
