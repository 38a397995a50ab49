#include "sdf/load_glsl_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <glm/geometric.hpp>
#include <set>

#include "sdf/load_views.h"
#include "sdf/map_header.h"
#include "sdf/number_rules.h"
#include "sdf/scene_error.h"

namespace edgewise::sdf {
namespace {

/// Of a light in the header: white Lambert that faces it shines with 1.
constexpr double kMapLight = 3.14159265358979323846;

glm::dvec3 asVector(const std::vector<double>& n) {
    return {n[0], n[1], n[2]};
}

class HeaderReader {
  public:
    explicit HeaderReader(FieldScene& scene) : scene_(scene) {}

    void read(const HeaderLine& header) {
        header_ = &header;
        if (header.key == "camera") readCamera();
        if (header.key == "light") readLight();
        if (header.key == "background") scene_.background = asVector(once({"", 3, true}));
        if (header.key == "far") scene_.far = positive(once({"", 1, true})[0]);
        if (header.key == "lipschitz") scene_.glsl->lipschitz = positive(once({"", 1, true})[0]);
        if (scene_.background && glm::any(glm::lessThan(*scene_.background, glm::dvec3(0.0))))
            fail("must not be negative");
    }

  private:
    [[noreturn]] void fail(const std::string& rule) const {
        throw SceneError(place(), fmt::format("{}: {}", header_->key, rule));
    }
    std::string place() const { return fmt::format("line {}", header_->line); }

    std::vector<double> once(const HeaderWord& word) {
        if (!seen_.insert(std::string(header_->key)).second) fail("is there twice");
        return readHeaderWords(*header_, {word})[0];
    }
    double positive(double value) const {
        if (!(value >= kSmallest)) fail(fmt::format("must be at least {}, not {}", kSmallest, value));
        return value;
    }

    void readCamera() {
        const auto numbers =
            readHeaderWords(*header_, {{"eye", 3, true}, {"target", 3, true}, {"fovy", 1, false}});
        SurfaceCamera camera;
        camera.eye_world = asVector(numbers[0]), camera.target_world = asVector(numbers[1]);
        if (!numbers[2].empty()) camera.fovy_degrees = positive(numbers[2][0]);
        if (camera.fovy_degrees >= 180.0)
            fail(fmt::format("fovy must be below 180, not {}", camera.fovy_degrees));
        // Straight up or down: as with --eye.
        const glm::dvec3 view = glm::abs(camera.target_world - camera.eye_world);
        if (view.x + view.z <= kSmallest * view.y) camera.up_world = {0.0, 0.0, -1.0};
        requireView(camera, place());
        scene_.cameras.push_back(camera);
    }

    void readLight() {
        const glm::dvec3 direction = asVector(readHeaderWords(*header_, {{"direction", 3, true}})[0]);
        if (!(glm::length(direction) >= kSmallest)) fail("direction must not be all 0");
        SurfaceLight light;
        light.direction_world = glm::normalize(direction);
        light.intensity = kMapLight;
        scene_.lights.push_back(light);
    }

    FieldScene& scene_;
    const HeaderLine* header_ = nullptr;
    std::set<std::string> seen_;
};

constexpr std::string_view kBlanks = " \t\r\n\v\f";

/// The place behind the word, which may follow blanks; npos where something else does.
std::size_t behindWord(std::string_view code, std::size_t at, std::string_view word) {
    const std::size_t begin = std::min(code.find_first_not_of(kBlanks, at), code.size());
    return code.substr(begin).starts_with(word) ? begin + word.size() : code.npos;
}

/// Whether "TYPE NAME (" stands somewhere.
bool namesFunction(std::string_view code, std::string_view type, std::string_view name) {
    const auto partOfWord = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    for (std::size_t at = code.find(type); at != code.npos; at = code.find(type, at + 1)) {
        if (at > 0 && partOfWord(code[at - 1])) continue;
        const std::size_t after = at + type.size();
        if (after == code.size() || kBlanks.find(code[after]) == kBlanks.npos) continue;
        const std::size_t behind = behindWord(code, after, name);
        if (behind != code.npos && behindWord(code, behind, "(") != code.npos) return true;
    }
    return false;
}

/// Without a byte order mark, and with line ends that the compiler counts.
std::string plainText(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    std::string plain(text);
    for (std::size_t at = plain.find('\r'); at != plain.npos; at = plain.find('\r', at + 1))
        if (at + 1 == plain.size() || plain[at + 1] != '\n') plain[at] = '\n';
    return plain;
}

}  // namespace

FieldScene loadGlslMap(std::string_view original, const std::string& file) {
    if (original.size() > kMostMapBytes)
        throw SceneError("the file",
                         fmt::format("must have at most {} bytes, not {}", kMostMapBytes, original.size()));
    if (original.find('\0') != std::string_view::npos) throw SceneError("the file", "has a NUL byte");
    const std::string text = plainText(original);
    FieldScene scene;
    scene.materials.push_back({.name = "default"});
    scene.glsl.emplace().file = file;
    scene.glsl->text = text;
    HeaderReader reader(scene);
    for (const HeaderLine& header : headerLines(text)) reader.read(header);
    if (!scene.lights.empty()) scene.ambient = glm::dvec3(0.15);  // as the default rig's
    const std::string code = withoutComments(text);
    if (!namesFunction(code, "float", "map"))
        throw SceneError("the file", "defines no function float map(vec3 p)");
    scene.glsl->has_albedo = namesFunction(code, "vec3", "albedo");
    return scene;
}

}  // namespace edgewise::sdf
