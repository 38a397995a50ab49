#include "sdf/number_rules.h"

#include <fmt/format.h>

#include <cmath>

namespace edgewise::sdf {
namespace {

Json componentSchema(const NumberInfo& info) {
    switch (info.rule) {
        case Rule::kPositive:
            return {{"type", "number"}, {"minimum", kSmallest}, {"maximum", info.largest}};
        case Rule::kNotNegative:
            return {{"type", "number"}, {"minimum", 0}, {"maximum", info.largest}};
        case Rule::kCount:
            return {{"type", "integer"}, {"minimum", 0}, {"maximum", info.largest}};
        case Rule::kSwitch:
            return {{"enum", {0, 1}}};
        case Rule::kAny:
        case Rule::kNotZero:
            break;
    }
    return {{"type", "number"}, {"minimum", -info.largest}, {"maximum", info.largest}};
}

}  // namespace

std::string ruleOf(const NumberInfo& info) {
    switch (info.rule) {
        case Rule::kPositive:
            return fmt::format("from {} to {}", kSmallest, info.largest);
        case Rule::kNotNegative:
            return fmt::format("from 0 to {}", info.largest);
        case Rule::kCount:
            return fmt::format("whole, from 0 to {}", info.largest);
        case Rule::kSwitch:
            return "0 or 1";
        case Rule::kAny:
        case Rule::kNotZero:
            break;
    }
    return fmt::format("from {} to {}", -info.largest, info.largest);
}

bool obeys(const NumberInfo& info, double value) {
    if (!(std::abs(value) <= info.largest)) return false;
    switch (info.rule) {
        case Rule::kPositive:
            return value >= kSmallest;
        case Rule::kNotNegative:
            return value >= 0.0;
        case Rule::kCount:
            return value >= 0.0 && value == std::floor(value);
        case Rule::kSwitch:
            return value == 0.0 || value == 1.0;
        case Rule::kAny:
        case Rule::kNotZero:
            break;
    }
    return true;
}

Json schemaOf(const NumberInfo& info) {
    Json schema = componentSchema(info);
    if (info.vector) schema = {{"type", "array"}, {"items", schema}, {"minItems", 3}, {"maxItems", 3}};
    // A vector's length is at least its largest component.
    if (info.rule == Rule::kNotZero)
        schema["contains"] = {{"anyOf", {{{"minimum", kSmallest}}, {{"maximum", -kSmallest}}}}};
    if (info.fallback)
        schema["default"] = info.vector ? Json(std::vector<double>(3, *info.fallback)) : Json(*info.fallback);
    return schema;
}

}  // namespace edgewise::sdf
