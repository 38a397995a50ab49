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
            "--device=" + picture.device,
            fmt::format("--memory={:.0f}", std::ceil(kUsualMemory + image_mib)),
            "--method=" + method};
}

namespace {

struct Contest {
    std::vector<compare::Contender> contenders;
    std::vector<compare::Row> rows;

    Contest(const ComparedPicture& picture, const std::vector<std::string>& methods) {
        findScene(picture.scene);
        const Prefilter filter = makePrefilter(picture.filter, picture.radius, {});
        for (const std::string& method : methods) {
            contenders.push_back({method, workerArguments(picture, method)});
            rows.push_back(compare::rowOf(parseMethod(method), filter));
        }
    }
};

}  // namespace

compare::Comparison compareOn(const ComparedPicture& picture, const std::string& reference,
                              const std::vector<std::string>& methods,
                              const compare::ScheduleOptions& schedule, Progress& progress,
                              const compare::ReferenceWishes& wishes) {
    Contest contest(picture, methods);
    compare::Row own;
    const compare::ReferencePicture truth = compare::referenceOf(
        {reference, workerArguments(picture, reference)}, schedule.scratch, own, progress, wishes);
    compare::runByTurns(
        contest.contenders, schedule, contest.rows,
        [&](std::size_t i, const ImageBuffer& image) { compare::judgeRow(contest.rows[i], image, truth); },
        [](std::size_t) {}, progress);
    return {picture.scene,           reference,  "", version(), compare::thisMachine(),
            std::move(contest.rows), truth.error};
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
