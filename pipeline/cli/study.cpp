#include "pipeline/cli/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <set>

#include "pipeline/cli/interrupt.h"
#include "pipeline/cli/parse_values.h"
#include "pipeline/cli/report.h"
#include "pipeline/cli/timing_options.h"
#include "pipeline/cli/worker_flags.h"
#include "pipeline/error.h"
#include "pipeline/load_scene.h"
#include "pipeline/resolve_camera.h"
#include "pipeline/scene_catalog.h"
#include "pipeline/sweep/content_hash.h"
#include "pipeline/sweep/study_file.h"
#include "pipeline/version.h"

namespace edgewise::cli {
namespace {

namespace fs = std::filesystem;
using sweep::CameraEntry;
using sweep::Entry;
using sweep::FilterEntry;
using sweep::StudyFile;
using sweep::StudyProblems;

constexpr const char* kOwnBox = "box";

struct StudyScene {
    std::string name, file, content;
};

/// What flags say of themselves means nothing in a file.
std::string withoutFlag(const std::string& message) {
    const std::size_t colon = message.find(": ");
    return message.starts_with("--") && colon != std::string::npos ? message.substr(colon + 2) : message;
}

/// `filter` as typed or by default.
FilterArguments resolved(const Prefilter& filter) {
    FilterArguments arguments{filter.name, fmt::format("{}", filter.radius), {}};
    const bool gaussian =
        filter.kind == KernelKind::kGaussian || filter.kind == KernelKind::kGaussianSeparable;
    if (gaussian && filter.sigma) arguments.sigma = fmt::format("{}", *filter.sigma);
    return arguments;
}

class StudyReader {
  public:
    StudyReader(const std::string& path, Progress& progress)
        : folder_(fs::path(path).parent_path()),
          problems_(path),
          file_(sweep::readStudyFile(path, problems_)),
          progress_(progress) {}

    Study read() {
        readOptions();
        readMethods();
        readFilters();
        readSizes();
        readScenes();
        if (!problems_.empty()) throw ProblemList(problems_.messages(), problems_.limitsAlone() ? 1 : 2);
        makeJobs();
        return std::move(study_);
    }

  private:
    /// What `work` throws is a problem of that line; whether there was none.
    bool check(int line, const std::string& key, const std::function<void()>& work) {
        try {
            work();
            return true;
        } catch (const InputError& error) {
            problems_.add(line, key, withoutFlag(error.what()));
        } catch (const FailureError& error) {
            problems_.add(line, key, withoutFlag(error.what()), true);
        }
        return false;
    }

    void once(std::map<std::string, int>& seen, const std::string& value, const Entry& entry,
              const std::string& key) {
        const auto [first, fresh] = seen.try_emplace(value, entry.line);
        if (!fresh)
            problems_.add(entry.line, key,
                          fmt::format("'{}' is there already, in line {}", entry.text, first->second));
    }

    void checkOption(const char* key, const std::function<void(const std::string&)>& read) {
        const auto value = file_.option(key);
        if (value) check(file_.lineOf(key), key, [&] { read(*value); });
    }

    /// One of the flags, by itself; taken where it is right.
    template <class Member>
    void takeMaking(const char* key, Member member) {
        checkOption(key, [&](const std::string& text) {
            MethodArguments alone;
            alone.*member = text;
            readMethodOptions(alone);
            study_.making.*member = text;
        });
    }

    void readOptions() {
        takeMaking("device", &MethodArguments::device);
        takeMaking("precision", &MethodArguments::precision);
        takeMaking("shading", &MethodArguments::shading);
        takeMaking("background", &MethodArguments::background);
        takeMaking("threads", &MethodArguments::threads);
        takeMaking("memory", &MethodArguments::memory);
        takeMaking("seed", &MethodArguments::seed);
        takeMaking("frames", &MethodArguments::frames);
        for (const Entry& name : file_.list("no_skip"))
            check(name.line, "no_skip", [&] {
                MethodArguments alone;
                alone.no_skip = {name.text};
                readMethodOptions(alone);
                study_.making.no_skip.push_back(name.text);
            });
        study_.schedule.runs = readRuns("runs", kUsualRuns);
        checkOption("runs",
                    [&](const std::string& text) { study_.schedule.runs = readRuns("--runs", text); });
        checkOption("budget", [&](const std::string& text) {
            study_.schedule.budget_seconds = readBudget("--budget", text);
        });
        check(file_.lineOf("reference"), "reference", [&] {
            checkAbilities(study_.making, parseMethod(file_.option("reference").value_or(kUsualReference)));
        });
    }

