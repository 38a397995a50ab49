#include "pipeline/vulkan/user_calls.h"

#include <algorithm>
#include <map>

#include "pipeline/vulkan/user_words.h"

namespace edgewise::vulkan {
namespace {

using Names = std::set<std::string_view>;
using Graph = std::map<std::string_view, Names>;

const Names kEntryPoints{"main", "mainImage", "mainVR", "mainSound", "mainCubemap"};

class Calls {
  public:
    Calls(const std::vector<GlslToken>& tokens, const std::vector<GlslPart>& parts)
        : tokens_(tokens), parts_(parts) {}

    UserCalls run() {
        for (const GlslPart& part : parts_)
            if (part.is_function) callees_[part.name], callers_[part.name];
        Names wanted_roots, unfit;
        std::vector<RefusedWord> refused(parts_.size());
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            const GlslPart& part = parts_[i];
            if (!part.is_function) {
                if (hasValue(part)) wanted_roots.merge(called(part));
                continue;
            }
            refused[i] = refusedWord(part);
            for (const std::string_view callee : called(part))
                callees_[part.name].insert(callee), callers_[callee].insert(part.name);
            if (!refused[i].why.empty()) unfit.insert(part.name);
        }
        for (const std::string_view root : {"map", "albedo"})
            if (callees_.contains(root)) wanted_roots.insert(root);
        const Names wanted = reached(wanted_roots, callees_);
        unfit.merge(reached(entryPoints(), callees_));
        const Names out = reached(without(unfit, wanted), callers_);

        UserCalls result;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            if (!parts_[i].is_function) continue;
            const bool is_wanted = wanted.contains(parts_[i].name);
            if (!is_wanted && (out.contains(parts_[i].name) || !refused[i].why.empty()))
                result.left_out.push_back(i);
            if (!is_wanted || refused[i].why.empty()) continue;
            if (hasFitOverload(parts_[i].name, refused))
                result.left_out.push_back(i);
            else
                result.refused.push_back(refused[i]);
        }
        return result;
    }

  private:
    bool hasValue(const GlslPart& part) const {
        for (std::size_t i = part.first; i < part.last; ++i)
            if (tokens_[i].text == "=") return true;
        return false;
    }
    Names called(const GlslPart& part) const {
        Names names;
        for (std::size_t i = part.is_function ? part.body : part.first; i + 1 < part.last; ++i)
            if (tokens_[i].word && tokens_[i + 1].text == "(" && callees_.contains(tokens_[i].text))
                names.insert(tokens_[i].text);
        return names;
    }
    RefusedWord refusedWord(const GlslPart& part) const {
        for (std::size_t i = part.first; i < part.last; ++i) {
            // A member of that name, or a function of the user's.
            const bool member = i > 0 && tokens_[i - 1].text == ".";
            if (!tokens_[i].word || member || callees_.contains(tokens_[i].text)) continue;
            const std::string_view why =
                whyNotInMaps(tokens_[i].text, i + 1 < part.last && tokens_[i + 1].text == "(");
            if (!why.empty()) return {i, why};
        }
        return {0, {}};
    }
    Names entryPoints() const {
        Names names;
        for (const std::string_view name : kEntryPoints)
            if (callees_.contains(name)) names.insert(name);
        return names;
    }
    static Names reached(const Names& from, const Graph& graph) {
        Names seen = from;
        std::vector<std::string_view> open(from.begin(), from.end());
        while (!open.empty()) {
            const std::string_view name = open.back();
            open.pop_back();
            for (const std::string_view to : graph.at(name))
                if (seen.insert(to).second) open.push_back(to);
        }
        return seen;
    }
    static Names without(const Names& names, const Names& others) {
        Names rest;
        std::ranges::set_difference(names, others, std::inserter(rest, rest.end()));
        return rest;
    }
    bool hasFitOverload(std::string_view name, const std::vector<RefusedWord>& refused) const {
        for (std::size_t i = 0; i < parts_.size(); ++i)
            if (parts_[i].is_function && parts_[i].name == name && refused[i].why.empty()) return true;
        return false;
    }

    const std::vector<GlslToken>& tokens_;
    const std::vector<GlslPart>& parts_;
    Graph callees_, callers_;
};

}  // namespace

UserCalls userCalls(const std::vector<GlslToken>& tokens, const std::vector<GlslPart>& parts) {
    return Calls(tokens, parts).run();
}

}  // namespace edgewise::vulkan
