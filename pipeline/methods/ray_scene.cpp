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

/// Pixels that fill a packet, as square as a power of two allows; one where a pixel fills it.
glm::ivec2 blockOf(int pixels) {
    glm::ivec2 block(1);
    while (2 * block.x * block.y <= pixels) (block.x == block.y ? block.x : block.y) *= 2;
    return block;
}

/// Downwards, below zero too.
int floorTo(int value, int step) {
    return value - (value % step + step) % step;
}

}  // namespace

/// Traces samples a packet at a time. A packet is full, or a block of pixels that lies where it lies whatever
/// the window is: which rays share one can decide what wins where depths are equal.
template <int kWidth>
class PacketTracer {
  public:
    explicit PacketTracer(const RayScene& scene) : scene_(scene), view_(scene.triangles_.view) {
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

    /// The sample's owner goes to `out`, once the packet is traced; null: it only fills its lane.
    void add(glm::dvec2 corner_px, glm::dvec2 at_px, Owner* out, LayerStacks& stacks) {
        const glm::dvec2 from_centre = corner_px - view_.centre_px;
        float* const x = view_.perspective ? packet_.ray.dir_x : packet_.ray.org_x;
        float* const y = view_.perspective ? packet_.ray.dir_y : packet_.ray.org_y;
        x[count_] = static_cast<float>((from_centre.x + at_px.x) * view_.per_px);
        y[count_] = static_cast<float>((from_centre.y + at_px.y) * view_.per_px);
        at_px_[count_] = corner_px + at_px;
        out_[count_] = out;
        if (++count_ == kWidth) flush(stacks);
    }

    void flush(LayerStacks& stacks) {
        if (count_ == 0) return;
        for (int lane = 0; lane < kWidth; ++lane) {
            valid_[lane] = lane < count_ ? -1 : 0;
            packet_.ray.tfar[lane] = std::numeric_limits<float>::infinity();
            packet_.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
            packet_.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
        }
        trace(scene_.opaque_.get());
        for (int lane = 0; lane < count_; ++lane) {
            end_[lane] = endOf(lane);
            if (out_[lane] != nullptr) *out_[lane] = end_[lane] != nullptr ? end_[lane]->owner : kBackground;
        }
        if (scene_.see_through_ != nullptr) addPanes(stacks);
        count_ = 0;
    }

  private:
    void trace(RTCScene scene) {
        if (scene != nullptr)
            RayPacket<kWidth>::intersect(valid_.data(), scene, &panes_context_.context, &packet_);
    }

    bool hit(int lane) const { return packet_.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID; }

    /// The opaque triangle that ends the view; null: none does.
    const ScreenTriangle* endOf(int lane) const {
        if (!hit(lane)) return nullptr;
        const std::uint32_t nearest = scene_.triangles_.opaque.triangle[packet_.hit.primID[lane]];
        return &scene_.screen_.triangles[scene_.ties_.seenAt(nearest, at_px_[lane])];
    }

    /// Again through what is see-through, as far as the opaque triangle and a little farther: which are in
    /// front the depth planes say.
    void addPanes(LayerStacks& stacks) {
        for (int lane = 0; lane < count_; ++lane) {
            panes_[lane].clear();
            if (!hit(lane)) continue;
            packet_.ray.tfar[lane] *= kBehind;
            packet_.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
        }
        trace(scene_.see_through_.get());
        for (int lane = 0; lane < count_; ++lane)
            if (!panes_[lane].empty() && out_[lane] != nullptr)
                *out_[lane] = stackOf(lane, at_px_[lane], end_[lane], stacks);
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
    Owner stackOf(int lane, glm::dvec2 p_px, const ScreenTriangle* end, LayerStacks& stacks) {
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
    int count_ = 0;  ///< lanes that are filled
    std::array<glm::dvec2, kWidth> at_px_;
    std::array<Owner*, kWidth> out_;
    std::array<const ScreenTriangle*, kWidth> end_{};  ///< where each lane's view ends
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
      ties_(screen),
      device_(newDevice()),
      opaque_(newScene(device_.get(), triangles_.opaque, nullptr)),
      see_through_(newScene(device_.get(), triangles_.see_through, notePanes)) {}

int RayScene::packetSize() const {
    const auto native = [&](RTCDeviceProperty width) {
        return rtcGetDeviceProperty(device_.get(), width) != 0;
    };
    if (native(RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)) return 16;
    if (native(RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED)) return 8;
    return 4;
}

template <int kWidth>
void RayScene::traceWindow(const PixelBox& window, const PixelPatterns& patterns, SampledOwners& out) const {
    const glm::ivec2 block = blockOf(kWidth / patterns.samples);
    const PixelBox tiles{floorTo(window.x0, kTilePx) / kTilePx, floorTo(window.y0, kTilePx) / kTilePx,
                         (window.x1 + kTilePx - 1) / kTilePx, (window.y1 + kTilePx - 1) / kTilePx};
    const auto traceBlock = [&](PacketTracer<kWidth>& tracer, int x0, int y0) {
        for (int y = y0; y < y0 + block.y; ++y)
            for (int x = x0; x < x0 + block.x; ++x) {
                const bool inside = window.contains(x, y);
                const std::size_t pixel =
                    static_cast<std::size_t>(y - window.y0) * window.width() + (x - window.x0);
                Owner* owner = inside ? &out.owner[pixel * patterns.samples] : nullptr;
                for (const glm::dvec2& at : patterns.pattern(patterns.patternOf(x, y)))
                    tracer.add({x, y}, at, inside ? owner++ : nullptr, out.stacks);
            }
        tracer.flush(out.stacks);
    };
    tbb::parallel_for(0, tiles.width() * tiles.height(), [&](int tile) {
        PacketTracer<kWidth> tracer(*this);
        const int left = (tiles.x0 + tile % tiles.width()) * kTilePx,
                  top = (tiles.y0 + tile / tiles.width()) * kTilePx;
        const int x1 = std::min(left + kTilePx, window.x1), y1 = std::min(top + kTilePx, window.y1);
        for (int y = std::max(top, floorTo(window.y0, block.y)); y < y1; y += block.y)
            for (int x = std::max(left, floorTo(window.x0, block.x)); x < x1; x += block.x)
                traceBlock(tracer, x, y);
    });
}

SampledOwners RayScene::trace(const PixelBox& window, const PixelPatterns& patterns) const {
    SampledOwners out;
    out.owner.resize(static_cast<std::size_t>(window.width()) * window.height() * patterns.samples);
    try {
        switch (packetSize()) {
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
