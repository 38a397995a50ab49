// A reference that is made of meshes of an SDF scene, ever finer ones, until it hardly moves.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "pipeline/compare/comparison.h"
#include "pipeline/compare/schedule.h"
#include "pipeline/compare/worker_process.h"

namespace edgewise::compare {

/// RMSE over linear RGB that the reference may be off by, and how many meshes are made for that at most.
inline constexpr double kStatedError = 1e-3;
inline constexpr std::size_t kMostMeshes = 4;

/// By judge::compareImages(); the pictures have one box.
PictureDistance distanceBetween(const ImageBuffer& picture, const ImageBuffer& reference);

/// MeshLevel::left of the second, where the first and it are that far off the surface. Large where the second
/// is no nearer.
PictureDistance leftOf(const PictureDistance& moved, double first_px, double second_px);

struct MadeOfMeshes {
    ImageBuffer first, finest;  ///< of the coarsest and of the finest mesh
    PictureDistance own_error;  ///< MeshLevel::left of the finest
};
/// Fills a row's reference_error and, where its mesh is the one that the reference began with, antialiasing.
void judgeOnMesh(Row& row, const ImageBuffer& picture, const MeshReference& reference,
                 const MadeOfMeshes& made);

/// The same method on a mesh within that part of a pixel.
std::string onMeshWithin(double error_px, const MethodSpec& method);

class MeshReferenceMaker {
  public:
    /// What a worker is started with to make a method's pictures.
    using ArgumentsOf = std::function<std::vector<std::string>(const std::string& method)>;

    MeshReferenceMaker(const MethodSpec& method, ArgumentsOf arguments, std::filesystem::path scratch,
                       std::size_t most_meshes = kMostMeshes);

    using Made = MadeOfMeshes;
    /// `filter`: {name, radius, sigma} as typed. The first call decides how many meshes there are; `row`
    /// takes size and device. Throws as referenceOf().
    Made make(const nlohmann::json& filter, Row& row, Progress& progress);

    /// Of the first call's filter; silhouettes are measured then too.
    const MeshReference& facts() const { return facts_; }

  private:
    ImageBuffer pictureOf(std::size_t level, const nlohmann::json& filter, Row& row, Progress& progress);
    bool addLevel(Row& row, Progress& progress);
    void measureSilhouettes(Progress& progress);

    const MethodSpec method_;
    const ArgumentsOf arguments_;
    const std::filesystem::path scratch_;
    const std::size_t most_meshes_;
    std::vector<WorkerProcess> workers_;  ///< by level
    MeshReference facts_;
    bool decided_ = false;
};

}  // namespace edgewise::compare
