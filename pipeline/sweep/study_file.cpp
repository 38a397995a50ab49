#include "pipeline/sweep/study_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <toml++/toml.h>
#include <set>

#include "pipeline/error.h"
#include "pipeline/read_file.h"

namespace edgewise::sweep {
namespace {

enum class Type { kText, kInteger, kNumber, kTriple };

const std::map<std::string, Type> kLists{{"scenes", Type::kText},  {"methods", Type::kText},
                                         {"radii", Type::kNumber}, {"sigmas", Type::kNumber},
                                         {"sizes", Type::kText},   {"no_skip", Type::kText}};
const std::map<std::string, Type> kOptions{
    {"reference", Type::kText},    {"runs", Type::kInteger},    {"budget", Type::kNumber},
    {"device", Type::kText},       {"precision", Type::kText},  {"shading", Type::kText},
    {"background", Type::kTriple}, {"threads", Type::kInteger}, {"memory", Type::kInteger},
    {"seed", Type::kInteger},      {"frames", Type::kInteger}};
const std::map<std::string, Type> kFilterKeys{
    {"name", Type::kText}, {"radius", Type::kNumber}, {"sigma", Type::kNumber}};
const std::map<std::string, Type> kCameraKeys{
    {"name", Type::kText}, {"eye", Type::kTriple}, {"target", Type::kTriple}, {"fovy", Type::kNumber}};

int lineOf(const toml::node& node) {
    return static_cast<int>(node.source().begin.line);
}
int lineOf(const toml::key& key) {
    return static_cast<int>(key.source().begin.line);
}

const char* nameOf(Type type) {
    switch (type) {
        case Type::kText:
            return "a text";
        case Type::kInteger:
            return "a whole number";
        case Type::kNumber:
            return "a number";
        case Type::kTriple:
            return "three numbers, as in [1, 0.5, 0]";
    }
    return "";
}

std::optional<std::string> numberText(const toml::node& node) {
    if (!node.is_number()) return {};
    return fmt::format("{}", *node.value<double>());
}

/// As a flag would take it; none for another type.
std::optional<std::string> textOf(const toml::node& node, Type type) {
    if (type == Type::kText) return node.value_exact<std::string>();
    if (type == Type::kNumber) return numberText(node);
    if (type == Type::kInteger)
        return node.is_integer() ? std::optional(fmt::format("{}", *node.value<std::int64_t>()))
                                 : std::nullopt;
    const toml::array* array = node.as_array();
    if (!array || array->size() != 3) return {};
    std::vector<std::string> numbers;
    for (const toml::node& element : *array) {
        const auto number = numberText(element);
        if (!number) return {};
        numbers.push_back(*number);
    }
    return fmt::format("{}", fmt::join(numbers, ","));
}

class Reader {
  public:
    explicit Reader(StudyProblems& problems) : problems_(problems) {}

    StudyFile read(const toml::table& root) {
        for (const auto& [key, node] : root) {
            const std::string name(key.str());
            study_.keys[name] = lineOf(key);
            readKey(name, node);
        }
        for (const char* key : {"scenes", "methods"})
            if (!study_.keys.contains(key)) problems_.add(1, key, "is missing: a study needs some");
        return std::move(study_);
    }

  private:
    void readKey(const std::string& name, const toml::node& node) {
        if (const auto list = kLists.find(name); list != kLists.end())
            forEach(name, node, [&](const toml::node& element) {
                if (const auto entry = take(element, name, list->second))
                    study_.lists[name].push_back(*entry);
            });
        else if (const auto option = kOptions.find(name); option != kOptions.end()) {
            if (const auto entry = take(node, name, option->second)) study_.options[name] = *entry;
        } else if (name == "filters")
            forEach(name, node, [&](const toml::node& element) { readFilter(element); });
        else if (name == "cameras")
            forEach(name, node, [&](const toml::node& element) { readCamera(element); });
        else
            refuse(name);
    }

    void refuse(const std::string& name) {
        std::set<std::string> known{"filters", "cameras"};
        for (const auto& [key, type] : kLists) known.insert(key);
        for (const auto& [key, type] : kOptions) known.insert(key);
        problems_.add(study_.keys[name], name,
                      fmt::format("is no key of a study; those are {}", fmt::join(known, ", ")));
    }

    template <class Take>
    void forEach(const std::string& name, const toml::node& node, Take&& each) {
        const toml::array* array = node.as_array();
        if (!array) return problems_.add(lineOf(node), name, "is not a list");
        if (array->empty()) return problems_.add(lineOf(node), name, "is an empty list");
        for (const toml::node& element : *array) each(element);
    }

