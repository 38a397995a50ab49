#include "analytic/border.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "analytic/sort_few.h"

namespace edgewise {
namespace {

constexpr std::int64_t kWhole = std::int64_t{1} << 60;

using Crossings = std::vector<BorderCrossing>;

/// Crossings [first, last) that doubt cannot tell apart.
struct Cluster {
    std::size_t first, last;
};

/// No doubt is taken to be larger than `limit`. Fills `reaches_back`: how far down this crossing or a later
/// one may lie.
void noteDoubts(Crossings& c, double limit) {
    double low = HUGE_VAL;
    for (auto x = c.rbegin(); x != c.rend(); ++x)
        x->reaches_back = low = std::min(low, x->order - std::min(x->doubt, limit));
}

/// A cluster ends where no crossing before may lie behind any crossing after.
std::size_t clusterEnd(const Crossings& c, std::size_t first, double limit) {
    const auto reachOf = [=](const BorderCrossing& x) { return x.order + std::min(x.doubt, limit); };
    double reach = reachOf(c[first]);
    std::size_t last = first + 1;
    for (; last < c.size() && c[last].reaches_back <= reach; ++last)
        reach = std::max(reach, reachOf(c[last]));
    return last;
}

/// How often the cluster leaves a label, less how often it enters it.
int surplus(const Crossings& c, Cluster cluster, Owner label) {
    int count = 0;
    for (std::size_t i = cluster.first; i < cluster.last; ++i)
        count += (c[i].before == label) - (c[i].after == label);
    return count;
}

/// The label that leads into the cluster: it is left once more often than it is entered. None or several:
/// unknown.
std::optional<Owner> labelBefore(const Crossings& c, Cluster cluster) {
    std::optional<Owner> found;
    for (std::size_t i = cluster.first; i < cluster.last; ++i) {
        if (found == c[i].before || surplus(c, cluster, c[i].before) <= 0) continue;
        if (found) return std::nullopt;
        found = c[i].before;
    }
    return found;
}

/// The label that leads into a cluster which leaves it as it was: a corner that only touches the border. The
/// order of the segments around their vertex tells, if their labels chain in it.
std::optional<Owner> labelAroundVertex(const Crossings& c, Cluster cluster) {
    Crossings fan(c.begin() + static_cast<std::ptrdiff_t>(cluster.first),
                  c.begin() + static_cast<std::ptrdiff_t>(cluster.last));
    const auto key = [](const BorderCrossing& x) { return std::tie(x.spread, x.order, x.before, x.after); };
    std::sort(fan.begin(), fan.end(),
              [&](const BorderCrossing& a, const BorderCrossing& b) { return key(a) < key(b); });
    for (std::size_t i = 0; i + 1 < fan.size(); ++i)
        if (fan[i].after != fan[i + 1].before) return std::nullopt;
    return fan.front().before;
}

/// Whether the base point, where `order` is 0, may lie in the cluster. A base owner looked up farther away
/// stands.
bool holdsBase(const Crossings& c, Cluster cluster, bool circle) {
    constexpr double kLookup = 0x1p-30;
    return std::any_of(c.begin() + static_cast<std::ptrdiff_t>(cluster.first),
                       c.begin() + static_cast<std::ptrdiff_t>(cluster.last), [=](const BorderCrossing& x) {
                           const double order = circle ? std::remainder(x.order, 1.0) : x.order;
                           return std::abs(order) <= kLookup + x.doubt;
                       });
}

/// The label before the first crossing: the first cluster that changes labels decides. If none does, the
/// whole border but for their insides has one owner: the base's, unless it lies in a cluster that can be
/// sorted.
Owner firstLabel(const Crossings& c, Owner base, bool circle, double limit) {
    std::optional<Owner> touching;
    for (std::size_t first = 0; first < c.size();) {
        const Cluster cluster{first, clusterEnd(c, first, limit)};
        if (const std::optional<Owner> label = labelBefore(c, cluster)) return *label;
        if (!touching && holdsBase(c, cluster, circle)) touching = labelAroundVertex(c, cluster);
        first = cluster.last;
    }
    return touching.value_or(base);
}

/// Cuts the circle in its longest gap, where no cluster can be.
void cutInLongestGap(Crossings& c) {
    std::size_t cut = 0;
    double longest = c.front().order + 1.0 - c.back().order;
    for (std::size_t i = 1; i < c.size(); ++i) {
        const double gap = c[i].order - c[i - 1].order;
        if (gap > longest) {
            longest = gap;
            cut = i;
        }
    }
    std::rotate(c.begin(), c.begin() + static_cast<std::ptrdiff_t>(cut), c.end());
    for (std::size_t i = c.size() - cut; i < c.size(); ++i) {
        c[i].position += kWhole;
        c[i].order += 1.0;
    }
}

void sortCrossings(Crossings& c) {
    const auto key = [](const BorderCrossing& x) {
        return std::tie(x.order, x.position, x.before, x.after, x.doubt);
    };
    sortFew(c, 16, [&](const BorderCrossing& a, const BorderCrossing& b) {
        return a.order != b.order ? a.order < b.order : key(a) < key(b);
    });
}

/// The label that a cluster leads to: it is entered once more often than it is left.
Owner labelAfter(const Crossings& c, Cluster cluster, Owner label) {
    for (std::size_t i = cluster.first; i < cluster.last; ++i)
        if (surplus(c, cluster, c[i].after) < 0) return c[i].after;
    return label;
}

/// Whether the cluster leaves several labels more often than it enters them: then it is no part of a chain.
bool leavesSeveral(const Crossings& c, Cluster cluster) {
    std::optional<Owner> found;
    for (std::size_t i = cluster.first; i < cluster.last; ++i) {
        const int count = surplus(c, cluster, c[i].before);
        if (count > 1 || (count == 1 && found && *found != c[i].before)) return true;
        if (count == 1) found = c[i].before;
    }
    return false;
}

/// Whether the labels chain from `label` through all clusters that change it, and around the circle.
bool chainsFrom(const Crossings& c, Owner label, bool circle, double limit) {
    const Owner start = label;
    for (std::size_t first = 0; first < c.size();) {
        const Cluster cluster{first, clusterEnd(c, first, limit)};
        const std::optional<Owner> expected = labelBefore(c, cluster);
        if (expected ? *expected != label : leavesSeveral(c, cluster)) return false;
        label = labelAfter(c, cluster, label);
        first = cluster.last;
    }
    return !circle || label == start;
}

/// Whether rounding alone may have made all changes of labels: every cluster of crossings that may lie in any
/// order leaves the label as it was, and none is where the base is.
bool baseDecides(const Crossings& c, bool circle) {
    for (std::size_t first = 0; first < c.size();) {
        const Cluster cluster{first, clusterEnd(c, first, HUGE_VAL)};
        if (labelBefore(c, cluster) || holdsBase(c, cluster, circle)) return false;
        first = cluster.last;
    }
    return true;
}

/// The label before the first crossing. Along a side it is the one that all crossings together leave once
/// more than they enter it, if there is one: no order is needed. Near a tangent much may be doubted, and then
/// a cluster may hide what its crossings say: so first as if little were, unless the base can tell.
Owner startLabel(Crossings& c, Owner base, bool circle) {
    constexpr double kLittle = 0x1p-46;
    if (!circle)
        if (const std::optional<Owner> label = labelBefore(c, {0, c.size()})) return *label;
    noteDoubts(c, HUGE_VAL);
    if (baseDecides(c, circle)) return base;
    Owner label = base;
    for (const double limit : {kLittle, HUGE_VAL}) {
        noteDoubts(c, limit);
        label = firstLabel(c, base, circle, limit);
        if (chainsFrom(c, label, circle, limit)) break;
    }
    return label;
}

/// Whether the labels chain in the order of the crossings, from `label` and around the circle.
bool chainsInOrder(const Crossings& c, Owner label, bool circle) {
    for (const BorderCrossing& x : c) {
        if (x.before != label) return false;
        label = x.after;
    }
    return !circle || label == c.front().before;
}

/// Whether every crossing changes the label and none may be confused with the next: what startLabel() makes
/// of these is the label before the first one, without further ado. Twice the doubts and more, for the
/// roundings of their sums.
bool changeApart(const Crossings& c) {
    double doubt = 0.0;
    for (const BorderCrossing& x : c) {
        if (x.before == x.after) return false;
        doubt = std::max(doubt, x.doubt);
    }
    for (std::size_t i = 1; i < c.size(); ++i)
        if (!(c[i].order - c[i - 1].order > 4 * doubt)) return false;
    return true;
}

/// The owner behind the last crossing, where `start` is the one before the first: labels are entered as often
/// as they are left, but for these two. None where the map is open.
std::optional<Owner> endLabel(const Crossings& c, Owner start) {
    std::vector<Owner> entered{start}, left;
    for (const BorderCrossing& x : c) entered.push_back(x.after), left.push_back(x.before);
    std::sort(entered.begin(), entered.end());
    std::sort(left.begin(), left.end());
    std::optional<Owner> end;
    std::size_t at = 0;
    for (const Owner owner : entered) {
        if (at < left.size() && left[at] == owner) {
            ++at;
            continue;
        }
        if (end) return std::nullopt;
        end = owner;
    }
    return end;
}

/// Stretches from each crossing to the next.
void shareInOrder(const Crossings& c, Owner start, std::int64_t from, std::int64_t to,
                  std::vector<BorderShare>& shares) {
    shares.push_back({start, c.front().position - from});
    for (std::size_t i = 0; i + 1 < c.size(); ++i)
        shares.push_back({c[i].after, c[i + 1].position - c[i].position});
    shares.push_back({c.back().after, to - c.back().position});
}

/// An owner has what lies before the crossings that leave it, less what lies before those that enter it: that
/// holds in whatever order rounding has put them.
void shareInAnyOrder(const Crossings& c, Owner end, std::int64_t from, std::int64_t to, Owner start,
                     std::vector<BorderShare>& shares) {
    shares.push_back({start, -from});
    for (const BorderCrossing& x : c) {
        shares.push_back({x.before, x.position});
        shares.push_back({x.after, -x.position});
    }
    shares.push_back({end, to});
}

}  // namespace

int shareBorder(Crossings& c, bool circle, Owner base, std::vector<BorderShare>& shares) {
    shares.clear();
    if (c.empty()) {
        shares.push_back({base, kWhole});
        return 0;
    }
    sortCrossings(c);
    if (circle) cutInLongestGap(c);
    const std::int64_t from = circle ? c.front().position : 0, to = from + kWhole;
    const Owner first = c.front().before;
    if (chainsInOrder(c, first, circle) && changeApart(c)) {
        shareInOrder(c, first, from, to, shares);
        return 0;
    }
    const Owner start = startLabel(c, base, circle);
    if (chainsInOrder(c, start, circle)) {
        shareInOrder(c, start, from, to, shares);
        return 0;
    }
    const std::optional<Owner> end = endLabel(c, start);
    const bool closed = end && (!circle || *end == start);
    if (closed)
        shareInAnyOrder(c, *end, from, to, start, shares);
    else
        shareInOrder(c, start, from, to, shares);
    return closed ? 0 : 1;
}

}  // namespace edgewise
