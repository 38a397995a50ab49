// One element of a glTF file's JSON together with its name in the file, for checks whose errors say where.
#pragma once

#include <fmt/format.h>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "pipeline/error.h"

namespace edgewise {

/// No count, offset or length in a glTF may exceed this: products with a byte stride then fit 64 bits.
inline constexpr std::uint64_t kMaxGltfInteger = std::numeric_limits<std::uint32_t>::max();

/// A view of a JSON value; `where` is "file:" for the root and "file: accessors[3].sparse" below it.
/// Every failure is an InputError that names it.
class GltfElement {
  public:
    GltfElement(nlohmann::json& value, std::string where) : value_(&value), where_(std::move(where)) {}

    nlohmann::json& json() const { return *value_; }
    const std::string& where() const { return where_; }
    [[noreturn]] void fail(const std::string& why) const {
        throw InputError(where_.ends_with(':') ? where_.substr(0, where_.size() - 1) : where_, why);
    }

    bool has(const char* key) const { return value_->contains(key); }

    std::optional<GltfElement> find(const char* key) const {
        const auto found = value_->find(key);
        if (found == value_->end()) return std::nullopt;
        return GltfElement(*found, fmt::format("{}{}{}", where_, where_.ends_with(':') ? " " : ".", key));
    }
    GltfElement need(const char* key) const {
        auto found = find(key);
        if (!found) fail(fmt::format("{} is missing", key));
        return *found;
    }
    std::size_t size() const { return value_->size(); }
    GltfElement at(std::size_t i) const { return {(*value_)[i], fmt::format("{}[{}]", where_, i)}; }

    /// The body of an extension of this element, an object.
    std::optional<GltfElement> extension(const char* name) const {
        const auto extensions = find("extensions");
        if (!extensions) return std::nullopt;
        const auto body = extensions->object().find(name);
        if (body) body->object();
        return body;
    }

    const GltfElement& object() const { return expect(value_->is_object(), "an object"); }
    const GltfElement& array() const { return expect(value_->is_array(), "an array"); }
    std::string string() const {
        expect(value_->is_string(), "a string");
        return value_->get<std::string>();
    }
    bool boolean() const {
        expect(value_->is_boolean(), "true or false");
        return value_->get<bool>();
    }
    double number() const {
        expect(value_->is_number(), "a number");
        return value_->get<double>();
    }
    /// A number that float32 can hold: products of two such stay finite in double.
    double moderate() const {
        const double value = number();
        if (!(std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max())))
            fail(fmt::format("{} is beyond the range of a 32-bit float", value));
        return value;
    }
    /// A whole number in [low, high]. 3.0 is one too (the specification's wish); it is rewritten as 3.
    std::uint64_t integer(std::uint64_t low = 0, std::uint64_t high = kMaxGltfInteger) const {
        const double number_value = number();
        if (number_value != static_cast<double>(static_cast<std::int64_t>(clampToInt53(number_value))))
            fail(fmt::format("{} is not a whole number below 2^32", number_value));
        const auto whole = static_cast<std::int64_t>(number_value);
        if (whole < 0 || static_cast<std::uint64_t>(whole) < low)
            fail(fmt::format("{} is below {}", whole, low));
        if (static_cast<std::uint64_t>(whole) > high) fail(fmt::format("{} is above {}", whole, high));
        *value_ = static_cast<std::uint64_t>(whole);
        return static_cast<std::uint64_t>(whole);
    }
    /// A reference into an array of `count` elements called `what`.
    std::size_t reference(std::size_t count, const char* what) const {
        const std::uint64_t index = integer();
        if (index >= count) fail(fmt::format("{} is out of range: the file has {} {}", index, count, what));
        return index;
    }
    std::uint64_t integerOf(std::initializer_list<std::uint64_t> allowed) const {
        const std::uint64_t found = integer();
        for (const std::uint64_t choice : allowed)
            if (found == choice) return found;
        fail(fmt::format("{} is not one of {}", found, fmt::join(allowed, ", ")));
    }
    std::string stringOf(std::initializer_list<const char*> allowed) const {
        const std::string found = string();
        for (const char* choice : allowed)
            if (found == choice) return found;
        fail(fmt::format("\"{}\" is not one of {}", found, fmt::join(allowed, ", ")));
    }
    void numbers(std::size_t count) const {
        array();
        if (size() != count) fail(fmt::format("has {} numbers, not {}", size(), count));
        for (std::size_t i = 0; i < count; ++i) at(i).number();
    }

    void moderateIf(const char* key) const {
        if (const auto found = find(key)) found->moderate();
    }
    /// `count` moderate numbers, if the key is there.
    void moderatesIf(const char* key, std::size_t count) const {
        const auto found = find(key);
        if (!found) return;
        found->numbers(count);
        for (std::size_t i = 0; i < count; ++i) found->at(i).moderate();
    }

    std::uint64_t integerOr(const char* key, std::uint64_t absent) const {
        const auto found = find(key);
        return found ? found->integer() : absent;
    }
    double numberOr(const char* key, double absent) const {
        const auto found = find(key);
        return found ? found->number() : absent;
    }
    bool booleanOr(const char* key, bool absent) const {
        const auto found = find(key);
        return found ? found->boolean() : absent;
    }
    std::optional<std::size_t> referenceIf(const char* key, std::size_t count, const char* what) const {
        const auto found = find(key);
        if (!found) return std::nullopt;
        return found->reference(count, what);
    }

    /// Calls visit(element) for every element of the array `key`, if there is one.
    template <class Visit>
    void each(const char* key, const Visit& visit) const {
        const auto list = find(key);
        if (!list) return;
        list->array();
        for (std::size_t i = 0; i < list->size(); ++i) visit(list->at(i));
    }

  private:
    const GltfElement& expect(bool holds, const char* wanted) const {
        if (!holds) fail(fmt::format("is {}, not {}", described(), wanted));
        return *this;
    }
    std::string described() const {
        const std::string type = value_->type_name();
        return value_->is_null() ? type : (value_->is_array() || value_->is_object() ? "an " : "a ") + type;
    }
    static double clampToInt53(double number_value) {
        return number_value < -0x1p53 ? -0x1p53 : number_value > 0x1p53 ? 0x1p53 : number_value;
    }

    nlohmann::json* value_;
    std::string where_;
};

}  // namespace edgewise
