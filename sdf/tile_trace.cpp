#include "sdf/tile_trace.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "sdf/cone_march.h"
#include "sdf/tape_lanes.h"
#include "sdf/trace_loop.h"

namespace edgewise::sdf {
namespace {

/// As many as stay in a core's caches.
constexpr std::size_t kRaysAtOnce = 1024;

/// A ray on its way: its Trace asks.
template <class Trace>
class RayAsker {
  public:
    template <class... Settings>
    RayAsker(const FieldRay& ray, std::uint32_t index, const Settings&... settings)
        : ray_(ray), trace_(ray_, settings...), index_(index) {}
    bool asks() const { return trace_.asks(); }
    glm::dvec3 askedPoint() const { return ray_.origin_world + ray_.direction_world * trace_.askedAt(); }
    void take(double value) { trace_.take(value); }
    double radius() const { return ray_.pixel_radius + ray_.pixel_slope * trace_.askedAt(); }
    const Trace& trace() const { return trace_; }
    std::uint32_t index() const { return index_; }

  private:
    FieldRay ray_;
    Trace trace_;
    std::uint32_t index_;
};

/// One hit a ray.
struct HitProgram {
    using Asker = RayAsker<RayTrace>;
    const TraceSettings& settings;
    std::span<TraceHit> hits;

    double marginPx() const { return 0.0; }
    Asker start(const FieldRay& ray, std::uint32_t index) const { return {ray, index, settings}; }
    void keepFar(const TileRay& ray) const {
        hits[ray.index] = {};
        hits[ray.index].t = ray.ray.t_max;
    }
    void keep(const Asker& asker, double scale, TileCounts& counts) const {
        const TraceHit hit = asker.trace().hit(scale);
        counts.evaluations += hit.evaluations;
        counts.iterations += hit.iterations, counts.failed += hit.failed;
        hits[asker.index()] = hit;
    }
};

/// All that a ray's cone meets.
struct ConeProgram {
    using Asker = RayAsker<ConeTrace>;
    const TraceSettings& settings;
    const ConeSettings& cones;
    std::span<ConeHits> hits;

    double marginPx() const { return std::max(0.5 * (std::sqrt(2.0) * cones.coverage - 1.0), 0.0); }
    Asker start(const FieldRay& ray, std::uint32_t index) const { return {ray, index, settings, cones}; }
    void keepFar(const TileRay& ray) const { hits[ray.index] = {}; }
    void keep(const Asker& asker, double, TileCounts& counts) const {
        const ConeHits& met = asker.trace().hits();
        counts.evaluations += met.evaluations, counts.iterations += met.evaluations;
        hits[asker.index()] = met;
    }
};

/// Those that ask in one cell, eight at a time; round by round, until none asks.
template <class Asker>
class LaneQueue {
  public:
    LaneQueue(const CellTapes& cells, double scale, TileCounts& counts)
        : cells_(cells), scale_(scale), counts_(counts) {}

    void serve(std::span<Asker> askers) {
        for (Asker& asker : askers) await(asker, nullptr);
        while (!waiting_.empty()) serveAll();
    }

  private:
    struct Waiting {
        std::uint32_t cell_index;
        const TapeCell* cell;
        Asker* asker;
    };
    void await(Asker& asker, const TapeCell* near) {
        if (!asker.asks()) return;
        const TapeCell& cell = cells_.at(asker.askedPoint(), near, asker.radius(), counts_.prune);
        waiting_.push_back({cell.index, &cell, &asker});
    }

    void serveAll() {
        std::swap(now_, waiting_);
        waiting_.clear();
        std::sort(now_.begin(), now_.end(),
                  [](const Waiting& a, const Waiting& b) { return a.cell_index < b.cell_index; });
        for (auto begin = now_.begin(); begin != now_.end();) {
            const auto end = std::find_if(
                begin, now_.end(), [=](const Waiting& w) { return w.cell_index != begin->cell_index; });
            here_.clear();
            for (auto w = begin; w != end; ++w) here_.push_back(w->asker);
            serveCell(*begin->cell);
            begin = end;
        }
    }

