#include "tests/fuzz/mutate_json.h"

#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/witness/dice.h"

namespace edgewise::fuzz {
namespace {

using Json = nlohmann::json;

void collect(Json& value, std::vector<Json*>& all, int depth = 0) {
    all.push_back(&value);
    if (depth < 64 && value.is_structured())
        for (auto& child : value) collect(child, all, depth + 1);
}

std::size_t pick(witness::Dice& dice, std::size_t count) {
    return static_cast<std::size_t>(dice.integer(0, static_cast<int>(count) - 1));
}

void mutateNumber(Json& value, witness::Dice& dice) {
    const std::array<Json, 20> awkward{0,   1,   2,     3,     4,           5,  6,   7,     8,       16,
                                       255, 256, 65535, 65536, 4294967295u, -1, 0.5, 1e300, -1e-300, 5126};
    if (dice.integer(0, 2) == 0 && value.is_number_integer())
        value = value.get<std::int64_t>() / 2 + dice.integer(-2, 2);
    else
        value = awkward[pick(dice, awkward.size())];
}

void mutateArray(Json& value, witness::Dice& dice) {
    if (value.empty()) return value.push_back(dice.integer(0, 3));
    const std::size_t i = pick(dice, value.size());
    if (dice.integer(0, 1) == 0)
        value.erase(i);
    else
        value.push_back(Json(value[i]));
}

void mutateObject(Json& value, const Json& other, witness::Dice& dice) {
    if (!value.empty() && dice.integer(0, 2) == 0) {
        auto member = value.begin();
        std::advance(member, static_cast<long>(pick(dice, value.size())));
        value.erase(member);
    } else if (other.is_object() && !other.empty()) {
        auto member = other.begin();
        std::advance(member, static_cast<long>(pick(dice, other.size())));
        value[member.key()] = member.value();
    }
}

}  // namespace

std::string mutateJson(const std::string& text, std::uint64_t seed) {
    Json root = Json::parse(text, nullptr, false);
    if (root.is_discarded()) return {};
    witness::Dice dice(seed);
    std::vector<Json*> all;
    collect(root, all);
    Json& value = *all[pick(dice, all.size())];
    const Json other = *all[pick(dice, all.size())];
    if (value.is_number())
        mutateNumber(value, dice);
    else if (value.is_array())
        mutateArray(value, dice);
    else if (value.is_object())
        mutateObject(value, other, dice);
    else
        value = other;
    return root.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace edgewise::fuzz
