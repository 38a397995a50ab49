#include "pipeline/methods/point_samples.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <span>
#include <utility>

#include "analytic/exact_depth.h"
#include "pipeline/error.h"
#include "pipeline/grid_orientation.h"
#include "pipeline/screen_map.h"

namespace edgewise {
namespace {

/// False only if the whole box lies outside an edge; rounding errs towards true (two products of u = 2^-53
/// each).
bool mayMeet(const ScreenTriangle& t, glm::dvec2 low, glm::dvec2 high) {
    for (int k = 0; k < 3; ++k) {
        const glm::dvec2 a = t.p_px[k], along = t.p_px[(k + 1) % 3] - a;
        const double x = along.y > 0.0 ? low.x : high.x, y = along.x > 0.0 ? high.y : low.y;
        const double left = along.x * (y - a.y), right = along.y * (x - a.x);
        if (left - right < -0x1p-51 * (std::fabs(left) + std::fabs(right))) return false;
    }
    return true;
}

}  // namespace

/// One tile's samples and what has been seen at them so far.
class TileSampler {
  public:
    void run(const PointSampler& sampler, std::size_t tile, const PixelBox& window, glm::dvec2 shift_px,
             SampledOwners& out) {
        const PixelBox whole = sampler.tileBox(tile);
        box_ = {std::max(whole.x0, window.x0), std::max(whole.y0, window.y0), std::min(whole.x1, window.x1),
                std::min(whole.y1, window.y1)};
        scene_ = &sampler.scene_;
        per_side_ = sampler.per_side_;
        stacks_mutex_ = &sampler.stacks_mutex_;
        begin(shift_px);
        const auto all = std::span(sampler.binned_)
                             .subspan(sampler.first_[tile], sampler.first_[tile + 1] - sampler.first_[tile]);
        for (const std::uint32_t i : all)
            if (!seesThrough(i)) cover(i);
        if (!scene_->see_through.empty())
            for (const std::uint32_t i : all)
                if (seesThrough(i)) addPanes(i);
        write(window, out);
        sampler.exact_depths_ += exact_depths_;
    }

  private:
    static constexpr std::uint32_t kNothing = 0xffffffffu;

    /// A see-through triangle in front of what ends the view at a sample.
    struct Pane {
        std::size_t sample;
        std::uint32_t triangle;
        double depth;
    };

    bool seesThrough(std::uint32_t triangle) const {
        return scene_->seesThrough(scene_->triangles[triangle].owner);
    }

    void begin(glm::dvec2 shift_px) {
        panes_.clear();
        place(box_.x0, box_.width(), shift_px.x, x_px_);
        place(box_.y0, box_.height(), shift_px.y, y_px_);
        dx_.clear();
        for (const double x : x_px_) dx_.push_back(x - scene_->anchor_px.x);
        depth_.assign(x_px_.size() * y_px_.size(), -std::numeric_limits<double>::infinity());
        seen_.assign(depth_.size(), kNothing);
        worst_error_ = 0.0;
        exact_depths_ = 0;
    }

    void place(int first, int pixels, double shift, std::vector<double>& position) const {
        position.clear();
        for (int i = 0; i < pixels; ++i)
            for (int a = 0; a < per_side_; ++a)
                position.push_back(first + i + sampleOffsetPx(a, per_side_) + shift);
    }

    void cover(std::uint32_t index) {
        const ScreenTriangle& t = scene_->triangles[index];
        forSamplesOf(t, [&](std::size_t i, double dx, double dy, double z, double bound) {
            const double ahead = z - depth_[i];
            if (ahead < -bound || (ahead <= bound && !exactlyNearer(t, seen_[i], dx, dy))) return;
            depth_[i] = z;
            seen_[i] = index;
        });
    }

    void addPanes(std::uint32_t index) {
        const ScreenTriangle& t = scene_->triangles[index];
        forSamplesOf(t, [&](std::size_t i, double dx, double dy, double z, double bound) {
            const double ahead = z - depth_[i];
            if (ahead > bound || (ahead >= -bound && inFront(index, seen_[i], dx, dy)))
                panes_.push_back({i, index, z});
        });
    }

