#include "paper_figures/edge_part.h"

#include <gtest/gtest.h>

namespace edgewise::figures {
namespace {

TEST(EdgePart, HasTheKindAloneAndNoneOfTheOthers) {
    Film film;
    film.width = 40, film.height = 20;
    std::vector<EdgeKind> kinds(800, EdgeKind::kNone);
    const auto set = [&](int x, int y, EdgeKind kind) { kinds[static_cast<std::size_t>(40 * y + x)] = kind; };
    for (int y = 0; y < 20; ++y) {
        set(5, y, EdgeKind::kContour), set(6, y, EdgeKind::kTexture);  // mixed
        set(30, y, EdgeKind::kContour);                                // alone
    }
    const PixelBox first = partOfKind(kinds, film, EdgeKind::kContour, {8, 4}, {});
    EXPECT_TRUE(first.x0 <= 30 && 30 < first.x1);
    EXPECT_EQ(first.width(), 8);
    EXPECT_EQ(first.height(), 4);
    const PixelBox second = partOfKind(kinds, film, EdgeKind::kContour, {8, 4}, std::vector{first});
    EXPECT_TRUE(second.x0 <= 30 && 30 < second.x1);
    EXPECT_TRUE(second.y0 >= first.y1 || second.y1 <= first.y0);
    const PixelBox texture = partOfKind(kinds, film, EdgeKind::kTexture, {8, 4}, {});
    EXPECT_TRUE(texture.x0 == 6 || !(texture.x0 <= 5 && texture.x1 > 5)) << texture.x0;
}

}  // namespace
}  // namespace edgewise::figures