    /// As long as there are eight; then one pass for the rest, who go on with those that come.
    void serveCell(const TapeCell& cell) {
        std::uint32_t passes = 0;
        while (!here_.empty()) ++passes, pass(cell);
        cells_.ran(cell, passes, counts_.prune);
    }

    /// Up to eight from the end.
    void pass(const TapeCell& cell) {
        const std::size_t count = std::min<std::size_t>(kPointLanes, here_.size());
        std::array<Asker*, kPointLanes> lane{};
        std::copy_n(here_.end() - static_cast<std::ptrdiff_t>(count), count, lane.begin());
        here_.resize(here_.size() - count);
        LanePoints points;
        for (std::size_t i = 0; i < kPointLanes; ++i) {
            const glm::dvec3 p = lane[std::min(i, count - 1)]->askedPoint();
            for (int axis = 0; axis < 3; ++axis) points.axis[axis][i] = p[axis];
        }
        double values[kPointLanes];
        laneValues(cell.tape, points, values);
        ++counts_.passes;
        counts_.instructions += count * cell.tape.size();
        const bool stay = here_.size() >= kPointLanes;
        for (std::size_t i = 0; i < count; ++i) {
            lane[i]->take(values[i] * scale_);
            if (stay && lane[i]->asks() && &cells_.at(lane[i]->askedPoint(), &cell) == &cell)
                here_.push_back(lane[i]);
            else
                await(*lane[i], &cell);
        }
    }

