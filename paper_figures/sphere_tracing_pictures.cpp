#include "paper_figures/sphere_tracing_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "paper_figures/traced_view.h"
#include "pipeline/methods/field_pictures.h"

namespace edgewise::figures {
namespace {

using sdf::Relaxation, sdf::TraceSettings;

/// `color(i)`: of the pixel, linear.
template <class Color>
PictureRow::Picture picture(const TracedView& view, const std::string& name, const std::string& caption,
                            const Color& color) {
    ImageBuffer image(view.film.crop);
    for (std::size_t i = 0; i < image.rgba.size(); ++i) image.rgba[i] = glm::dvec4(color(i), 1.0);
    return pictureOf(image, name, caption);
}

template <class Value>
double meanOf(const std::vector<Value>& values) {
    double sum = 0.0;
    for (const Value value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

/// Figure 7.
PictureRow iterations(const SphereTracingEffort& effort, Progress& progress) {
    constexpr std::uint32_t kPaperSteps = 80;
    const TracedView view("city", effort.picture_width, effort.picture_height);
    PictureRow row{"Iterations of the city's rays",
                   "At most 80, as in Figure 7: black is none, then blue, red, yellow, and white is 80. A "
                   "cone's steps stand for those of all its rays and are not in the picture.",
                   {}};
    const auto add = [&](const std::string& name, const std::string& words, TraceSettings settings) {
        settings.most_steps = static_cast<int>(kPaperSteps);
        const FieldSamples seen = trace(view, settings, progress).samples;
        const auto out =
            std::ranges::count_if(seen.iterations, [&](std::uint32_t n) { return n >= kPaperSteps; });
        const std::string caption =
            fmt::format("{}: mean {:.1f}, {:.2f} % of the rays out of steps", words, meanOf(seen.iterations),
                        100.0 * static_cast<double>(out) / static_cast<double>(seen.iterations.size()));
        row.pictures.push_back(picture(view, "iterations_" + name, caption, [&](std::size_t i) {
            return heatColor(seen.iterations[i] / static_cast<double>(kPaperSteps));
        }));
    };
    add("classic", "classic", settingsOf(Relaxation::kNone, false));
    add("keinert", "Keinert, omega 1.2", settingsOf(Relaxation::kKeinert, false));
    add("auto", "auto", settingsOf(Relaxation::kAuto, false));
    add("auto_prepass", "auto, after cones", settingsOf(Relaxation::kAuto, true));
    return row;
}

/// Figure 8.
PictureRow candidates(const SphereTracingEffort& effort, Progress& progress) {
    constexpr int kPaperSteps = 64, kAllSteps = 16384;
    const TracedView view("thin", effort.picture_width, effort.picture_height);
    PictureRow row{"Normals of thin things after 64 steps",
                   "As in Figure 8: half the normal and a half as red, green and blue; black is nothing, and "
                   "what is out of steps with no surface within half a pixel. Floors "
                   "are green.",
                   {}};
    const auto add = [&](const std::string& name, const std::string& caption, bool screen, int steps) {
        TraceSettings settings = settingsOf(Relaxation::kNone, false);
        settings.screen_candidate = screen, settings.most_steps = steps, settings.threshold = 1.0;
        const FieldSamples seen = trace(view, settings, progress).samples;
        row.pictures.push_back(picture(view, "normals_" + name, caption, [&](std::size_t i) {
            return std::isfinite(seen.depth[i]) ? 0.5 + 0.5 * glm::dvec3(seen.normal[i]) : glm::dvec3(0.0);
        }));
    };
    add("last", "the last point", false, kPaperSteps);
    add("screen", "the candidate nearest on the screen, where half a pixel holds it", true, kPaperSteps);
    add("all", "as many steps as it takes", true, kAllSteps);
    return row;
}

/// Figure 9.
PictureRow residuals(const SphereTracingEffort& effort, Progress& progress) {
    constexpr int kPaperSteps = 5;
    const TracedView view("blob", effort.picture_width, effort.picture_height);
    const auto traced = [&](int steps) {
        TraceSettings settings = settingsOf(Relaxation::kNone, false);
        settings.threshold = 1.0, settings.discontinuity_steps = steps;
        return trace(view, settings, progress).samples;
    };
    const FieldSamples before = traced(0), after = traced(kPaperSteps);
    const double white = *std::ranges::max_element(before.residual);
    PictureRow row{"100 f(p) where rays end",
                   fmt::format("As in Figure 9, grey: black is 0, white {:.3g}.", 100.0 * white),
                   {}};
    const auto add = [&](const std::string& name, const std::string& caption, const FieldSamples& seen) {
        row.pictures.push_back(picture(view, "residual_" + name, caption, [&](std::size_t i) {
            return glm::dvec3(std::clamp(seen.residual[i] / white, 0.0, 1.0));
        }));
    };
    add("before", "as traced", before);
    add("after", fmt::format("after {} steps of equation 3", kPaperSteps), after);
    return row;
}

}  // namespace

std::vector<PictureRow> sphereTracingPictures(const SphereTracingEffort& effort, Progress& progress) {
    return {iterations(effort, progress), candidates(effort, progress), residuals(effort, progress)};
}

}  // namespace edgewise::figures
