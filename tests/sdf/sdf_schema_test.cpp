#include "sdf/sdf_schema.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sdf/tree.h"

namespace edgewise::sdf {
namespace {

using Json = nlohmann::json;

TEST(SdfSchema, ThePublishedOneIsMadeOfTheReadersTables) {
    std::stringstream text;
    text << std::ifstream(EDGEWISE_SDF_TESTS "/../../data/sdf.schema.json").rdbuf();
    EXPECT_TRUE(text.str() == schemaText()) << "run make_scenes data";
}

TEST(SdfSchema, KnowsEveryKindAndEveryNumber) {
    const Json schema = Json::parse(schemaText()), &definitions = schema["$defs"];
    EXPECT_EQ(definitions["node"]["properties"]["type"]["enum"].size(), kindInfos().size());
    EXPECT_EQ(definitions["node"]["allOf"].size(), kindInfos().size());
    std::size_t numbers = 0;
    for (const KindInfo& kind : kindInfos()) {
        const Json& definition = definitions[std::string(kind.name)];
        const Json &properties = definition["properties"], &required = definition["required"];
        EXPECT_EQ(properties["type"]["const"], kind.name);
        EXPECT_EQ(properties.contains("child"), kind.children == KindInfo::Children::kOne);
        EXPECT_EQ(properties.contains("children"), kind.children == KindInfo::Children::kSome);
        for (const NumberInfo& number : kind.numbers) {
            ++numbers;
            const std::string name(number.name);
            ASSERT_TRUE(properties.contains(name)) << kind.name << "." << name;
            EXPECT_EQ(properties[name].value("type", "") == "array", number.vector)
                << kind.name << "." << name;
            const bool must = std::find(required.begin(), required.end(), name) != required.end();
            EXPECT_EQ(must, !number.fallback.has_value()) << kind.name << "." << name;
            EXPECT_EQ(properties[name].contains("default"), number.fallback.has_value());
            const Json& one = number.vector ? properties[name]["items"] : properties[name];
            if (number.rule == Rule::kSwitch) continue;
            EXPECT_EQ(one["maximum"], number.largest);
            EXPECT_EQ(one["type"], number.rule == Rule::kCount ? "integer" : "number");
            EXPECT_EQ(one["minimum"] >= 0.0, number.rule != Rule::kAny && number.rule != Rule::kNotZero);
        }
    }
    EXPECT_GT(numbers, 30u);
}

}  // namespace
}  // namespace edgewise::sdf
