#include "pipeline/methods/ray_scene.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "pipeline/error.h"
#include "pipeline/methods/ray_packet.h"

namespace edgewise {
namespace {

constexpr int kTilePx = 16;

/// What a ray may pass behind the opaque triangle it ends at and still be tested against it: float32 rounds t
/// to 2^-24 of itself, a few times.
constexpr float kBehind = 1.0f + 0x1p-18f;

/// What the filter function finds beside Embree's own context: it must come first.
struct PaneContext {
    RTCIntersectContext context;
    std::vector<std::uint32_t>* panes;  ///< by lane
};

/// Notes every hit and refuses it, so that the ray goes on.
void notePanes(const RTCFilterFunctionNArguments* at) {
    auto* const panes = reinterpret_cast<PaneContext*>(at->context)->panes;
    for (unsigned lane = 0; lane < at->N; ++lane) {
        if (at->valid[lane] == 0) continue;
        panes[RTCRayN_id(at->ray, at->N, lane)].push_back(RTCHitN_primID(at->hit, at->N, lane));
        at->valid[lane] = 0;
    }
}

void checkEmbree(RTCDevice device) {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    throw FailureError("embree", error == RTC_ERROR_OUT_OF_MEMORY
                                     ? std::string("out of memory")
                                     : fmt::format("error {}", static_cast<int>(error)));
}

EmbreeDevice newDevice() {
    EmbreeDevice device(rtcNewDevice(nullptr));
    if (!device) checkEmbree(nullptr);
    if (!device) throw FailureError("embree", "no device");
    return device;
}

template <class Element>
void fill(RTCGeometry geometry, RTCBufferType type, RTCFormat format, const std::vector<Element>& elements) {
    void* const buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Element), elements.size());
    if (buffer != nullptr) std::copy(elements.begin(), elements.end(), static_cast<Element*>(buffer));
}

/// Null without triangles. Robust: no ray slips through a shared edge. On one thread, since the order in
/// which several build decides what wins where depths are equal.
EmbreeScene newScene(RTCDevice device, const ViewTriangles& triangles, RTCFilterFunctionN filter) {
    if (triangles.corners.empty()) return nullptr;
    EmbreeScene scene(rtcNewScene(device));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    fill(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, triangles.vertices);
    fill(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles.corners);
    if (filter != nullptr) rtcSetGeometryIntersectFilterFunction(geometry, filter);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    tbb::task_arena one(1);
    one.execute([&] { rtcCommitScene(scene.get()); });
    checkEmbree(device);
    return scene;
}

}  // namespace

/// Traces the samples of pixels, one packet after the other.
template <int kWidth>
class PixelTracer {
  public:
    explicit PixelTracer(const RayScene& scene) : scene_(scene), view_(scene.triangles_.view) {
        for (int lane = 0; lane < kWidth; ++lane) {
            packet_.ray.tnear[lane] = packet_.ray.time[lane] = 0.0f;
            packet_.ray.org_x[lane] = packet_.ray.org_y[lane] = packet_.ray.org_z[lane] = 0.0f;
            packet_.ray.dir_x[lane] = packet_.ray.dir_y[lane] = 0.0f;
            packet_.ray.dir_z[lane] = 1.0f;
            packet_.ray.mask[lane] = ~0u;
            packet_.ray.id[lane] = lane;
            packet_.ray.flags[lane] = 0;
        }
        rtcInitIntersectContext(&panes_context_.context);
        panes_context_.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        panes_context_.panes = panes_.data();
    }

    void pixel(glm::dvec2 corner_px, std::span<const glm::dvec2> at_px, Owner* out, LayerStacks& stacks) {
        for (std::size_t first = 0; first < at_px.size(); first += kWidth) {
            const std::size_t count = std::min<std::size_t>(kWidth, at_px.size() - first);
            aim(corner_px, at_px.subspan(first, count));
            trace(scene_.opaque_.get());
            for (std::size_t lane = 0; lane < count; ++lane) out[first + lane] = ownerOf(lane);
            if (scene_.see_through_ != nullptr)
                addPanes(corner_px, at_px.subspan(first, count), out + first, stacks);
        }
    }

  private:
    void aim(glm::dvec2 corner_px, std::span<const glm::dvec2> at_px) {
        const auto count = static_cast<int>(at_px.size());
        float* const x = view_.perspective ? packet_.ray.dir_x : packet_.ray.org_x;
        float* const y = view_.perspective ? packet_.ray.dir_y : packet_.ray.org_y;
        const glm::dvec2 from_centre = corner_px - view_.centre_px;
        for (int lane = 0; lane < count; ++lane) {
            x[lane] = static_cast<float>((from_centre.x + at_px[lane].x) * view_.per_px);
            y[lane] = static_cast<float>((from_centre.y + at_px[lane].y) * view_.per_px);
        }
        for (int lane = 0; lane < kWidth; ++lane) {
            valid_[lane] = lane < count ? -1 : 0;
            packet_.ray.tfar[lane] = std::numeric_limits<float>::infinity();
            packet_.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
            packet_.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
        }
    }

    void trace(RTCScene scene) {
        if (scene != nullptr)
            RayPacket<kWidth>::intersect(valid_.data(), scene, &panes_context_.context, &packet_);
    }

    bool hit(std::size_t lane) const { return packet_.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID; }

    const ScreenTriangle& opaqueAt(std::size_t lane) const {
        return scene_.screen_.triangles[scene_.triangles_.opaque.triangle[packet_.hit.primID[lane]]];
    }

    Owner ownerOf(std::size_t lane) const { return hit(lane) ? opaqueAt(lane).owner : kBackground; }