    /// Calls visit(sample, dx, dy, depth, bound) for the samples that t covers: offsets from the anchor, and
    /// what may separate its depth from another's by rounding.
    template <class Visit>
    void forSamplesOf(const ScreenTriangle& t, const Visit& visit) {
        const DepthPlane& plane = scene_->planes[t.plane];
        const double y_min = std::min({t.p_px[0].y, t.p_px[1].y, t.p_px[2].y});
        const double y_max = std::max({t.p_px[0].y, t.p_px[1].y, t.p_px[2].y});
        const auto row_begin = std::lower_bound(y_px_.begin(), y_px_.end(), y_min) - y_px_.begin();
        const auto row_end = std::upper_bound(y_px_.begin(), y_px_.end(), y_max) - y_px_.begin();
        if (row_begin == row_end) return;
        const double error = depthError(plane);
        worst_error_ = std::max(worst_error_, error);
        for (auto row = static_cast<std::size_t>(row_begin); row < static_cast<std::size_t>(row_end); ++row)
            visitRow(t, plane, row, error + worst_error_, visit);
    }

    /// Bound of |z_computed - z| in this tile: z = A dx + (B dy + C) with at most 3 u of each term, u =
    /// 2^-53; 4 u leaves room for the roundings of the bound itself.
    double depthError(const DepthPlane& plane) const {
        const double reach_x = std::max(std::fabs(dx_.front()), std::fabs(dx_.back()));
        const double reach_y = std::max(std::fabs(y_px_.front() - scene_->anchor_px.y),
                                        std::fabs(y_px_.back() - scene_->anchor_px.y));
        return 0x1p-51 * (std::fabs(plane.dz_dx) * reach_x + std::fabs(plane.dz_dy) * reach_y +
                          std::fabs(plane.z_anchor));
    }

    template <class Visit>
    void visitRow(const ScreenTriangle& t, const DepthPlane& plane, std::size_t row, double bound,
                  const Visit& visit) {
        std::size_t begin = 0, end = x_px_.size();
        const double y = y_px_[row];
        for (int k = 0; k < 3 && begin < end; ++k) cutSpan(t.p_px[k], t.p_px[(k + 1) % 3], y, begin, end);
        const double dy = y - scene_->anchor_px.y, at_row = plane.dz_dy * dy + plane.z_anchor;
        for (std::size_t j = begin; j < end; ++j)
            visit(row * x_px_.size() + j, dx_[j], dy, plane.dz_dx * dx_[j] + at_row, bound);
    }

    /// Keeps the samples of the row that lie inside the edge, or on it where it is a top or left edge.
    void cutSpan(glm::dvec2 a, glm::dvec2 b, double y, std::size_t& begin, std::size_t& end) const {
        if (a.y == b.y) {
            const bool top = b.x > a.x;
            if (top ? y < a.y : y >= a.y) end = begin;
        } else if (b.y < a.y) {
            begin = std::max(begin, firstWhere(a, b, y, [](int side) { return side >= 0; }));
        } else {
            end = std::min(end, firstWhere(a, b, y, [](int side) { return side <= 0; }));
        }
    }

    /// The first sample whose side of the edge satisfies a condition that holds from there on: a rounded
    /// guess, then exact steps.
    template <class Condition>
    std::size_t firstWhere(glm::dvec2 a, glm::dvec2 b, double y, const Condition& holds) const {
        const double x = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
        const double guess =
            std::clamp(std::ceil((x - x_px_.front()) * per_side_), 0.0, double(x_px_.size()));
        auto j = static_cast<std::size_t>(guess);
        auto sideOf = [&](std::size_t i) { return gridOrientation(a, b, {x_px_[i], y}); };
        while (j > 0 && holds(sideOf(j - 1))) --j;
        while (j < x_px_.size() && !holds(sideOf(j))) ++j;
        return j;
    }

    /// Triangles come in index order: what has been seen keeps a tie.
    bool exactlyNearer(const ScreenTriangle& t, std::uint32_t seen, double dx, double dy) {
        const std::uint32_t other = scene_->triangles[seen].plane;
        if (other == t.plane) return false;
        ++exact_depths_;
        return depthDifferenceSign(scene_->planes[t.plane], scene_->planes[other], dx, dy) > 0;
    }

