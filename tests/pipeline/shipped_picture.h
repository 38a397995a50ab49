// A small part of a picture of every scene that ships: what the tests of whole methods render.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "data/generate/recipes.h"
#include "pipeline/load_gltf.h"
#include "pipeline/methods/method.h"
#include "pipeline/resolve_camera.h"
#include "pipeline/scene_folders.h"

namespace edgewise::test {

struct ShippedPicture {
    std::string name;
    Scene scene;
    ResolvedCamera camera;
    Film film;
};

/// Recipes of the scenes whose files lie in data/.
inline std::vector<scenes::Recipe> shippedRecipes() {
    std::vector<scenes::Recipe> shipped;
    for (const auto* recipes : {&scenes::namedRecipes(), &scenes::degenerateRecipes()})
        std::copy_if(recipes->begin(), recipes->end(), std::back_inserter(shipped),
                     [](const scenes::Recipe& recipe) { return recipe.ships; });
    return shipped;
}

/// At the size it is made for, of which the crop is at most `side_px` square and starts at `corner` (0 to 1)
/// of what is left of the film.
inline ShippedPicture shippedPicture(const scenes::Recipe& recipe, int side_px,
                                     glm::dvec2 corner = {0.3, 0.45}) {
    ShippedPicture picture;
    picture.name = std::filesystem::path(recipe.file).stem();
    picture.scene = loadGltf(defaultDataFolders().back() / recipe.file);
    CameraOptions options;
    options.size = glm::ivec2(recipe.width_px, recipe.height_px);
    picture.camera = resolveCamera(picture.scene, options, picture.film);
    const int width = std::min(side_px, recipe.width_px), height = std::min(side_px, recipe.height_px);
    const int x = static_cast<int>(corner.x * (recipe.width_px - width));
    const int y = static_cast<int>(corner.y * (recipe.height_px - height));
    picture.film.crop = {x, y, x + width, y + height};
    return picture;
}

inline ShippedPicture shippedPicture(const std::string& name, int side_px, glm::dvec2 corner = {0.3, 0.45}) {
    for (const scenes::Recipe& recipe : shippedRecipes())
        if (std::filesystem::path(recipe.file).stem() == name) return shippedPicture(recipe, side_px, corner);
    throw std::invalid_argument("no scene that ships is called " + name);
}

inline MethodResult renderPicture(const ShippedPicture& picture, const Prefilter& filter,
                                  const RenderOptions& options = {}, const char* method = "nsaa") {
    Progress progress;
    return runMethod(parseMethod(method),
                     {picture.scene, picture.camera, picture.film, filter, options, progress});
}

/// A part of the picture by one thread within the least memory has the bits of that part of the whole.
inline void expectCropThreadsAndMemoryDoNotShow(const char* method) {
    ShippedPicture picture = shippedPicture("log-grid", 40);
    const Prefilter box = makePrefilter("box", {}, {});
    const ImageBuffer whole = renderPicture(picture, box, {}, method).image;
    const PixelBox all = picture.film.crop;
    picture.film.crop = {all.x0 + 5, all.y0 + 7, all.x1 - 3, all.y1 - 2};
    RenderOptions options;
    options.threads = 1, options.memory_mib = 0;
    const ImageBuffer part = renderPicture(picture, box, options, method).image;
    for (int y = picture.film.crop.y0; y < picture.film.crop.y1; ++y)
        for (int x = picture.film.crop.x0; x < picture.film.crop.x1; ++x)
            ASSERT_EQ(part.rgba[part.index(x, y)], whole.rgba[whole.index(x, y)]) << x << "," << y;
}

/// Of a parameter of a test: letters, digits and underscores.
inline std::string testName(std::string name) {
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
    return name;
}
inline std::string nameOf(const scenes::Recipe& recipe) {
    return testName(std::filesystem::path(recipe.file).stem());
}
inline std::string nameOf(const Prefilter& filter) {
    return testName(filter.name);
}

/// A background that no scene mistakes for black.
inline RenderOptions onBlue() {
    RenderOptions options;
    options.background = {0.25, 0.5, 1.0};
    return options;
}

}  // namespace edgewise::test
