#include "analytic/border.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

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
    for (BorderCrossing& x : c) x.doubt = std::min(x.doubt, limit);
    for (auto x = c.rbegin(); x != c.rend(); ++x) x->reaches_back = low = std::min(low, x->order - x->doubt);
}

/// A cluster ends where no crossing before may lie behind any crossing after.
std::size_t clusterEnd(const Crossings& c, std::size_t first) {
    double reach = c[first].order + c[first].doubt;
    std::size_t last = first + 1;
    for (; last < c.size() && c[last].reaches_back <= reach; ++last)
        reach = std::max(reach, c[last].order + c[last].doubt);
    return last;
}

/// The label that leads into the cluster: it is left once more often than it is entered. None or several:
/// unknown.
std::optional<Owner> labelBefore(const Crossings& c, Cluster cluster) {
    std::optional<Owner> found;
    for (std::size_t i = cluster.first; i < cluster.last; ++i) {
        int surplus = 0;
        for (std::size_t j = cluster.first; j < cluster.last; ++j)
            surplus += (c[j].before == c[i].before) - (c[j].after == c[i].before);
        if (surplus <= 0 || found == c[i].before) continue;
        if (found) return std::nullopt;
        found = c[i].before;
    }
    return found;
}

/// The cluster's crossings in an order in which their labels chain from `label`, all of them where that is
/// possible: an Eulerian path by Hierholzer's way, labels being its nodes; those that it cannot reach come
/// last.
std::vector<std::size_t> chain(const Crossings& c, Cluster cluster, Owner label) {
    constexpr std::size_t kStart = ~std::size_t{0};
    std::vector<bool> used(c.size(), false);
    std::vector<std::size_t> walk{kStart}, path;
    while (!walk.empty()) {
        const Owner here = walk.back() == kStart ? label : c[walk.back()].after;
        std::size_t next = cluster.first;
        while (next < cluster.last && (used[next] || c[next].before != here)) ++next;
        if (next < cluster.last) {
            used[next] = true;
            walk.push_back(next);
        } else {
            if (walk.back() != kStart) path.push_back(walk.back());
            walk.pop_back();
        }
    }
    std::reverse(path.begin(), path.end());
    for (std::size_t i = cluster.first; i < cluster.last; ++i)
        if (!used[i]) path.push_back(i);
    return path;
}

/// Puts the cluster's labels, not its positions, into the order in which they chain from `label`; returns the
/// last one.
Owner chainLabels(Crossings& c, Cluster cluster, Owner label) {
    if (cluster.last - cluster.first == 1) return c[cluster.first].after;
    const auto begin = c.begin() + static_cast<std::ptrdiff_t>(cluster.first);
    const Crossings sorted(begin, c.begin() + static_cast<std::ptrdiff_t>(cluster.last));
    auto at = begin;
    for (std::size_t i : chain(sorted, {0, sorted.size()}, label)) {
        at->before = sorted[i].before;
        at->after = sorted[i].after;
        ++at;
    }
    return c[cluster.last - 1].after;
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

/// Whether the cluster leaves any label as it was and does not know this one: something touches the border
/// from outside, behind an edge that touches it too.
bool passesBy(const Crossings& c, Cluster cluster, Owner label) {
    for (std::size_t i = cluster.first; i < cluster.last; ++i) {
        int surplus = 0;
        for (std::size_t j = cluster.first; j < cluster.last; ++j)
            surplus += (c[j].before == c[i].before) - (c[j].after == c[i].before);
        if (surplus != 0 || c[i].before == label) return false;
    }
    return true;
}

/// The label before the first crossing: the first cluster that changes labels decides. If none does, the
/// whole border but for their insides has one owner: the base's, unless it lies in a cluster that can be
/// sorted.
Owner firstLabel(const Crossings& c, Owner base, bool circle) {
    std::optional<Owner> touching;
    for (std::size_t first = 0; first < c.size();) {
        const Cluster cluster{first, clusterEnd(c, first)};
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
    std::sort(c.begin(), c.end(),
              [&](const BorderCrossing& a, const BorderCrossing& b) { return key(a) < key(b); });
}

}  // namespace

namespace {

/// What the next cluster expects, or the start of the circle behind the last one.
std::optional<Owner> labelAfter(const Crossings& c, Cluster cluster, bool circle, Owner start) {
    if (cluster.last < c.size()) return labelBefore(c, {cluster.last, clusterEnd(c, cluster.last)});
    return circle ? std::optional(start) : std::nullopt;
}

/// Segments that meet on the border may end there a rounding apart, one inside and one outside, and then a
/// crossing is missing. The cluster leads to what comes next, if any of its crossings does.
Owner mendEnd(Crossings& c, Cluster cluster, Owner label, std::optional<Owner> next) {
    if (!next || *next == label) return label;
    for (std::size_t i = cluster.first; i < cluster.last; ++i)
        if (c[i].after == *next) return c[cluster.last - 1].after = *next;
    return label;
}

}  // namespace

namespace {

/// Puts the labels in order; `first` becomes the label before the first crossing. Returns the conflicts, and
/// as many more as crossings were found missing.
int orderLabels(Crossings& c, bool circle, Owner base, double limit, Owner& first_label) {
    noteDoubts(c, limit);
    const Owner start = first_label = firstLabel(c, base, circle);
    Owner label = start;
    int conflicts = 0;
    for (std::size_t first = 0; first < c.size();) {
        const Cluster cluster{first, clusterEnd(c, first)};
        first = cluster.last;
        if (passesBy(c, cluster, label)) {
            for (std::size_t i = cluster.first; i < cluster.last; ++i) c[i].before = c[i].after = label;
            continue;
        }
        const std::optional<Owner> expected = labelBefore(c, cluster);
        if (expected && *expected != label) ++conflicts;
        label = chainLabels(c, cluster, expected.value_or(label));
        if (cluster.last - cluster.first > 1)
            label = mendEnd(c, cluster, label, labelAfter(c, cluster, circle, start));
    }
    if (circle && label != start) ++conflicts;
    return conflicts;
}

bool chains(const Crossings& c) {
    for (std::size_t i = 0; i + 1 < c.size(); ++i)
        if (c[i].after != c[i + 1].before) return false;
    return true;
}

}  // namespace

int shareBorder(Crossings& c, bool circle, Owner base, std::vector<BorderShare>& shares) {
    // Near a tangent much may be doubted, and then more labels change places than need to: so first as if
    // little were.
    constexpr double kLittle = 0x1p-46;
    shares.clear();
    if (c.empty()) {
        shares.push_back({base, kWhole});
        return 0;
    }
    sortCrossings(c);
    if (circle) cutInLongestGap(c);
    const bool much =
        std::any_of(c.begin(), c.end(), [](const BorderCrossing& x) { return x.doubt > kLittle; });
    const Crossings doubted = much ? c : Crossings();
    Owner start = base;
    int conflicts = orderLabels(c, circle, base, much ? kLittle : HUGE_VAL, start);
    if (much && (conflicts != 0 || !chains(c))) {
        c = doubted;
        conflicts = orderLabels(c, circle, base, HUGE_VAL, start);
    }
    shares.push_back({start, circle ? 0 : c.front().position});
    for (std::size_t i = 0; i + 1 < c.size(); ++i)
        shares.push_back({c[i].after, c[i + 1].position - c[i].position});
    shares.push_back({c.back().after, (circle ? c.front().position + kWhole : kWhole) - c.back().position});
    return conflicts;
}

}  // namespace edgewise
