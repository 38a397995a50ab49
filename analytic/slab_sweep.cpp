#include "analytic/slab_sweep.h"

#include <algorithm>
#include <bit>

#include "analytic/event_sweep.h"
#include "analytic/exact_depth.h"

namespace edgewise {
namespace {

constexpr std::uint32_t kBorder = 0xffffffffu;  ///< in the place of a line: the cell's border

/// Two abscissae nearer than this may stand in any order: each carries 5 roundings of at most 2^-49 px, since
/// points lie within two cells of the origin.
constexpr double kUnsure = 2 * 5 * 0x1p-49;

/// What the sweep knows of a line at the present slab.
struct Track {
    double x_top = 0.0, x_bottom = 0.0, x_mid = 0.0;
    FinePoint top, bottom;  ///< the line's canonical points at the slab's ends, where an event gave them
    bool top_known = false, bottom_known = false;
    OpenPiece piece;
    std::size_t labelled_in = SIZE_MAX;  ///< slab of the newest label
    Owner new_left = kBackground, new_right = kBackground;
};

/// The owner changes to `after` at a line.
struct Bound {
    std::uint32_t line;
    Owner after;
    bool operator==(const Bound&) const = default;
};

/// The owners of a slab from left to right.
struct Profile {
    Owner first = kBackground;
    std::vector<Bound> bounds;

    /// Left of bound i.
    Owner ownerBefore(std::size_t i) const { return i == 0 ? first : bounds[i - 1].after; }
};

/// Where the owner above or below an ordinate changes, or where a horizontal line or the cell ends.
struct Break {
    FineCoordinate x;
    int above = 0;  ///< 1 where the owner above changes, -1 where the one below does, else 0
    Owner before = kBackground, after = kBackground;
};

/// How often each owner lies above an ordinate, less how often below. Where lines end out of order, one place
/// counts several owners: their boundaries close all the same.
class OwnerBalance {
  public:
    void clear() { counts_.clear(); }
    void add(Owner owner, int by) {
        const auto known = std::find_if(counts_.begin(), counts_.end(),
                                        [owner](const auto& entry) { return entry.first == owner; });
        if (known == counts_.end())
            counts_.emplace_back(owner, by);
        else if ((known->second += by) == 0)
            counts_.erase(known);
    }
    bool empty() const { return counts_.empty(); }
    /// The counts as pairs of one owner above and one below; the counts sum to 0.
    void pairs(std::vector<std::pair<Owner, Owner>>& out) const {
        out.clear();
        for (const auto& [owner, count] : counts_)
            for (int k = 0; k < count; ++k) out.emplace_back(owner, owner);
        std::size_t next = 0;
        for (const auto& [owner, count] : counts_)
            for (int k = 0; k < -count; ++k) out[next++].second = owner;
    }

  private:
    std::vector<std::pair<Owner, int>> counts_;
};

}  // namespace

struct SlabSweep::State {
    const ScreenScene* scene;
    Cell cell;
    glm::dvec2 origin;
    const VisibilityOptions* options;
    CellOutput* out;

    LeafLines leaf;
    EventSweep events;
    std::vector<Track> tracks;
    std::vector<std::uint32_t> by_entry, order, left_lines;
    std::vector<std::uint64_t> mask;
    Profile above, below;
    std::vector<Break> breaks;
    OwnerBalance balance;
    std::vector<std::pair<Owner, Owner>> over_under;
    std::vector<const LocalPlane*> panes;
    std::vector<Owner> layers;
    double y_mid = 0.0;  ///< of the slab, from the origin
    std::size_t next_entry, next_event, next_horizontal;

