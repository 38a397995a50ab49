#include "pipeline/vulkan/raster.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace edgewise::vulkan {
namespace {

/// A side of a target, and how far the viewport reaches beyond it: pieces end there, cut in double, so that
/// the device's own clipping moves no edge. A float holds a place on the viewport to 2^-12 px, and its
/// transform rounds two times to 2^-11 px at most: less than half a subpixel of 2^-8 px.
constexpr std::uint32_t kMostTargetPx = 8192, kGuardTargetPx = 1024;

constexpr vk::Format kDepthFormat = vk::Format::eD32Sfloat;

std::uint32_t samplesOf(const SamplePattern& pattern, RasterForm form) {
    return form == RasterForm::kMultisampled ? static_cast<std::uint32_t>(pattern.size()) : 1u;
}

/// Integers need not be multisampled; bytes are, on every device.
TargetFormat targetFormat(const SamplePattern& pattern, RasterForm form) {
    const bool bytes = form == RasterForm::kMultisampled;
    return {bytes ? vk::Format::eR8G8B8A8Unorm : vk::Format::eR32Uint, kDepthFormat,
            samplesOf(pattern, form)};
}

GraphicsOptions optionsFor(const SamplePattern& pattern, RasterForm form) {
    GraphicsOptions options;
    options.target = targetFormat(pattern, form);
    options.guard_px = kGuardTargetPx;
    return options;
}

/// kBackground.
vk::ClearColorValue clearFor(RasterForm form) {
    if (form == RasterForm::kMultisampled) return std::array<float, 4>{1.0f, 1.0f, 1.0f, 1.0f};
    return std::array<std::uint32_t, 4>{kBackground, 0, 0, 0};
}

struct DepthRange {
    double least = std::numeric_limits<double>::infinity(), most = -least;
};

DepthRange depthsOf(const ScreenScene& scene) {
    DepthRange range;
    for (const ScreenTriangle& t : scene.triangles) {
        const DepthPlane& plane = scene.planes[t.plane];
        for (const glm::dvec2& p : t.p_px) {
            const glm::dvec2 d = p - scene.anchor_px;
            const double z = plane.dz_dx * d.x + (plane.dz_dy * d.y + plane.z_anchor);
            range.least = std::min(range.least, z), range.most = std::max(range.most, z);
        }
    }
    return range;
}

ScreenBox grown(const PixelBox& box, double by_px) {
    return {{box.x0 - by_px, box.y0 - by_px}, {box.x1 + by_px, box.y1 + by_px}};
}

}  // namespace

RasterForm rasterFormFor(const SamplePattern& pattern, const DeviceTraits& traits) {
    if (pattern.lattice) return RasterForm::kLattice;
    return traits.standard_samples & static_cast<std::uint32_t>(pattern.size()) ? RasterForm::kMultisampled
                                                                                : RasterForm::kShifted;
}

std::string describe(RasterForm form, const SamplePattern& pattern) {
    if (form == RasterForm::kMultisampled) return fmt::format("{} samples in hardware", pattern.size());
    if (form == RasterForm::kShifted) return fmt::format("{} shifted passes", pattern.size());
    return pattern.size() == 1 ? "a sample a pixel"
                               : fmt::format("a target {} times as large", pattern.columns);
}

/// One window of a graph.
struct Raster::Job {
    PixelBox window;
    std::shared_ptr<RenderTarget> target;
    DrawnPieces drawn;
    Buffer pieces, clipped;
    Resource triangles, planes, pieces_in, clipped_in, owners;
};

Raster::Raster(const Device& device, const ScreenScene& scene, const SamplePattern& pattern, RasterForm form)
    : device_(device),
      scene_(scene),
      pattern_(pattern),
      form_(form),
      draw_(device,
            {"raster.vert", "", form == RasterForm::kMultisampled ? "raster_bytes.frag" : "raster.frag"},
            kRasterBindings, sizeof(RasterPush), optionsFor(pattern, form)),
      collect_(device, form == RasterForm::kMultisampled ? "collect_bytes.comp" : "collect.comp", 1,
               sizeof(CollectPush), {}, 1) {
    const DepthRange range = depthsOf(scene);
    if (!(range.least < range.most)) {
        depth_scale_ = 0.0, depth_offset_ = 0.5;
    } else if (range.least > 0.0) {  // 1/w: floats keep its relative precision if it is only scaled
        depth_scale_ = std::ldexp(1.0, -std::ilogb(range.most) - 2);
    } else {
        depth_scale_ = 0.5 / (range.most - range.least);
        depth_offset_ = 0.25 - range.least * depth_scale_;
    }
}

