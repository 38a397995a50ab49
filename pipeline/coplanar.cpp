#include "pipeline/coplanar.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <span>
#include <tuple>

#include "analytic/expansion.h"
#include "pipeline/huge_pages.h"
#include "pipeline/plane_key.h"
#include "pipeline/runs.h"

namespace edgewise {
namespace {

using Corners = std::array<glm::vec3, 3>;

Corners fileCorners(const Geometry& geometry, std::uint32_t triangle) {
    const auto& t = geometry.triangles[triangle];
    return {geometry.position_file[t[0]], geometry.position_file[t[1]], geometry.position_file[t[2]]};
}

/// One component of a x b + b x c + c x a = (b - a) x (c - a). Products of two floats are exact in double.
Expansion<6> normalComponent(const Corners& p, int axis) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    Expansion<6> sum;
    for (int k = 0; k < 3; ++k) {
        const glm::vec3 &a = p[k], &b = p[(k + 1) % 3];
        sum.add(double(a[i]) * b[j]);
        sum.add(-double(a[j]) * b[i]);
    }
    return sum;
}

/// The sign of normalComponent(). The filter's bound: six exact products, five additions, each off by at most
/// u = 2^-53 of a partial sum that is at most `size`.
int normalSign(const Corners& p, int axis) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    double sum = 0.0, size = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double forward = double(p[k][i]) * p[(k + 1) % 3][j],
                     back = double(p[k][j]) * p[(k + 1) % 3][i];
        sum += forward - back;
        size += std::fabs(forward) + std::fabs(back);
    }
    if (std::fabs(sum) > 0x1p-50 * size) return sum > 0.0 ? 1 : -1;
    return normalComponent(p, axis).sign();
}

bool hasArea(const Corners& p) {
    return normalSign(p, 0) != 0 || normalSign(p, 1) != 0 || normalSign(p, 2) != 0;
}

/// The widest extent of the normal, rounded: it chooses the representative.
double roughSize(const Corners& p) {
    const glm::dvec3 n = glm::cross(glm::dvec3(p[1]) - glm::dvec3(p[0]), glm::dvec3(p[2]) - glm::dvec3(p[0]));
    return std::max({std::fabs(n.x), std::fabs(n.y), std::fabs(n.z)});
}

/// A plane with its exact normal.
struct ExactPlane {
    std::array<Expansion<6>, 3> normal;
    glm::vec3 point;

    explicit ExactPlane(const Corners& p)
        : normal{normalComponent(p, 0), normalComponent(p, 1), normalComponent(p, 2)}, point(p[0]) {}

    /// n . (q - point) = 0, exactly.
    bool contains(const glm::vec3& q) const {
        Expansion<72> distance;
        for (int axis = 0; axis < 3; ++axis) {
            if (q[axis] == point[axis]) continue;
            distance.addScaled(normal[axis], q[axis]);
            distance.addScaled(normal[axis], -double(point[axis]));
        }
        return distance.sign() == 0;
    }

    bool contains(const Corners& p) const { return contains(p[0]) && contains(p[1]) && contains(p[2]); }

    int widestAxis() const {
        auto size = [&](int axis) { return std::fabs(normal[axis].roundedSum()); };
        return size(0) >= size(1) && size(0) >= size(2) ? 0 : (size(1) >= size(2) ? 1 : 2);
    }
};

/// A triangle's place among those of its scene that may share its plane: half of a hash of node, instance and
/// plane, and its index. The other half says which bucket it lies in.
struct Candidate {
    std::uint32_t hash, index;
    bool operator<(const Candidate& other) const {
        return std::tie(hash, index) < std::tie(other.hash, other.index);
    }
};

constexpr std::uint64_t kNoArea = 0;

/// Hashes of triangles [begin, end) of a geometry; kNoArea for those.
void hashPlanes(const Geometry& g, std::size_t begin, std::size_t end, std::uint64_t* out) {
    std::vector<Corners> corners;
    corners.reserve(end - begin);
    for (std::size_t t = begin; t < end; ++t)
        corners.push_back(fileCorners(g, static_cast<std::uint32_t>(t)));
    const auto keys = planeKeys(corners);
    const std::uint64_t place = (std::uint64_t{g.node} << 32 | g.instance) * 0x9e3779b97f4a7c15u;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::uint64_t hash = (keys[i].value_or(0) ^ place) * 0xd6e8feb86659fd93u;
        out[i] = hasArea(corners[i]) ? std::max<std::uint64_t>(hash ^ hash >> 32, 1) : kNoArea;
    }
}

ZeroedVector<std::uint64_t> planeHashes(const Scene& scene) {
    ZeroedVector<std::uint64_t> hashes(scene.triangle_count);
    for (const Geometry& geometry : scene.geometry)
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, geometry.triangles.size(), 1024),
                          [&](const auto& range) {
                              hashPlanes(geometry, range.begin(), range.end(),
                                         hashes.data() + geometry.first_triangle + range.begin());
                          });
    return hashes;
}

/// Candidates dealt into buckets by their hash, and sorted there, where they fit a cache.
struct Buckets {
    std::vector<std::size_t> first;
    ZeroedVector<Candidate> candidates;

    std::span<Candidate> of(std::size_t bucket) {
        return std::span(candidates).subspan(first[bucket], first[bucket + 1] - first[bucket]);
    }
};

