#include "pipeline/cli/picture_options.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "pipeline/cli/interrupt.h"
#include "pipeline/cli/parse_values.h"
#include "pipeline/error.h"
#include "pipeline/load_scene.h"
#include "pipeline/resolve_camera.h"
#include "pipeline/scene_catalog.h"
#include "sdf/field_scene.h"

namespace edgewise::cli {
namespace {

/// A fraction as whole steps of a Progress.
class LoadProgress {
  public:
    explicit LoadProgress(Progress& progress) : progress_(progress) { progress_.stage("load", kSteps); }

    void operator()(double fraction) {
        if (progress_.cancelled()) throw Interrupted();
        const auto step = static_cast<std::size_t>(fraction * kSteps);
        if (step > done_) progress_.advance(step - done_);
        done_ = std::max(done_, step);
    }

  private:
    static constexpr std::size_t kSteps = 100;
    Progress& progress_;
    std::size_t done_ = 0;
};

/// A film moved further than its own longest side could reach the end of the screen's grid.
glm::dvec2 readShift(const std::string& text) {
    const glm::dvec2 shift = parsePair("--shift", text);
    if (std::max(std::abs(shift.x), std::abs(shift.y)) > kMaxFilmSide)
        throw InputError("--shift", fmt::format("'{}' is not within +-{} pixels", text, kMaxFilmSide));
    return shift;
}

Scene readScene(const PictureArguments& arguments, Progress& progress) {
    LoadOptions options;
    options.scene = arguments.scene_choice.value_or("");
    if (arguments.time) options.time = parseNumber("--time", *arguments.time);
    if (arguments.animation && !arguments.time)
        throw InputError("--animation", "needs --time: without it the rest pose is drawn");
    options.animation = arguments.animation.value_or("");
    options.progress = LoadProgress(progress);
    Scene scene = loadScene(findScene(arguments.scene), options);
    scene.source = arguments.scene;
    throwIfInterrupted();
    return scene;
}

CameraOptions readCamera(const PictureArguments& arguments) {
    CameraOptions options;
    options.camera = arguments.camera.value_or("");
    if (arguments.eye) options.eye = parseTriple("--eye", *arguments.eye);
    if (arguments.target) options.target = parseTriple("--target", *arguments.target);
    if (arguments.fovy) options.fovy_degrees = parseNumber("--fovy", *arguments.fovy);
    if (arguments.size) options.size = parseSize("--size", *arguments.size);
    return options;
}

}  // namespace

void addPictureOptions(CLI::App& command, PictureArguments& arguments) {
    command
        .add_option("SCENE", arguments.scene,
                    ".gltf, .glb, .sdf.json or .map.glsl file, or a name of `edgewise scenes`")
        ->required();
    command
        .add_option("--size", arguments.size,
                    "pixels; yfov (orthographic: ymag) holds [1024 wide, the camera's aspect ratio]")
        ->type_name("WxH");
    command
        .add_option("--crop", arguments.crop,
                    "half-open part of the output, with the bits of the whole image")
        ->type_name("X0,Y0,X1,Y1");
    command.add_option("--shift", arguments.shift, "moves the film by a fraction of a pixel [0,0]")
        ->type_name("DX,DY");
    command
        .add_option("--scene", arguments.scene_choice,
                    "the file's scene; a name wins over an index [the file's own]")
        ->type_name("NAME|INDEX");
    command.add_option("--time", arguments.time, "pose of an animated file [the rest pose]")
        ->type_name("SECONDS");
    command
        .add_option("--animation", arguments.animation,
                    "with --time: the file's animation; a name wins over an index [the first]")
        ->type_name("NAME|INDEX");
    command
        .add_option(
            "--camera", arguments.camera,
            "camera node, in depth-first order; a name wins over an index [the first, or one that frames the "
            "scene]")
        ->type_name("NAME|INDEX");
    command.add_option("--eye", arguments.eye, "a camera of your own stands here")->type_name("X,Y,Z");
    command.add_option("--target", arguments.target, "and looks here [the scene's centre]")
        ->type_name("X,Y,Z");
    command.add_option("--fovy", arguments.fovy, "with this vertical angle [45]")->type_name("DEG");
}

Picture loadPicture(const PictureArguments& arguments, Progress& progress) {
    const CameraOptions camera_options = readCamera(arguments);
    Film film;
    if (arguments.shift) film.shift_px = readShift(*arguments.shift);
    std::optional<PixelBox> crop;
    if (arguments.crop) crop = parseCrop("--crop", *arguments.crop);

    Picture picture;
    picture.scene = readScene(arguments, progress);
    picture.camera = resolveCamera(picture.scene, camera_options, film);
    if (crop) {
        checkCrop("--crop", *crop, film.width, film.height);
        film.crop = *crop;
    }
    picture.film = film;
    return picture;
}

void warnOfIgnored(const Scene& scene) {
    for (const Ignored& ignored : scene.ignored)
        spdlog::warn("{}: {} ignored ({} times)", scene.source, ignored.what, ignored.count);
    if (!scene.field) return;
    for (const std::string& warning : scene.field->warnings)
        spdlog::warn("{}: {}", scene.source, oneLine(warning));
}

}  // namespace edgewise::cli
