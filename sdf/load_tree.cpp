#include "sdf/load_tree.h"

#include <fmt/format.h>

#include "sdf/json_reader.h"
#include "sdf/load_views.h"
#include "sdf/nearest_name.h"
#include "sdf/scale_bounds.h"

namespace edgewise::sdf {
namespace {

using Children = KindInfo::Children;

const KindInfo& readKind(const Json& object, const std::string& path) {
    if (!object.contains("type")) refuse(path + ".type", "must be given");
    const std::string name = readText(object["type"], path + ".type");
    if (const KindInfo* kind = findKind(name)) return *kind;
    std::vector<std::string_view> names;
    for (const KindInfo& kind : kindInfos()) names.push_back(kind.name);
    refuse(path + ".type", fmt::format("no kind of node is called '{}'{}", name, didYouMean(name, names)));
}

void requireKeys(const Json& object, const std::string& path, const KindInfo& kind) {
    std::vector<std::string_view> known{"type", "material", "lipschitz", "at", "rotate", "scale"};
    for (const NumberInfo& number : kind.numbers) known.push_back(number.name);
    if (kind.children == Children::kOne) known.push_back("child");
    if (kind.children == Children::kSome) known.push_back("children");
    requireKnownKeys(object, path, known);
}

class TreeReader {
  public:
    explicit TreeReader(const std::vector<SurfaceMaterial>& materials) : materials_(materials) {}

    Tree run(const Json& root) {
        tree_.root = read(root, "tree", 1);
        return std::move(tree_);
    }

  private:
    std::uint32_t read(const Json& object, const std::string& path, int level) {
        requireObject(object, path);
        if (level > kMostTreeLevels)
            refuse(path, fmt::format("lies too deep: nodes nest at most {} deep", kMostTreeLevels));
        const KindInfo& kind = readKind(object, path);
        requireKeys(object, path, kind);
        std::vector<double> numbers = readOwnNumbers(object, path, kind);
        const std::vector<std::uint32_t> children = readChildren(object, path, kind, level);
        const std::uint32_t index = add(kind.kind, std::move(numbers), children, path);
        Node& node = tree_.nodes[index];
        if (object.contains("material")) {
            const std::string name = readText(object["material"], path + ".material");
            node.material = findMaterial(materials_, name, path + ".material");
        }
        const auto bound = numbersAt(object, path, commonKeys().lipschitz);
        if (!bound.empty()) node.declared_lipschitz = bound[0];
        return placed(object, path, index);
    }

    std::uint32_t add(Kind kind, std::vector<double> numbers, const std::vector<std::uint32_t>& children,
                      const std::string& path) {
        if (tree_.nodes.size() >= kMostNodes)
            refuse(path, fmt::format("a tree has at most {} nodes", kMostNodes));
        const std::uint32_t index = tree_.add(kind, std::move(numbers), children);
        Node& node = tree_.nodes[index];
        node.path = path;
        // Once here, so that no box is asked for its child's again and again.
        if (kind == Kind::kTwist) node.numbers[1] = twistRadius(tree_, node);
        return index;
    }

    static std::vector<double> numbersAt(const Json& object, const std::string& path,
                                         const NumberInfo& info) {
        std::vector<double> numbers;
        const auto found = object.find(std::string(info.name));
        if (found != object.end()) readNumbers(*found, fmt::format("{}.{}", path, info.name), info, numbers);
        return numbers;
    }

    static std::vector<double> requiredNumbers(const Json& object, const std::string& path,
                                               const NumberInfo& info) {
        std::vector<double> numbers = numbersAt(object, path, info);
        if (numbers.empty() && !info.fallback) refuse(fmt::format("{}.{}", path, info.name), "must be given");
        if (numbers.empty()) numbers.assign(info.vector ? 3 : 1, *info.fallback);
        return numbers;
    }

    static std::vector<double> readOwnNumbers(const Json& object, const std::string& path,
                                              const KindInfo& kind) {
        std::vector<double> all;
        for (const NumberInfo& info : kind.numbers) {
            const std::vector<double> numbers = requiredNumbers(object, path, info);
            all.insert(all.end(), numbers.begin(), numbers.end());
        }
        return all;
    }

    std::vector<std::uint32_t> readChildren(const Json& object, const std::string& path, const KindInfo& kind,
                                            int level) {
        if (kind.children == Children::kNone) return {};
        const char* const key = kind.children == Children::kOne ? "child" : "children";
        if (!object.contains(key)) refuse(fmt::format("{}.{}", path, key), "must be given");
        const Json& value = object[key];
        if (kind.children == Children::kOne) return {read(value, path + ".child", level + 1)};
        if (!value.is_array() || value.empty())
            refuse(path + ".children", fmt::format("must be a list of one node or more, not {}",
                                                   value.is_array() ? "an empty one" : value.type_name()));
        std::vector<std::uint32_t> children;
        for (std::size_t i = 0; i < value.size(); ++i)
            children.push_back(read(value[i], fmt::format("{}.children[{}]", path, i), level + 1));
        return children;
    }

    std::uint32_t placed(const Json& object, const std::string& path, std::uint32_t index) {
        const CommonKeys& keys = commonKeys();
        const auto scale = numbersAt(object, path, keys.scale);
        if (!scale.empty()) index = add(Kind::kScale, scale, {index}, path + ".scale");
        if (object.contains("rotate")) {
            const std::string where = path + ".rotate";
            requireObject(object["rotate"], where);
            requireKnownKeys(object["rotate"], where, {"axis", "degrees"});
            std::vector<double> turn = requiredNumbers(object["rotate"], where, keys.axis);
            turn.push_back(requiredNumbers(object["rotate"], where, keys.degrees)[0]);
            index = add(Kind::kRotate, turn, {index}, where);
        }
        const auto at = numbersAt(object, path, keys.at);
        return at.empty() ? index : add(Kind::kTranslate, at, {index}, path + ".at");
    }

    const std::vector<SurfaceMaterial>& materials_;
    Tree tree_;
};

}  // namespace

const CommonKeys& commonKeys() {
    static const CommonKeys keys;
    return keys;
}

Tree readTree(const Json& node, const std::vector<SurfaceMaterial>& materials) {
    return TreeReader(materials).run(node);
}

}  // namespace edgewise::sdf
