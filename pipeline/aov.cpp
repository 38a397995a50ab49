#include "pipeline/aov.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/composite.h"
#include "pipeline/error.h"
#include "pipeline/methods/point_samples.h"
#include "pipeline/progress.h"

namespace edgewise {
namespace {

/// Rows that are looked up at once: their owners take little beside the image.
constexpr int kRowsAtOnce = 128;

PixelBox moved(const PixelBox& box, glm::dvec2 whole_px) {
    const int dx = static_cast<int>(whole_px.x), dy = static_cast<int>(whole_px.y);
    return {box.x0 + dx, box.y0 + dy, box.x1 + dx, box.y1 + dy};
}

std::size_t channelsOf(Aov aov) {
    if (aov == Aov::kCryptomatte) return 2 * 2 * kCryptomatteRanks;
    return aov == Aov::kNormal ? 3 : 1;
}

}  // namespace

const std::vector<std::pair<std::string, Aov>>& aovNames() {
    static const std::vector<std::pair<std::string, Aov>> names{{"depth", Aov::kDepth},
                                                                {"normal", Aov::kNormal},
                                                                {"index", Aov::kIndex},
                                                                {"owners", Aov::kOwners},
                                                                {"cryptomatte", Aov::kCryptomatte}};
    return names;
}

std::size_t aovChannelCount(const std::set<Aov>& wanted) {
    std::size_t count = 0;
    for (const Aov aov : wanted) count += channelsOf(aov);
    return count;
}

AovPass::AovPass(const std::set<Aov>& wanted, const Scene& scene, const ResolvedCamera& camera,
                 const Film& film, const ScreenScene& screen, const ScreenPieces& pieces,
                 const Shading& shading)
    : wanted_(wanted),
      scene_(scene),
      camera_(camera.camera),
      camera_from_world_(camera.camera_from_world),
      offset_px_(film.debug_offset_px),
      screen_(screen),
      pieces_(pieces),
      shading_(shading) {
    if (!wants(Aov::kCryptomatte)) return;
    layers_ = {CryptomatteLayer::ofObjects(scene), CryptomatteLayer::ofMaterials(scene)};
}

void AovPass::begin(ImageBuffer& image) const {
    auto& channels = image.aov.channels;
    if (wants(Aov::kDepth)) channels.push_back({"Z"});
    if (wants(Aov::kNormal)) channels.insert(channels.end(), {{"N.X"}, {"N.Y"}, {"N.Z"}});
    if (wants(Aov::kIndex)) channels.push_back({"index", true});
    if (wants(Aov::kOwners)) channels.push_back({"owners"});
    for (const CryptomatteLayer& layer : layers_) layer.describe(image.aov);
    image.aov.words.assign(channels.size() * image.rgba.size(), 0);
}

void AovPass::samplePoints(Progress& progress, ImageBuffer& image) const {
    if (!pointSamples()) return;
    const PixelBox& box = image.box;
    const PointSampler sampler(screen_, moved(box, offset_px_), 1);
    progress.stage("aov", static_cast<std::size_t>(box.height()));
    for (int y = box.y0; y < box.y1; y += kRowsAtOnce) {
        if (progress.cancelled()) throw Interrupted();
        const PixelBox rows{box.x0, y, box.x1, std::min(y + kRowsAtOnce, box.y1)};
        const SampledOwners sampled = sampler.sample(moved(rows, offset_px_));
        tbb::parallel_for(rows.y0, rows.y1, [&](int row) {
            const Owner* owner = sampled.owner.data() + static_cast<std::size_t>(row - y) * rows.width();
            for (int x = rows.x0; x < rows.x1; ++x)
                point(x, row, sampled.stacks.layersOf(owner[x - rows.x0]), image);
        });
        progress.advance(static_cast<std::size_t>(rows.height()));
    }
}

void AovPass::points(const SampledOwners& sampled, ImageBuffer& image) const {
    if (!pointSamples()) return;
    tbb::parallel_for(image.box.y0, image.box.y1, [&](int y) {
        for (int x = image.box.x0; x < image.box.x1; ++x)
            point(x, y, sampled.stacks.layersOf(sampled.owner[image.index(x, y)]), image);
    });
}

Owner AovPass::frontLayer(std::span<const Owner> layers, glm::dvec2 p_px) const {
    for (const Owner layer : layers.first(layers.size() - 1))
        if (shading_.atPoint(layer, p_px).alpha > 0.0) return layer;
    return layers.back();
}

void AovPass::point(int x, int y, std::span<const Owner> layers, ImageBuffer& image) const {
    std::uint32_t* out = image.aov.pixel(image.index(x, y));
    const glm::dvec2 p_px = glm::dvec2(x + 0.5, y + 0.5) + offset_px_;
    const Owner front = frontLayer(layers, p_px);
    const bool seen = front != kBackground;
    if (wants(Aov::kDepth)) *out++ = floatBits(seen ? depthAt(front, p_px) : kBackgroundDepth);
    if (wants(Aov::kNormal)) {
        const glm::dvec3 normal = seen ? normalAt(front, p_px) : glm::dvec3(0.0);
        for (int axis = 0; axis < 3; ++axis) *out++ = floatBits(normal[axis]);
    }
    if (wants(Aov::kIndex)) *out = front;
}

/// From the depth plane, and within what the near-clipped triangle spans: a plane seen almost edge-on is
/// rounded away from it.
double AovPass::depthAt(Owner owner, glm::dvec2 p_px) const {
    const TriangleRef at = findTriangle(scene_, owner);
    const Geometry& geometry = scene_.geometry[at.geometry];
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const std::uint32_t vertex : geometry.triangles[at.triangle]) {
        const double depth = -(camera_from_world_ * glm::dvec4(geometry.position_world[vertex], 1.0)).z;
        least = std::min(least, depth), most = std::max(most, depth);
    }
    const DepthPlane& plane = screen_.planes[screen_.triangles[pieces_.first[owner]].plane];
    const glm::dvec2 d = p_px - screen_.anchor_px;
    const double z = (plane.dz_dx * d.x + plane.dz_dy * d.y) + plane.z_anchor;
    const double depth = camera_.perspective ? (z > 0.0 ? 1.0 / z : most) : -z;
    return std::clamp(depth, std::min(std::max(least, camera_.znear), most), most);
}

