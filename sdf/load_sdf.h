// A .sdf.json text as a scene.
#pragma once

#include <string_view>

#include "sdf/field_scene.h"

namespace edgewise::sdf {

/// Bytes of a scene's text; more is refused.
inline constexpr std::size_t kMostSceneBytes = std::size_t(64) << 20;

/// Steeper or flatter is nothing that float arithmetic can trace: of every instruction's Lipschitz bound.
inline constexpr double kSteepest = 1e6;

/// Throws SceneError naming the path in the document ("tree.children[3].radius"), or line and column where it
/// is no JSON, and the rule. The tree can be lowered. `source` stays empty.
FieldScene loadSdf(std::string_view text);

/// A box around the tree's solid, of unions those parts that are bounded, and the analytic spheres; all 0
/// where nothing is bounded.
Box sceneBounds(const FieldScene& scene);

/// Eight of the bounds' diagonals: beyond all that a camera which frames them sees of them, at angles of view
/// from 10 degrees on.
double farFor(const Box& bounds);

}  // namespace edgewise::sdf
