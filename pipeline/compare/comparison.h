// What `edgewise compare` finds: a row a method, and what is common to all rows.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analytic/prefilter.h"
#include "pipeline/judge/kind_errors.h"
#include "pipeline/judge/metrics.h"
#include "pipeline/methods/method.h"

namespace edgewise::compare {

enum class RowStatus { kOk, kTimeout, kFailed };
std::string nameOf(RowStatus status);

struct Spread {
    double median = 0.0, min = 0.0, max = 0.0;
    std::size_t runs = 0;
};
/// Of no values: zeros.
Spread spreadOf(std::vector<double> values);

/// Over the pixels whose support holds one or two edges, none parallel to an axis.
struct FewEdgesError {
    std::size_t pixels = 0;
    double rmse = 0.0;
};

/// Between two pictures, over linear RGB.
struct PictureDistance {
    double rmse = 0.0, max = 0.0;
    std::optional<double> edge_rmse;
};

/// One mesh of a reference, and how its picture differs from the coarser one's.
struct MeshLevel {
    double error_px = 0.0;  ///< asked for
    MeshReport mesh;
    std::optional<PictureDistance> moved;  ///< none: the first
    std::optional<PictureDistance> left;   ///< the picture's own error, by how it moved
};

/// What is known of a reference that is made of a mesh of an SDF scene: each level's mesh is asked to be half
/// as far off as the last one's, until what is left of the picture's error is `stated` at most. Outlines move
/// with the mesh, and pixels with outlines, to first order: of meshes that are measured a and then b < a off
/// the surface, moving the picture by m, the second one's is off by m b / (a - b) (Richardson).
struct MeshReference {
    double stated = 0.0;  ///< RMSE
    std::vector<MeshLevel> levels;
    /// Of the first level's mesh and of the field, in px.
    double silhouette_there_px = 0.0, silhouette_back_px = 0.0, silhouette_mean_px = 0.0;
    bool reached() const { return levels.back().left && levels.back().left->rmse <= stated; }
};

struct Row {
    std::string method;                                                    ///< as typed
    nlohmann::ordered_json parameters = nlohmann::ordered_json::object();  ///< resolvedParameters()
    std::string filter;
    double radius = 0.0;          ///< px
    std::optional<double> sigma;  ///< px; of the Gaussians
    glm::ivec2 size{0};           ///< px
    std::string device;
    RowStatus status = RowStatus::kOk;
    std::string why;                                    ///< not ok: in words
    std::vector<double> seconds, setup_seconds;         ///< by run
    std::map<std::string, std::vector<double>> stages;  ///< name -> seconds by run
    std::map<std::string, std::uint64_t> counts;        ///< of the last run, by name
    double peak_mib = 0.0;
    std::optional<judge::ErrorMetrics> error;  ///< none where no picture was made
    std::optional<FewEdgesError> few_edges;    ///< with a reference that is nsaa
    std::optional<judge::KindErrors> kinds;    ///< where kinds of edges are told: SDF scenes
    std::optional<double> bias_half_width;     ///< of error->bias's 95 % interval; none for small pictures
    std::optional<MeshReport> mesh;            ///< of methods that polygonized the scene
    /// With a reference of a mesh: the reference's own error, by this row's filter, and, of methods on the
    /// reference's first mesh, the distance from exact antialiasing of that mesh.
    std::optional<PictureDistance> reference_error, antialiasing;
    std::vector<PlanEntry> plan;
    std::vector<std::string> notes;
    std::string exr, png;                  ///< file names in the folder; empty where no picture was made
    std::string signed_map, absolute_map;  ///< likewise
};

/// A row before its first run: the method, its parameters and its filter.
Row rowOf(const MethodSpec& method, const Prefilter& filter);

/// Of the process's machine: name, processor, cores, memory.
struct Machine {
    std::string host, processor;
    unsigned cores = 0;
    double memory_mib = 0.0;
};
Machine thisMachine();

/// How far a reference of samples is off itself, judged by one of more samples on some of the picture's rows.
struct ReferenceError {
    std::string judge;  ///< the method
    judge::KindErrors kinds;
};

struct Comparison {
    std::string scene, reference, command, version;
    Machine machine;
    std::vector<Row> rows;
    std::optional<ReferenceError> reference_error = {};  ///< of SDF scenes with a reference ssaa:K
    std::optional<MeshReference> mesh_reference = {};
};

}  // namespace edgewise::compare
