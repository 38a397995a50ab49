// An SDF as its author wrote it: shapes, operators on them, and changes of position, as a tree.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sdf/tape.h"

namespace edgewise::sdf {

enum class Kind : unsigned char {
    // Shapes about the origin.
    kSphere,
    kBox,
    kBoxFrame,
    kTorus,
    kCapsule,
    kCylinder,
    kCone,
    kPlane,
    kEllipsoid,
    kOctahedron,
    kDodecahedron,
    kIcosahedron,
    kHexPrism,
    kGyroid,
    kMenger,
    // Of one or more children, from left to right.
    kUnion,
    kIntersection,
    kDifference,
    kSmoothUnion,
    kSmoothIntersection,
    kSmoothDifference,
    // Of one child.
    kComplement,
    kOffset,
    kShell,
    kScaleValue,
    kDisplace,
    kTranslate,
    kRotate,
    kScale,
    kStretch,
    kMirror,
    kRepeat,
    kElongate,
    kTwist
};

/// What a number or vector of a node may be.
enum class Rule : unsigned char {
    kAny,
    kPositive,
    kNotNegative,
    kNotZero,  ///< vectors: not all 0
    kCount,    ///< whole and >= 0
    kSwitch    ///< vectors of 0 or 1
};

struct NumberInfo {
    std::string_view name;
    bool vector = false;
    Rule rule = Rule::kAny;
    std::optional<double> fallback = {};  ///< of every component; none: it must be given
    double largest = 1e6;                 ///< in size
};

/// What a kind of node is called in .sdf.json and what it takes.
struct KindInfo {
    Kind kind;
    std::string_view name;
    std::string_view what;  ///< one line
    enum class Children { kNone, kOne, kSome } children;
    std::vector<NumberInfo> numbers;
};
const std::vector<KindInfo>& kindInfos();
const KindInfo& kindInfo(Kind kind);
/// nullptr: no kind has that name.
const KindInfo* findKind(std::string_view name);

struct Node {
    Kind kind = Kind::kSphere;
    std::vector<double> numbers;  ///< in KindInfo's order, vectors as three
    std::vector<std::uint32_t> children;
    std::uint32_t material = kNoMaterial;      ///< of the shapes below that have none of their own
    std::optional<double> declared_lipschitz;  ///< of the node's value, in the node's own frame
    std::string path;                          ///< where in the file, for messages: "tree.children[3]"
};

struct Tree {
    std::vector<Node> nodes;
    std::uint32_t root = 0;
    bool empty() const { return nodes.empty(); }
    /// Adds a node, and gives its index.
    std::uint32_t add(Kind kind, std::vector<double> numbers = {}, std::vector<std::uint32_t> children = {},
                      std::uint32_t material = kNoMaterial);
};

/// +-infinity where unbounded; empty where low > high.
struct Box {
    double low[3], high[3];
    bool bounded() const;
    bool empty() const;
};

/// A box around all points of a node's own frame whose value is at most `level` >= 0.
Box levelBox(const Tree& tree, std::uint32_t node, double level = 0.0);

/// The tree as instructions, in the order of the children; every value's and position's Lipschitz bound with
/// them. Twists and displacements are divided by their bounds, so that what is beside them keeps its steps.
/// Throws SceneError naming the node where it needs more than kMostSlots slots, where a repeated child does
/// not fit its cell, where a twisted one has no bounds.
Tape lower(const Tree& tree);

}  // namespace edgewise::sdf
