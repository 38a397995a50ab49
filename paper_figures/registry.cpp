#include "paper_figures/figure.h"

namespace edgewise::figures {

const std::vector<Figure>& figureRegistry() {
    static const std::vector<Figure> figures{
        {"nsaa-1", "NSAA, Figure 1", "multisampling and the exact integral on one pixel", makeNsaaPixel},
        {"nsaa-2", "NSAA, Figure 2", "the pipeline with its intermediate buffers", makeNsaaStages},
        {"nsaa-3", "NSAA, Figure 3", "conservative area, thickening and clipping box", makeNsaaGather},
        {"nsaa-4", "NSAA, Figure 4", "the zone plate by nsaa, multisampling and smaa", makeNsaaZonePlate},
        {"nsaa-5", "NSAA, Figure 5", "the log grid, likewise", makeNsaaLogGrid},
        {"nsaa-6", "NSAA, Figure 6", "disk, cone and Gaussian of radius 2 beside csaa", makeNsaaFilters},
        {"nsaa-7", "NSAA, Figure 7", "a sequence of tori, textured and lit", makeNsaaTori},
        {"nsaa-times", "NSAA, section 4.3", "shares of time, and memory", makeNsaaTimes},
        {"filter-study", "NSAA, Figure 6, continued",
         "frequency response, ringing, blur and aliasing of every filter", makeFilterStudy},
        {"performance", "ours", "time against error, growth, stages and the distance to the ideal",
         makePerformance},
        {"error-time", "ours", "error against run time of every method on every scene", makeErrorTime},
#ifdef EDGEWISE_HAS_ORACLE
        {"shared-geometry", "ours", "triangle methods and SDF methods on the same four scenes",
         makeSharedGeometry},
        {"stability", "ours", "the stability atlas: error against condition over stiff and extreme cases",
         makeStability},
#endif
        {"planner", "ours", "what the plan leaves out of a scene, and what that saves", makePlanner},
        {"sphere-tracing", "Enhanced sphere tracing, sections 3 and 4",
         "what relaxation, cones, pruning and Keinert's other enhancements save", makeSphereTracing},
        {"sphere-drawn", "Enhanced sphere tracing, Figures 2 to 6", "rays drawn step by step",
         makeSphereDrawn},
        {"sphere-scenes", "Enhanced sphere tracing, Figures 1, 10 and 11", "scenes of those kinds",
         makeSphereScenes},
        {"lottes", "Lottes' sphere tracing antialiasing", "frame by frame and averaged, with the 11 rays",
         makeLottes},
        {"cone-drawn", "Cone-traced supersampling, Figures 2 to 4, 6 and 7", "a cone drawn step by step",
         makeConeDrawn},
        {"cone-scenes", "Cone-traced supersampling, Figures 1, 5 and 10",
         "pictures with parts enlarged, by kinds of edges", makeConeScenes},
        {"cone-table", "Cone-traced supersampling, Table 1", "times of five scenes at two sizes",
         makeConeTable},
        {"cone-tracing", "Cone-traced supersampling, sections 3 to 5",
         "error against run time of methods for SDF scenes by kinds of edges, and what is claimed of it",
         makeConeTracing},
        {"cone-beyond", "ours", "ctss-x against CTSS: edges of each kind side by side", makeConeBeyond},
    };
    return figures;
}

}  // namespace edgewise::figures
