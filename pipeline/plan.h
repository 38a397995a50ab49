// The plan: which stages run for a scene, and why the others do not. Data, printed by --explain and `edgewise
// info`.
#pragma once

#include <vector>

#include "pipeline/methods/method.h"
#include "pipeline/shade.h"
#include "pipeline/visibility.h"
#include "pipeline/weights.h"

namespace edgewise {

struct Plan {
    std::vector<PlanEntry> entries;
    VisibilityStageOptions visibility;
    WeightOptions weights;
    OwnerClasses classes;  ///< empty where nothing cancels
    /// By owner, where no sample decides it; empty where every colour is fetched. Triangles within one texel
    /// are here, but are not merged into classes.
    std::vector<std::optional<Shade>> constant;
};

/// Names that --no-skip takes.
const std::vector<std::string>& skippableStages();

/// By owner: its shade, where it has pieces and cannot vary.
std::vector<std::optional<Shade>> constantShades(const ScreenPieces& pieces, const Shading& shading);

Plan makePlan(const Scene& scene, const ScreenScene& screen, const ScreenPieces& pieces,
              const Shading& shading, const RenderOptions& options);

/// The same, but for visibility=awj13: EdgeVisibility asks every edge of every cell. Throws InputError where
/// a triangle is seen through.
void planByEdges(const ScreenScene& screen, Plan& plan);

}  // namespace edgewise
