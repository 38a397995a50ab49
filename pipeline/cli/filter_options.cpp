#include "pipeline/cli/filter_options.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <stdexcept>

#include "pipeline/cli/parse_values.h"
#include "pipeline/error.h"

namespace edgewise::cli {

void addFilterOptions(CLI::App& command, FilterArguments& arguments) {
    command.add_option("--filter", arguments.name, "`edgewise filters` lists them")
        ->type_name("F")
        ->capture_default_str();
    command.add_option("--radius", arguments.radius, "pixels [the filter's own]")->type_name("R");
    command.add_option("--sigma", arguments.sigma, "pixels, Gaussian filters only [R/3]")->type_name("S");
}

Prefilter readFilter(const FilterArguments& arguments) {
    std::optional<double> radius, sigma;
    if (arguments.radius) radius = parseNumber("--radius", *arguments.radius);
    if (arguments.sigma) sigma = parseNumber("--sigma", *arguments.sigma);
    try {
        return makePrefilter(arguments.name, radius, sigma);
    } catch (const std::invalid_argument& error) {
        throw InputError("--filter", error.what());  // which names the filter
    }
}

}  // namespace edgewise::cli
