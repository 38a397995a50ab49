#include "paper_figures/cone_tracing_measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "paper_figures/cone_tracing_pictures.h"
#include "pipeline/error.h"
#include "pipeline/load_scene.h"
#include "pipeline/methods/field_frame.h"
#include "pipeline/methods/stopwatch.h"
#include "pipeline/resolve_camera.h"
#include "pipeline/scene_catalog.h"

namespace edgewise::figures {
namespace {

/// What is shown of every scene, then what only the claims ask for.
const std::vector<std::string> kMethods{"none",
                                        "ssaa:2",
                                        "ssaa:3",
                                        "ctss",
                                        "ctss-r",
                                        "ctss-r:coverage=2",
                                        "ctss+ssaa:2",
                                        "ctss-x",
                                        "ctss:weights=uniform",
                                        "ctss:mask=4x8",
                                        "ctss:backtrace=off"};

/// Table 1 at 1280x720: ratios of 4xSSAA, CTSS and CTSS-R. Its Sponza is beside our atrium.
const std::map<std::string, std::map<std::string, double>> kTable1{
    {"primitives", {{"ssaa:2", 4.46}, {"ctss", 1.30}, {"ctss-r", 1.10}}},
    {"random-box", {{"ssaa:2", 4.17}, {"ctss", 1.37}, {"ctss-r", 1.29}}},
    {"random-shape", {{"ssaa:2", 4.19}, {"ctss", 1.32}, {"ctss-r", 1.23}}},
    {"atrium", {{"ssaa:2", 4.29}, {"ctss", 1.37}, {"ctss-r", 1.05}}},
    {"sparse-shape", {{"ssaa:2", 4.25}, {"ctss", 1.28}, {"ctss-r", 1.16}}}};

std::optional<double> publishedRatio(const std::string& scene, const std::string& method) {
    const auto row = kTable1.find(scene);
    if (row == kTable1.end()) return std::nullopt;
    const auto cell = row->second.find(method);
    return cell == row->second.end() ? std::nullopt : std::optional(cell->second);
}

double medianOf(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

struct SquaredErrors {
    double sum = 0.0;
    std::uint64_t pixels = 0;
    void add(const glm::dvec4& d) { sum += d.x * d.x + d.y * d.y + d.z * d.z, ++pixels; }
    Psnr psnr() const {
        if (pixels == 0 || sum == 0.0) return std::nullopt;
        return -10.0 * std::log10(sum / (3.0 * static_cast<double>(pixels)));
    }
};

/// `kinds`: of the film, `width` wide; the pictures may be parts of it.
EdgePsnr edgePsnr(const ImageBuffer& image, const ImageBuffer& reference, const std::vector<EdgeKind>& kinds,
                  int width) {
    SquaredErrors all;
    std::map<EdgeKind, SquaredErrors> by_kind;
    for (int y = image.box.y0; y < image.box.y1; ++y)
        for (int x = image.box.x0; x < image.box.x1; ++x) {
            const EdgeKind kind = kinds[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                        static_cast<std::size_t>(x)];
            if (kind == EdgeKind::kNone) continue;
            const glm::dvec4 d = image.rgba[image.index(x, y)] - reference.rgba[reference.index(x, y)];
            all.add(d), by_kind[kind].add(d);
        }
    EdgePsnr found{all.psnr(), {}};
    for (const auto& [kind, errors] : by_kind) found.by_kind[kind] = errors.psnr();
    return found;
}

/// By turns, so that what else the machine does meets all alike.
void timeMethods(ConeScene& scene, const ConeTracingEffort& effort, Progress& progress) {
    const ConeView view(scene.name, effort.timed_width, effort.timed_height);
    std::vector<std::vector<double>> seconds(kMethods.size());
    for (int run = 0; run < effort.runs; ++run)
        for (std::size_t m = 0; m < kMethods.size(); ++m) {
            Stopwatch watch;
            const MethodResult made = view.made(kMethods[m], progress);
            seconds[m].push_back(watch.lap() - made.setup_seconds);
            scene.runs[m].counts = made.counts;
        }
    for (std::size_t m = 0; m < kMethods.size(); ++m) scene.runs[m].seconds = medianOf(seconds[m]);
    scene.timed_width = view.film.width, scene.timed_height = view.film.height;
}

PixelBox middleQuarter(const Film& film) {
    return {film.width / 4, film.height / 4, film.width - film.width / 4, film.height - film.height / 4};
}

void judgeMethods(ConeScene& scene, const ConeTracingEffort& effort, Progress& progress) {
    ConeView view(scene.name, effort.width, effort.height);
    scene.width = view.film.width, scene.height = view.film.height;
    Progress quiet;
    const std::vector<EdgeKind> kinds = judge::edgeKindsOf(view.input(quiet), effort.facts_side);
    for (const EdgeKind kind : kinds) ++scene.pixels[kind];
    const ImageBuffer reference = view.reference(effort.reference_side, progress).image;
    for (ConeRun& run : scene.runs)
        run.psnr = edgePsnr(view.made(run.method, progress).image, reference, kinds, view.film.width);
    scene.plain_reference = edgePsnr(view.made(fmt::format("ssaa:{}", effort.reference_side), progress).image,
                                     reference, kinds, view.film.width);
    view.film.crop = middleQuarter(view.film);
    scene.reference =
        edgePsnr(view.reference(effort.finer_side, progress).image, reference, kinds, view.film.width);
}

ConeScene measureScene(const std::string& name, const ConeTracingEffort& effort, Progress& progress) {
    ConeScene scene;
    scene.name = name, scene.of_paper = kTable1.contains(name);
    for (const std::string& method : kMethods) {
        ConeRun run;
        run.method = method, run.published = publishedRatio(name, method);
        scene.runs.push_back(std::move(run));
    }
    timeMethods(scene, effort, progress);
    progress.advance(1);
    judgeMethods(scene, effort, progress);
    progress.advance(1);
    return scene;
}

}  // namespace

ConeView::ConeView(const std::string& name, int width, int height) : scene(loadScene(findScene(name))) {
    CameraOptions wanted;
    wanted.size = glm::ivec2(width, height);
    camera = resolveCamera(scene, wanted, film);
    options.device = DeviceChoice::kCpu;
    options.background = scene.field->background.value_or(glm::dvec3(0.0));
}

MethodResult ConeView::made(const std::string& method, Progress& progress) const {
    if (progress.cancelled()) throw Interrupted();
    Progress quiet;
    return runMethod(parseMethod(method), input(quiet));
}

MethodResult ConeView::reference(int per_side, Progress& progress) const {
    if (progress.cancelled()) throw Interrupted();
    FieldSettings settings;
    settings.trace.threshold /= per_side;
    Progress quiet;
    return traceFiltered(input(quiet), settings, per_side, makeCpuFieldTracer);
}

ConeTracing measureConeTracing(const ConeTracingEffort& effort, Progress& progress) {
    progress.stage("scenes", 2 * effort.scenes.size() + 1);
    Stopwatch watch;
    ConeTracing found;
    found.quick = effort.quick, found.runs = effort.runs;
    found.reference_side = effort.reference_side, found.finer_side = effort.finer_side;
    found.facts_side = effort.facts_side;
    for (const std::string& name : effort.scenes)
        found.scenes.push_back(measureScene(name, effort, progress));
    found.pictures = coneTracingPictures(effort, progress);
    progress.advance(1);
    found.seconds = watch.lap();
    return found;
}

}  // namespace edgewise::figures