    std::optional<Entry> take(const toml::node& node, const std::string& name, Type type) {
        if (const auto text = textOf(node, type)) return Entry{*text, lineOf(node)};
        problems_.add(lineOf(node), name, fmt::format("must be {}", nameOf(type)));
        return {};
    }

    /// The values of a table whose keys are known; none where one is not.
    std::optional<std::map<std::string, Entry>> takeTable(const toml::table& table, const std::string& name,
                                                          const std::map<std::string, Type>& keys) {
        std::map<std::string, Entry> values;
        bool good = true;
        for (const auto& [key, node] : table) {
            const std::string inner = fmt::format("{}.{}", name, key.str());
            const auto known = keys.find(std::string(key.str()));
            std::vector<std::string> names;
            for (const auto& [each, type] : keys) names.push_back(each);
            if (known == keys.end()) {
                problems_.add(lineOf(key), inner, fmt::format("is unknown; {} are", fmt::join(names, ", ")));
                good = false;
            } else if (const auto entry = take(node, inner, known->second))
                values[known->first] = *entry;
            else
                good = false;
        }
        return good ? std::optional(values) : std::nullopt;
    }

    static std::optional<Entry> part(const std::map<std::string, Entry>& values, const char* key) {
        const auto found = values.find(key);
        return found == values.end() ? std::nullopt : std::optional(found->second);
    }
    static std::optional<std::string> text(const std::optional<Entry>& entry) {
        return entry ? std::optional(entry->text) : std::nullopt;
    }

    void readFilter(const toml::node& node) {
        if (const auto name = textOf(node, Type::kText)) {
            study_.filters.push_back({{*name, lineOf(node)}, {}, {}});
        } else if (const toml::table* table = node.as_table()) {
            const auto values = takeTable(*table, "filters", kFilterKeys);
            if (!values) return;
            const auto name_entry = part(*values, "name");
            if (!name_entry) return problems_.add(lineOf(node), "filters", "has a filter without a name");
            study_.filters.push_back({*name_entry, part(*values, "radius"), part(*values, "sigma")});
        } else
            problems_.add(lineOf(node), "filters", "must be texts or tables {name, radius, sigma}");
    }

    void readCamera(const toml::node& node) {
        std::optional<std::string> name = textOf(node, Type::kText);
        if (!name) name = textOf(node, Type::kInteger);
        if (name) {
            if (name->empty()) return problems_.add(lineOf(node), "cameras", "has a camera without a name");
            study_.cameras.push_back({*name, lineOf(node), *name, {}, {}, {}});
        } else if (const toml::table* table = node.as_table())
            readOwnCamera(*table);
        else
            problems_.add(lineOf(node), "cameras", "must be names, numbers or tables {eye, target, fovy}");
    }

    void readOwnCamera(const toml::table& table) {
        const auto values = takeTable(table, "cameras", kCameraKeys);
        if (!values) return;
        CameraEntry camera;
        camera.line = lineOf(table);
        camera.eye = text(part(*values, "eye")), camera.target = text(part(*values, "target"));
        camera.fovy = text(part(*values, "fovy"));
        const auto word = [](const char* key, const std::optional<std::string>& value) {
            return value ? fmt::format("{} {} ", key, *value) : "";
        };
        camera.label = text(part(*values, "name"))
                           .value_or(word("eye", camera.eye) + word("target", camera.target) +
                                     word("fovy", camera.fovy));
        while (camera.label.ends_with(' ')) camera.label.pop_back();
        if (!camera.eye && !camera.target && !camera.fovy)
            return problems_.add(camera.line, "cameras", "has a table without eye, target or fovy");
        study_.cameras.push_back(camera);
    }

    StudyProblems& problems_;
    StudyFile study_;
};

}  // namespace

const std::vector<Entry>& StudyFile::list(const std::string& key) const {
    static const std::vector<Entry> none;
    const auto found = lists.find(key);
    return found == lists.end() ? none : found->second;
}

std::optional<std::string> StudyFile::option(const std::string& key) const {
    const auto found = options.find(key);
    return found == options.end() ? std::nullopt : std::optional(found->second.text);
}

int StudyFile::lineOf(const std::string& key) const {
    const auto found = keys.find(key);
    return found == keys.end() ? 1 : found->second;
}

StudyFile readStudyFile(const std::string& path, StudyProblems& problems) {
    const std::string text = readText(path);
    try {
        return Reader(problems).read(toml::parse(text, path));
    } catch (const toml::parse_error& error) {
        throw InputError(fmt::format("{}:{}", path, error.source().begin.line),
                         std::string(error.description()));
    }
}

}  // namespace edgewise::sweep
