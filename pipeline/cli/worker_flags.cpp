#include "pipeline/cli/worker_flags.h"

namespace edgewise::cli {
namespace {

/// One word each, so that a value may begin with '-'.
class Flags {
  public:
    void add(const std::string& name, const std::optional<std::string>& value) {
        if (value) words.push_back(name + "=" + *value);
    }
    std::vector<std::string> words{"compare-worker"};
};

}  // namespace

std::vector<std::string> workerFlags(const PictureArguments& picture, const FilterArguments& filter,
                                     const MethodArguments& making, const std::string& method) {
    Flags flags;
    flags.words.push_back(picture.scene);
    flags.add("--scene", picture.scene_choice), flags.add("--time", picture.time);
    flags.add("--animation", picture.animation), flags.add("--camera", picture.camera);
    flags.add("--size", picture.size), flags.add("--crop", picture.crop), flags.add("--shift", picture.shift);
    flags.add("--eye", picture.eye), flags.add("--target", picture.target), flags.add("--fovy", picture.fovy);
    flags.add("--filter", filter.name), flags.add("--radius", filter.radius),
        flags.add("--sigma", filter.sigma);
    flags.add("--device", making.device), flags.add("--precision", making.precision);
    flags.add("--shading", making.shading), flags.add("--background", making.background);
    flags.add("--threads", making.threads), flags.add("--memory", making.memory),
        flags.add("--seed", making.seed);
    flags.add("--frames", making.frames);
    for (const std::string& stage : making.no_skip) flags.add("--no-skip", stage);
    flags.add("--method", method);
    return flags.words;
}

}  // namespace edgewise::cli
