// What the plan leaves out of a scene, and what that saves.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "paper_figures/figure_plot.h"
#include "pipeline/compare/comparison.h"

namespace edgewise::figures {

/// A scene made as planned, then without each of the plan's savings.
struct PlannerScene {
    std::string name;
    bool field = false;
    struct Forced {
        std::string name;  ///< as --no-skip takes it, or a switch of `sphere`
        compare::Row row;
    };
    compare::Row planned;
    std::vector<Forced> forced;
};

struct Planner {
    bool quick = false;
    int runs = 0;
    double budget_seconds = 0.0;  ///< a scene's variant
    std::vector<PlannerScene> scenes;
    std::vector<std::string> notes;
};

/// What one omission saves on one scene.
struct Saving {
    std::string scene, name;
    bool field = false;
    bool used = true;             ///< the plan makes use of it here
    std::string why;              ///< in the plan's words
    std::optional<double> ratio;  ///< time without it over time as planned; none where a run is missing
    bool at_least = false;        ///< it met the budget: the ratio is the least that it can be
    std::string stage;            ///< that gains most
    double stage_without = 0.0, stage_planned = 0.0;  ///< its medians, s
};

std::vector<Saving> savingsOf(const Planner& found);

std::vector<FigurePlot> plannerPlots(const Planner& found);
std::string plannerHtml(const Planner& found, const std::vector<FigurePlot>& plots);
std::string plannerCsv(const Planner& found);

}  // namespace edgewise::figures
