#include "paper_figures/figure.h"

namespace edgewise::figures {

const std::vector<Figure>& figureRegistry() {
    static const std::vector<Figure> figures{
        {"filter-study", "NSAA, Figure 6, continued",
         "frequency response, ringing, blur and aliasing of every filter", makeFilterStudy},
        {"performance", "ours", "time against error, growth, stages and the distance to the ideal",
         makePerformance},
    };
    return figures;
}

}  // namespace edgewise::figures
