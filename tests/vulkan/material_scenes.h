// Random scenes of a few triangles with every feature that shading knows, and the odd cases of each.
#pragma once

#include <glm/gtc/matrix_transform.hpp>

#include "tests/pipeline/test_scene.h"
#include "tests/witness/dice.h"

namespace edgewise::vulkan::test {

/// What may appear in a scene.
struct MaterialFeatures {
    bool textures = true, lit = true, lights = true, normals = true, colors = true, alpha = true;
};

class MaterialScene {
  public:
    Scene scene;
    ResolvedCamera camera;
    Film film = edgewise::test::makeFilm(64, 64);

    MaterialScene(std::uint64_t seed, const MaterialFeatures& features, int geometries = 12)
        : features_(features), dice_(seed) {
        camera = dice_.coin() ? edgewise::test::makePerspective() : edgewise::test::makeOrthographic(2.0);
        const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), dice_.angle(), glm::normalize(vector(1.0)));
        camera.camera_from_world = glm::translate(glm::dmat4(1.0), vector(0.5)) * turn;
        if (features_.textures)
            for (int i = 0; i < 6; ++i) addImage();
        std::vector<Geometry> all;
        for (int i = 0; i < geometries; ++i) all.push_back(geometry());
        scene_ = edgewise::test::makeScene(std::move(all));
        scene_.images = std::move(images_), scene_.textures = std::move(textures_);
        scene_.materials.clear();
        for (int i = 0; i < geometries; ++i) {
            scene_.geometry[static_cast<std::size_t>(i)].material = static_cast<std::uint32_t>(i);
            scene_.materials.push_back(material());
        }
        if (features_.lights)
            for (int i = dice_.integer(1, 4); i > 0; --i) scene_.lights.push_back(light());
        scene = std::move(scene_);
    }

  private:
    bool chance(double p) { return dice_.uniform(0, 1) < p; }
    glm::dvec3 vector(double size) {
        const double x = dice_.uniform(-size, size), y = dice_.uniform(-size, size),
                     z = dice_.uniform(-size, size);
        return {x, y, z};
    }
    glm::dvec3 color() { return 0.5 + vector(0.5); }
    glm::dmat4 worldFromCamera() const { return glm::inverse(camera.camera_from_world); }

    /// In front of the camera, some across the eye's plane.
    Geometry geometry() {
        std::vector<edgewise::test::Corners> triangles;
        const glm::dvec3 centre = vector(1.5) + glm::dvec3(0, 0, -3);
        const double size = dice_.uniform(0.3, 3.5);
        for (int t = dice_.integer(1, 3); t > 0; --t) {
            edgewise::test::Corners corners;
            for (glm::vec3& p : corners) p = glm::vec3(centre + vector(size));
            triangles.push_back(corners);
        }
        Geometry g = edgewise::test::makeGeometry(triangles, worldFromCamera());
        addStreams(g);
        return g;
    }

    void addStreams(Geometry& g) {
        const std::size_t count = g.position_world.size();
        for (auto& uv : g.uv)
            if (features_.textures && chance(0.8)) fillUv(uv, count);
        if (features_.normals && chance(0.6)) {
            const bool flat = chance(0.2);
            for (std::size_t i = 0; i < count; ++i)
                g.normal_world.push_back(chance(0.1)     ? glm::dvec3(0.0)
                                         : flat && i > 0 ? g.normal_world.back()
                                                         : vector(2.0));
        }
        if (features_.normals && chance(0.4))
            for (std::size_t i = 0; i < count; ++i)
                g.tangent_world.emplace_back(chance(0.1) ? glm::dvec3(0.0) : vector(1.0),
                                             dice_.coin() ? 1.0 : -1.0);
        if (features_.colors && chance(0.5)) {
            const bool flat = chance(0.2);
            for (std::size_t i = 0; i < count; ++i)
                g.color.push_back(flat && i > 0 ? g.color.back()
                                                : glm::dvec4(color(), dice_.uniform(0.3, 1)));
        }
    }

    /// From a texel to many repeats; or a line, whose tangent there is none of.
    void fillUv(std::vector<glm::dvec2>& uv, std::size_t count) {
        const double size = dice_.magnitude(-1.5, 2.0);
        const bool line = chance(0.15);
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec2 p = dice_.around({0.5, 0.5}, size);
            uv.emplace_back(p.x, line ? p.x : p.y);
        }
    }

    void addImage() {
        Image image;
        image.width = dice_.integer(1, 40), image.height = dice_.integer(1, 40);
        const bool one_color = chance(0.15);
        for (int i = 0; i < image.width * image.height; ++i)
            image.texels.push_back(one_color && i > 0 ? image.texels.back()
                                                      : glm::vec4(color(), dice_.uniform(0, 1)));
        images_.push_back(std::move(image));
        for (int i = 0; i < 3; ++i) {
            Texture texture;
            texture.image = static_cast<std::uint32_t>(images_.size() - 1);
            texture.wrap_s = wrap(), texture.wrap_t = wrap();
            texture.mag = filter(), texture.min = filter();
            texture.mip = filter();
            if (chance(0.25)) texture.mip.reset();
            textures_.push_back(texture);
        }
    }
    Wrap wrap() { return static_cast<Wrap>(dice_.integer(0, 2)); }
    TexelFilter filter() { return dice_.coin() ? TexelFilter::kLinear : TexelFilter::kNearest; }

    TextureUse map(double p) {
        TextureUse use;
        if (!features_.textures || !chance(p)) return use;
        use.texture =
            static_cast<std::uint32_t>(dice_.integer(0, static_cast<int>(scene_.textures.size()) - 1));
        use.uv = dice_.integer(0, 1);
        if (dice_.coin()) use.uv_from_vertex = {vector(2.0), vector(2.0), glm::dvec3(vector(1.0))};
        for (int column = 0; column < 3; ++column) use.uv_from_vertex[column].z = column == 2 ? 1.0 : 0.0;
        return use;
    }

    Material material() {
        Material m;
        m.base_color = chance(0.1) ? glm::dvec4(0, 0, 0, 1) : glm::dvec4(color(), dice_.uniform(0.3, 1.0));
        m.base_color_map = map(0.6);
        m.unlit = !features_.lit || chance(0.2);
        m.double_sided = chance(0.9);
        m.metallic = dice_.uniform(0, 1), m.roughness = dice_.uniform(0, 1);
        m.metallic_roughness_map = map(0.4);
        m.normal_map = map(0.5), m.normal_scale = dice_.uniform(-1, 2);
        m.occlusion_map = map(0.4), m.occlusion_strength = dice_.uniform(0, 1);
        if (dice_.coin()) m.emissive = 2.0 * color();
        m.emissive_map = map(0.5);
        if (features_.alpha) m.alpha_mode = static_cast<AlphaMode>(dice_.integer(0, 2));
        return m;
    }

    Light light() {
        Light out;
        out.type = static_cast<Light::Type>(dice_.integer(0, 2));
        out.color = color(), out.intensity = dice_.uniform(0.5, 20);
        if (dice_.coin()) out.range = dice_.uniform(1, 8);
        out.outer_cone_angle = dice_.uniform(0.1, 1.5),
        out.inner_cone_angle = dice_.uniform(0, out.outer_cone_angle);
        out.position_world = glm::dvec3(worldFromCamera() * glm::dvec4(vector(3.0), 1.0));
        out.direction_world = glm::normalize(vector(1.0));
        return out;
    }

    MaterialFeatures features_;
    witness::Dice dice_;
    Scene scene_;
    std::vector<Image> images_;
    std::vector<Texture> textures_;
};

}  // namespace edgewise::vulkan::test
