#include "pipeline/vulkan/scene_upload.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

namespace edgewise::vulkan {
namespace {

constexpr std::size_t kBankTexels = std::size_t{1} << kBankBits;

/// The roles of a material's maps that can change its colour.
struct MapUse {
    const TextureUse* use;
    std::uint32_t role;
};

class TableMaker {
  public:
    explicit TableMaker(const ShadedScene& from) : from_(from), lit_rig_(from.shading.lighting().isRig()) {
        out_.owners.resize(from.pieces.first.size() - 1);
        out_.materials.resize(from.scene.materials.size());
        material_is_made_.resize(from.scene.materials.size());
    }

    ShadeTables make() {
        for (const Geometry& geometry : from_.scene.geometry) addGeometry(geometry);
        if (uses(kUsesLight)) addPlaneNormals(), addLights();
        fillFrame();
        if (from_.points) use(kUsesPoints);
        const auto& see_through = from_.screen.see_through;
        if (std::any_of(see_through.begin(), see_through.end(), [](auto s) { return s != 0; }))
            use(kUsesStacks);
        for (const OwnerRecord& owner : out_.owners)
            out_.most_turns = std::max(out_.most_turns, turnsOf(owner));
        return std::move(out_);
    }

  private:
    void use(std::uint32_t what) { out_.uses |= what; }
    bool uses(std::uint32_t what) const { return (out_.uses & what) != 0; }

    /// As shade.comp counts them.
    std::size_t turnsOf(const OwnerRecord& owner) const {
        if (owner.flags & kFromTable) return 1;
        const std::uint32_t maps =
            out_.surfaces.empty() ? 0 : out_.materials[out_.surfaces[owner.surface].material].maps;
        return std::size_t{5} * owner.pieces + maps + out_.lights.size() + 5;
    }

    void addGeometry(const Geometry& geometry) {
        bool shaded = false, varies = false;
        for (std::size_t t = 0; t < geometry.triangles.size(); ++t) {
            const auto owner = static_cast<Owner>(geometry.first_triangle + t);
            if (from_.pieces.first[owner] == from_.pieces.first[owner + 1]) continue;
            if (takeFromTable(owner)) continue;
            const bool constant = from_.constant.empty() && !from_.shading.varies(owner);
            addOwner(owner, geometry.triangles[t], constant);
            shaded = true, varies |= !constant;
        }
        if (shaded) addSurface(geometry, varies);
    }

    bool takeFromTable(Owner owner) {
        if (from_.constant.empty() || !from_.constant[owner]) return false;
        const Shade& shade = *from_.constant[owner];
        const std::array<double, 4> rgba{shade.color.r, shade.color.g, shade.color.b, shade.alpha};
        if (out_.table.empty() || !std::equal(rgba.begin(), rgba.end(), out_.table.end() - 4))
            out_.table.insert(out_.table.end(), rgba.begin(), rgba.end());
        OwnerRecord& record = out_.owners[owner];
        record.first = static_cast<std::uint32_t>(out_.table.size() / 4 - 1);
        record.flags = kFromTable;
        use(kUsesTable);
        return true;
    }

    void addOwner(Owner owner, const std::array<std::uint32_t, 3>& vertex, bool constant) {
        const std::uint32_t first = from_.pieces.first[owner];
        std::uint32_t flags = from_.pieces.back_facing[owner] ? kBackFacing : 0;
        if (constant) flags |= kConstantShade;
        out_.owners[owner] = {vertex[0],
                              vertex[1],
                              vertex[2],
                              static_cast<std::uint32_t>(out_.surfaces.size()),
                              first,
                              from_.pieces.first[owner + 1] - first,
                              from_.screen.triangles[first].plane,
                              flags};
        use(kUsesShading | (constant ? 0 : kUsesVarying));
    }