    const CellTapes& cells_;
    double scale_;
    TileCounts& counts_;
    std::vector<Waiting> waiting_, now_;
    std::vector<Asker*> here_;
};

}  // namespace

TileSides TileSides::forSamples(int per_side) {
    const int scale = std::min(static_cast<int>(std::bit_ceil(static_cast<unsigned>(per_side))), 64);
    return {std::max(64 / scale, 1), std::max(8 / scale, 1), std::max(2 / scale, 1)};
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
template <class Program>
class TileWork {
  public:
    TileWork(const TileTracer& tracer, const Program& program, TileCounts& counts)
        : t_(tracer),
          scale_(tracer.sign_ / tracer.tape_.lipschitz),
          program_(program),
          margin_px_(program.marginPx()),
          counts_(counts) {}

    void run(int x, int y, std::span<TileRay> rays) {
        std::vector<Tile> tiles{{x, y, t_.sides_.top_px, rays, t_.grid_.t_min}};
        march(tiles);
        while (!tiles.empty() && tiles.front().side > leastSide()) {
            if (tiles.front().side == t_.sides_.leaf_px) counts_.leaf_tiles += tiles.size();
            std::vector<Tile> parts;
            for (const Tile& tile : tiles) addQuarters(tile, parts);
            tiles = std::move(parts);
            march(tiles);
        }
        if (leastSide() == t_.sides_.leaf_px) counts_.leaf_tiles += tiles.size();
        traceRays(tiles);
    }

  private:
    using Asker = typename Program::Asker;
    struct Tile {
        int x, y, side;
        std::span<TileRay> rays;
        double t_start;
    };

    Beam beamOf(int x, int y, int side) const {
        return t_.grid_.beam({x - margin_px_, y - margin_px_},
                             {x + side + margin_px_, y + side + margin_px_});
    }
    /// How narrow cones get does not depend on which rays are asked for: a crop has the whole's bits.
    int leastSide() const {
        return t_.settings_.prepass ? std::min(t_.sides_.cone_px, t_.sides_.leaf_px) : t_.sides_.leaf_px;
    }

    /// Moves the tiles' starts as far as their cones are free; takes out the empty ones.
    void march(std::vector<Tile>& tiles) {
        std::erase_if(tiles, [](const Tile& tile) { return tile.rays.empty(); });
        if (!t_.settings_.prepass || tiles.empty()) return;
        std::vector<ConeMarch> cones;
        const Relaxation relaxation = t_.settings_.relaxation;
        for (const Tile& tile : tiles)
            cones.emplace_back(beamOf(tile.x, tile.y, tile.side), tile.t_start, t_.grid_.t_max, relaxation);
        LaneQueue<ConeMarch>(t_.cells_, scale_, counts_).serve(cones);
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            counts_.cones += 1, counts_.cone_evaluations += cones[i].evaluations();
            tiles[i].t_start = cones[i].freeUpTo();
            if (cones[i].empty()) leaveOut(tiles[i]);
        }
        std::erase_if(tiles, [](const Tile& tile) { return tile.rays.empty(); });
    }

    void leaveOut(Tile& tile) {
        for (const TileRay& ray : tile.rays) program_.keepFar(ray);
        counts_.rays += tile.rays.size(), ++counts_.empty_tiles;
        tile.rays = {};
    }

    /// The four tiles of half the side.
    static void addQuarters(const Tile& tile, std::vector<Tile>& parts) {
        const int half = tile.side / 2;
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
    }

    void traceRays(const std::vector<Tile>& tiles) {
        std::vector<Asker> askers;
        LaneQueue<Asker> queue(t_.cells_, scale_, counts_);
        for (const Tile& tile : tiles) {
            for (const TileRay& ray : tile.rays) {
                FieldRay shorter = ray.ray;
                shorter.t_min = std::max(shorter.t_min, tile.t_start);
                askers.push_back(program_.start(shorter, ray.index));
            }
            if (askers.size() >= kRaysAtOnce) finish(queue, askers);
        }
        finish(queue, askers);
    }

    void finish(LaneQueue<Asker>& queue, std::vector<Asker>& askers) {
        queue.serve(askers);
        for (const Asker& asker : askers) program_.keep(asker, 1.0 / scale_, counts_);
        counts_.rays += askers.size();
        askers.clear();
    }

    const TileTracer& t_;
    double scale_;
    const Program& program_;
    double margin_px_;
    TileCounts& counts_;
};

TileTracer::TileTracer(const Tape& tape, const RayGrid& grid, const TraceSettings& settings, double sign,
                       TileSides sides, const CellTapes* cells)
    : tape_(tape),
      grid_(grid),
      settings_(settings),
      sign_(sign),
      sides_(sides),
      own_cells_(tape, grid.eye_world, grid.t_max, settings.prune),
      cells_(cells && settings.prune ? *cells : own_cells_) {}

void TileTracer::trace(int x_px, int y_px, std::vector<TileRay>& rays, std::span<TraceHit> hits,
                       TileCounts& counts) const {
    const HitProgram program{settings_, hits};
    TileWork(*this, program, counts).run(x_px, y_px, rays);
}

void TileTracer::traceLoose(std::span<const FieldRay> rays, std::span<TraceHit> hits,
                            TileCounts& counts) const {
    const HitProgram program{settings_, hits};
    const double scale = sign_ / tape_.lipschitz;
    LaneQueue<HitProgram::Asker> queue(cells_, scale, counts);
    std::vector<HitProgram::Asker> askers;
    for (std::size_t first = 0; first < rays.size(); first += kRaysAtOnce) {
        askers.clear();
        for (std::size_t i = first; i < std::min(rays.size(), first + kRaysAtOnce); ++i)
            askers.push_back(program.start(rays[i], static_cast<std::uint32_t>(i)));
        queue.serve(askers);
        for (const HitProgram::Asker& asker : askers) program.keep(asker, 1.0 / scale, counts);
    }
    counts.rays += rays.size();
}

void TileTracer::traceCones(int x_px, int y_px, std::vector<TileRay>& rays, const ConeSettings& cones,
                            std::span<ConeHits> hits, TileCounts& counts) const {
    const ConeProgram program{settings_, cones, hits};
    TileWork(*this, program, counts).run(x_px, y_px, rays);
}

}  // namespace edgewise::sdf
