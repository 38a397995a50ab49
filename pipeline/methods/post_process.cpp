#include "pipeline/methods/post_process.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/error.h"
#include "pipeline/methods/registry.h"

namespace edgewise {
namespace {

PixelBox grown(const PixelBox& box, int margin, const Film& film) {
    return {std::max(box.x0 - margin, 0), std::max(box.y0 - margin, 0), std::min(box.x1 + margin, film.width),
            std::min(box.y1 + margin, film.height)};
}

ImageBuffer cropped(const ImageBuffer& image, const PixelBox& crop) {
    ImageBuffer part(crop);
    const std::size_t words = image.aov.channels.size();
    part.aov.channels = image.aov.channels;
    part.aov.metadata = image.aov.metadata;
    part.aov.words.resize(part.rgba.size() * words);
    for (int y = crop.y0; y < crop.y1; ++y) {
        const std::size_t from = image.index(crop.x0, y), to = part.index(crop.x0, y);
        std::copy_n(&image.rgba[from], crop.width(), &part.rgba[to]);
        std::copy_n(&image.edge[from], crop.width(), &part.edge[to]);
        if (words > 0) std::copy_n(image.aov.pixel(from), words * crop.width(), part.aov.pixel(to));
    }
    return part;
}

}  // namespace

PostProcess makePostProcess(const MethodSpec& spec) {
    if (spec.name == "fxaa") return makeFxaa(spec);
    if (spec.name == "smaa") return makeSmaa(spec);
    throw InputError(fmt::format("method '{}'", spec.typed), "filters no picture, only fxaa and smaa do");
}

MethodResult runOnPicture(const PostProcess& process, const MethodInput& in,
                          const std::function<MethodResult(const MethodInput&)>& make) {
    Film film = in.film;
    film.crop = grown(film.crop, process.reach_px, film);
    MethodResult result = make({in.scene, in.camera, film, in.filter, in.options, in.progress});
    process.apply(result.image, in.progress, result.stages);
    result.image = cropped(result.image, in.film.crop);
    result.setup_seconds += process.setup_seconds;
    return result;
}

MethodResult runOnNone(const PostProcess& process, const MethodSpec& spec, const MethodInput& in) {
    return runOnPicture(process, in, [&](const MethodInput& whole) { return runNone(spec, whole); });
}

}  // namespace edgewise