    std::vector<MapUse> mapsOf(const Material& m) const {
        std::vector<MapUse> all{{&m.base_color_map, kBaseMap}};
        if (!m.unlit) {
            all.push_back({&m.metallic_roughness_map, kMetallicRoughnessMap});
            if (lit_rig_) all.push_back({&m.occlusion_map, kOcclusionMap});
            if (m.emissive != glm::dvec3(0.0)) all.push_back({&m.emissive_map, kEmissiveMap});
            all.push_back({&m.normal_map, kNormalMap});
        }
        std::erase_if(all, [&](const MapUse& map) {
            return !map.use->present() || from_.scene.textures[map.use->texture].image == kNone;
        });
        return all;
    }

    void addMaterial(std::uint32_t index) {
        if (material_is_made_[index]) return;
        material_is_made_[index] = true;
        const Material& m = from_.scene.materials[index];
        MaterialRecord& out = out_.materials[index];
        out = {m.base_color.r,
               m.base_color.g,
               m.base_color.b,
               m.base_color.a,
               m.metallic,
               m.roughness,
               m.normal_scale,
               m.occlusion_strength,
               m.emissive.r,
               m.emissive.g,
               m.emissive.b,
               m.alpha_cutoff,
               modeOf(m),
               m.unlit ? 1u : 0u,
               static_cast<std::uint32_t>(out_.maps.size()),
               0};
        for (const MapUse& map : mapsOf(m)) addMap(map);
        out.maps = static_cast<std::uint32_t>(out_.maps.size()) - out.first_map;
        if (!m.unlit) use(kUsesLight);
        if (out.alpha_mode != kOpaqueMode) use(kUsesAlpha);
    }

    static std::uint32_t modeOf(const Material& m) {
        if (m.alpha_mode == AlphaMode::kMask) return kMaskMode;
        return m.alpha_mode == AlphaMode::kBlend ? kBlendMode : kOpaqueMode;
    }

    void addMap(const MapUse& map) {
        const TexelKind kind = map.role == kNormalMap ? TexelKind::kNormal : TexelKind::kValue;
        const Texture& texture = from_.scene.textures[map.use->texture];
        const MipPyramid& pyramid = from_.shading.pyramid(texture.image, kind);
        const glm::dmat3& m = map.use->uv_from_vertex;
        MapRecord out{m[0][0],
                      m[0][1],
                      m[1][0],
                      m[1][1],
                      m[2][0],
                      m[2][1],
                      map.role,
                      static_cast<std::uint32_t>(map.use->uv),
                      static_cast<int>(texture.wrap_s),
                      static_cast<int>(texture.wrap_t),
                      static_cast<int>(texture.mag),
                      static_cast<int>(texture.min),
                      texture.mip ? static_cast<int>(*texture.mip) : -1,
                      pyramid.levels(),
                      levelsOf(pyramid),
                      0};
        // one colour is that colour, not a mean of itself
        if (pyramid.uniform()) out.mag = out.min = static_cast<int>(TexelFilter::kNearest), out.mip = -1;
        out_.maps.push_back(out);
        use(kUsesTextures | (map.role == kNormalMap ? kUsesNormalMaps : 0));
    }

    /// The first level's record; a pyramid that several maps use is there once. Of one colour, its one texel.
    std::uint32_t levelsOf(const MipPyramid& pyramid) {
        const auto first = static_cast<std::uint32_t>(out_.levels.size());
        const auto [known, is_new] = pyramids_.try_emplace(&pyramid, first);
        if (!is_new) return known->second;
        for (int i = 0; i < pyramid.levels(); ++i) {
            const Image& image = pyramid.level(i);
            const bool one = pyramid.uniform().has_value();
            out_.levels.push_back(
                {one ? 1 : image.width, one ? 1 : image.height, static_cast<std::uint32_t>(texels_), 0});
            addTexels(std::span(image.texels).first(one ? 1 : image.texels.size()));
        }
        return first;
    }

