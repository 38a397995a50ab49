#include "paper_figures/figure.h"

namespace edgewise::figures {

const std::vector<Figure>& figureRegistry() {
    static const std::vector<Figure> figures{
        {"filter-study", "NSAA, Figure 6, continued",
         "frequency response, ringing, blur and aliasing of every filter", makeFilterStudy},
        {"performance", "ours", "time against error, growth, stages and the distance to the ideal",
         makePerformance},
        {"sphere-tracing", "Enhanced sphere tracing, sections 3 and 4",
         "what relaxation, cones, pruning and Keinert's other enhancements save", makeSphereTracing},
        {"cone-tracing", "Cone-traced supersampling, sections 3 to 5",
         "what cones cost and mend, by kinds of edges, and what lines divide exactly", makeConeTracing},
    };
    return figures;
}

}  // namespace edgewise::figures
