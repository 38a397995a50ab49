// What .sdf.json holds beside the tree (materials, cameras, lights, analytic shapes, the scene itself) as
// tables: one for the reader and the schema.
#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sdf/parse_json.h"
#include "sdf/tree.h"

namespace edgewise::sdf {

/// One value of a key, with the numbers that only come with it. A number is required where it is listed so.
struct RecordVariant {
    std::string_view name;
    std::vector<NumberInfo> numbers;
    std::vector<std::string_view> required;
};

struct RecordChoice {
    std::string_view name;
    std::vector<std::string_view> options;  ///< the first is the default
};

struct RecordInfo {
    std::string_view what;                 ///< one line
    std::vector<NumberInfo> numbers = {};  ///< absent ones have field_scene.h's defaults
    std::vector<RecordChoice> choices = {};
    std::vector<std::string_view> texts = {}, flags = {};
    std::vector<RecordVariant> variants = {};  ///< by the key "type"; the first is the default
    bool type_required = false;
};

const RecordInfo& materialRecord();
const RecordInfo& cameraRecord();
const RecordInfo& lightRecord();
const RecordInfo& analyticRecord();
const RecordInfo& convexRecord();
/// The scene's own numbers and flags; its other keys are lists and objects.
const RecordInfo& sceneRecord();

/// What a record's object held.
class Record {
  public:
    /// Throws SceneError. `more_keys` are read by others.
    static Record read(const Json& object, const std::string& path, const RecordInfo& info,
                       const std::vector<std::string_view>& more_keys = {});

    std::size_t variant = 0;  ///< index

    bool has(std::string_view name) const { return numbers_.contains(name); }
    // Absent: `to` is left alone.
    void take(std::string_view name, double& to) const;
    void take(std::string_view name, int& to) const;
    void take(std::string_view name, glm::dvec3& to) const;
    void take(std::string_view name, std::string& to) const;
    void take(std::string_view name, bool& to) const;
    std::size_t choice(std::string_view name) const;

  private:
    std::map<std::string_view, std::vector<double>> numbers_;
    std::map<std::string_view, std::string> texts_;
    std::map<std::string_view, bool> flags_;
    std::map<std::string_view, std::size_t> choices_;
};

}  // namespace edgewise::sdf