bool Raster::fits(int width, int height) const {
    const int scale = form_ == RasterForm::kLattice ? pattern_.columns : 1;
    const std::size_t most_px = std::min(kMostTargetPx, device_.traits().max_target_px - 2 * kGuardTargetPx);
    const std::size_t w = width, h = height;
    return w * scale <= most_px && h * scale <= most_px &&
           w * h * pattern_.size() * sizeof(uint) <= device_.traits().max_storage_bytes;
}

Resource Raster::addTo(PassGraph& graph, Resource triangles, Resource planes, const PixelBox& window) {
    const int scale = form_ == RasterForm::kLattice ? pattern_.columns : 1;
    const auto width = static_cast<std::uint32_t>(window.width() * scale),
               height = static_cast<std::uint32_t>(window.height() * scale);
    if (!target_ || target_->size() != vk::Extent2D(width, height)) {
        target_.reset();
        target_ =
            std::make_shared<RenderTarget>(device_, "samples", targetFormat(pattern_, form_), width, height);
    }
    DrawnPieces drawn = piecesFor(scene_, grown(window, 1.0), grown(window, double(kGuardTargetPx) / scale));
    Buffer pieces = bufferOf(device_, "pieces", drawn.ids),
           clipped = bufferOf(device_, "clipped pieces", drawn.clipped);
    const std::size_t bytes =
        static_cast<std::size_t>(window.width()) * window.height() * pattern_.size() * sizeof(uint);
    const auto job = std::make_shared<Job>(Job{window, target_, std::move(drawn), std::move(pieces),
                                               std::move(clipped), triangles, planes, 0, 0,
                                               graph.buffer("sample owners", [bytes] { return bytes; })});
    job->pieces_in = graph.input("pieces", job->pieces);
    job->clipped_in = graph.input("clipped pieces", job->clipped);
    draw_.forgetSets(), collect_.forgetSets();
    const std::size_t draws = form_ == RasterForm::kShifted ? pattern_.at_px.size() : 1;
    for (std::size_t sample = 0; sample < draws; ++sample) addDraw(graph, job, sample);
    return job->owners;
}

void Raster::addDraw(PassGraph& graph, const std::shared_ptr<Job>& job, std::size_t sample) {
    graph.add("visibility draw",
              {.reads = {job->triangles, job->clipped_in, job->planes, job->pieces_in, job->owners},
               .writes = {job->owners},
               .record = [=, this](const PassContext& pass) {
                   draw_.draw(
                       pass.commands, *job->target,
                       {pass[job->triangles], pass[job->clipped_in], pass[job->planes], pass[job->pieces_in]},
                       PushBytes(pushFor(job->window, sample)),
                       {.vertices = static_cast<std::uint32_t>(3 * job->drawn.ids.size())}, clearFor(form_));
               }});
    graph.add("visibility collect",
              {.reads = {job->owners}, .writes = {job->owners}, .record = [=, this](const PassContext& pass) {
                   const CollectPush push = collectFor(job->window, sample);
                   collect_.record(pass.commands, {pass[job->owners]}, {job->target->color().view()},
                                   PushBytes(push), {(push.width + 7) / 8, (push.height + 7) / 8});
               }});
}

RasterPush Raster::pushFor(const PixelBox& window, std::size_t sample) const {
    const bool shifted = form_ == RasterForm::kShifted;
    const double scale = form_ == RasterForm::kLattice ? pattern_.columns : 1.0;
    const glm::dvec2 shift = shifted ? 0.5 - pattern_.at_px[sample] : glm::dvec2(0.0);
    return {double(window.x0),
            double(window.y0),
            scale,
            shift.x + kGuardTargetPx,
            shift.y + kGuardTargetPx,
            window.width() * scale + 2.0 * kGuardTargetPx,
            window.height() * scale + 2.0 * kGuardTargetPx,
            scene_.anchor_px.x,
            scene_.anchor_px.y,
            depth_scale_,
            depth_offset_};
}

CollectPush Raster::collectFor(const PixelBox& window, std::size_t sample) const {
    const int scale = form_ == RasterForm::kLattice ? pattern_.columns : 1;
    const auto count = form_ == RasterForm::kLattice ? 1u : static_cast<uint>(pattern_.size());
    return {static_cast<uint>(window.width() * scale), static_cast<uint>(window.height() * scale), count,
            static_cast<uint>(sample)};
}

}  // namespace edgewise::vulkan