    void addTexels(std::span<const glm::vec4> texels) {
        texels_ += texels.size();
        while (!texels.empty()) {
            if (out_.banks.empty() || out_.banks.back().size() == kBankTexels) out_.banks.emplace_back();
            std::vector<glm::vec4>& bank = out_.banks.back();
            const std::size_t count = std::min(texels.size(), kBankTexels - bank.size());
            bank.insert(bank.end(), texels.begin(), texels.begin() + static_cast<std::ptrdiff_t>(count));
            texels = texels.subspan(count);
        }
    }

    /// The streams that the geometry's material asks for.
    void addSurface(const Geometry& g, bool varies) {
        addMaterial(g.material);
        const Material& material = from_.scene.materials[g.material];
        bool wants[2] = {false, false}, bumps = false;
        for (const MapUse& map : mapsOf(material)) {
            wants[map.use->uv] = true;
            bumps |= map.role == kNormalMap && !g.uv[map.use->uv].empty();
        }
        SurfaceRecord out{g.material, kAbsent, kAbsent, kAbsent, kAbsent, kAbsent, kAbsent, 0};
        if (varies || bumps) out.positions = addPositions(g);
        if (!material.unlit && !g.normal_world.empty()) out.normals = addNormals(g), use(kUsesVertexNormals);
        if (bumps && !g.tangent_world.empty()) out.tangents = addStream<4>(g.tangent_world);
        if (wants[0] && !g.uv[0].empty()) out.uv0 = addStream<2>(g.uv[0]);
        if (wants[1] && !g.uv[1].empty()) out.uv1 = addStream<2>(g.uv[1]);
        if (!g.color.empty()) out.colors = addStream<4>(g.color), use(kUsesVertexColors);
        out_.surfaces.push_back(out);
    }

    std::uint32_t addPositions(const Geometry& g) {
        const auto first = static_cast<std::uint32_t>(out_.positions.size());
        for (const glm::dvec3& world : g.position_world) {
            const glm::dvec3 eye(from_.camera.camera_from_world * glm::dvec4(world, 1.0));
            for (int k = 0; k < 3; ++k) out_.positions.push_back(eye[k]);
        }
        return first;
    }

    std::uint32_t addNormals(const Geometry& g) {
        const auto first = static_cast<std::uint32_t>(out_.attributes.size());
        for (const glm::dvec3& world : g.normal_world) {
            const glm::dvec3 eye = f64::unitOrZero(glm::dmat3(from_.camera.camera_from_world) * world);
            for (int k = 0; k < 3; ++k) out_.attributes.push_back(eye[k]);
        }
        return first;
    }

    template <int kSize, class Vector>
    std::uint32_t addStream(const std::vector<Vector>& values) {
        static_assert(Vector::length() == kSize);
        const auto first = static_cast<std::uint32_t>(out_.attributes.size());
        for (const Vector& v : values)
            for (int k = 0; k < kSize; ++k) out_.attributes.push_back(v[k]);
        return first;
    }

    void addPlaneNormals() {
        for (const glm::dvec3& n : from_.pieces.plane_normal_eye)
            out_.plane_normals.insert(out_.plane_normals.end(), {n.x, n.y, n.z});
    }

    void addLights() {
        for (const EyeLight& l : from_.shading.lighting().lights()) {
            out_.lights.push_back({l.position.x, l.position.y, l.position.z, l.along.x, l.along.y, l.along.z,
                                   l.strength.r, l.strength.g, l.strength.b, l.range, l.cos_outer, l.scale,
                                   l.type, 0});
            if (l.type != f64::kDirectionalLight) use(kUsesPositionalLights);
        }
    }

