#include "pipeline/methods/resolved_parameters.h"

#include <cmath>

#include "pipeline/methods/registry.h"

namespace edgewise {
namespace {

using Json = nlohmann::ordered_json;

/// Whole numbers without a point.
Json numberJson(double value) {
    constexpr double kLargestWhole = 0x1p53;
    if (value != std::floor(value) || std::abs(value) > kLargestWhole) return value;
    return static_cast<std::int64_t>(value);
}

Json valueJson(const std::string& text) {
    const std::optional<double> number = numberIn(text);
    return number ? numberJson(*number) : Json(text);
}

}  // namespace

Json resolvedParameters(const MethodSpec& method) {
    Json json = Json::object();
    if (method.number) json["number"] = *method.number;
    for (const auto& [key, value] : method.parameters) json[key] = valueJson(value);
    for (const MethodSpec& other : method.composed) json[other.name] = resolvedParameters(other);
    if (method.mesh)
        json["mesh"] = {{"error", numberJson(method.mesh->error_px)}, {"mesher", method.mesh->mesher}};
    return json;
}

}  // namespace edgewise
