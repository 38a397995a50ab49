#include "pipeline/plan.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <bit>
#include <functional>

#include "pipeline/error.h"

namespace edgewise {
namespace {

/// A hash table of the owners whose constant shades were seen first.
class FirstOfShade {
  public:
    FirstOfShade(const std::vector<std::optional<Shade>>& constant, std::size_t count)
        : constant_(constant), slots_(std::bit_ceil(2 * count + 1), kFree) {}

    Owner of(Owner owner) {
        std::size_t slot = hash(*constant_[owner]) & (slots_.size() - 1);
        for (; slots_[slot] != kFree; slot = (slot + 1) & (slots_.size() - 1))
            if (*constant_[slots_[slot]] == *constant_[owner]) return slots_[slot];
        ++size_;
        return slots_[slot] = owner;
    }
    std::size_t size() const { return size_; }

  private:
    static constexpr Owner kFree = kBackground;

    static std::size_t hash(const Shade& s) {
        std::uint64_t h = 0;
        for (const double value : {s.color.r, s.color.g, s.color.b, s.alpha})
            h = (h ^ std::bit_cast<std::uint64_t>(value + 0.0)) * 0x9e3779b97f4a7c15ull, h ^= h >> 31;
        return h;
    }

    const std::vector<std::optional<Shade>>& constant_;
    std::vector<Owner> slots_;
    std::size_t size_ = 0;
};

/// Owners of one constant colour are represented by the lowest of them.
OwnerClasses classesOf(const std::vector<std::optional<Shade>>& constant, std::size_t& merged,
                       std::size_t& classes) {
    OwnerClasses out;
    merged = tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, constant.size(), 4096), std::size_t{0},
        [&](const auto& range, std::size_t sum) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) sum += constant[i].has_value();
            return sum;
        },
        std::plus<>());
    if (merged == 0) return out;
    FirstOfShade first(constant, merged);
    out.representative.resize(constant.size());
    for (std::size_t i = 0; i < constant.size(); ++i) {
        const auto owner = static_cast<Owner>(i);
        out.representative[i] = constant[i] ? first.of(owner) : owner;
    }
    classes = first.size();
    if (classes == merged) out.representative.clear();
    return out;
}

/// Whether Shading::ofOneTexel() can have anything.
bool takesTexelsAsTheyAre(const Scene& scene) {
    return std::any_of(scene.materials.begin(), scene.materials.end(), [&](const Material& m) {
        if (!m.unlit || !m.base_color_map.present()) return false;
        const Texture& texture = scene.textures[m.base_color_map.texture];
        return !texture.mip && texture.min == TexelFilter::kNearest;
    });
}

void addOneTexelShades(const ScreenPieces& pieces, const Shading& shading,
                       std::vector<std::optional<Shade>>& constant) {
    constant.resize(pieces.first.size() - 1);
    tbb::parallel_for(std::size_t{0}, constant.size(), [&](std::size_t i) {
        if (pieces.first[i] != pieces.first[i + 1] && !constant[i])
            constant[i] = shading.ofOneTexel(static_cast<Owner>(i));
    });
}

bool isTextured(const Material& m) {
    return m.base_color_map.present() || m.metallic_roughness_map.present() || m.normal_map.present() ||
           m.occlusion_map.present() || m.emissive_map.present();
}

std::string fetchReason(const Scene& scene) {
    std::size_t textured = 0, unlit = 0;
    for (const Material& m : scene.materials) {
        textured += isTextured(m);
        unlit += m.unlit;
    }
    return fmt::format("{} of {} materials have a texture, {} are unlit", textured, scene.materials.size(),
                       unlit);
}

}  // namespace

const std::vector<std::string>& skippableStages() {
    static const std::vector<std::string> names{"visibility", "piercing",  "cancel", "interior",
                                                "fetch",      "occlusion", "empty"};
    return names;
}

std::vector<std::optional<Shade>> constantShades(const ScreenPieces& pieces, const Shading& shading) {
    std::vector<std::optional<Shade>> shades(pieces.first.size() - 1);
    tbb::parallel_for(std::size_t{0}, shades.size(), [&](std::size_t i) {
        const auto owner = static_cast<Owner>(i);
        if (pieces.first[i] != pieces.first[i + 1]) shades[i] = shading.constant(owner);
    });
    return shades;
}

Plan makePlan(const Scene& scene, const ScreenScene& screen, const ScreenPieces& pieces,
              const Shading& shading, const RenderOptions& options) {
    Plan plan;
    const auto add = [&](const char* stage, bool runs, std::string why) {
        if (options.keeps(stage)) runs = true, why = "forced by --no-skip";
        plan.entries.push_back({stage, runs, std::move(why)});
        return !runs;
    };
    const auto panes = static_cast<std::size_t>(std::ranges::count(screen.see_through, 1));
    plan.entries.push_back({"layers", panes > 0,
                            panes > 0 ? fmt::format("{} triangles are seen through: owners are stacks", panes)
                                      : "every triangle that is there is opaque"});
    const bool one_plane = screen.planes.size() < 2;
    plan.visibility.cell.certify =
        add("visibility", false,
            "where one sheet of triangles covers a cell: its edges are the visible segments");
    plan.visibility.cell.every_depth_line = !add(
        "piercing", false,
        one_plane ? "one plane: nothing pierces" : "for pairs of triangles that keep their order in a cell");
    plan.visibility.cell.occlusion =
        add("occlusion", false,
            "for triangles that another one hides in a whole cell: dropped before pairs are made");
    plan.visibility.skip_empty =
        add("empty", false, "for cells without triangles: they are the background's");
    plan.weights.skip_interior =
        add("interior", false, "for supports without segments: the owner there has all the weight");

    plan.weights.shading = options.shading;
    plan.weights.precision = options.precision;
    std::size_t merged = 0, classes = 0;
    plan.constant = constantShades(pieces, shading);
    OwnerClasses by_color = classesOf(plan.constant, merged, classes);
    const bool cancel = !by_color.representative.empty();
    const std::string cancel_why = cancel ? fmt::format(
                                                "{} triangles have {} constant colours: segments between "
                                                "equal ones are not integrated",
                                                merged, classes)
                                          : "no two triangles have one constant colour";
    if (add("cancel", !cancel, cancel_why)) plan.classes = std::move(by_color);
    plan.weights.skip_cancelling = !options.keeps("cancel");
    const bool fetch = merged == 0;
    const std::string fetch_why =
        fetch ? "every colour varies: " + fetchReason(scene)
              : fmt::format("{} triangles of constant colour fetch nothing; {}", merged, fetchReason(scene));
    if (!add("fetch", fetch, fetch_why)) plan.constant.clear();
    if (!options.keeps("fetch") && takesTexelsAsTheyAre(scene))
        addOneTexelShades(pieces, shading, plan.constant);
    return plan;
}

void planByEdges(const ScreenScene& screen, Plan& plan) {
    if (std::ranges::count(screen.see_through, 1) > 0)
        throw InputError("visibility=awj13", "knows opaque triangles only, and the scene has others");
    plan.visibility.cell.by_edges = true;
    plan.visibility.cell.certify = false;
    for (PlanEntry& entry : plan.entries) {
        if (entry.stage == "visibility") entry.runs = true, entry.why = "visibility=awj13 asks every edge";
        if (entry.stage == "piercing")
            entry.runs = false, entry.why = "visibility=awj13 knows no triangles that pierce others";
    }
}

}  // namespace edgewise
