#include "pipeline/cli/exposure_option.h"

#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cmath>

#include "pipeline/cli/parse_values.h"
#include "pipeline/error.h"

namespace edgewise::cli {
namespace {

constexpr double kMaxExposureEv = 1000.0;  // 2^1000 is still a double

}  // namespace

void addExposureOption(CLI::App& command, std::optional<std::string>& text) {
    command.add_option("--exposure", text, "PNG only [0]")->type_name("EV");
}

double readExposure(const std::optional<std::string>& text) {
    const double ev = text ? parseNumber("--exposure", *text) : 0.0;
    if (std::abs(ev) > kMaxExposureEv)
        throw InputError("--exposure", fmt::format("{} is not within +-{}", ev, kMaxExposureEv));
    return ev;
}

}  // namespace edgewise::cli
