#include "paper_figures/edge_part.h"

#include <algorithm>
#include <cmath>

namespace edgewise::figures {
namespace {

/// An edge through the part is that long; what is beyond tells no more.
constexpr double kEnoughOfWidth = 1.5;

double scoreOf(const std::vector<EdgeKind>& kinds, int film_width, const PixelBox& box, EdgeKind kind) {
    double own = 0.0, other = 0.0;
    for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x) {
            const EdgeKind at = kinds[static_cast<std::size_t>(y * film_width + x)];
            own += at == kind, other += at != kind && at != EdgeKind::kNone;
        }
    return std::min(own, kEnoughOfWidth * box.width()) - other;
}

bool meet(const PixelBox& a, const PixelBox& b) {
    return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

}  // namespace

PixelBox partOfKind(const std::vector<EdgeKind>& kinds, const Film& film, EdgeKind kind, glm::ivec2 size,
                    std::span<const PixelBox> others) {
    PixelBox best{0, 0, size.x, size.y};
    double most = -HUGE_VAL;
    const int step = std::max(1, size.y / 4);
    for (int y = 0; y + size.y <= film.height; y += step)
        for (int x = 0; x + size.x <= film.width; x += step) {
            const PixelBox box{x, y, x + size.x, y + size.y};
            if (std::ranges::any_of(others, [&](const PixelBox& other) { return meet(box, other); }))
                continue;
            const double score = scoreOf(kinds, film.width, box, kind);
            if (score > most) most = score, best = box;
        }
    return best;
}

}  // namespace edgewise::figures