Buckets dealt(const ZeroedVector<std::uint64_t>& hashes) {
    const std::size_t buckets = std::bit_ceil(hashes.size() / 512 + 1);
    std::vector<std::atomic<std::uint32_t>> histogram(buckets);
    const auto forAll = [&](const auto& visit) {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, hashes.size(), 4096), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i)
                if (hashes[i] != kNoArea) visit(i, histogram[hashes[i] & (buckets - 1)]);
        });
    };
    forAll([](std::size_t, auto& count) { count.fetch_add(1, std::memory_order_relaxed); });
    Buckets out{offsetsFromCounts(histogram), {}};
    for (std::size_t b = 0; b < buckets; ++b)
        histogram[b].store(static_cast<std::uint32_t>(out.first[b]), std::memory_order_relaxed);
    out.candidates.resize(out.first.back());
    forAll([&](std::size_t i, auto& next) {
        out.candidates[next.fetch_add(1, std::memory_order_relaxed)] = {
            static_cast<std::uint32_t>(hashes[i] >> 32), static_cast<std::uint32_t>(i)};
    });
    return out;
}

/// By triangle: the first triangle of its plane, kNone without area, and whether it is wound against the
/// plane's representative; where the first triangle is itself, the representative.
struct Leaders {
    std::vector<std::uint32_t> leader;
    ZeroedVector<std::uint32_t> widest;
    std::vector<std::uint8_t> reversed;
};

struct FoundPlane {
    std::uint32_t node, instance, leader, widest;
    double size;
    ExactPlane plane;
};

Corners cornersOf(const Scene& scene, std::uint32_t index) {
    const TriangleRef at = findTriangle(scene, index);
    return fileCorners(scene.geometry[at.geometry], at.triangle);
}

/// Whether the normals of two triangles of one plane point against each other.
bool opposed(const Corners& p, const Corners& q) {
    for (int axis = 0; axis < 3; ++axis)
        if (const int sign = normalSign(p, axis); sign != 0) return sign != normalSign(q, axis);
    return false;
}

/// The planes of candidates with equal hashes: one, unless hashes collide.
void leadRun(const Scene& scene, std::span<const Candidate> run, std::vector<FoundPlane>& planes,
             Leaders& out) {
    planes.clear();
    for (const Candidate& candidate : run) {
        const TriangleRef at = findTriangle(scene, candidate.index);
        const Geometry& g = scene.geometry[at.geometry];
        const Corners p = fileCorners(g, at.triangle);
        const double size = roughSize(p);
        const auto found = std::ranges::find_if(planes, [&](const FoundPlane& f) {
            return f.node == g.node && f.instance == g.instance && f.plane.contains(p);
        });
        if (found == planes.end()) {
            planes.push_back({g.node, g.instance, candidate.index, candidate.index, size, ExactPlane(p)});
            out.leader[candidate.index] = candidate.index;
            continue;
        }
        out.leader[candidate.index] = found->leader;
        if (size > found->size) found->widest = candidate.index, found->size = size;
    }
    for (const FoundPlane& found : planes) out.widest[found.leader] = found.widest;
    for (const Candidate& candidate : run) {
        const std::uint32_t widest = out.widest[out.leader[candidate.index]];
        if (widest != candidate.index)
            out.reversed[candidate.index] =
                opposed(cornersOf(scene, widest), cornersOf(scene, candidate.index));
    }
}

Leaders findLeaders(const Scene& scene, Buckets buckets) {
    Leaders out{std::vector<std::uint32_t>(scene.triangle_count, kNone),
                ZeroedVector<std::uint32_t>(scene.triangle_count),
                std::vector<std::uint8_t>(scene.triangle_count)};
    const auto lead = [&](std::span<Candidate> all, std::vector<FoundPlane>& planes) {
        std::sort(all.begin(), all.end());
        for (std::size_t begin = 0, end; begin < all.size(); begin = end) {
            end = begin + 1;
            while (end < all.size() && all[end].hash == all[begin].hash) ++end;
            const std::uint32_t first = all[begin].index;
            if (end > begin + 1)
                leadRun(scene, all.subspan(begin, end - begin), planes, out);
            else
                out.leader[first] = out.widest[first] = first;
        }
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, buckets.first.size() - 1, 8),
                      [&](const auto& range) {
                          std::vector<FoundPlane> planes;
                          for (std::size_t b = range.begin(); b < range.end(); ++b)
                              lead(buckets.of(b), planes);
                      });
    return out;
}

/// Numbers the planes by their first triangle.
CoplanarGroups numbered(const Scene& scene, Leaders leaders) {
    const std::size_t count = scene.triangle_count;
    const auto leads = [&](std::size_t i) { return leaders.leader[i] == i; };
    const std::vector<std::size_t> before = countedBefore(count, leads);
    CoplanarGroups groups{std::vector<std::uint32_t>(count), std::move(leaders.reversed),
                          std::vector<FilePlane>(before.back())};
    forRuns(count, [&](std::size_t run, std::size_t begin, std::size_t end) {
        auto plane = static_cast<std::uint32_t>(before[run]);
        for (std::size_t i = begin; i < end; ++i) {
            if (!leads(i)) continue;
            const TriangleRef widest = findTriangle(scene, leaders.widest[i]);
            groups.planes[plane] = {widest.geometry, widest.triangle};
            groups.plane_of[i] = plane++;
        }
    });
    forRuns(count, [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (const std::uint32_t leader = leaders.leader[i]; leader != i)
                groups.plane_of[i] = leader == kNone ? kNone : groups.plane_of[leader];
    });
    return groups;
}

}  // namespace

std::array<f64::dd, 3> fileNormal(const Geometry& geometry, std::uint32_t triangle) {
    const Corners p = fileCorners(geometry, triangle);
    return {normalComponent(p, 0).toDoubleDouble(), normalComponent(p, 1).toDoubleDouble(),
            normalComponent(p, 2).toDoubleDouble()};
}

CoplanarGroups findCoplanar(const Scene& scene) {
    return numbered(scene, findLeaders(scene, dealt(planeHashes(scene))));
}

}  // namespace edgewise
