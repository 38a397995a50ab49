// What the shipped SDF scenes show of Keinert et al. 2014: the screen-space candidate, discontinuity
// reduction, the convex shortcut.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "pipeline/field_tracer.h"
#include "pipeline/load_scene.h"
#include "pipeline/resolve_camera.h"
#include "pipeline/scene_catalog.h"

namespace edgewise {
namespace {

struct ShippedPicture {
    Scene scene;
    Film film;
    ResolvedCamera camera;
    Prefilter filter = makePrefilter("box", {}, {});
    RenderOptions options;
    Progress progress;

    ShippedPicture(const std::string& name, int width, int height) : scene(loadScene(findScene(name))) {
        CameraOptions choice;
        choice.size = glm::ivec2(width, height);
        camera = resolveCamera(scene, choice, film);
        options.device = DeviceChoice::kCpu;
        options.background = scene.field->background.value_or(glm::dvec3(0.0));
    }
    MethodInput input() { return {scene, camera, film, filter, options, progress}; }
    FieldSamples trace(const FieldSettings& settings, MethodResult* result = nullptr) {
        FieldWindow window;
        window.pixels = film.crop;
        const MethodInput in = input();
        const auto tracer = makeCpuFieldTracer(in, settings);
        FieldSamples samples = tracer->trace(window);
        if (result != nullptr) tracer->report(*result);
        return samples;
    }
    int width() const { return film.width; }
    int height() const { return film.height; }
};

/// Whether a neighbourhood of 3 x 3 pixels of `truth` shows a normal like the sample's, within 20 degrees.
bool isShown(const FieldSamples& samples, const FieldSamples& truth, int x, int y, int width, int height) {
    const glm::vec3& n = samples.normal[y * width + x];
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i)
            if (glm::dot(n, truth.normal[j * width + i]) > std::cos(glm::radians(20.0f))) return true;
    return false;
}

/// Pixels whose hit is in the air, farther than half a pixel from any surface; of them those whose normal
/// nothing near them has; pixels where a surface is missing.
struct Wrong {
    int air = 0, normals = 0, lost = 0;
};
Wrong wrongPixels(const FieldSamples& samples, const FieldSamples& truth, double half_pixel, int width,
                  int height) {
    Wrong wrong;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * width + x;
            const bool hit = samples.surface[i] != kNone;
            // Pixels beside the axis are seen under less than the middle's angle.
            const bool air = hit && samples.residual[i] > half_pixel * samples.depth[i];
            wrong.lost += !hit && truth.surface[i] != kNone;
            wrong.air += air, wrong.normals += air && !isShown(samples, truth, x, y, width, height);
        }
    return wrong;
}

/// Figure 8: 64 steps without cones. What is out of steps and near nothing is shown as the background.
TEST(FieldQuality, TheScreenCandidateLeavesNoGhostSilhouette) {
    ShippedPicture picture("thin", 192, 108);
    FieldSettings settings;
    settings.trace.relaxation = sdf::Relaxation::kNone;
    settings.trace.prepass = false;
    settings.trace.most_steps = 60000;
    const FieldSamples truth = picture.trace(settings);
    const double half_pixel = std::tan(0.5 * picture.camera.camera.yfov) / picture.height();
    settings.trace.most_steps = 64;
    const auto count = [&](bool screen, sdf::Relaxation relaxation) {
        settings.trace.screen_candidate = screen, settings.trace.relaxation = relaxation;
        return wrongPixels(picture.trace(settings), truth, half_pixel, picture.width(), picture.height());
    };
    for (const auto& [name, relaxation] : {std::pair("classic", sdf::Relaxation::kNone),
                                           {"keinert 1.2", sdf::Relaxation::kKeinert},
                                           {"auto", sdf::Relaxation::kAuto}}) {
        const Wrong last = count(false, relaxation), screen = count(true, relaxation);
        std::printf(
            "%-12s last point: %d in the air, %d with a wrong normal; candidate: %d, %d, and %d lost\n", name,
            last.air, last.normals, screen.air, screen.normals, screen.lost);
        if (relaxation == sdf::Relaxation::kNone) {
            EXPECT_GT(last.normals, 100);
        }
        EXPECT_GT(last.air, 50) << name;
        EXPECT_EQ(screen.air, 0) << name;
    }
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
}

/// Figures 9 and 10: the textured blob. Along a ray f falls by slope times cosine, measured between both
/// hits.
TEST(FieldQuality, DiscontinuitiesFallTenfoldInThreeSteps) {
    ShippedPicture picture("blob", 320, 180);
    FieldSettings settings;
    settings.trace.threshold = 1.0;
    const FieldSamples plain = picture.trace(settings);
    settings.trace.discontinuity_steps = 3;
    const FieldSamples even = picture.trace(settings);
    const auto steep = [&](std::size_t i) {
        const double way = even.depth[i] - plain.depth[i];
        return std::isfinite(way) && way != 0.0 && (plain.residual[i] - even.residual[i]) / way >= 0.6;
    };
    std::vector<double> before, after;
    for (int y = 0; y + 1 < picture.height(); ++y)
        for (int x = 0; x + 1 < picture.width(); ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * picture.width() + x;
            for (const std::size_t j : {i + 1, i + picture.width()}) {
                if (plain.surface[i] != plain.surface[j] || !steep(i) || !steep(j)) continue;
                before.push_back(std::abs(plain.residual[i] - plain.residual[j]));
                after.push_back(std::abs(even.residual[i] - even.residual[j]));
            }
        }
    std::printf("%zu pairs, median jump %.2e -> %.2e: %.1f times less\n", before.size(), median(before),
                median(after), median(before) / median(after));
    EXPECT_GT(before.size(), 2000u);
    EXPECT_LE(10.0 * median(after), median(before));
}

/// Section 4: with two reflections and eight refractions.
TEST(FieldQuality, TheConvexShortcutAsksLessAndShowsTheSame) {
    ShippedPicture picture("convex", 192, 108);
    FieldSettings settings;
    MethodResult with, without;
    const FieldSamples a = picture.trace(settings, &with);
    settings.trace.convex = false;
    const FieldSamples b = picture.trace(settings, &without);
    const auto all = [](const MethodResult& r) {
        return r.counts.at("evaluations") + r.counts.at("cone_evaluations") +
               r.counts.at("secondary_evaluations");
    };
    int differ = 0, far = 0;
    for (std::size_t i = 0; i < a.depth.size(); ++i) {
        differ += a.surface[i] != b.surface[i];
        const glm::dvec4 d = glm::abs(a.color[i] - b.color[i]);
        far += std::max({d.x, d.y, d.z}) > 1.0 / 255.0;
    }
    std::printf("%.2f times fewer evaluations; %d surfaces and %d colours of %zu differ\n",
                double(all(without)) / double(all(with)), differ, far, a.depth.size());
    EXPECT_GT(double(all(without)), 1.05 * double(all(with)));
    EXPECT_LE(differ * 1000, static_cast<int>(a.depth.size()));
}

}  // namespace
}  // namespace edgewise
