#include "pipeline/methods/field_aov.h"

#include <algorithm>
#include <cmath>

#include "pipeline/error.h"
#include "pipeline/field_rays.h"
#include "pipeline/methods/stopwatch.h"

namespace edgewise {

FieldAov::FieldAov(const MethodInput& in) : in_(in), grid_(rayGrid(in.camera, in.film, in.scene.field->far)) {
    for (const auto& [name, aov] : aovNames())
        if ((aov == Aov::kOwners || aov == Aov::kCryptomatte) && in.options.aovs.contains(aov))
            throw InputError("--aov " + name, "an SDF scene has no triangles to count");
}

void FieldAov::begin(ImageBuffer& image) const {
    auto& channels = image.aov.channels;
    if (in_.options.aovs.contains(Aov::kDepth)) channels.push_back({"Z"});
    if (in_.options.aovs.contains(Aov::kNormal)) channels.insert(channels.end(), {{"N.X"}, {"N.Y"}, {"N.Z"}});
    if (in_.options.aovs.contains(Aov::kIndex)) channels.push_back({"index", true});
    image.aov.words.assign(channels.size() * image.rgba.size(), 0);
}

void FieldAov::pixel(int x, int y, const FieldSamples& samples, std::size_t i, ImageBuffer& image) const {
    std::uint32_t* out = image.aov.pixel(image.index(x, y));
    if (in_.options.aovs.contains(Aov::kDepth)) {
        const glm::dvec3 along = grid_.ray({x + 0.5, y + 0.5}).direction_world;
        const double depth = samples.depth[i];
        *out++ =
            floatBits(std::isfinite(depth) ? depth * glm::dot(along, grid_.axis_world) : kBackgroundDepth);
    }
    if (in_.options.aovs.contains(Aov::kNormal))
        for (int axis = 0; axis < 3; ++axis) *out++ = floatBits(samples.normal[i][axis]);
    if (in_.options.aovs.contains(Aov::kIndex)) *out = samples.surface[i];
}

void traceFieldAovs(const MethodInput& in, const FieldTracerMaker& make, ImageBuffer& image) {
    const FieldAov aov(in);
    if (!aov.active()) return;
    aov.begin(image);
    constexpr double kBytesPerSample = 256.0;  // a sample's results and what its tracing takes, generously
    const PixelBox& crop = in.film.crop;
    const double fit =
        0.5 * 0x1p20 * static_cast<double>(in.options.memory_mib) / (kBytesPerSample * crop.width());
    const int rows = static_cast<int>(std::clamp(fit, 1.0, static_cast<double>(crop.height())));
    const std::unique_ptr<FieldTracer> tracer = make(in, {});
    for (int top = crop.y0; top < crop.y1; top += rows) {
        FieldWindow window;
        window.pixels = {crop.x0, top, crop.x1, std::min(top + rows, crop.y1)};
        const FieldSamples samples = tracer->trace(window);
        std::size_t i = 0;
        for (int y = window.pixels.y0; y < window.pixels.y1; ++y)
            for (int x = crop.x0; x < crop.x1; ++x) aov.pixel(x, y, samples, i++, image);
        checkCancelled(in.progress);
    }
}

}  // namespace edgewise