    void readMethods() {
        std::map<std::string, int> seen;
        for (const Entry& method : file_.list("methods")) {
            once(seen, method.text, method, "methods");
            check(method.line, "methods", [&] {
                const MethodSpec spec = parseMethod(method.text);
                checkAbilities(study_.making, spec);
                methods_.push_back(method.text);
                (takesFilter(spec) ? filtered_ : boxed_).push_back(method.text);
            });
        }
        if (!filtered_.empty() || boxed_.empty() || boxed_.size() != file_.list("methods").size()) return;
        for (const char* key : {"filters", "radii", "sigmas"})
            if (file_.keys.contains(key))
                problems_.add(file_.lineOf(key), key,
                              "no method of the study takes a filter: each has a pixel-wide box of its own");
    }

    /// A radius or sigma that some filter takes.
    std::vector<Entry> numbersFor(const char* key, const char* filter, bool is_sigma) {
        std::vector<Entry> good;
        std::map<std::string, int> seen;
        for (const Entry& number : file_.list(key)) {
            once(seen, number.text, number, key);
            FilterArguments arguments{filter, {}, {}};
            (is_sigma ? arguments.sigma : arguments.radius) = number.text;
            if (check(number.line, fmt::format("{}: {}", key, number.text), [&] { readFilter(arguments); }))
                good.push_back(number);
        }
        return good;
    }

    void readFilters() {
        std::vector<FilterEntry> filters = file_.filters;
        if (!file_.keys.contains("filters")) filters.push_back({{FilterArguments().name, 1}, {}, {}});
        const std::vector<Entry> radii = numbersFor("radii", kOwnBox, false),
                                 sigmas = numbersFor("sigmas", "gaussian", true);
        for (const FilterEntry& filter : filters) {
            const FilterArguments plain{filter.name.text, {}, {}};
            if (check(filter.name.line, "filters", [&] { readFilter(plain); })) cross(filter, radii, sigmas);
        }
    }

    static std::vector<std::optional<std::string>> choices(const std::optional<Entry>& own,
                                                           const std::vector<Entry>& common) {
        if (own) return {own->text};
        if (common.empty()) return {std::nullopt};
        std::vector<std::optional<std::string>> texts;
        for (const Entry& entry : common) texts.push_back(entry.text);
        return texts;
    }

    /// The first that is wrong stands for the others.
    void cross(const FilterEntry& entry, const std::vector<Entry>& radii, const std::vector<Entry>& sigmas) {
        for (const auto& radius : choices(entry.radius, radii))
            for (const auto& sigma : choices(entry.sigma, sigmas)) {
                const bool right = check(entry.name.line, "filters", [&] {
                    const Prefilter filter = readFilter({entry.name.text, radius, sigma});
                    const FilterArguments arguments = resolved(filter);
                    const std::string text =
                        fmt::format("{} R {}{}{}", arguments.name, *arguments.radius,
                                    arguments.sigma ? " s " : "", arguments.sigma.value_or(""));
                    once(filters_seen_, text, {text, entry.name.line}, "filters");
                    filters_.push_back(arguments);
                });
                if (!right) return;
            }
    }

    void readSizes() {
        std::map<std::string, int> seen;
        for (const Entry& size : file_.list("sizes"))
            check(size.line, "sizes: " + size.text, [&] {
                const glm::ivec2 pixels = parseSize("--size", size.text);
                const std::string text = fmt::format("{}x{}", pixels.x, pixels.y);
                once(seen, text, size, "sizes");
                sizes_.push_back(text);
            });
        if (!file_.keys.contains("sizes")) sizes_.push_back(std::nullopt);
    }

    void readScenes() {
        cameras_ = file_.cameras;
        std::map<std::string, int> labels, files;
        for (const CameraEntry& camera : cameras_)
            once(labels, camera.label, {camera.label, camera.line}, "cameras");
        if (!file_.keys.contains("cameras")) cameras_.push_back({});
        for (const Entry& scene : file_.list("scenes"))
            check(scene.line, "scenes", [&] {
                const std::string file = fileOf(scene.text);
                once(files, fs::weakly_canonical(file).string(), scene, "scenes");
                checkScene(file, scene);
                scenes_.push_back({scene.text, file, sweep::sceneHash(file)});
            });
    }

