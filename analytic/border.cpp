#include "analytic/border.h"

#include <algorithm>
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

bool near(const BorderCrossing& a, const BorderCrossing& b) {
    return b.order - a.order <= a.doubt + b.doubt;
}

std::size_t clusterEnd(const Crossings& c, std::size_t first) {
    std::size_t last = first + 1;
    while (last < c.size() && near(c[last - 1], c[last])) ++last;
    return last;
}

/// The label that leads into the cluster: it is left once more often than it is entered. None or several: unknown.
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

/// Gives the cluster's labels, not its positions, an order in which they chain from `label`; returns the last one.
Owner chainLabels(Crossings& c, Cluster cluster, Owner label) {
    for (std::size_t i = cluster.first; i < cluster.last; ++i) {
        std::size_t next = i;
        while (next < cluster.last && c[next].before != label) ++next;
        if (next == cluster.last) next = i;
        std::swap(c[i].before, c[next].before);
        std::swap(c[i].after, c[next].after);
        label = c[i].after;
    }
    return label;
}

/// The label before the first crossing: clusters that leave a label as it was do not tell, the first that does decides.
Owner firstLabel(const Crossings& c, Owner base) {
    for (std::size_t first = 0; first < c.size();) {
        const Cluster cluster{first, clusterEnd(c, first)};
        if (const std::optional<Owner> label = labelBefore(c, cluster)) return *label;
        first = cluster.last;
    }
    const bool known = std::any_of(c.begin(), c.end(), [=](const BorderCrossing& x) { return x.before == base; });
    return known && c.size() == clusterEnd(c, 0) ? base : c[0].before;
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
    const auto key = [](const BorderCrossing& x) { return std::tie(x.order, x.position, x.before, x.after, x.doubt); };
    std::sort(c.begin(), c.end(), [&](const BorderCrossing& a, const BorderCrossing& b) { return key(a) < key(b); });
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
    const Owner start = firstLabel(c, base);
    Owner label = start;
    int conflicts = 0;
    for (std::size_t first = 0; first < c.size();) {
        const Cluster cluster{first, clusterEnd(c, first)};
        const std::optional<Owner> expected = labelBefore(c, cluster);
        if (expected && *expected != label) ++conflicts;
        label = chainLabels(c, cluster, expected.value_or(label));
        first = cluster.last;
    }
    if (circle && label != start) ++conflicts;
    shares.push_back({start, circle ? 0 : c.front().position});
    for (std::size_t i = 0; i + 1 < c.size(); ++i) shares.push_back({c[i].after, c[i + 1].position - c[i].position});
    shares.push_back({label, (circle ? c.front().position + kWhole : kWhole) - c.back().position});
    return conflicts;
}

}  // namespace edgewise
