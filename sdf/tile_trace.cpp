#include "sdf/tile_trace.h"

#include <algorithm>
#include <array>
#include <bit>

#include "sdf/cone_march.h"
#include "sdf/tape_lanes.h"
#include "sdf/trace_loop.h"

namespace edgewise::sdf {
namespace {

/// A ray on its way.
class RayAsker {
  public:
    RayAsker(const FieldRay& ray, std::uint32_t index, const TraceSettings& settings)
        : ray_(ray), trace_(ray_, settings), index_(index) {}
    bool asks() const { return trace_.asks(); }
    double askedAt() const { return trace_.askedAt(); }
    glm::dvec3 askedPoint() const { return ray_.origin_world + ray_.direction_world * trace_.askedAt(); }
    void take(double value) { trace_.take(value); }
    TraceHit hit(double scale) const { return trace_.hit(scale); }
    std::uint32_t index() const { return index_; }

  private:
    FieldRay ray_;
    RayTrace trace_;
    std::uint32_t index_;
};

/// Those that ask in one slab, eight at a time, until they ask elsewhere or no more.
template <class Asker>
class LaneQueue {
  public:
    LaneQueue(SlabTapes& tapes, double scale, TileCounts& counts)
        : tapes_(tapes), scale_(scale), counts_(counts) {}

    void serve(std::span<Asker> askers) {
        for (Asker& asker : askers) await(asker);
        while (!waiting_.empty()) serveNearest();
    }

  private:
    struct Waiting {
        int slab;
        Asker* asker;
    };
    void await(Asker& asker) {
        if (asker.asks()) waiting_.push_back({tapes_.indexOf(asker.askedAt()), &asker});
    }

    void serveNearest() {
        int nearest = waiting_.front().slab;
        for (const Waiting& w : waiting_) nearest = std::min(nearest, w.slab);
        const auto others = std::stable_partition(waiting_.begin(), waiting_.end(),
                                                  [=](const Waiting& w) { return w.slab == nearest; });
        std::vector<Asker*>& here = here_;
        here.clear();
        for (auto w = waiting_.begin(); w != others; ++w) here.push_back(w->asker);
        waiting_.erase(waiting_.begin(), others);
        const Tape& tape = tapes_.of(nearest, here.size(), counts_.prune);
        while (!here.empty()) pass(tape, nearest, here);
    }

    /// Up to eight from the end.
    void pass(const Tape& tape, int slab, std::vector<Asker*>& here) {
        const std::size_t count = std::min<std::size_t>(kPointLanes, here.size());
        std::array<Asker*, kPointLanes> lane{};
        std::copy_n(here.end() - static_cast<std::ptrdiff_t>(count), count, lane.begin());
        here.resize(here.size() - count);
        LanePoints points;
        for (std::size_t i = 0; i < kPointLanes; ++i) {
            const glm::dvec3 p = lane[std::min(i, count - 1)]->askedPoint();
            for (int axis = 0; axis < 3; ++axis) points.axis[axis][i] = p[axis];
        }
        double values[kPointLanes];
        laneValues(tape, points, values);
        ++counts_.passes;
        counts_.instructions += count * tape.size();
        for (std::size_t i = 0; i < count; ++i) {
            lane[i]->take(values[i] * scale_);
            if (!lane[i]->asks()) continue;
            if (tapes_.indexOf(lane[i]->askedAt()) == slab)
                here.push_back(lane[i]);
            else
                await(*lane[i]);
        }
    }

    SlabTapes& tapes_;
    double scale_;
    TileCounts& counts_;
    std::vector<Waiting> waiting_;
    std::vector<Asker*> here_;
};

}  // namespace

TileSides TileSides::forSamples(int per_side) {
    const int scale = std::min(static_cast<int>(std::bit_ceil(static_cast<unsigned>(per_side))), 64);
    return {std::max(64 / scale, 1), std::max(8 / scale, 1)};
}

TileCounts& TileCounts::operator+=(const TileCounts& other) {
    rays += other.rays, evaluations += other.evaluations, iterations += other.iterations;
    failed += other.failed, cones += other.cones, cone_evaluations += other.cone_evaluations;
    instructions += other.instructions, passes += other.passes;
    leaf_tiles += other.leaf_tiles, empty_tiles += other.empty_tiles;
    prune += other.prune;
    return *this;
}

/// One top tile.
class TileWork {
  public:
    TileWork(const TileTracer& tracer, std::span<TraceHit> hits, TileCounts& counts)
        : t_(tracer), scale_(tracer.sign_ / tracer.tape_.lipschitz), hits_(hits), counts_(counts) {}

    void run(int x, int y, std::span<TileRay> rays) {
        const Beam beam = beamOf(x, y, t_.sides_.top_px);
        const Slabs slabs(beam, t_.grid_.t_min, t_.grid_.t_max);
        SlabTapes tapes(t_.tape_, slabs, beam, t_.settings_.prune);
        std::vector<Tile> top{{x, y, t_.sides_.top_px, rays, t_.grid_.t_min}};
        march(top, tapes);
        if (!top.empty()) descend(top.front(), tapes);
    }

