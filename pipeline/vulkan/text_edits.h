// Changes of a text that keep its lines.
#pragma once

#include <algorithm>
#include <map>
#include <string>

namespace edgewise::vulkan {

/// Insertions and erasures by place in the text.
class Edits {
  public:
    void insert(std::size_t at, std::string text) { edits_.emplace(at, Edit{0, std::move(text)}); }
    void erase(std::size_t begin, std::size_t end) { edits_.emplace(begin, Edit{end - begin, {}}); }
    /// Lines keep their numbers: ends of lines stay.
    std::string apply(const std::string& text) const {
        std::string result;
        std::size_t at = 0;
        for (const auto& [place, edit] : edits_) {
            if (place < at) continue;  // within what was erased
            result.append(text, at, place - at);
            result += edit.text;
            at = place + edit.erased;
            result.append(
                static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(place),
                                                    text.begin() + static_cast<std::ptrdiff_t>(at), '\n')),
                '\n');
        }
        return result.append(text, at);
    }

  private:
    struct Edit {
        std::size_t erased;
        std::string text;
    };
    std::multimap<std::size_t, Edit> edits_;
};

}  // namespace edgewise::vulkan
