#include "sdf/tree.h"

#include <algorithm>
#include <cmath>

namespace edgewise::sdf {
namespace {

using Children = KindInfo::Children;

std::vector<KindInfo> makeKinds() {
    const NumberInfo radius{"radius", false, Rule::kPositive};
    const NumberInfo inradius{"inradius", false, Rule::kPositive};
    const NumberInfo height{"height", false, Rule::kPositive};
    const NumberInfo size{"size", true, Rule::kPositive};
    const NumberInfo smoothness{"smoothness", false, Rule::kPositive};
    const NumberInfo thickness{"thickness", false, Rule::kPositive};
    return {
        {Kind::kSphere, "sphere", "a ball about the origin", Children::kNone, {radius}},
        {Kind::kBox, "box", "edges of these lengths along the axes", Children::kNone, {size}},
        {Kind::kBoxFrame,
         "box-frame",
         "the twelve edges of a box, as beams",
         Children::kNone,
         {size, thickness}},
        {Kind::kTorus,
         "torus",
         "around the y axis: to the tube's middle, and the tube's radius",
         Children::kNone,
         {{"major", false, Rule::kPositive}, {"minor", false, Rule::kPositive}}},
        {Kind::kCapsule,
         "capsule",
         "all within a radius of a segment",
         Children::kNone,
         {{"from", true}, {"to", true}, radius}},
        {Kind::kCylinder, "cylinder", "around the y axis", Children::kNone, {radius, height}},
        {Kind::kCone,
         "cone",
         "a frustum around the y axis: its radii below and above",
         Children::kNone,
         {{"bottom", false, Rule::kNotNegative}, {"top", false, Rule::kNotNegative, 0.0}, height}},
        {Kind::kPlane,
         "plane",
         "the half-space below a plane: dot(p, normal / |normal|) <= offset",
         Children::kNone,
         {{"normal", true, Rule::kNotZero}, {"offset", false, Rule::kAny, 0.0}}},
        {Kind::kEllipsoid,
         "ellipsoid",
         "a bound, not the distance",
         Children::kNone,
         {{"radii", true, Rule::kPositive}}},
        {Kind::kOctahedron, "octahedron", "radius to its corners", Children::kNone, {radius}},
        {Kind::kDodecahedron, "dodecahedron", "radius of the ball within", Children::kNone, {inradius}},
        {Kind::kIcosahedron, "icosahedron", "radius of the ball within", Children::kNone, {inradius}},
        {Kind::kHexPrism, "hex-prism", "around the y axis", Children::kNone, {inradius, height}},
        {Kind::kGyroid,
         "gyroid",
         "the unbounded sheet around a gyroid; thickness about what it measures across",
         Children::kNone,
         {{"period", false, Rule::kPositive}, thickness}},
        {Kind::kMenger,
         "menger",
         "Menger's sponge of so many levels",
         Children::kNone,
         {{"size", false, Rule::kPositive}, {"levels", false, Rule::kCount, 3.0, 12.0}}},

        {Kind::kUnion, "union", "what any child fills", Children::kSome, {}},
        {Kind::kIntersection, "intersection", "what all children fill", Children::kSome, {}},
        {Kind::kDifference, "difference", "the first child without the others", Children::kSome, {}},
        {Kind::kSmoothUnion, "smooth-union", "rounded over a band of values", Children::kSome, {smoothness}},
        {Kind::kSmoothIntersection, "smooth-intersection", "likewise", Children::kSome, {smoothness}},
        {Kind::kSmoothDifference, "smooth-difference", "likewise", Children::kSome, {smoothness}},

        {Kind::kComplement, "complement", "inside out", Children::kOne, {}},
        {Kind::kOffset, "offset", "grown by a distance, or shrunk", Children::kOne, {{"distance"}}},
        {Kind::kShell, "shell", "a sheet around the surface", Children::kOne, {thickness}},
        {Kind::kScaleValue,
         "scale-value",
         "the same surface with all values times a factor",
         Children::kOne,
         {{"factor", false, Rule::kPositive}}},
        {Kind::kDisplace,
         "displace",
         "amplitude * sin(fx x) sin(fy y) sin(fz z) added to the values, but for factors of frequency 0; "
         "then "
         "all divided by what makes it a bound again",
         Children::kOne,
         {{"amplitude"}, {"frequency", true}}},
        {Kind::kTranslate, "translate", "moved", Children::kOne, {{"by", true}}},
        {Kind::kRotate,
         "rotate",
         "turned about an axis through the origin, counter-clockwise seen from its end",
         Children::kOne,
         {{"axis", true, Rule::kNotZero}, {"degrees"}}},
        {Kind::kScale, "scale", "larger by a factor", Children::kOne, {{"factor", false, Rule::kPositive}}},
        {Kind::kStretch,
         "stretch",
         "by a factor an axis: a bound, not the distance",
         Children::kOne,
         {{"factors", true, Rule::kPositive}}},
        {Kind::kMirror,
         "mirror",
         "the positive side, and its image on the other; 1 an axis that is mirrored",
         Children::kOne,
         {{"axes", true, Rule::kSwitch}}},
        {Kind::kRepeat,
         "repeat",
         "copies at multiples of the spacing, so many to either side an axis; spacing 0: that axis has none",
         Children::kOne,
         {{"spacing", true, Rule::kNotNegative}, {"count", true, Rule::kCount, 1e6}}},
        {Kind::kElongate,
         "elongate",
         "cut in the middle, pulled apart by these lengths",
         Children::kOne,
         {{"by", true, Rule::kNotNegative}}},
        {Kind::kTwist,
         "twist",
         "turned about the y axis, +x towards +z, by so much a unit of height; radius: of the cylinder that "
         "holds the child "
         "[its box]",
         Children::kOne,
         {{"degrees_per_unit"}, {"radius", false, Rule::kNotNegative, 0.0}}},
    };
}

}  // namespace

const std::vector<KindInfo>& kindInfos() {
    static const std::vector<KindInfo> kinds = makeKinds();
    return kinds;
}

const KindInfo& kindInfo(Kind kind) {
    return kindInfos()[static_cast<std::size_t>(kind)];
}

const KindInfo* findKind(std::string_view name) {
    const auto& kinds = kindInfos();
    const auto found =
        std::find_if(kinds.begin(), kinds.end(), [&](const KindInfo& k) { return k.name == name; });
    return found == kinds.end() ? nullptr : &*found;
}

std::uint32_t Tree::add(Kind kind, std::vector<double> numbers, std::vector<std::uint32_t> children,
                        std::uint32_t material) {
    Node node;
    node.kind = kind;
    node.numbers = std::move(numbers);
    node.children = std::move(children);
    node.material = material;
    nodes.push_back(std::move(node));
    root = static_cast<std::uint32_t>(nodes.size() - 1);
    return root;
}

}  // namespace edgewise::sdf
