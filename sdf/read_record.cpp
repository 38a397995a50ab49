#include <algorithm>

#include "sdf/json_reader.h"
#include "sdf/records.h"

namespace edgewise::sdf {
namespace {

std::vector<std::string_view> variantNames(const RecordInfo& info) {
    std::vector<std::string_view> names;
    for (const RecordVariant& variant : info.variants) names.push_back(variant.name);
    return names;
}

std::size_t readVariant(const Json& object, const std::string& path, const RecordInfo& info) {
    const auto type = object.find("type");
    if (type == object.end() && info.type_required) refuse(path + ".type", "must be given");
    return type == object.end() || info.variants.empty()
               ? 0
               : readChoice(*type, path + ".type", variantNames(info));
}

std::vector<NumberInfo> numbersOf(const RecordInfo& info, std::size_t variant) {
    std::vector<NumberInfo> numbers = info.numbers;
    if (!info.variants.empty())
        numbers.insert(numbers.end(), info.variants[variant].numbers.begin(),
                       info.variants[variant].numbers.end());
    return numbers;
}

std::vector<std::string_view> keysOf(const RecordInfo& info, const std::vector<NumberInfo>& numbers) {
    std::vector<std::string_view> keys = info.texts;
    keys.insert(keys.end(), info.flags.begin(), info.flags.end());
    for (const RecordChoice& choice : info.choices) keys.push_back(choice.name);
    for (const NumberInfo& number : numbers) keys.push_back(number.name);
    if (!info.variants.empty()) keys.push_back("type");
    return keys;
}

}  // namespace

Record Record::read(const Json& object, const std::string& path, const RecordInfo& info,
                    const std::vector<std::string_view>& more_keys) {
    requireObject(object, path);
    Record record;
    record.variant = readVariant(object, path, info);
    const std::vector<NumberInfo> numbers = numbersOf(info, record.variant);
    std::vector<std::string_view> known = keysOf(info, numbers);
    known.insert(known.end(), more_keys.begin(), more_keys.end());
    requireKnownKeys(object, path, known);
    const auto read = [&](std::string_view name, auto&& take) {
        const auto found = object.find(std::string(name));
        if (found != object.end())
            take(*found, path.empty() ? std::string(name) : path + "." + std::string(name));
    };
    for (const NumberInfo& number : numbers)
        read(number.name, [&](const Json& value, const std::string& where) {
            readNumbers(value, where, number, record.numbers_[number.name]);
        });
    for (const std::string_view name : info.texts)
        read(name, [&](const Json& value, const std::string& where) {
            record.texts_[name] = readText(value, where);
        });
    for (const std::string_view name : info.flags)
        read(name, [&](const Json& value, const std::string& where) {
            record.flags_[name] = readFlag(value, where);
        });
    for (const RecordChoice& choice : info.choices)
        read(choice.name, [&](const Json& value, const std::string& where) {
            record.choices_[choice.name] = readChoice(value, where, choice.options);
        });
    if (!info.variants.empty())
        for (const std::string_view name : info.variants[record.variant].required)
            if (!record.has(name)) refuse(path + "." + std::string(name), "must be given");
    return record;
}

void Record::take(std::string_view name, double& to) const {
    if (const auto found = numbers_.find(name); found != numbers_.end()) to = found->second[0];
}
void Record::take(std::string_view name, int& to) const {
    if (const auto found = numbers_.find(name); found != numbers_.end())
        to = static_cast<int>(found->second[0]);
}
void Record::take(std::string_view name, glm::dvec3& to) const {
    if (const auto found = numbers_.find(name); found != numbers_.end())
        to = {found->second[0], found->second[1], found->second[2]};
}
void Record::take(std::string_view name, std::string& to) const {
    if (const auto found = texts_.find(name); found != texts_.end()) to = found->second;
}
void Record::take(std::string_view name, bool& to) const {
    if (const auto found = flags_.find(name); found != flags_.end()) to = found->second;
}
std::size_t Record::choice(std::string_view name) const {
    const auto found = choices_.find(name);
    return found == choices_.end() ? 0 : found->second;
}

}  // namespace edgewise::sdf
