#include "sdf/parse_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "sdf/scene_error.h"

namespace edgewise::sdf {
namespace {

constexpr std::size_t kMostQuoted = 40, kMostMessage = 160;

/// Counts characters that were read, so that errors which the parser does not find itself have a place too.
class CountingIterator {
  public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;
    CountingIterator(const char* at, const char** last) : at_(at), last_(last) {}
    reference operator*() const { return *at_; }
    CountingIterator& operator++() {
        *last_ = at_++;
        return *this;
    }
    CountingIterator operator++(int) {
        const CountingIterator before = *this;
        ++*this;
        return before;
    }
    bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
    bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

  private:
    const char* at_;
    const char** last_;
};

class Builder : public nlohmann::json_sax<Json> {
  public:
    Builder(std::string_view text, const char* const& last) : text_(text), last_(last) {}

    Json take() { return std::move(root_); }

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(number_integer_t value) override { return add(value); }
    bool number_unsigned(number_unsigned_t value) override { return add(value); }
    bool number_float(number_float_t value, const string_t&) override { return add(value); }
    bool string(string_t& value) override { return add(std::move(value)); }
    bool binary(binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open(Json::object()); }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& name) override {
        if (open_.back()->contains(name))
            fail(position(), fmt::format("the key '{}' is there twice", name.substr(0, kMostQuoted)));
        key_ = std::move(name);
        return true;
    }
    bool parse_error(std::size_t at, const std::string&, const nlohmann::detail::exception& error) override {
        fail(at, wordsOf(error.what()));
    }

  private:
    std::size_t position() const { return static_cast<std::size_t>(last_ - text_.data()) + 1; }

    /// `at`: the number of characters read.
    [[noreturn]] void fail(std::size_t at, const std::string& rule) const {
        const std::string_view before = text_.substr(0, std::min(at > 0 ? at - 1 : 0, text_.size()));
        const auto line = 1 + std::count(before.begin(), before.end(), '\n');
        const std::size_t begin = before.rfind('\n');
        const std::size_t column = before.size() - (begin == std::string_view::npos ? 0 : begin + 1) + 1;
        throw SceneError(fmt::format("line {}, column {}", line, column), rule);
    }

    /// Of "[json.exception...] parse error at line 1, column 2: WHAT" the last part.
    static std::string wordsOf(std::string text) {
        std::size_t begin = text.find("] ");
        begin = begin == std::string::npos ? 0 : begin + 2;
        if (text.compare(begin, 20, "parse error at line ") == 0) begin = text.find(": ", begin) + 2;
        text = text.substr(begin);
        return text.size() > kMostMessage ? text.substr(0, kMostMessage) + "..." : text;
    }

    Json* put(Json value) {
        if (open_.empty()) {
            root_ = std::move(value);
            return &root_;
        }
        if (open_.back()->is_object())
            return &open_.back()->get_ref<Json::object_t&>().emplace(key_, std::move(value)).first->second;
        auto& list = open_.back()->get_ref<Json::array_t&>();
        list.push_back(std::move(value));
        return &list.back();
    }
    bool add(Json value) {
        put(std::move(value));
        return true;
    }
    // An element of an array moves when the array grows: only after the element is closed.
    bool open(Json value) {
        if (open_.size() >= kMostJsonLevels)
            fail(position(), fmt::format("arrays and objects nest at most {} deep", kMostJsonLevels));
        open_.push_back(put(std::move(value)));
        return true;
    }
    bool close() {
        open_.pop_back();
        return true;
    }

    std::string_view text_;
    const char* const& last_;
    Json root_;
    std::vector<Json*> open_;
    std::string key_;
};

}  // namespace

Json parseJson(std::string_view text) {
    const char* last = text.data();
    Builder builder(text, last);
    const CountingIterator begin(text.data(), &last), end(text.data() + text.size(), &last);
    Json::sax_parse(begin, end, &builder);
    return builder.take();
}

}  // namespace edgewise::sdf
