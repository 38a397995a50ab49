#include "pipeline/gltf_skin.h"

#include <tiny_gltf.h>

#include "pipeline/gltf_accessor.h"
#include "pipeline/gltf_transform.h"

namespace edgewise {
namespace {

glm::dmat4 affineAt(const AccessorNumbers& numbers, std::size_t element) {
    glm::dmat4 matrix(1.0);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row) matrix[column][row] = numbers.value(element, 4 * column + row);
    return matrix;
}

std::vector<glm::dmat4> inverseBindMatrices(const GltfElement& skin, const tinygltf::Model& model,
                                            const std::string& source, std::size_t joint_count) {
    std::vector<glm::dmat4> matrices(joint_count, glm::dmat4(1.0));
    const auto reference = skin.find("inverseBindMatrices");
    if (!reference) return matrices;
    const auto index = static_cast<int>(reference->integer());
    const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
    if (accessor.type != TINYGLTF_TYPE_MAT4 || accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
        reference->fail(fmt::format("accessors[{}] is not of float MAT4", index));
    if (accessor.count < joint_count)
        reference->fail(
            fmt::format("accessors[{}] has {} matrices for {} joints", index, accessor.count, joint_count));
    const AccessorNumbers numbers = readNumbers(model, index, source);
    for (std::size_t i = 0; i < joint_count; ++i) matrices[i] = affineAt(numbers, i);
    return matrices;
}

glm::dmat4 blend(const SkinInfluences::Entry* entries, std::size_t count,
                 const std::vector<glm::dmat4>& joints) {
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) sum += entries[i].weight;
    if (sum == 0.0) return joints[entries[0].joint];
    glm::dmat4 matrix(0.0);
    for (std::size_t i = 0; i < count; ++i)
        if (entries[i].weight != 0.0) matrix += joints[entries[i].joint] * (entries[i].weight / sum);
    for (int column = 0; column < 4; ++column) matrix[column][3] = column == 3 ? 1.0 : 0.0;
    return matrix;
}

}  // namespace

std::vector<glm::dmat4> jointMatrices(const GltfElement& root, const tinygltf::Model& model, std::size_t skin,
                                      const std::vector<glm::dmat4>& world_of_node,
                                      const std::string& source) {
    const GltfElement from = root.need("skins").at(skin);
    const GltfElement joints = from.need("joints");
    std::vector<glm::dmat4> matrices = inverseBindMatrices(from, model, source, joints.size());
    for (std::size_t i = 0; i < joints.size(); ++i) {
        matrices[i] = world_of_node[static_cast<std::size_t>(joints.at(i).integer())] * matrices[i];
        if (!isFinite(matrices[i])) joints.at(i).fail("its joint matrix is not finite");
    }
    return matrices;
}

std::vector<glm::dmat4> blendJoints(const SkinInfluences& influences, const std::vector<glm::dmat4>& joints,
                                    const std::string& where) {
    for (std::size_t i = 0; i < influences.entries.size(); ++i)
        if (influences.entries[i].joint >= joints.size())
            throw InputError(where,
                             fmt::format("vertex {} has joint {}, the skin has {}", i / influences.per_vertex,
                                         influences.entries[i].joint, joints.size()));
    std::vector<glm::dmat4> matrices(influences.entries.size() / influences.per_vertex);
    for (std::size_t v = 0; v < matrices.size(); ++v)
        matrices[v] = blend(&influences.entries[v * influences.per_vertex], influences.per_vertex, joints);
    return matrices;
}

}  // namespace edgewise
