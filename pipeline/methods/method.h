// The one interface of all antialiasing methods: scene, camera, film, filter, options -> image, stage times,
// plan.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "analytic/precision.h"
#include "analytic/prefilter.h"
#include "pipeline/aov_names.h"
#include "pipeline/film.h"
#include "pipeline/image_buffer.h"
#include "pipeline/methods/device_choice.h"
#include "pipeline/progress.h"
#include "pipeline/scene.h"

namespace edgewise {

/// Where a (pixel, owner) is shaded.
enum class ShadingMode {
    kClosest,   ///< at the owner's point nearest to the pixel's sample
    kCentroid,  ///< at the centroid of what is seen of the owner in the support
    kSamples,   ///< the mean over up to ShadingChoice::samples points of what is seen
    kHit        ///< sampling methods: each sample where it lands; nsaa: kClosest, and says so
};

struct ShadingChoice {
    ShadingMode mode = ShadingMode::kClosest;
    int samples = 1;
};

struct RenderOptions {
    glm::dvec3 background{0.0};  ///< linear
    DeviceChoice device = DeviceChoice::kAuto;
    Precision precision = Precision::kFp64;  ///< of weights
    int threads = 0;                         ///< 0: all
    std::size_t memory_mib = 1024;
    ShadingChoice shading;
    std::uint64_t seed = 0;
    int frames = 1;  ///< of temporal methods: the picture is their mean
    std::set<std::string> no_skip;
    std::set<Aov> aovs;
    std::optional<std::filesystem::path> dump_dir;

    /// --no-skip NAME, or all.
    bool keeps(const std::string& stage) const { return no_skip.contains(stage) || no_skip.contains("all"); }
};

struct MethodInput {
    const Scene& scene;
    const ResolvedCamera& camera;
    const Film& film;
    const Prefilter& filter;
    const RenderOptions& options;
    Progress& progress;
};

struct StageTime {
    std::string name;
    double seconds = 0.0;
};

/// Whether a stage ran, and the reason in words.
struct PlanEntry {
    std::string stage;
    bool runs = true;
    std::string why;
};

/// How an SDF scene becomes triangles.
struct MeshChoice {
    double error_px = 0.2;  ///< mesh and surface are no further apart, in pixels, where they are seen
    std::string mesher = "dual";
};

/// The mesh that a triangle method was given in the place of an SDF scene.
struct MeshReport {
    std::string mesher;
    std::size_t triangles = 0;  ///< beside planes
    double pixel_world = 0.0;   ///< a pixel where the mesh is closest to the eye, in world units; 0: unseen
    double asked_px = 0.0;      ///< how far mesh and surface may be apart
    double error_px = 0.0;      ///< measured, by the pixels of each place
    double mesh_to_surface = 0.0;  ///< measured in world units, also where nothing is seen
    double surface_to_mesh = 0.0;
    double cell_world = 0.0;  ///< of the mesher's lattice
    double seconds = 0.0;     ///< in all; part of setup_seconds
    bool no_shadows = false;  ///< lights that throw some on the field throw none on the mesh
};

struct MethodResult {
    ImageBuffer image;
    std::vector<StageTime> stages;
    std::vector<PlanEntry> plan;
    std::map<std::string, std::uint64_t> counts;
    double setup_seconds = 0.0;
    std::string device = "cpu";      ///< where it ran
    std::vector<std::string> notes;  ///< one sentence each
    std::optional<MeshReport> mesh;  ///< of an SDF scene that was polygonized first
};

/// A method as the user typed it: NAME, NAME:NUMBER, NAME:key=value,..., composed by '+'; mesh+ before it.
struct MethodSpec {
    std::string typed;
    std::string name;
    std::optional<int> number;
    std::map<std::string, std::string> parameters;  ///< all, typed or not; device only where it is typed
    std::vector<MethodSpec> composed;               ///< what follows each '+', in order
    std::optional<MeshChoice> mesh;                 ///< mesh+: SDF scenes are polygonized first

    /// The value of a parameter that the method has.
    const std::string& parameter(const std::string& key) const { return parameters.at(key); }
    /// The same of a number, which parseMethod() has checked.
    double numberOf(const std::string& key) const;
    /// Whether the method has the parameter, with this value.
    bool has(const std::string& key, std::string_view value) const {
        const auto found = parameters.find(key);
        return found != parameters.end() && found->second == value;
    }
};

/// Throws InputError for an unknown method, parameter or value, a missing, superfluous or impossible number.
MethodSpec parseMethod(std::string_view typed);

/// Whether a method takes --filter; the others have a pixel-wide box of their own.
bool takesFilter(const MethodSpec& spec);

/// Where the method runs: its own device= over options.device. Throws FailureError where Vulkan is asked for
/// and there is none.
DeviceDecision decideDevice(const MethodSpec& spec, const RenderOptions& options);

/// Whether the method makes its picture of an SDF scene's mesh: it needs triangles, or is mesh+M.
bool wantsMesh(const MethodSpec& spec);

struct FieldMesh;
/// The picture of a mesh that is made already (field_mesh.h), of the same camera and film as the input's but
/// for the crop. What the mesh took is not in the result: addMeshReport() adds it.
MethodResult runOnMesh(const MethodSpec& spec, const FieldMesh& mesh, const MethodInput& input);
void addMeshReport(const MeshReport& report, MethodResult& result);

/// SDF scenes are polygonized first where wantsMesh() says so.
/// Throws InputError for what a method cannot do, FailureError where a limit is met, Interrupted when
/// cancelled.
MethodResult runMethod(const MethodSpec& spec, const MethodInput& input);

/// One line a method of this build: name, parameters, what it is.
std::vector<std::string> describeMethods();

class FieldTracer;
struct FieldSettings;
/// What traces an SDF scene (field_tracer.h): the CPU's maker or Vulkan's.
using FieldTracerMaker =
    std::function<std::unique_ptr<FieldTracer>(const MethodInput&, const FieldSettings&)>;

/// Words that a parameter may be.
struct WordChoice {
    std::vector<std::string> words;
    std::string usual;  ///< where nothing is typed
};

/// Numbers that a parameter may be, ends included.
struct NumberRange {
    double low = 0.0, high = 1.0;
    double usual = 0.0;  ///< where nothing is typed
    bool whole = false;
};

/// What the registry holds for each method; a new method adds one entry in registry.cpp.
struct MethodEntry {
    enum class Number { kAbsent, kRequired };
    std::string name;
    std::string summary;
    Number number = Number::kAbsent;
    int smallest = 1, largest = 64;             ///< of the number
    bool own_box = false;                       ///< takes no --filter
    bool needs_triangles = false;               ///< SDF scenes are polygonized first
    std::string composes_with = {};             ///< name+THIS:K; empty: it stands alone
    std::vector<int> numbers = {};              ///< all that it may be; empty: any from smallest to largest
    std::map<std::string, WordChoice> choices;  ///< by parameter; device is added to all
    std::map<std::string, NumberRange> ranges = {};      ///< by parameter
    std::map<std::string, std::string> host_alone = {};  ///< parameter -> what has no Vulkan form
    MethodResult (*run)(const MethodSpec&, const MethodInput&) = nullptr;
    MethodResult (*run_vulkan)(const MethodSpec&,
                               const MethodInput&) = nullptr;  ///< nullptr: the CPU's alone
    /// On SDF scenes; nullptr: it needs triangles.
    MethodResult (*run_field)(const MethodSpec&, const MethodInput&, const FieldTracerMaker&) = nullptr;
    bool field_on_cpu = false;  ///< run_field makes no use of a device's tracer
};

}  // namespace edgewise
