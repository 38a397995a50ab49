#include "pipeline/cli/aov_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>

#include "pipeline/error.h"
#include "pipeline/write_image.h"

namespace edgewise::cli {
namespace {

std::string listOfNames() {
    std::vector<std::string> names;
    for (const auto& [name, aov] : aovNames()) names.push_back(name);
    return fmt::format("{}", fmt::join(names, ", "));
}

Aov readAov(const std::string& name) {
    const auto found = std::ranges::find(aovNames(), name, &std::pair<std::string, Aov>::first);
    if (found == aovNames().end())
        throw InputError("--aov", fmt::format("'{}' is none of {}", name, listOfNames()));
    return found->second;
}

}  // namespace

void addAovOptions(CLI::App& command, std::vector<std::string>& names) {
    command
        .add_option(
            "--aov", names,
            fmt::format("more channels in the EXR: {}; repeatable. depth (Z), normal (N, world space) "
                        "and index: of the nearest triangle at the pixel's sample; owners: how many "
                        "have a weight; cryptomatte: exact coverage of nodes and materials",
                        listOfNames()))
        ->type_name("NAME")
        ->allow_extra_args(false);
}

std::set<Aov> readAovs(const std::vector<std::string>& names, const std::vector<std::string>& outputs) {
    std::set<Aov> aovs;
    for (const std::string& name : names) aovs.insert(readAov(name));
    const auto isExr = [](const std::string& path) { return imageFormat(path) == ImageFormat::kExr; };
    if (!aovs.empty() && std::ranges::none_of(outputs, isExr))
        throw InputError("--aov", "needs an output that ends in .exr: PNG holds the colour alone");
    return aovs;
}

}  // namespace edgewise::cli