glm::dvec3 AovPass::normalAt(Owner owner, glm::dvec2 p_px) const {
    return glm::transpose(glm::dmat3(camera_from_world_)) * shading_.normal(owner, p_px);
}

void AovPass::addLayers(std::span<const Owner> layers, FixedWeight weight, glm::dvec2 p_px,
                        std::vector<OwnerWeight>& out) const {
    if (layers.size() == 1) return out.push_back({layers[0], weight});
    throughLayers(
        layers, [&](Owner layer) { return shading_.closest(layer, p_px); },
        [&](std::size_t k, double share, const glm::dvec3&) {
            out.push_back(
                {layers[k], static_cast<FixedWeight>(std::llround(static_cast<double>(weight) * share))});
        });
}

void AovPass::pixel(int x, int y, std::span<const OwnerWeight> owners, const LayerStacks& stacks,
                    ImageBuffer& image) const {
    std::uint32_t* out = image.aov.pixel(image.index(x, y)) + image.aov.channels.size();
    const glm::dvec2 p_px = glm::dvec2(x + 0.5, y + 0.5) + offset_px_;
    thread_local std::vector<OwnerWeight> layers;
    layers.clear();
    if (!layers_.empty())
        for (const OwnerWeight& entry : owners)
            addLayers(stacks.layersOf(entry.owner), entry.weight, p_px, layers);
    bool complete = true;
    for (auto layer = layers_.rbegin(); layer != layers_.rend(); ++layer) {
        out -= 2 * kCryptomatteRanks;
        complete &= layer->rank(scene_, layers, out);
    }
    truncated_ += !complete;
    if (wants(Aov::kOwners))
        *--out = floatBits(static_cast<double>(
            std::ranges::count_if(owners, [](const OwnerWeight& entry) { return entry.weight != 0; })));
}

void AovPass::tile(const WeightTile& tile, const LayerStacks& stacks, ImageBuffer& image) const {
    std::size_t p = 0;
    for (int y = tile.box.y0; y < tile.box.y1; ++y)
        for (int x = tile.box.x0; x < tile.box.x1; ++x, ++p)
            pixel(x, y, std::span(tile.entries).subspan(tile.offset[p], tile.offset[p + 1] - tile.offset[p]),
                  stacks, image);
}

}  // namespace edgewise
