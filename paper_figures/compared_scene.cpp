#include "paper_figures/compared_scene.h"

#include <fmt/format.h>

#include <cmath>

#include "pipeline/compare/judge_row.h"
#include "pipeline/scene_catalog.h"
#include "pipeline/version.h"

namespace edgewise::figures {
namespace {

/// For everything but the image, MiB: the program's default.
constexpr double kUsualMemory = 1024.0;
constexpr double kBytesPerPixel = sizeof(glm::dvec4) + sizeof(float);

}  // namespace

std::vector<std::string> workerArguments(const ComparedPicture& picture, const std::string& method) {
    const double image_mib = kBytesPerPixel * picture.width * picture.height / 0x1p20;
    return {"compare-worker",
            picture.scene,
            fmt::format("--size={}x{}", picture.width, picture.height),
            "--filter=" + picture.filter,
            fmt::format("--radius={}", picture.radius),
            "--device=cpu",
            fmt::format("--memory={:.0f}", std::ceil(kUsualMemory + image_mib)),
            "--method=" + method};
}

compare::Comparison compareOn(const ComparedPicture& picture, const std::string& reference,
                              const std::vector<std::string>& methods,
                              const compare::ScheduleOptions& schedule, Progress& progress) {
    findScene(picture.scene);
    const Prefilter filter = makePrefilter(picture.filter, picture.radius, {});
    compare::Comparison found{picture.scene, reference, "", version(), compare::thisMachine(), {}, {}};
    std::vector<compare::Contender> contenders;
    for (const std::string& method : methods) {
        contenders.push_back({method, workerArguments(picture, method)});
        found.rows.push_back(compare::rowOf(parseMethod(method), filter));
    }
    compare::Row own;
    const compare::ReferencePicture truth = compare::referenceOf(
        {reference, workerArguments(picture, reference)}, schedule.scratch, own, progress);
    compare::runByTurns(
        contenders, schedule, found.rows,
        [&](std::size_t i, const ImageBuffer& image) { compare::judgeRow(found.rows[i], image, truth); },
        [](std::size_t) {}, progress);
    return found;
}

}  // namespace edgewise::figures
