#include "analytic/cell_clip.h"

#include <algorithm>

namespace edgewise {
namespace {

constexpr OrderKey kFarKey = static_cast<OrderKey>(1) << 120;

/// Shortens the part inside where the line crosses a side border of the cell.
class SideClip {
  public:
    SideClip(const CellFrame& frame, LeafLine& line) : frame_(frame), line_(line) {}

    void entering(int side) {
        line_.side_before = side;
        const FinePoint p = at(side);
        const OrderKey key = frame_.key(yOf(p));
        if (key > line_.in0) line_.in0 = key, line_.enter = p, entered_ = true;
    }
    void leaving(int side) {
        line_.side_after = side;
        const FinePoint p = at(side);
        const OrderKey key = frame_.key(yOf(p));
        if (key < line_.in1) line_.in1 = key, line_.exit = p, left_ = true;
    }
    /// Ends on the upper and lower borders, where no side border came first.
    void finish(bool from_above, bool to_below) {
        const Cell& cell = frame_.cell;
        if (from_above && !entered_) line_.enter = pointAtY(line_.carrier, border(cell.min.y));
        if (to_below && !left_) line_.exit = pointAtY(line_.carrier, border(cell.max.y));
        line_.slope = line_.carrier.slope();
        const double x0 = frame_.localX(line_.enter), x1 = frame_.localX(line_.exit);
        line_.x_low = std::min(x0, x1), line_.x_high = std::max(x0, x1);
    }

  private:
    FinePoint at(int side) const {
        return pointAtX(line_.carrier, border(side < 0 ? frame_.cell.min.x : frame_.cell.max.x));
    }

    const CellFrame& frame_;
    LeafLine& line_;
    bool entered_ = false, left_ = false;
};

}  // namespace

CellFrame::CellFrame(const Cell& c, glm::dvec2 o)
    : cell(c), origin(o), top(orderKey(border(c.min.y), o.y)), bottom(orderKey(border(c.max.y), o.y)) {}

OrderKey CellFrame::key(FineCoordinate y) const {
    const double offset = y.grid - origin.y;
    if (!(offset < kGuardBandPx)) return kFarKey;
    if (!(offset > -kGuardBandPx)) return -kFarKey;
    return orderKey(y, origin.y);
}

bool clipEdge(const CellFrame& frame, LeafLine& line) {
    const Carrier& c = line.carrier;
    const OrderKey ka = orderKey({c.a.y, 0.0}, frame.origin.y), kb = orderKey({c.b.y, 0.0}, frame.origin.y);
    if (kb <= frame.top || ka >= frame.bottom) return false;
    line.in0 = line.y0 = std::max(ka, frame.top);
    line.in1 = line.y1 = std::min(kb, frame.bottom);
    const int from = frame.column(c.a.x), to = frame.column(c.b.x);
    if (from == to && from != 0) {
        line.side_before = line.side_after = from;
        line.in1 = line.in0;
        return from < 0;
    }
    if (ka > frame.top) line.enter = gridPoint(c.a);
    if (kb < frame.bottom) line.exit = gridPoint(c.b);
    SideClip clip(frame, line);
    if (from != 0) clip.entering(from);
    if (to != 0) clip.leaving(to);
    if (!line.runsInside()) return line.side_before < 0 || line.side_after < 0;
    clip.finish(ka<frame.top, kb> frame.bottom);
    return true;
}

bool clipDepthLine(const CellFrame& frame, LeafLine& line) {
    const Carrier& c = line.carrier;
    line.in0 = line.y0 = frame.top;
    line.in1 = line.y1 = frame.bottom;
    const double slope = c.slope();
    SideClip clip(frame, line);
    if (slope != 0.0) {
        clip.entering(slope > 0.0 ? -1 : 1);
        clip.leaving(slope > 0.0 ? 1 : -1);
    } else {
        const FineCoordinate x = xOf(pointAtY(c, border(frame.cell.min.y)));
        const bool right_of_left = difference(x, border(frame.cell.min.x)) > 0.0;
        if (!right_of_left || difference(x, border(frame.cell.max.x)) > 0.0) return false;
    }
    if (!line.runsInside()) return false;
    clip.finish(true, true);
    return true;
}

bool clipHorizontalEdge(const CellFrame& frame, const Carrier& edge, LeafHorizontal& out) {
    const Cell& cell = frame.cell;
    if (edge.a.y <= cell.min.y || edge.a.y > cell.max.y || edge.a.x <= cell.min.x || edge.b.x > cell.max.x)
        return false;
    const FineCoordinate y{edge.a.y, 0.0};
    const FinePoint low = edge.b.x <= cell.min.x ? finePoint(border(cell.min.x), y) : gridPoint(edge.b);
    const FinePoint high = edge.a.x > cell.max.x ? finePoint(border(cell.max.x), y) : gridPoint(edge.a);
    out = {edge, orderKey(y, frame.origin.y), y, low, high};
    return true;
}

}  // namespace edgewise
