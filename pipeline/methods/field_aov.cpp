#include "pipeline/methods/field_aov.h"

#include <cmath>

#include "pipeline/error.h"
#include "pipeline/field_rays.h"

namespace edgewise {

FieldAov::FieldAov(const MethodInput& in)
    : in_(in), grid_(rayGrid(in.camera, in.film, in.scene.field->far)) {
    for (const auto& [name, aov] : aovNames())
        if ((aov == Aov::kOwners || aov == Aov::kCryptomatte) && in.options.aovs.contains(aov))
            throw InputError("--aov " + name, "an SDF scene has no triangles to count");
}

void FieldAov::begin(ImageBuffer& image) const {
    auto& channels = image.aov.channels;
    if (in_.options.aovs.contains(Aov::kDepth)) channels.push_back({"Z"});
    if (in_.options.aovs.contains(Aov::kNormal))
        channels.insert(channels.end(), {{"N.X"}, {"N.Y"}, {"N.Z"}});
    if (in_.options.aovs.contains(Aov::kIndex)) channels.push_back({"index", true});
    image.aov.words.assign(channels.size() * image.rgba.size(), 0);
}

void FieldAov::pixel(int x, int y, const FieldSamples& samples, std::size_t i, ImageBuffer& image) const {
    std::uint32_t* out = image.aov.pixel(image.index(x, y));
    if (in_.options.aovs.contains(Aov::kDepth)) {
        const glm::dvec3 along = grid_.ray({x + 0.5, y + 0.5}).direction_world;
        const double depth = samples.depth[i];
        *out++ = floatBits(std::isfinite(depth) ? depth * glm::dot(along, grid_.axis_world) : kBackgroundDepth);
    }
    if (in_.options.aovs.contains(Aov::kNormal))
        for (int axis = 0; axis < 3; ++axis) *out++ = floatBits(samples.normal[i][axis]);
    if (in_.options.aovs.contains(Aov::kIndex)) *out = samples.surface[i];
}

}  // namespace edgewise