    /// Whether a triangle is in front of another, decided exactly: by depth, then by index. Nothing is behind
    /// all.
    bool inFront(std::uint32_t index, std::uint32_t other, double dx, double dy) {
        if (other == kNothing) return true;
        const ScreenTriangle &t = scene_->triangles[index], &o = scene_->triangles[other];
        if (t.plane == o.plane) return t.owner < o.owner;
        ++exact_depths_;
        const int sign = depthDifferenceSign(scene_->planes[t.plane], scene_->planes[o.plane], dx, dy);
        return sign != 0 ? sign > 0 : t.owner < o.owner;
    }

    void write(const PixelBox& window, SampledOwners& out) {
        const std::size_t columns = x_px_.size();
        const std::size_t stride = static_cast<std::size_t>(window.width()) * per_side_;
        const std::size_t corner = static_cast<std::size_t>(box_.y0 - window.y0) * per_side_ * stride +
                                   static_cast<std::size_t>(box_.x0 - window.x0) * per_side_;
        const auto at = [&](std::size_t i) { return corner + i / columns * stride + i % columns; };
        for (std::size_t i = 0; i < seen_.size(); ++i)
            out.owner[at(i)] = seen_[i] == kNothing ? kBackground : scene_->triangles[seen_[i]].owner;
        sortPanes();
        for (std::size_t first = 0, end = 0; first < panes_.size(); first = end) {
            layers_.clear();
            const std::size_t sample = panes_[first].sample;
            for (end = first; end < panes_.size() && panes_[end].sample == sample; ++end)
                layers_.push_back(scene_->triangles[panes_[end].triangle].owner);
            if (layers_.size() > kMostLayers) throw LayerLimit{positionOf(sample)};
            layers_.push_back(out.owner[at(sample)]);
            out.owner[at(sample)] = nameOf(out.stacks);
        }
    }

    /// By sample, then front to back.
    void sortPanes() {
        std::ranges::sort(panes_, [&](const Pane& p, const Pane& q) {
            if (p.sample != q.sample) return p.sample < q.sample;
            if (p.triangle == q.triangle) return false;
            const double ahead = p.depth - q.depth, bound = 2.0 * worst_error_;
            if (std::abs(ahead) > bound) return ahead > 0.0;
            return inFront(p.triangle, q.triangle, dx_[p.sample % dx_.size()],
                           y_px_[p.sample / dx_.size()] - scene_->anchor_px.y);
        });
    }

    /// Neighbours mostly share their stack: only another one asks the table, which all threads use.
    Owner nameOf(LayerStacks& stacks) {
        if (layers_ == last_layers_) return last_name_;
        const std::lock_guard lock(*stacks_mutex_);
        last_layers_ = layers_;
        return last_name_ = stacks.owner(layers_);
    }

    glm::dvec2 positionOf(std::size_t sample) const {
        return {x_px_[sample % x_px_.size()], y_px_[sample / x_px_.size()]};
    }

    const ScreenScene* scene_ = nullptr;
    PixelBox box_;
    int per_side_ = 1;
    std::vector<double> x_px_, y_px_, dx_, depth_;
    std::vector<std::uint32_t> seen_;
    double worst_error_ = 0.0;
    std::uint64_t exact_depths_ = 0;
    std::vector<Pane> panes_;
    std::vector<Owner> layers_, last_layers_;
    std::mutex* stacks_mutex_ = nullptr;
    Owner last_name_ = kBackground;
};

PointSampler::PointSampler(const ScreenScene& scene, const PixelBox& box, int per_side)
    : scene_(scene),
      box_(box),
      per_side_(per_side),
      tile_px_(std::clamp(128 / per_side, 1, 32)),  // 128 x 128 samples stay in the second-level cache
      tiles_x_((box.width() + tile_px_ - 1) / tile_px_),
      tiles_y_((box.height() + tile_px_ - 1) / tile_px_) {
    binTriangles();
}

PixelBox PointSampler::tileBox(std::size_t tile) const {
    const int x = box_.x0 + static_cast<int>(tile % tiles_x_) * tile_px_;
    const int y = box_.y0 + static_cast<int>(tile / tiles_x_) * tile_px_;
    return {x, y, std::min(x + tile_px_, box_.x1), std::min(y + tile_px_, box_.y1)};
}

template <class Visit>
void PointSampler::visitTiles(const ScreenTriangle& t, const Visit& visit) const {
    const glm::dvec2 low = glm::min(glm::min(t.p_px[0], t.p_px[1]), t.p_px[2]);
    const glm::dvec2 high = glm::max(glm::max(t.p_px[0], t.p_px[1]), t.p_px[2]);
    auto tileAt = [&](double p, int origin, int tiles) {
        return static_cast<int>(std::clamp(std::floor((p - origin) / tile_px_), -1.0, double(tiles)));
    };
    const int x0 = std::max(tileAt(low.x, box_.x0, tiles_x_), 0);
    const int x1 = std::min(tileAt(high.x, box_.x0, tiles_x_), tiles_x_ - 1);
    const int y0 = std::max(tileAt(low.y, box_.y0, tiles_y_), 0);
    const int y1 = std::min(tileAt(high.y, box_.y0, tiles_y_), tiles_y_ - 1);
    const bool large = x1 - x0 > 1 && y1 - y0 > 1;
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
            const glm::dvec2 corner(box_.x0 + x * tile_px_, box_.y0 + y * tile_px_);
            if (!large || mayMeet(t, corner, corner + double(tile_px_)))
                visit(static_cast<std::size_t>(y) * tiles_x_ + x);
        }
}