    void fillFrame() {
        const ScreenMap& map = from_.shading.screenMap();
        ShadeFrame& f = out_.frame;
        f.scale_px = map.scale_px;
        f.whole_x = map.whole_px.x, f.whole_y = map.whole_px.y;
        f.fraction_x = map.fraction_px.x, f.fraction_y = map.fraction_px.y;
        f.offset_x = map.offset_px.x, f.offset_y = map.offset_px.y;
        f.background_r = from_.background.r, f.background_g = from_.background.g;
        f.background_b = from_.background.b;
        f.ambient = lit_rig_ ? kRigAmbient : 0.0;
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row)
                f.eye_from_world[3 * column + row] = from_.camera.camera_from_world[column][row];
        f.perspective = map.perspective;
        f.uniform_view = from_.shading.lighting().viewIsUniform();
        f.lights = static_cast<std::uint32_t>(out_.lights.size());
    }

    const ShadedScene& from_;
    const bool lit_rig_;
    ShadeTables out_;
    std::vector<bool> material_is_made_;
    std::unordered_map<const MipPyramid*, std::uint32_t> pyramids_;
    std::size_t texels_ = 0;
};

}  // namespace

ShadeTables makeShadeTables(const ShadedScene& from) {
    return TableMaker(from).make();
}

std::optional<std::string> whyNotShaded(const ShadeTables& tables, const DeviceTraits& traits) {
    const auto limit = [&](const char* what, std::size_t bytes) -> std::optional<std::string> {
        if (bytes <= traits.max_storage_bytes) return std::nullopt;
        return fmt::format("{} take {} MiB, {} binds {} at most", what, (bytes >> 20) + 1, traits.name,
                           traits.max_storage_bytes >> 20);
    };
    if (traits.max_stage_buffers < kShadeBindings)
        return fmt::format("shading binds {} buffers, {} at most {}", kShadeBindings, traits.name,
                           traits.max_stage_buffers);
    if (tables.banks.size() > kMostBanks)
        return fmt::format("the scene's textures take more than {} MiB",
                           kMostBanks * kBankTexels * sizeof(glm::vec4) >> 20);
    if (const auto why = limit("vertices", 8 * std::max(tables.positions.size(), tables.attributes.size())))
        return why;
    return limit("triangles", std::max({sizeof(OwnerRecord) * tables.owners.size(), 8 * tables.table.size(),
                                        8 * tables.plane_normals.size()}));
}

SceneUpload::SceneUpload(const Device& device, const ShadeTables& tables) : nothing_(device, "nothing", 16) {
    const auto put = [&](int binding, const char* name, const auto& items) {
        if (!items.empty()) buffers_[binding].emplace(bufferOf(device, name, items));
    };
    buffers_[kShadeFrameBinding].emplace(bufferOf(device, "frame", std::span(&tables.frame, 1)));
    put(kOwnerRecordsBinding, "owners", tables.owners);
    put(kTableBinding, "table of colours", tables.table);
    put(kPlaneNormalsBinding, "plane normals", tables.plane_normals);
    put(kLightsBinding, "lights", tables.lights);
    if (!tables.surfaces.empty()) {
        put(kSurfacesBinding, "surfaces", tables.surfaces);
        put(kMaterialsBinding, "materials", tables.materials);
    }
    put(kPositionsBinding, "positions", tables.positions);
    put(kAttributesBinding, "attributes", tables.attributes);
    put(kMapsBinding, "maps", tables.maps);
    put(kLevelsBinding, "mip levels", tables.levels);
    for (std::size_t i = 0; i < tables.banks.size(); ++i)
        put(kBank0Binding + static_cast<int>(i), "texels", tables.banks[i]);
}

std::size_t SceneUpload::bytes() const {
    std::size_t sum = 0;
    for (const auto& buffer : buffers_)
        if (buffer) sum += buffer->bytes();
    return sum;
}

StackTables::StackTables(const LayerStacks& stacks) : first{0} {
    for (std::size_t i = 0; i < stacks.size(); ++i) {
        const auto mine = stacks.layers(kFirstStack + static_cast<Owner>(i));
        layers.insert(layers.end(), mine.begin(), mine.end());
        first.push_back(static_cast<std::uint32_t>(layers.size()));
    }
}

}  // namespace edgewise::vulkan
