#include "paper_figures/sphere_tracing_measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "paper_figures/changed_hits.h"
#include "paper_figures/sphere_tracing_pictures.h"
#include "pipeline/field_shading.h"
#include "pipeline/methods/stopwatch.h"
#include "sdf/evaluate.h"

namespace edgewise::figures {
namespace {

using sdf::Relaxation;
using sdf::TraceSettings;

struct NamedSetting {
    std::string name;
    TraceSettings settings;
    bool parameter_free;
};

std::vector<NamedSetting> settingsFor(const std::string& scene) {
    const double omega = keinertOmega(scene);
    return {{"classic", settingsOf(Relaxation::kNone, false), false},
            {"keinert", settingsOf(Relaxation::kKeinert, false, omega), false},
            {"balint", settingsOf(Relaxation::kBalint, false), false},
            {"auto", settingsOf(Relaxation::kAuto, false), true},
            {"classic + prepass", settingsOf(Relaxation::kNone, true), false},
            {"auto + prepass", settingsOf(Relaxation::kAuto, true), true}};
}

std::uint64_t total(const std::vector<std::uint32_t>& counts) {
    std::uint64_t sum = 0;
    for (const std::uint32_t count : counts) sum += count;
    return sum;
}

double medianOf(std::vector<double> values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

TracedScene measureScene(const std::string& name, const std::vector<NamedSetting>& settings,
                         const SphereTracingEffort& effort, Progress& progress) {
    const TracedView view(name, effort.width, effort.height);
    TracedScene scene;
    scene.name = name, scene.width = view.film.width, scene.height = view.film.height;
    scene.rays = static_cast<std::uint64_t>(view.film.width) * view.film.height;
    FieldSamples classic;
    std::vector<std::vector<double>> seconds(settings.size());
    for (int run = 0; run < effort.runs; ++run)
        for (std::size_t s = 0; s < settings.size(); ++s) {
            Traced traced = trace(view, settings[s].settings, progress);
            seconds[s].push_back(traced.seconds);
            if (run > 0) continue;
            TraceRun row{settings[s].name,
                         settings[s].parameter_free,
                         0.0,
                         traced.report.counts.at("evaluations") + traced.report.counts.at("cone_evaluations"),
                         total(traced.samples.iterations),
                         0};
            if (s == 0) classic = traced.samples;
            scene.changed = changedHits(view, classic, traced.samples);
            row.changed = scene.changed.size();
            scene.runs.push_back(row);
        }
    for (std::size_t s = 0; s < settings.size(); ++s) scene.runs[s].seconds = medianOf(seconds[s]);
    progress.advance(1);
    return scene;
}

/// Keinert's times with over-relaxation against those without, and of the convex shortcut.
const std::map<std::string, double> kPublished{{"city", 1.21}, {"jewel", 1.17}, {"path-room", 1.16}};
constexpr double kPublishedConvex = 1.11;

TracedScene measureConvex(const SphereTracingEffort& effort, Progress& progress) {
    std::vector<NamedSetting> settings;
    for (const bool shortcut : {false, true}) {
        TraceSettings with = settingsOf(Relaxation::kNone, false);
        with.convex = shortcut;
        settings.push_back({shortcut ? "convex shortcut" : "classic", with, false});
    }
    TracedScene scene = measureScene("convex", settings, effort, progress);
    scene.published = kPublishedConvex;
    return scene;
}

CandidateCount measureCandidates(const std::string& name, const SphereTracingEffort& effort,
                                 Progress& progress) {
    constexpr int kPaperSteps = 64, kAllSteps = 16384;
    constexpr float kSameNormal = 0.7f;  // within 45 degrees
    const TracedView view(name, effort.width, effort.height);
    const auto traced = [&](bool screen, int steps) {
        TraceSettings settings = settingsOf(Relaxation::kNone, false);
        settings.screen_candidate = screen, settings.most_steps = steps, settings.threshold = 1.0;
        return trace(view, settings, progress).samples;
    };
    const FieldSamples all = traced(true, kAllSteps), last = traced(false, kPaperSteps),
                       screen = traced(true, kPaperSteps);
    CandidateCount count{name, kPaperSteps, all.normal.size()};
    for (std::size_t i = 0; i < all.normal.size(); ++i) {
        const auto look = [&](const FieldSamples& seen, CandidateKind& kind) {
            const bool is = std::isfinite(all.depth[i]), looks = std::isfinite(seen.depth[i]);
            kind.holes += is && !looks;
            kind.wrong += looks && (!is || glm::dot(seen.normal[i], all.normal[i]) < kSameNormal);
        };
        look(last, count.last), look(screen, count.screen);
    }
    progress.advance(1);
    return count;
}

/// Slope times cosine at a hit: how fast the field falls along the ray.
double fallAlongRay(const TracedView& view, const sdf::Tape& tape, int x, int y, double t) {
    const sdf::FieldRay ray = view.rays.ray({x + 0.5, y + 0.5});
    const auto at = sdf::gradientAt(tape, ray.origin_world + t * ray.direction_world);
    return -glm::dot(at.gradient, ray.direction_world) / tape.lipschitz;
}

/// Neighbours are of one surface where their normals and depths agree to first order.
JumpCount measureJumps(const std::string& name, const SphereTracingEffort& effort, Progress& progress) {
    constexpr float kOneSurface = 0.98f;
    constexpr double kLeastSlope = 0.6;
    constexpr int kPaperSteps = 3;
    const TracedView view(name, effort.width, effort.height);
    const auto traced = [&](int steps) {
        TraceSettings settings = settingsOf(Relaxation::kNone, false);
        settings.threshold = 1.0, settings.discontinuity_steps = steps;
        return trace(view, settings, progress).samples;
    };
    const FieldSamples before = traced(0), after = traced(kPaperSteps);
    const sdf::Tape tape = loweredTree(*view.scene.field);
    std::vector<double> jumps_before, jumps_after;
    for (int y = 0; y < view.film.height; ++y)
        for (int x = 0; x + 1 < view.film.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * view.film.width + x, j = i + 1;
            if (!std::isfinite(before.depth[i]) || !std::isfinite(before.depth[j])) continue;
            if (before.surface[i] != before.surface[j]) continue;
            if (glm::dot(before.normal[i], before.normal[j]) < kOneSurface) continue;
            const double here = fallAlongRay(view, tape, x, y, before.depth[i]);
            const double there = fallAlongRay(view, tape, x + 1, y, before.depth[j]);
            if (std::min(here, there) < kLeastSlope) continue;
            jumps_before.push_back(std::abs(double(before.residual[i]) - before.residual[j]));
            jumps_after.push_back(std::abs(double(after.residual[i]) - after.residual[j]));
        }
    progress.advance(1);
    return {name, jumps_before.size(), medianOf(jumps_before), medianOf(jumps_after)};
}

PruningCount measurePruning(const std::string& name, const SphereTracingEffort& effort, Progress& progress) {
    const TracedView view(name, effort.pruning_side, effort.pruning_side);
    TraceSettings settings = settingsOf(Relaxation::kAuto, true);
    const Traced pruned = trace(view, settings, progress);
    settings.prune = false;
    const Traced whole = trace(view, settings, progress);
    const auto perEvaluation = [](const Traced& traced) {
        return double(traced.report.counts.at("instructions")) /
               double(traced.report.counts.at("evaluations") + traced.report.counts.at("cone_evaluations"));
    };
    PruningCount count{name,
                       view.film.width,
                       view.film.height,
                       whole.seconds,
                       pruned.seconds,
                       1e-6 * double(pruned.report.counts.at("prune_microseconds")),
                       perEvaluation(whole),
                       perEvaluation(pruned),
                       0};
    for (std::size_t i = 0; i < whole.samples.depth.size(); ++i)
        count.differing += whole.samples.depth[i] != pruned.samples.depth[i];
    progress.advance(1);
    return count;
}

}  // namespace

SphereTracing measureSphereTracing(const SphereTracingEffort& effort, Progress& progress) {
    progress.stage("trace", effort.scenes.size() + 1 + effort.candidate_scenes.size() +
                                effort.jump_scenes.size() + effort.pruning_scenes.size() + 1);
    Stopwatch watch;
    SphereTracing found;
    found.quick = effort.quick, found.runs = effort.runs;
    for (const std::string& name : effort.scenes) {
        found.scenes.push_back(measureScene(name, settingsFor(name), effort, progress));
        if (const auto published = kPublished.find(name); published != kPublished.end())
            found.scenes.back().published = published->second;
    }
    found.convex.push_back(measureConvex(effort, progress));
    for (const std::string& name : effort.candidate_scenes)
        found.candidates.push_back(measureCandidates(name, effort, progress));
    for (const std::string& name : effort.jump_scenes)
        found.jumps.push_back(measureJumps(name, effort, progress));
    for (const std::string& name : effort.pruning_scenes)
        found.pruning.push_back(measurePruning(name, effort, progress));
    found.pictures = sphereTracingPictures(effort, progress);
    progress.advance(1);
    found.seconds = watch.lap();
    return found;
}

}  // namespace edgewise::figures
