#include "pipeline/compare/mesh_reference.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/compare/raw_image.h"
#include "pipeline/judge/metrics.h"
#include "pipeline/scoped_path.h"

namespace edgewise::compare {
namespace {

using Json = nlohmann::json;

/// Of what a picture moved by, where its mesh is hardly nearer than the last one.
constexpr double kMostFactor = 100.0;
constexpr std::chrono::hours kWhatItTakes{24 * 365};

}  // namespace

PictureDistance distanceBetween(const ImageBuffer& picture, const ImageBuffer& reference) {
    const judge::ErrorMetrics metrics = judge::compareImages(picture, reference);
    return {metrics.rmse, metrics.max, metrics.edge_rmse};
}

PictureDistance leftOf(const PictureDistance& moved, double first_px, double second_px) {
    if (second_px == 0.0) return {0.0, 0.0, {}};
    const double factor = std::min(second_px / std::max(first_px - second_px, 0.0), kMostFactor);
    PictureDistance left{factor * moved.rmse, factor * moved.max, {}};
    if (moved.edge_rmse) left.edge_rmse = factor * *moved.edge_rmse;
    return left;
}

void judgeOnMesh(Row& row, const ImageBuffer& picture, const MeshReference& reference,
                 const MadeOfMeshes& made) {
    row.reference_error = made.own_error;
    const MeshReport& first = reference.levels.front().mesh;
    if (row.mesh && row.mesh->mesher == first.mesher && row.mesh->asked_px == first.asked_px)
        row.antialiasing = distanceBetween(picture, made.first);
}

std::string onMeshWithin(double error_px, const MethodSpec& method) {
    std::string name = method.typed;
    if (method.mesh) name.erase(0, name.find('+') + 1);
    return fmt::format("mesh:error={},mesher={}+{}", error_px, method.mesh.value_or(MeshChoice{}).mesher,
                       name);
}

MeshReferenceMaker::MeshReferenceMaker(const MethodSpec& method, ArgumentsOf arguments,
                                       std::filesystem::path scratch, std::size_t most_meshes)
    : method_(method),
      arguments_(std::move(arguments)),
      scratch_(std::move(scratch)),
      most_meshes_(most_meshes) {
    facts_.stated = kStatedError;
}

/// False where the mesher does not get that far.
bool MeshReferenceMaker::addLevel(Row& row, Progress& progress) {
    const double first_px = method_.mesh.value_or(MeshChoice{}).error_px;
    MeshLevel level;
    level.error_px = first_px / static_cast<double>(1 << facts_.levels.size());
    WorkerProcess worker(arguments_(onMeshWithin(level.error_px, method_)));
    try {
        worker.ask({{"do", "open"}}, kWhatItTakes, progress);
    } catch (const WorkerFailure& failure) {
        if (failure.status != 1 || facts_.levels.empty()) throw;
        row.notes.push_back(fmt::format("the reference's mesh is no finer: {}", failure.what()));
        return false;
    }
    workers_.push_back(std::move(worker));
    facts_.levels.push_back(level);
    return true;
}

ImageBuffer MeshReferenceMaker::pictureOf(std::size_t level, const Json& filter, Row& row,
                                          Progress& progress) {
    WorkerProcess& worker = workers_[level];
    worker.ask({{"do", "filter"}, {"filter", filter}}, kWhatItTakes, progress);
    const Json reply = worker.ask({{"do", "run"}}, kWhatItTakes, progress);
    takeFacts(reply, row);
    facts_.levels[level].mesh = row.mesh.value_or(MeshReport{});
    const ScopedPath file = temporaryFile(scratch_);
    worker.ask({{"do", "save"}, {"path", pathJson(file.path())}}, kWhatItTakes, progress);
    return readRaw(file.path());
}

void MeshReferenceMaker::measureSilhouettes(Progress& progress) {
    const Json reply = workers_.front().ask({{"do", "silhouette"}}, kWhatItTakes, progress);
    facts_.silhouette_there_px = reply.at("there"), facts_.silhouette_back_px = reply.at("back");
    facts_.silhouette_mean_px = reply.at("mean");
}

MeshReferenceMaker::Made MeshReferenceMaker::make(const Json& filter, Row& row, Progress& progress) {
    Made made;
    if (!decided_) addLevel(row, progress);
    made.first = made.finest = pictureOf(0, filter, row, progress);
    if (!decided_) measureSilhouettes(progress);
    for (std::size_t level = 1; level < most_meshes_; ++level) {
        if (decided_ ? level >= workers_.size() : !addLevel(row, progress)) break;
        ImageBuffer finer = pictureOf(level, filter, row, progress);
        const PictureDistance moved = distanceBetween(made.finest, finer);
        made.own_error =
            leftOf(moved, facts_.levels[level - 1].mesh.error_px, facts_.levels[level].mesh.error_px);
        made.finest = std::move(finer);
        if (decided_) continue;
        facts_.levels[level].moved = moved, facts_.levels[level].left = made.own_error;
        if (facts_.reached()) break;
    }
    decided_ = true;
    return made;
}

}  // namespace edgewise::compare