    /// Again through what is see-through, as far as the opaque triangle and a little farther: which are in
    /// front the depth planes say.
    void addPanes(glm::dvec2 corner_px, std::span<const glm::dvec2> at_px, Owner* out, LayerStacks& stacks) {
        std::array<const ScreenTriangle*, kWidth> end{};
        for (std::size_t lane = 0; lane < at_px.size(); ++lane) {
            panes_[lane].clear();
            if (!hit(lane)) continue;
            end[lane] = &opaqueAt(lane);
            packet_.ray.tfar[lane] *= kBehind;
            packet_.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
        }
        trace(scene_.see_through_.get());
        for (std::size_t lane = 0; lane < at_px.size(); ++lane)
            if (!panes_[lane].empty()) out[lane] = stackOf(lane, corner_px + at_px[lane], end[lane], stacks);
    }

    struct Pane {
        double depth;
        Owner owner;
        /// Front to back: the nearer, then the lower index.
        bool operator<(const Pane& o) const { return depth != o.depth ? depth > o.depth : owner < o.owner; }
        bool operator==(const Pane&) const = default;
    };

    Pane paneOf(const ScreenTriangle& triangle, glm::dvec2 p_px) const {
        return {depthAt(scene_.screen_, triangle, p_px), triangle.owner};
    }

    /// A ray along the edge between two pieces of a triangle meets both: they are one layer.
    Owner stackOf(std::size_t lane, glm::dvec2 p_px, const ScreenTriangle* end, LayerStacks& stacks) {
        sorted_.clear();
        const Pane last = end != nullptr ? paneOf(*end, p_px) : Pane{-HUGE_VAL, kBackground};
        for (const std::uint32_t i : panes_[lane]) {
            const Pane pane =
                paneOf(scene_.screen_.triangles[scene_.triangles_.see_through.triangle[i]], p_px);
            if (pane < last) sorted_.push_back(pane);
        }
        std::ranges::sort(sorted_, std::less<>());
        sorted_.erase(std::unique(sorted_.begin(), sorted_.end()), sorted_.end());
        if (sorted_.size() > kMostLayers) throw LayerLimit{p_px};
        layers_.clear();
        for (const Pane& pane : sorted_) layers_.push_back(pane.owner);
        layers_.push_back(last.owner);
        return nameOf(stacks);
    }

    /// Neighbours mostly share their stack: only another one asks the table, which all threads use.
    Owner nameOf(LayerStacks& stacks) {
        if (layers_ == last_layers_) return last_name_;
        const std::lock_guard lock(scene_.stacks_mutex_);
        last_layers_ = layers_;
        return last_name_ = stacks.owner(layers_);
    }

    const RayScene& scene_;
    const RayView& view_;
    typename RayPacket<kWidth>::Hit packet_;
    alignas(64) std::array<int, kWidth> valid_;
    PaneContext panes_context_;
    std::array<std::vector<std::uint32_t>, kWidth> panes_;
    std::vector<Pane> sorted_;
    std::vector<Owner> layers_, last_layers_;
    Owner last_name_ = kBackground;
};

RayScene::RayScene(const ScreenScene& screen, const Film& film, bool perspective, int margin_px)
    : screen_(screen),
      triangles_(viewTriangles(screen, film, perspective, margin_px)),
      device_(newDevice()),
      opaque_(newScene(device_.get(), triangles_.opaque, nullptr)),
      see_through_(newScene(device_.get(), triangles_.see_through, notePanes)) {}

int RayScene::packetSize(int samples) const {
    const auto native = [&](RTCDeviceProperty width) {
        return rtcGetDeviceProperty(device_.get(), width) != 0;
    };
    if (samples >= 16 && native(RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)) return 16;
    if (samples >= 8 && native(RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED)) return 8;
    return 4;
}

template <int kWidth>
void RayScene::traceWindow(const PixelBox& window, const PixelPatterns& patterns, SampledOwners& out) const {
    const int across = (window.width() + kTilePx - 1) / kTilePx,
              down = (window.height() + kTilePx - 1) / kTilePx;
    tbb::parallel_for(0, across * down, [&](int tile) {
        PixelTracer<kWidth> tracer(*this);
        const int x0 = window.x0 + tile % across * kTilePx, y0 = window.y0 + tile / across * kTilePx;
        for (int y = y0; y < std::min(y0 + kTilePx, window.y1); ++y)
            for (int x = x0; x < std::min(x0 + kTilePx, window.x1); ++x) {
                const std::size_t pixel =
                    static_cast<std::size_t>(y - window.y0) * window.width() + (x - window.x0);
                tracer.pixel({x, y}, patterns.pattern(patterns.patternOf(x, y)),
                             &out.owner[pixel * patterns.samples], out.stacks);
            }
    });
}

SampledOwners RayScene::trace(const PixelBox& window, const PixelPatterns& patterns) const {
    SampledOwners out;
    out.owner.resize(static_cast<std::size_t>(window.width()) * window.height() * patterns.samples);
    try {
        switch (packetSize(patterns.samples)) {
            case 16:
                traceWindow<16>(window, patterns, out);
                break;
            case 8:
                traceWindow<8>(window, patterns, out);
                break;
            default:
                traceWindow<4>(window, patterns, out);
        }
    } catch (const LayerLimit& limit) {
        throw FailureError(
            fmt::format("pixel {:.0f},{:.0f}", std::floor(limit.at_px.x), std::floor(limit.at_px.y)),
            fmt::format("more than {} triangles are seen through each other", kMostLayers));
    }
    sortStacks(out);
    return out;
}

}  // namespace edgewise