  private:
    struct Tile {
        int x, y, side;
        std::span<TileRay> rays;
        double t_start;
    };

    Beam beamOf(int x, int y, int side) const { return t_.grid_.beam({x, y}, {x + side, y + side}); }

    /// Moves the tiles' starts as far as their cones are free; takes out the empty ones.
    void march(std::vector<Tile>& tiles, SlabTapes& tapes) {
        std::erase_if(tiles, [](const Tile& tile) { return tile.rays.empty(); });
        if (!t_.settings_.prepass || tiles.empty()) return;
        std::vector<ConeMarch> cones;
        const Relaxation relaxation = t_.settings_.relaxation;
        for (const Tile& tile : tiles)
            cones.emplace_back(beamOf(tile.x, tile.y, tile.side), tile.t_start, t_.grid_.t_max, relaxation);
        LaneQueue<ConeMarch>(tapes, scale_, counts_).serve(cones);
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            counts_.cones += 1, counts_.cone_evaluations += cones[i].evaluations();
            tiles[i].t_start = cones[i].freeUpTo();
            if (cones[i].empty()) leaveOut(tiles[i]);
        }
        std::erase_if(tiles, [](const Tile& tile) { return tile.rays.empty(); });
    }

    void leaveOut(Tile& tile) {
        for (const TileRay& ray : tile.rays) {
            TraceHit far;
            far.t = ray.ray.t_max;
            hits_[ray.index] = far;
        }
        counts_.rays += tile.rays.size(), ++counts_.empty_tiles;
        tile.rays = {};
    }

    /// The four tiles of half the side.
    std::vector<Tile> quarters(const Tile& tile) {
        const int half = tile.side / 2;
        std::vector<Tile> parts;
        auto begin = tile.rays.begin();
        for (int part = 0; part < 4; ++part) {
            const int x = tile.x + (part & 1) * half, y = tile.y + (part >> 1) * half;
            const auto end = std::partition(begin, tile.rays.end(), [&](const TileRay& ray) {
                return (ray.p_px.x >= tile.x + half) == ((part & 1) != 0) &&
                       (ray.p_px.y >= tile.y + half) == ((part >> 1) != 0);
            });
            parts.push_back({x, y, half, {begin, end}, tile.t_start});
            begin = end;
        }
        return parts;
    }

    void descend(const Tile& tile, SlabTapes& tapes) {
        if (tile.side <= t_.sides_.leaf_px) return traceLeaf(tile, tapes);
        std::vector<Tile> parts = quarters(tile);
        march(parts, tapes);
        for (const Tile& part : parts) {
            SlabTapes own(tapes, beamOf(part.x, part.y, part.side));
            descend(part, own);
        }
    }

    /// Cones get as narrow as a pixel, as long as each holds a few rays.
    void traceLeaf(const Tile& leaf, SlabTapes& tapes) {
        ++counts_.leaf_tiles;
        std::vector<Tile> tiles{leaf};
        while (t_.settings_.prepass && !tiles.empty() && tiles.front().side > 1) {
            if (tiles.front().rays.size() < kLeastRaysToSplit) break;
            std::vector<Tile> parts;
            for (const Tile& tile : tiles)
                for (const Tile& part : quarters(tile)) parts.push_back(part);
            march(parts, tapes);
            tiles = std::move(parts);
        }
        traceRays(tiles, tapes);
    }

    void traceRays(const std::vector<Tile>& tiles, SlabTapes& tapes) {
        std::vector<RayAsker> askers;
        for (const Tile& tile : tiles)
            for (const TileRay& ray : tile.rays) {
                FieldRay shorter = ray.ray;
                shorter.t_min = std::max(shorter.t_min, tile.t_start);
                askers.emplace_back(shorter, ray.index, t_.settings_);
            }
        LaneQueue<RayAsker>(tapes, scale_, counts_).serve(askers);
        for (const RayAsker& asker : askers) {
            const TraceHit hit = asker.hit(1.0 / scale_);
            counts_.rays += 1, counts_.evaluations += hit.evaluations;
            counts_.iterations += hit.iterations, counts_.failed += hit.failed;
            hits_[asker.index()] = hit;
        }
    }

    static constexpr std::size_t kLeastRaysToSplit = 9;

    const TileTracer& t_;
    double scale_;
    std::span<TraceHit> hits_;
    TileCounts& counts_;
};

TileTracer::TileTracer(const Tape& tape, const RayGrid& grid, const TraceSettings& settings, double sign,
                       TileSides sides)
    : tape_(tape), grid_(grid), settings_(settings), sign_(sign), sides_(sides) {}

void TileTracer::trace(int x_px, int y_px, std::vector<TileRay>& rays, std::span<TraceHit> hits,
                       TileCounts& counts) const {
    TileWork(*this, hits, counts).run(x_px, y_px, rays);
}

}  // namespace edgewise::sdf
