#include "pipeline/gltf_animation.h"

#include <tiny_gltf.h>

#include "pipeline/gltf_accessor.h"
#include "pipeline/gltf_check.h"
#include "pipeline/gltf_choice.h"
#include "pipeline/gltf_ignored.h"
#include "pipeline/gltf_keyframes.h"

namespace edgewise {
namespace {

enum class Interpolation { kStep, kLinear, kCubicSpline };

using Values = KeyValues;

/// One channel's sampler: keys, and `width` numbers a value.
class Sampler {
  public:
    Sampler(const GltfElement& from, const tinygltf::Model& model, const std::string& source,
            std::string path, std::size_t targets)
        : from_(from), model_(model), source_(source), path_(std::move(path)) {
        const auto kind = from.find("interpolation");
        const std::string name = kind ? kind->string() : "LINEAR";
        if (name == "STEP") interpolation_ = Interpolation::kStep;
        if (name == "CUBICSPLINE") interpolation_ = Interpolation::kCubicSpline;
        readTimes();
        width_ = path_ == "weights" ? targets : path_ == "rotation" ? 4 : 3;
        readOutput();
    }

    Values at(double time) const {
        const Moment moment = momentAt(times_, time);
        if (interpolation_ == Interpolation::kCubicSpline) return spline(moment);
        if (interpolation_ == Interpolation::kStep || moment.before == moment.after)
            return value(moment.before);
        if (path_ == "rotation") return slerp(value(moment.before), value(moment.after), moment.fraction);
        return combined(1.0 - moment.fraction, value(moment.before), moment.fraction, value(moment.after));
    }

  private:
    const tinygltf::Accessor& accessorOf(const GltfElement& reference) const {
        return model_.accessors[static_cast<std::size_t>(reference.integer())];
    }

    void readTimes() {
        const GltfElement input = from_.need("input");
        const tinygltf::Accessor& accessor = accessorOf(input);
        if (accessor.type != TINYGLTF_TYPE_SCALAR || accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
            input.fail("its times are not float scalars");
        times_ = readNumbers(model_, static_cast<int>(input.integer()), source_).stored;
        for (std::size_t i = 1; i < times_.size(); ++i)
            if (!(times_[i - 1] < times_[i]))
                input.fail(fmt::format("time {} follows {}", times_[i], times_[i - 1]));
    }

    void readOutput() {
        const GltfElement output = from_.need("output");
        const tinygltf::Accessor& accessor = accessorOf(output);
        const bool is_float = accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
        const bool may_be_small = path_ == "rotation" || path_ == "weights";
        const int type = path_ == "weights"    ? TINYGLTF_TYPE_SCALAR
                         : path_ == "rotation" ? TINYGLTF_TYPE_VEC4
                                               : TINYGLTF_TYPE_VEC3;
        if (accessor.type != type || !(is_float || (may_be_small && accessor.normalized)))
            output.fail(fmt::format("its format does not fit {}", path_));
        output_ = readNumbers(model_, static_cast<int>(output.integer()), source_);
        const std::size_t wanted = times_.size() * width_ * valuesPerKey(),
                          components = output_.stored.size();
        if (components != wanted)
            output.fail(fmt::format("has {} numbers, not {} for {} keys", components, wanted, times_.size()));
    }

    std::size_t valuesPerKey() const { return interpolation_ == Interpolation::kCubicSpline ? 3 : 1; }

    /// part: of a cubic spline's key, 0 its in-tangent, 1 its value, 2 its out-tangent.
    Values value(std::size_t key, std::size_t part = 0) const {
        Values value(width_);
        for (std::size_t i = 0; i < width_; ++i)
            value[i] = output_.stored[(key * valuesPerKey() + part) * width_ + i] / output_.divisor;
        return value;
    }

    Values spline(const Moment& m) const {
        if (m.before == m.after) return value(m.before, 1);
        return hermite(m, value(m.before, 1), value(m.before, 2), value(m.after, 0), value(m.after, 1));
    }

    const GltfElement& from_;
    const tinygltf::Model& model_;
    const std::string& source_;
    std::string path_;
    Interpolation interpolation_ = Interpolation::kLinear;
    Values times_;
    AccessorNumbers output_;
    std::size_t width_ = 0;
};

bool isKnownPath(const std::string& path) {
    return path == "translation" || path == "rotation" || path == "scale" || path == "weights";
}

/// Morph targets of the node's mesh; all of its primitives have as many.
std::size_t targetCount(const tinygltf::Model& model, const tinygltf::Node& node) {
    if (node.mesh < 0) return 0;
    return model.meshes[static_cast<std::size_t>(node.mesh)].primitives[0].targets.size();
}

void setNode(const GltfElement& channel, const std::string& path, const Values& value, tinygltf::Node& node) {
    if (path == "weights") {
        node.weights = value;
        return;
    }
    if (!node.matrix.empty()) channel.fail("moves a node that has a matrix");
    if (path == "translation") node.translation = value;
    if (path == "scale") node.scale = value;
    if (path != "rotation") return;
    node.rotation = normalized(value);
    if (dot(node.rotation, node.rotation) == 0.0) channel.fail("turns its node by the quaternion 0, 0, 0, 0");
}

void playChannel(const GltfElement& animation, const GltfElement& channel, double time,
                 tinygltf::Model& model, Scene& scene) {
    const GltfElement target = channel.need("target");
    const std::string path = target.need("path").string();
    if (!isKnownPath(path)) return countIgnored(scene, "animation channels of an unknown path");
    const auto reference = target.find("node");
    if (!reference) return;
    tinygltf::Node& node = model.nodes[static_cast<std::size_t>(reference->integer())];
    const std::size_t targets = targetCount(model, node);
    if (path == "weights" && targets == 0)
        return countIgnored(scene, "animated weights without morph targets");
    const auto sampler = static_cast<std::size_t>(channel.need("sampler").integer());
    const GltfElement from = animation.need("samplers").at(sampler);
    setNode(channel, path, Sampler(from, model, scene.source, path, targets).at(time), node);
}

}  // namespace

void checkAnimation(const GltfElement& animation, const GltfCounts& counts) {
    std::size_t samplers = 0;
    animation.each("samplers", [&](const GltfElement& sampler) {
        sampler.object().need("input").reference(counts.accessors, "accessors");
        sampler.need("output").reference(counts.accessors, "accessors");
        if (const auto kind = sampler.find("interpolation")) kind->string();
        ++samplers;
    });
    animation.each("channels", [&](const GltfElement& channel) {
        channel.object().need("sampler").reference(samplers, "samplers");
        const GltfElement target = channel.need("target").object();
        target.referenceIf("node", counts.nodes, "nodes");
        target.need("path").string();
    });
}

void playAnimation(const GltfElement& root, const std::string& wanted, double time, tinygltf::Model& model,
                   Scene& scene) {
    std::vector<std::string> names;
    root.each("animations", [&](const GltfElement& animation) {
        const auto name = animation.find("name");
        names.push_back(name ? name->string() : "");
    });
    if (names.empty()) throw InputError("--time", fmt::format("{} has no animations", scene.source));
    const std::size_t index =
        wanted.empty() ? 0 : chooseElement(names, wanted, "--animation", scene.source, "animations");
    const GltfElement animation = root.need("animations").at(index);
    animation.each("channels",
                   [&](const GltfElement& channel) { playChannel(animation, channel, time, model, scene); });
}

}  // namespace edgewise