    void begin(const ScreenScene& s, const Cell& c, glm::dvec2 o, const VisibilityOptions& opt,
               CellOutput& output);
    void startSlab(std::size_t slab);
    void locate(std::size_t slab);
    void sweep(std::size_t slab);
    void updatePieces(std::size_t slab);
    void emitRows(std::size_t slab);
    void emitHorizontals(std::size_t slab);
    void closePiece(std::uint32_t line, const FinePoint& end);
    void toggle(std::uint32_t line);
    /// What is seen of `mask` in the middle of the slab between lines `left` and `right`, or the cell's
    /// borders.
    Owner seen(std::uint32_t left, std::uint32_t right, std::size_t slab);
    template <class Before>
    Owner seenThrough(const LocalPlane* opaque, double x, const Before& before);
    double middle(std::uint32_t left, std::uint32_t right) const;
    bool exactlyInFront(const LocalPlane& p, const LocalPlane& q, std::uint32_t left, std::uint32_t right,
                        std::size_t slab);
    f64::dd exactMiddle(std::uint32_t line, double border_grid, std::size_t slab) const;
    int compare(std::uint32_t p, std::uint32_t q, std::size_t slab) const;
    FinePoint topPoint(std::uint32_t line, std::size_t slab) const;
    FinePoint bottomPoint(std::uint32_t line, std::size_t slab) const;
    bool sameProfiles() const;
    std::size_t commonBounds() const;
    void addBreaks(const Profile& profile, std::size_t from, int above, std::size_t slab);
    void collectBreaks(std::size_t first, std::size_t common, std::size_t slab);
    void emitHorizontal(FineCoordinate from, FineCoordinate to, Owner over, Owner under, std::size_t first,
                        std::size_t slab);
    double leftBorder() const { return (cell.min.x - origin.x) + kBorderRestPx; }
    double rightBorder() const { return (cell.max.x - origin.x) + kBorderRestPx; }
};

void SlabSweep::State::begin(const ScreenScene& s, const Cell& c, glm::dvec2 o, const VisibilityOptions& opt,
                             CellOutput& output) {
    scene = &s, cell = c, origin = o, options = &opt, out = &output;
    tracks.assign(leaf.lines.size(), Track{});
    mask.assign(leaf.words, 0);
    by_entry.clear(), order.clear(), left_lines.clear();
    for (std::uint32_t i = 0; i < leaf.lines.size(); ++i) {
        const LeafLine& line = leaf.lines[i];
        if (line.runsInside()) by_entry.push_back(i);
        if (line.side_before < 0 || line.side_after < 0) left_lines.push_back(i);
    }
    std::sort(by_entry.begin(), by_entry.end(), [this](std::uint32_t a, std::uint32_t b) {
        return leaf.lines[a].in0 < leaf.lines[b].in0 || (leaf.lines[a].in0 == leaf.lines[b].in0 && a < b);
    });
    next_entry = next_event = next_horizontal = 0;
    above.bounds.clear(), below.bounds.clear();
    ++out->counts.cells;
    out->counts.slabs += leaf.keys.size() - 1;
}

/// Lines end, carry on from the slab above, or begin.
void SlabSweep::State::startSlab(std::size_t slab) {
    const OrderKey key = leaf.keys[slab];
    for (const std::uint32_t i : order) {
        Track& t = tracks[i];
        t.x_top = t.x_bottom, t.top = t.bottom, t.top_known = t.bottom_known, t.bottom_known = false;
        if (leaf.lines[i].in1 == key) closePiece(i, leaf.lines[i].exit);
    }
    std::erase_if(order, [&](std::uint32_t i) { return leaf.lines[i].in1 == key; });
    while (next_entry < by_entry.size() && leaf.lines[by_entry[next_entry]].in0 <= key) {
        const std::uint32_t i = by_entry[next_entry++];
        Track& t = tracks[i];
        t.top = leaf.lines[i].enter, t.top_known = true, t.x_top = leaf.frame.localX(t.top);
        t.bottom_known = false;  // an event where the line begins is its top, not its bottom
        order.push_back(i);
    }
}

/// Abscissae at the slab's bottom, then the order at its middle.
void SlabSweep::State::locate(std::size_t slab) {
    const OrderKey key = leaf.keys[slab + 1];
    while (next_event < leaf.events.size() && leaf.events[next_event].key < key) ++next_event;
    for (std::size_t e = next_event; e < leaf.events.size() && leaf.events[e].key == key; ++e) {
        for (const std::uint32_t i : {leaf.events[e].p, leaf.events[e].q}) {
            Track& t = tracks[i];
            if (!t.bottom_known) t.bottom = leaf.events[e].point, t.bottom_known = true;
        }
    }
    for (const std::uint32_t i : order) {
        Track& t = tracks[i];
        const LeafLine& line = leaf.lines[i];
        if (line.in1 == key) t.bottom = line.exit, t.bottom_known = true;
        t.x_bottom =
            t.bottom_known ? leaf.frame.localX(t.bottom) : line.xAt(leaf.frame, leaf.ordinates[slab + 1]);
        t.x_mid = 0.5 * (t.x_top + t.x_bottom);
    }
    for (std::size_t i = 1; i < order.size(); ++i) {  // nearly sorted: the slab above was
        const std::uint32_t line = order[i];
        std::size_t j = i;
        for (; j > 0 && compare(order[j - 1], line, slab) > 0; --j) order[j] = order[j - 1];
        order[j] = line;
    }
}

/// -1, 0 or 1 as line p runs left of, on or right of line q in the slab. Doubles decide where they can; else
/// the canonical points, which know nothing of the cell.
int SlabSweep::State::compare(std::uint32_t p, std::uint32_t q, std::size_t slab) const {
    // Double-double points of lines up to 2^21 px long are good to 2^-80 px, then rounded to multiples of
    // 2^-76 px: each of one line's two ends may be off by one of them, or the other's.
    constexpr double kSame = 2 * 0x1p-76;
    const double d = tracks[p].x_mid - tracks[q].x_mid;
    if (std::abs(d) > kUnsure) return d > 0.0 ? 1 : -1;
    ++out->counts.fine_orders;
    const FineCoordinate p0 = xOf(topPoint(p, slab)), q0 = xOf(topPoint(q, slab));
    const FineCoordinate p1 = xOf(bottomPoint(p, slab)), q1 = xOf(bottomPoint(q, slab));
    const double fine =
        ((p0.grid - q0.grid) + (p1.grid - q1.grid)) + ((p0.rest - q0.rest) + (p1.rest - q1.rest));
    return std::abs(fine) <= kSame ? 0 : fine > 0.0 ? 1 : -1;
}

FinePoint SlabSweep::State::bottomPoint(std::uint32_t line, std::size_t slab) const {
    if (tracks[line].bottom_known) return tracks[line].bottom;
    return pointAtY(leaf.lines[line].carrier, leaf.ordinates[slab + 1]);
}

void SlabSweep::State::toggle(std::uint32_t line) {
    for (std::size_t w = 0; w < leaf.words; ++w) mask[w] ^= leaf.masks[line * leaf.words + w];
}

/// Half the sum of a line's abscissae at the slab's ends, or of a border's, from the anchor.
f64::dd SlabSweep::State::exactMiddle(std::uint32_t line, double border_grid, std::size_t slab) const {
    const double anchor = scene->anchor_px.x;
    if (line == kBorder) return offsetFrom(border(border_grid), anchor);
    const f64::dd sum = f64::ddAdd(offsetFrom(xOf(topPoint(line, slab)), anchor),
                                   offsetFrom(xOf(bottomPoint(line, slab)), anchor));
    return {0.5 * sum.hi, 0.5 * sum.lo};
}

/// Decided at the canonical middle, which knows nothing of the cell's frame.
bool SlabSweep::State::exactlyInFront(const LocalPlane& p, const LocalPlane& q, std::uint32_t left,
                                      std::uint32_t right, std::size_t slab) {
    ++out->counts.exact_depth;
    const f64::dd x = f64::ddAdd(exactMiddle(left, cell.min.x, slab), exactMiddle(right, cell.max.x, slab));
    const f64::dd y = f64::ddAdd(offsetFrom(leaf.ordinates[slab], scene->anchor_px.y),
                                 offsetFrom(leaf.ordinates[slab + 1], scene->anchor_px.y));
    const int sign = depthDifferenceSign(scene->planes[p.plane], scene->planes[q.plane],
                                         {0.5 * x.hi, 0.5 * x.lo}, {0.5 * y.hi, 0.5 * y.lo});
    return sign != 0 ? sign > 0 : p.owner < q.owner;
}

double SlabSweep::State::middle(std::uint32_t left, std::uint32_t right) const {
    const double x0 = left == kBorder ? leftBorder() : tracks[left].x_mid;
    const double x1 = right == kBorder ? rightBorder() : tracks[right].x_mid;
    return 0.5 * (x0 + x1);
}

Owner SlabSweep::State::seen(std::uint32_t left, std::uint32_t right, std::size_t slab) {
    const double x = middle(left, right);
    const auto before = [&](const LocalPlane& p, const LocalPlane& q) {
        const int order_now = filteredOrder(p, q, x, y_mid);
        return order_now > 0 || (order_now == 0 && exactlyInFront(p, q, left, right, slab));
    };
    const LocalPlane* best = nullptr;
    for (std::size_t w = 0; w < leaf.words; ++w) {
        for (std::uint64_t bits = mask[w] & ~leaf.see_through[w]; bits != 0; bits &= bits - 1) {
            const LocalPlane& p = leaf.planes[w * 64 + static_cast<std::size_t>(std::countr_zero(bits))];
            if (!best || before(p, *best)) best = &p;
        }
    }
    if (leaf.any_see_through) return seenThrough(best, x, before);
    return best ? best->owner : kBackground;
}

/// The stack of the see-through triangles of `mask` in front of the opaque one, or of the background.
template <class Before>
Owner SlabSweep::State::seenThrough(const LocalPlane* opaque, double x, const Before& before) {
    panes.clear();
    for (std::size_t w = 0; w < leaf.words; ++w) {
        for (std::uint64_t bits = mask[w] & leaf.see_through[w]; bits != 0; bits &= bits - 1) {
            const LocalPlane& p = leaf.planes[w * 64 + static_cast<std::size_t>(std::countr_zero(bits))];
            if (opaque && !before(p, *opaque)) continue;
            const auto behind =
                std::ranges::find_if(panes, [&](const LocalPlane* q) { return before(p, *q); });
            panes.insert(behind, &p);
        }
    }
    layers.clear();
    for (const LocalPlane* p : panes)  // pieces of one triangle are one layer
        if (layers.empty() || layers.back() != p->owner) layers.push_back(p->owner);
    if (layers.size() > kMostLayers) throw LayerLimit{origin + glm::dvec2(x, y_mid)};
    layers.push_back(opaque ? opaque->owner : kBackground);
    return out->stacks.owner(layers);
}

/// Walks the slab's middle from left to right; labels the lines where the owner changes.
void SlabSweep::State::sweep(std::size_t slab) {
    const OrderKey key = leaf.keys[slab];
    std::fill(mask.begin(), mask.end(), 0);
    for (const std::uint32_t i : left_lines) {
        const LeafLine& line = leaf.lines[i];
        if (key < line.y0 || key >= line.y1) continue;
        const int side = key >= line.in1 ? line.side_after : key < line.in0 ? line.side_before : 0;
        if (side < 0) toggle(i);
    }
    y_mid = 0.5 * (leaf.frame.localY(leaf.ordinates[slab]) + leaf.frame.localY(leaf.ordinates[slab + 1]));
    const auto next = [&](std::size_t i) { return i < order.size() ? order[i] : kBorder; };
    Owner owner = below.first = seen(kBorder, next(0), slab);
    below.bounds.clear();
    for (std::size_t i = 0; i < order.size();) {
        const std::uint32_t first = order[i];
        std::uint32_t chosen = first;
        for (; i < order.size() && (order[i] == first || compare(order[i], first, slab) == 0); ++i) {
            toggle(order[i]);
            const Carrier &c = leaf.lines[order[i]].carrier, &best = leaf.lines[chosen].carrier;
            if (c.isEdge() != best.isEdge() ? c.isEdge() : c.ref < best.ref) chosen = order[i];
        }
        const Owner after = seen(first, next(i), slab);
        if (after == owner) continue;
        Track& t = tracks[chosen];
        t.labelled_in = slab, t.new_left = owner, t.new_right = after;
        below.bounds.push_back({chosen, after});
        owner = after;
    }
}

FinePoint SlabSweep::State::topPoint(std::uint32_t line, std::size_t slab) const {
    const LeafLine& l = leaf.lines[line];
    if (l.in1 == leaf.keys[slab]) return l.exit;
    return tracks[line].top_known ? tracks[line].top : pointAtY(l.carrier, leaf.ordinates[slab]);
}

void SlabSweep::State::closePiece(std::uint32_t line, const FinePoint& end) {
    tracks[line].piece.close(leaf.lines[line], end, out->segments);
}

void SlabSweep::State::updatePieces(std::size_t slab) {
    for (const std::uint32_t i : order) {
        Track& t = tracks[i];
        OpenPiece& piece = t.piece;
        const bool labelled = t.labelled_in == slab;
        if (piece.open && labelled && piece.left == t.new_left && piece.right == t.new_right) continue;
        if (!piece.open && !labelled) continue;
        const FinePoint p = topPoint(i, slab);
        closePiece(i, p);
        if (labelled) piece.begin(t.new_left, t.new_right, p);
    }
}

void SlabSweep::State::emitRows(std::size_t slab) {
    const double y0 = leaf.ordinates[slab].grid, y1 = leaf.ordinates[slab + 1].grid;
    for (int row = static_cast<int>(std::floor(y0 - 0.5)); row + 0.5 <= y1; ++row) {
        const FineCoordinate y{row + 0.5, 0.0};
        const OrderKey key = orderKey(y, origin.y);
        if (key < leaf.keys[slab] || key >= leaf.keys[slab + 1]) continue;
        out->rows.push_back({row, below.first, cell.min.x + kBorderRestPx});
        double reached = cell.min.x + kBorderRestPx;  // rounding must not exchange the ends of a thin owner
        for (const Bound& b : below.bounds) {
            reached = std::max(reached, origin.x + leaf.lines[b.line].xAt(leaf.frame, y));
            out->rows.push_back({row, b.after, reached});
        }
    }
}

/// Whether two profiles change owners at the same lines: then nothing changes across the ordinate between
/// them.
bool SlabSweep::State::sameProfiles() const {
    return above.first == below.first && std::ranges::equal(above.bounds, below.bounds);
}

/// The bounds that both profiles begin with say nothing of the ordinate between them.
std::size_t SlabSweep::State::commonBounds() const {
    if (above.first != below.first) return 0;
    const auto [a, b] = std::ranges::mismatch(above.bounds, below.bounds);
    return static_cast<std::size_t>(a - above.bounds.begin());
}

void SlabSweep::State::addBreaks(const Profile& profile, std::size_t from, int above_sign, std::size_t slab) {
    Owner before = profile.ownerBefore(from);
    for (const Bound& b : std::span(profile.bounds).subspan(from)) {
        breaks.push_back({xOf(topPoint(b.line, slab)), above_sign, before, b.after});
        before = b.after;
    }
}

/// Between the cell's borders by ascending abscissa. It comes from the points at which the pieces of the
/// lines end, bit for bit: only then do the horizontals close what those leave open.
void SlabSweep::State::collectBreaks(std::size_t first, std::size_t common, std::size_t slab) {
    breaks.assign(1, {border(cell.min.x)});
    for (std::size_t h = first; h < next_horizontal; ++h) {
        breaks.push_back({xOf(leaf.horizontals[h].low)});
        breaks.push_back({xOf(leaf.horizontals[h].high)});
    }
    addBreaks(above, common, 1, slab);
    addBreaks(below, common, -1, slab);
    std::stable_sort(breaks.begin() + 1, breaks.end(),
                     [](const Break& a, const Break& b) { return difference(a.x, b.x) < 0.0; });
    breaks.push_back({border(cell.max.x)});
}

/// Owners change across an ordinate along horizontal lines. Where they change and no line explains it,
/// rounded planes disagree with each other within a thin slab, or lines that meet do so a rounding apart: a
/// closing piece, however short, keeps every owner's boundary closed. [E16]
void SlabSweep::State::emitHorizontals(std::size_t slab) {
    const std::size_t first = next_horizontal;
    const OrderKey key = leaf.keys[slab];
    while (next_horizontal < leaf.horizontals.size() && leaf.horizontals[next_horizontal].key == key)
        ++next_horizontal;
    if (first == next_horizontal && sameProfiles()) return;
    const std::size_t common = commonBounds();
    collectBreaks(first, common, slab);
    balance.clear();
    balance.add(above.ownerBefore(common), 1);
    balance.add(below.ownerBefore(common), -1);
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        const Break& here = breaks[i];
        if (here.above != 0) {
            balance.add(here.after, here.above);
            balance.add(here.before, -here.above);
        }
        if (balance.empty() || difference(here.x, breaks[i + 1].x) == 0.0) continue;
        balance.pairs(over_under);
        for (const auto& [over, under] : over_under)
            emitHorizontal(here.x, breaks[i + 1].x, over, under, first, slab);
    }
}

