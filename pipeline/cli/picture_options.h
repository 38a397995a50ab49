// What every command that looks at a picture takes: the scene, the camera and the film.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "pipeline/film.h"
#include "pipeline/progress.h"
#include "pipeline/scene.h"

namespace edgewise::cli {

/// The flags as typed; an absent one is empty.
struct PictureArguments {
    std::string scene;
    std::optional<std::string> scene_choice, time, animation, camera, size, crop, shift, eye, target, fovy;
};

/// Adds SCENE, --scene, --time, --animation, --camera, --eye, --target, --fovy, --size, --crop, --shift.
void addPictureOptions(CLI::App& command, PictureArguments& arguments);

struct Picture {
    Scene scene;
    ResolvedCamera camera;
    Film film;
};

/// Reads the flags, then the file.
Picture loadPicture(const PictureArguments& arguments, Progress& progress);

/// One warning for each thing that the scene uses and edgewise ignores, and for each that it breaks.
void warnOfIgnored(const Scene& scene);

}  // namespace edgewise::cli
