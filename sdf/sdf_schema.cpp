#include "sdf/sdf_schema.h"

#include "sdf/load_tree.h"
#include "sdf/number_rules.h"
#include "sdf/records.h"

namespace edgewise::sdf {
namespace {

using Children = KindInfo::Children;

const Json kText{{"type", "string"}, {"maxLength", 255}};

Json reference(const std::string& name) {
    return {{"$ref", "#/$defs/" + name}};
}
Json listOf(const Json& item) {
    return {{"type", "array"}, {"items", item}};
}
/// What an object with that type has to be besides.
Json whenType(std::string_view type, const Json& then) {
    return {{"if", {{"properties", {{"type", {{"const", type}}}}}, {"required", {"type"}}}}, {"then", then}};
}

void addNumbers(Json& properties, const std::vector<NumberInfo>& numbers) {
    for (const NumberInfo& number : numbers) properties[std::string(number.name)] = schemaOf(number);
}

Json recordProperties(const RecordInfo& info) {
    Json properties = Json::object();
    addNumbers(properties, info.numbers);
    for (const RecordChoice& choice : info.choices)
        properties[std::string(choice.name)] = {{"enum", choice.options}, {"default", choice.options[0]}};
    for (const std::string_view text : info.texts) properties[std::string(text)] = kText;
    for (const std::string_view flag : info.flags) properties[std::string(flag)] = {{"type", "boolean"}};
    return properties;
}

Json closed(const Json& properties, const std::vector<std::string_view>& required, std::string_view what) {
    return {{"type", "object"},
            {"description", what},
            {"properties", properties},
            {"required", required},
            {"additionalProperties", false}};
}

/// One schema a variant.
Json recordSchema(const RecordInfo& info) {
    if (info.variants.empty()) return closed(recordProperties(info), {}, info.what);
    Json any = Json::array();
    for (const RecordVariant& variant : info.variants) {
        Json properties = recordProperties(info);
        addNumbers(properties, variant.numbers);
        properties["type"] = {{"const", variant.name}};
        std::vector<std::string_view> required = variant.required;
        if (info.type_required || &variant != &info.variants.front()) required.push_back("type");
        any.push_back(closed(properties, required, info.what));
    }
    return {{"anyOf", any}};
}

Json rotateSchema() {
    Json properties;
    addNumbers(properties, {commonKeys().axis, commonKeys().degrees});
    return closed(properties, {"axis", "degrees"}, "applied after scale, before at");
}

/// Beside a node's own numbers; each a definition of that name.
Json commonDefinitions() {
    Json definitions{{"rotate", rotateSchema()}, {"material-name", kText}};
    addNumbers(definitions, {commonKeys().lipschitz, commonKeys().scale, commonKeys().at});
    // Kinds have these names too.
    for (const char* name : {"rotate", "scale"}) {
        definitions[std::string("node-") + name] = definitions[name];
        definitions.erase(name);
    }
    return definitions;
}

Json kindSchema(const KindInfo& kind) {
    Json properties{{"type", {{"const", kind.name}}},
                    {"material", reference("material-name")},
                    {"rotate", reference("node-rotate")},
                    {"scale", reference("node-scale")},
                    {"at", reference("at")},
                    {"lipschitz", reference("lipschitz")}};
    addNumbers(properties, kind.numbers);
    std::vector<std::string_view> required{"type"};
    for (const NumberInfo& number : kind.numbers)
        if (!number.fallback) required.push_back(number.name);
    if (kind.children == Children::kOne) properties["child"] = reference("node"), required.push_back("child");
    if (kind.children == Children::kSome) {
        properties["children"] = listOf(reference("node"));
        properties["children"]["minItems"] = 1;
        required.push_back("children");
    }
    return closed(properties, required, kind.what);
}

Json nodeSchema() {
    Json names = Json::array(), kinds = Json::array();
    for (const KindInfo& kind : kindInfos()) {
        names.push_back(kind.name);
        kinds.push_back(whenType(kind.name, reference(std::string(kind.name))));
    }
    return {{"type", "object"},
            {"required", {"type"}},
            {"properties", {{"type", {{"enum", names}}}}},
            {"allOf", kinds}};
}

Json materialsSchema() {
    Json named = recordSchema(materialRecord());
    named["properties"]["name"] = kText;
    named["required"] = {"name"};
    return {
        {"anyOf", {{{"type", "object"}, {"additionalProperties", reference("material")}}, listOf(named)}}};
}

Json sceneProperties() {
    Json properties = recordProperties(sceneRecord());
    properties["tree"] = reference("node");
    properties["materials"] = materialsSchema();
    properties["cameras"] = listOf(recordSchema(cameraRecord()));
    properties["lights"] = listOf(recordSchema(lightRecord()));
    properties["analytic"] = listOf(recordSchema(analyticRecord()));
    properties["convex"] = recordSchema(convexRecord());
    return properties;
}

}  // namespace

std::string schemaText() {
    Json schema = closed(sceneProperties(), {"tree"}, "An SDF scene of edgewise (.sdf.json): +y is up");
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
    schema["title"] = "edgewise SDF scene";
    Json& definitions = schema["$defs"];
    definitions = commonDefinitions();
    definitions["node"] = nodeSchema();
    definitions["material"] = recordSchema(materialRecord());
    for (const KindInfo& kind : kindInfos()) definitions[std::string(kind.name)] = kindSchema(kind);
    return schema.dump(1) + "\n";
}

}  // namespace edgewise::sdf
