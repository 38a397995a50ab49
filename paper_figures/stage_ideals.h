// The least that each stage of nsaa has to move and compute, beside what it takes.
#pragma once

#include <string>
#include <vector>

#include "paper_figures/machine_rates.h"
#include "pipeline/compare/comparison.h"

namespace edgewise::figures {

/// What every counted thing costs a stage at the least.
struct IdealPart {
    std::string count;  ///< as --stats names it; "pixels" are the picture's
    double bytes = 0.0, flops = 0.0;
    std::string words;
};

struct StageModel {
    std::string stage;
    std::vector<IdealPart> parts;
};

/// A term's operations by the filter: the box's closed form [E1] between two clip points; a radial Gaussian's
/// quadrature of the fewest nodes, a short exponential each. Other filters: the box's.
double flopsPerTerm(const std::string& filter, double radius);

/// In the order in which the stages run.
std::vector<StageModel> stageModels(const std::string& filter, double radius);

struct StageDistance {
    std::string stage;
    double seconds = 0.0;  ///< measured, median
    double bytes = 0.0, flops = 0.0;
    double ideal_seconds = 0.0;  ///< max(bytes/bandwidth, flops/rate): both go on at once
    bool memory_bound = true;
    double distance() const { return seconds / ideal_seconds; }
};

/// Of a row of nsaa with its counts. Stages that it has not are left out.
std::vector<StageDistance> stageDistances(const compare::Row& nsaa, const MachineRates& rates);

/// Nanoseconds a counted thing: (stage, count).
struct UnitCost {
    std::string stage, count, title;
    double number = 0.0, nanoseconds = 0.0;
};
std::vector<UnitCost> unitCosts(const compare::Row& nsaa);

}  // namespace edgewise::figures
