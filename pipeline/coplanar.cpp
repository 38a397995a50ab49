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
#include "pipeline/plane_key.h"
#include "pipeline/scan.h"

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

struct Candidate {
    std::uint64_t key = 0;
    std::uint32_t node = 0, instance = 0, index = 0;
    std::uint32_t geometry = kNone, triangle = 0;  ///< geometry = kNone: no area
    auto order() const { return std::tie(node, instance, key, index); }
};

/// Candidates of triangles [begin, end) of a geometry.
void makeCandidates(const Scene& scene, std::uint32_t geometry, std::size_t begin, std::size_t end,
                    Candidate* out) {
    const Geometry& g = scene.geometry[geometry];
    std::vector<Corners> corners;
    corners.reserve(end - begin);
    for (std::size_t t = begin; t < end; ++t)
        corners.push_back(fileCorners(g, static_cast<std::uint32_t>(t)));
    const auto keys = planeKeys(corners);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto triangle = static_cast<std::uint32_t>(begin + i);
        const std::uint32_t place = hasArea(corners[i]) ? geometry : kNone;
        out[i] = {keys[i].value_or(0), g.node, g.instance, g.first_triangle + triangle, place, triangle};
    }
}

/// Those of one plane side by side: dealt into buckets by their hash, and sorted there, where they fit a
/// cache.
std::vector<Candidate> grouped(const std::vector<Candidate>& all) {
    const std::size_t buckets = std::bit_ceil(all.size() / 64 + 1);
    const auto bucketOf = [&](const Candidate& c) {
        const std::uint64_t place = std::uint64_t{c.node} << 32 | c.instance;
        return ((c.key ^ place * 0x9e3779b97f4a7c15u) * 0xd6e8feb86659fd93u >> 32) & (buckets - 1);
    };
    std::vector<std::atomic<std::uint32_t>> histogram(buckets);
    const auto forAll = [&](const auto& visit) {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, all.size(), 4096), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i)
                if (all[i].geometry != kNone) visit(all[i], histogram[bucketOf(all[i])]);
        });
    };
    forAll([](const Candidate&, auto& count) { count.fetch_add(1, std::memory_order_relaxed); });
    std::vector<std::uint32_t> counts(buckets);
    for (std::size_t b = 0; b < buckets; ++b) counts[b] = histogram[b].load(std::memory_order_relaxed);
    const std::vector<std::size_t> first = offsetsFromCounts(counts);
    for (std::size_t b = 0; b < buckets; ++b)
        histogram[b].store(static_cast<std::uint32_t>(first[b]), std::memory_order_relaxed);
    std::vector<Candidate> out(first.back());
    forAll([&](const Candidate& c, auto& next) { out[next.fetch_add(1, std::memory_order_relaxed)] = c; });
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, buckets, 64), [&](const auto& range) {
        for (std::size_t b = range.begin(); b < range.end(); ++b)
            std::sort(out.begin() + static_cast<std::ptrdiff_t>(first[b]),
                      out.begin() + static_cast<std::ptrdiff_t>(first[b + 1]),
                      [](const Candidate& a, const Candidate& c) { return a.order() < c.order(); });
    });
    return out;
}

std::vector<Candidate> groupedCandidates(const Scene& scene) {
    std::vector<Candidate> all(scene.triangle_count);
    for (std::uint32_t g = 0; g < scene.geometry.size(); ++g) {
        const Geometry& geometry = scene.geometry[g];
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, geometry.triangles.size(), 1024),
                          [&](const auto& range) {
                              makeCandidates(scene, g, range.begin(), range.end(),
                                             all.data() + geometry.first_triangle + range.begin());
                          });
    }
    return grouped(all);
}