void SlabSweep::State::emitHorizontal(FineCoordinate from, FineCoordinate to, Owner over, Owner under,
                                      std::size_t first, std::size_t slab) {
    if (difference(from, to) > 0.0) std::swap(from, to), std::swap(over, under);
    const FineCoordinate y = leaf.ordinates[slab];
    const auto emit = [&](std::uint64_t line_key, LineRef line) {
        out->segments.push_back({line_key, line, over, under, finePoint(to, y), finePoint(from, y)});
    };
    for (std::size_t h = first; h < next_horizontal; ++h) {
        const LeafHorizontal& line = leaf.horizontals[h];
        if (difference(xOf(line.low), from) <= 0.0 && difference(to, xOf(line.high)) <= 0.0)
            return emit(lineKey(line.carrier), line.carrier.ref);
    }
    if (difference(to, from) > kUnsure) ++out->counts.closings;
    emit(closingKey(y), LineRef::closing());
}

SlabSweep::SlabSweep() : state_(std::make_unique<State>()) {}
SlabSweep::~SlabSweep() = default;

void SlabSweep::run(const ScreenScene& scene, const Cell& cell, glm::dvec2 origin,
                    std::span<const std::uint32_t> triangles, const VisibilityOptions& options,
                    CellOutput& out) {
    State& s = *state_;
    s.leaf.collect(scene, cell, origin, triangles, options, out.counts);
    if (options.events && s.events.run(s.leaf, out)) return;
    s.leaf.sortKeys();
    s.begin(scene, cell, origin, options, out);
    const std::size_t slabs = s.leaf.keys.size() - 1;
    for (std::size_t slab = 0; slab < slabs; ++slab) {
        s.startSlab(slab);
        s.locate(slab);
        s.sweep(slab);
        s.updatePieces(slab);
        if (slab > 0) s.emitHorizontals(slab);
        s.emitRows(slab);
        std::swap(s.above, s.below);
    }
    for (const std::uint32_t i : s.order) s.closePiece(i, s.leaf.lines[i].exit);
}

}  // namespace edgewise
