#include "sdf/records.h"

namespace edgewise::sdf {
namespace {

/// A share: from 0 to 1.
NumberInfo share(std::string_view name, bool vector = false) {
    return {name, vector, Rule::kNotNegative, {}, 1.0};
}
NumberInfo notNegative(std::string_view name, bool vector = false) {
    return {name, vector, Rule::kNotNegative};
}
NumberInfo positive(std::string_view name, double largest = 1e6) {
    return {name, false, Rule::kPositive, {}, largest};
}
NumberInfo anyVector(std::string_view name) {
    return {name, true, Rule::kAny};
}
NumberInfo directionVector(std::string_view name) {
    return {name, true, Rule::kNotZero};
}

}  // namespace

const RecordInfo& materialRecord() {
    static const RecordInfo info{
        .what = "how a surface looks; colours are linear Rec.709",
        .numbers = {share("color", true), share("second_color", true), positive("pattern_size"),
                    directionVector("pattern_axis"), share("specular", true), positive("shininess"),
                    share("reflectance"), share("transmittance"), positive("ior", 10.0),
                    notNegative("absorption", true), notNegative("emission", true)},
        .choices = {{"shading", {"lambert", "blinn-phong", "unlit"}},
                    {"pattern", {"none", "checker", "stripes"}}},
    };
    return info;
}

const RecordInfo& cameraRecord() {
    static const RecordInfo info{
        .what = "looks from the eye at the target",
        .numbers = {anyVector("eye"), anyVector("target"), directionVector("up")},
        .texts = {"name"},
        .variants = {{"perspective", {positive("fovy", 179.0)}, {"eye", "target"}},
                     {"orthographic", {positive("ymag")}, {"eye", "target", "ymag"}}},
    };
    return info;
}

const RecordInfo& lightRecord() {
    static const RecordInfo info{
        .what = "lux where directional, candela where a point",
        .numbers = {share("color", true), notNegative("intensity")},
        .flags = {"shadows"},
        .variants = {{"directional", {directionVector("direction")}, {"direction"}},
                     {"point", {anyVector("position")}, {"position"}}},
    };
    return info;
}

const RecordInfo& analyticRecord() {
    static const RecordInfo info{
        .what = "what rays meet in closed form, beside the field",
        .texts = {"material"},
        .variants = {{"sphere", {anyVector("center"), positive("radius")}, {"center", "radius"}},
                     {"plane", {directionVector("normal"), {"offset"}}, {"normal"}}},
        .type_required = true,
    };
    return info;
}

const RecordInfo& convexRecord() {
    static const RecordInfo info{
        .what = "the whole tree is one convex solid within this sphere",
        .variants = {{"sphere", {anyVector("center"), positive("radius")}, {"center", "radius"}}},
    };
    return info;
}

const RecordInfo& sceneRecord() {
    static const RecordInfo info{
        .what = "an SDF scene",
        .numbers = {notNegative("ambient", true),
                    notNegative("background", true),
                    positive("far"),
                    {"reflections", false, Rule::kCount, {}, 64.0},
                    {"refractions", false, Rule::kCount, {}, 64.0}},
        .texts = {"$schema", "title"},
        .flags = {"path_traced"},
    };
    return info;
}

}  // namespace edgewise::sdf