/// Count, scan, fill. Chunks of triangles are counted apart, so that the lists come out ascending in
/// parallel.
void PointSampler::binTriangles() {
    constexpr std::size_t kChunks = 16;
    const std::size_t tiles = static_cast<std::size_t>(tiles_x_) * tiles_y_, count = scene_.triangles.size();
    std::vector<std::vector<std::size_t>> next(kChunks, std::vector<std::size_t>(tiles, 0));
    auto forEachChunk = [&](const auto& body) {
        tbb::parallel_for(std::size_t(0), kChunks, [&](std::size_t chunk) {
            for (std::size_t i = count * chunk / kChunks; i < count * (chunk + 1) / kChunks; ++i)
                visitTiles(scene_.triangles[i], [&](std::size_t tile) { body(next[chunk][tile], i); });
        });
    };
    forEachChunk([](std::size_t& counter, std::size_t) { ++counter; });
    first_.assign(tiles + 1, 0);
    std::size_t total = 0;
    for (std::size_t tile = 0; tile < tiles; ++tile) {
        first_[tile] = total;
        for (auto& chunk : next) total += std::exchange(chunk[tile], total);
    }
    first_[tiles] = total;
    binned_.resize(total);
    forEachChunk(
        [&](std::size_t& cursor, std::size_t i) { binned_[cursor++] = static_cast<std::uint32_t>(i); });
}

void sortStacks(SampledOwners& sampled) {
    if (sampled.stacks.empty()) return;
    const LayerStacks* const parts[] = {&sampled.stacks};
    std::vector<std::vector<Owner>> names;
    sampled.stacks = LayerStacks::joined(parts, names);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sampled.owner.size(), 1 << 16),
                      [&](const auto& range) {
                          for (std::size_t i = range.begin(); i < range.end(); ++i)
                              if (isStack(sampled.owner[i]))
                                  sampled.owner[i] = names[0][sampled.owner[i] - kFirstStack];
                      });
}

SampledOwners PointSampler::sample(const PixelBox& window, glm::dvec2 shift_px) const {
    SampledOwners out;
    out.owner.resize(static_cast<std::size_t>(window.width()) * window.height() * per_side_ * per_side_);
    const int x0 = (window.x0 - box_.x0) / tile_px_, x1 = (window.x1 - box_.x0 + tile_px_ - 1) / tile_px_;
    const int y0 = (window.y0 - box_.y0) / tile_px_, y1 = (window.y1 - box_.y0 + tile_px_ - 1) / tile_px_;
    tbb::enumerable_thread_specific<TileSampler> samplers;
    try {
        tbb::parallel_for(0, (x1 - x0) * (y1 - y0), [&](int i) {
            const int x = x0 + i % (x1 - x0), y = y0 + i / (x1 - x0);
            samplers.local().run(*this, static_cast<std::size_t>(y) * tiles_x_ + x, window, shift_px, out);
        });
    } catch (const LayerLimit& limit) {
        throw FailureError(
            fmt::format("pixel {:.0f},{:.0f}", std::floor(limit.at_px.x), std::floor(limit.at_px.y)),
            fmt::format("more than {} triangles are seen through each other", kMostLayers));
    }
    sortStacks(out);
    return out;
}

}  // namespace edgewise