/// For each candidate of a run of equal keys the first triangle of its plane. One plane a run, unless keys
/// collide.
void groupRun(const Scene& scene, std::span<const Candidate> run, std::vector<std::uint32_t>& leader_of) {
    if (run.size() == 1) return void(leader_of[run[0].index] = run[0].index);
    std::vector<std::pair<ExactPlane, std::uint32_t>> planes;
    for (const Candidate& candidate : run) {
        const Corners p = fileCorners(scene.geometry[candidate.geometry], candidate.triangle);
        const auto found = std::find_if(planes.begin(), planes.end(),
                                        [&](const auto& plane) { return plane.first.contains(p); });
        if (found != planes.end()) {
            leader_of[candidate.index] = found->second;
        } else {
            leader_of[candidate.index] = candidate.index;
            planes.emplace_back(ExactPlane(p), candidate.index);
        }
    }
}

std::vector<std::uint32_t> findLeaders(const Scene& scene, const std::vector<Candidate>& sorted) {
    std::vector<std::uint32_t> leader_of(scene.triangle_count, kNone);
    auto sameRun = [&](std::size_t i) {
        return i > 0 && sorted[i].node == sorted[i - 1].node &&
               sorted[i].instance == sorted[i - 1].instance && sorted[i].key == sorted[i - 1].key;
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sorted.size(), 1024), [&](const auto& range) {
        for (std::size_t begin = range.begin(); begin < range.end(); ++begin) {
            if (sameRun(begin)) continue;
            std::size_t end = begin + 1;
            while (end < sorted.size() && sameRun(end)) ++end;
            groupRun(scene, std::span(sorted).subspan(begin, end - begin), leader_of);
        }
    });
    return leader_of;
}

/// Numbers the planes by their first triangle and picks each one's widest triangle.
void choosePlanes(const Scene& scene, const std::vector<std::uint32_t>& leader_of, CoplanarGroups& groups) {
    std::vector<double> widest;
    for (std::uint32_t g = 0; g < scene.geometry.size(); ++g) {
        const Geometry& geometry = scene.geometry[g];
        for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t) {
            const std::uint32_t index = geometry.first_triangle + t, leader = leader_of[index];
            if (leader == kNone) continue;
            if (leader == index) {
                groups.plane_of[index] = static_cast<std::uint32_t>(groups.planes.size());
                groups.planes.emplace_back();
                widest.push_back(-1.0);
            }
            const std::uint32_t plane = groups.plane_of[index] = groups.plane_of[leader];
            const double size = roughSize(fileCorners(geometry, t));
            if (size <= widest[plane]) continue;
            widest[plane] = size;
            groups.planes[plane].geometry = g;
            groups.planes[plane].triangle = t;
        }
    }
}

void formNormals(const Scene& scene, CoplanarGroups& groups, std::vector<int>& axis) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, groups.planes.size(), 1024), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            FilePlane& plane = groups.planes[i];
            const ExactPlane exact(fileCorners(scene.geometry[plane.geometry], plane.triangle));
            for (int k = 0; k < 3; ++k) plane.normal[k] = exact.normal[k].toDoubleDouble();
            axis[i] = exact.widestAxis();
        }
    });
}

void findReversed(const Scene& scene, const std::vector<int>& axis, CoplanarGroups& groups) {
    for (const Geometry& geometry : scene.geometry) {
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(0, geometry.triangles.size(), 1024), [&](const auto& range) {
                for (std::size_t t = range.begin(); t < range.end(); ++t) {
                    const std::size_t index = geometry.first_triangle + t;
                    const std::uint32_t plane = groups.plane_of[index];
                    if (plane == kNone) continue;
                    const int sign =
                        normalSign(fileCorners(geometry, static_cast<std::uint32_t>(t)), axis[plane]);
                    groups.reversed[index] =
                        (sign > 0) != (groups.planes[plane].normal[axis[plane]].hi > 0.0);
                }
            });
    }
}

}  // namespace

CoplanarGroups findCoplanar(const Scene& scene) {
    CoplanarGroups groups;
    groups.plane_of.assign(scene.triangle_count, kNone);
    groups.reversed.assign(scene.triangle_count, 0);
    choosePlanes(scene, findLeaders(scene, groupedCandidates(scene)), groups);
    std::vector<int> axis(groups.planes.size());
    formNormals(scene, groups, axis);
    findReversed(scene, axis, groups);
    return groups;
}

}  // namespace edgewise
