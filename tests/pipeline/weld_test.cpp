#include "pipeline/weld.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <tuple>

namespace edgewise {
namespace {

std::tuple<double, double, double> key(const glm::dvec3& p) {
    return {p.x + 0.0, p.y + 0.0, p.z + 0.0};
}

/// Against a map filled one by one; most points come several times, some as -0.
TEST(PointTable, NumbersPointsByTheirFirstAppearance) {
    std::mt19937 random(9);
    std::uniform_int_distribution<int> lattice(-20, 20);
    ZeroedVector<glm::dvec3> points;
    for (int i = 0; i < 100000; ++i)
        points.emplace_back(lattice(random) * 0.1, lattice(random) * (i % 2 ? -0.1 : 0.1), lattice(random));
    PointTable table(points);
    std::map<std::tuple<double, double, double>, std::uint32_t> known;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto [at, fresh] = known.try_emplace(key(points[i]), static_cast<std::uint32_t>(known.size()));
        ASSERT_EQ(table.ids()[i], at->second) << "point " << i;
        ASSERT_EQ(table.points()[at->second], points[i]);
        if (fresh) {
            ASSERT_EQ(table.firstPlaces()[at->second], i);
        }
    }
    ASSERT_EQ(table.points().size(), known.size());
    ASSERT_LT(known.size(), points.size() / 2 + points.size() / 4);
    for (int i = 0; i < 200000; ++i) {  // old ones and new ones, until the table grows
        const glm::dvec3 p(lattice(random) * 0.1, lattice(random) * 0.1, i / 2);
        const auto at = known.try_emplace(key(p), static_cast<std::uint32_t>(known.size())).first;
        ASSERT_EQ(table.id(p), at->second);
    }
}

}  // namespace
}  // namespace edgewise