    /// A path stands before a name, and is relative to the study.
    std::string fileOf(const std::string& scene) const {
        std::error_code error;
        const fs::path beside = folder_ / scene;
        if (fs::is_regular_file(beside, error)) return beside.string();
        const auto names = sceneNames();
        const bool named = std::ranges::find(names, scene, &SceneInfo::name) != names.end();
        if (!named && fs::is_regular_file(scene, error))
            throw InputError(scene, "no such file beside the study: paths are relative to it");
        return findScene(scene).string();
    }

    void checkScene(const std::string& file, const Entry& entry) {
        progress_.stage("check " + entry.text, 0);
        LoadOptions options;
        options.progress = [&](double) { throwIfInterrupted(); };
        Scene scene = loadScene(file, options);
        throwIfInterrupted();
        scene.source = entry.text;
        for (const CameraEntry& camera : cameras_)
            check(camera.line > 0 ? camera.line : entry.line,
                  camera.line > 0 ? "cameras: " + camera.label : "scenes", [&] {
                      try {
                          Film film;
                          resolveCamera(scene, cameraOptions(camera), film);
                      } catch (const InputError& error) {
                          throw InputError(entry.text, withoutFlag(error.what()));
                      }
                  });
        if (problems_.empty()) warnOfIgnored(scene);
    }

    static CameraOptions cameraOptions(const CameraEntry& camera) {
        CameraOptions options;
        options.camera = camera.camera.value_or("");
        if (camera.eye) options.eye = parseTriple("--eye", *camera.eye);
        if (camera.target) options.target = parseTriple("--target", *camera.target);
        if (camera.fovy) options.fovy_degrees = parseNumber("--fovy", *camera.fovy);
        return options;
    }

    void makeJobs() {
        const FilterArguments box = resolved(readFilter({kOwnBox, {}, {}}));
        const auto is_box = [&](const FilterArguments& f) {
            return f.name == box.name && f.radius == box.radius;
        };
        const bool has_box = !filtered_.empty() && std::ranges::any_of(filters_, is_box);
        for (const StudyScene& scene : scenes_)
            for (const CameraEntry& camera : cameras_)
                for (const auto& size : sizes_) {
                    if (!filtered_.empty())
                        for (const FilterArguments& filter : filters_)
                            addJob(scene, camera, size, filter, is_box(filter) ? methods_ : filtered_);
                    if (!has_box && !boxed_.empty()) addJob(scene, camera, size, box, boxed_);
                }
    }

    std::string referenceFor(const StudyScene& scene) const {
        return file_.option("reference")
            .value_or(isFieldFile(scene.file) ? kUsualFieldReference : kUsualReference);
    }

    void addJob(const StudyScene& scene, const CameraEntry& camera, const std::optional<std::string>& size,
                const FilterArguments& filter, const std::vector<std::string>& methods) {
        StudyJob job;
        job.picture.scene = scene.file;
        job.picture.camera = camera.camera, job.picture.eye = camera.eye;
        job.picture.target = camera.target, job.picture.fovy = camera.fovy;
        job.picture.size = size;
        job.filter = filter;
        job.methods = methods;
        job.reference = referenceFor(scene);
        // All flags but the first words, which say where the scene's file lies.
        const std::vector<std::string> flags = workerFlags(job.picture, filter, study_.making, "");
        job.key = {{"version", version()},
                   {"scene", scene.name},
                   {"content", scene.content},
                   {"camera", camera.label},
                   {"flags", std::vector(flags.begin() + 2, flags.end() - 1)},
                   {"methods", methods},
                   {"reference", job.reference},
                   {"runs", study_.schedule.runs},
                   {"budget", file_.option("budget").value_or("")}};
        job.hash = sweep::contentHash(job.key.dump());
        study_.jobs.push_back(std::move(job));
    }

    fs::path folder_;
    StudyProblems problems_;
    StudyFile file_;
    Progress& progress_;
    Study study_;
    std::vector<std::string> methods_, filtered_, boxed_;  ///< all; those that take a filter; the others
    std::vector<FilterArguments> filters_;
    std::map<std::string, int> filters_seen_;
    std::vector<std::optional<std::string>> sizes_;
    std::vector<CameraEntry> cameras_;
    std::vector<StudyScene> scenes_;
};

}  // namespace

Study readStudy(const std::string& path, Progress& progress) {
    return StudyReader(path, progress).read();
}

}  // namespace edgewise::cli
