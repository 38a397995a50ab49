#include "tests/bench/freetype_peer.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include FT_OUTLINE_H

namespace edgewise::bench {
namespace {

using Contours = std::vector<std::vector<glm::dvec2>>;

/// Chains what edges are left when opposite ones have cancelled; the vertices' ids tell which are one.
class Boundary {
  public:
    void add(const ScreenTriangle& t) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t from = t.vertex[k], to = t.vertex[(k + 1) % 3];
            place_[from] = t.p_px[k];
            if (const auto opposite = find(to, from); opposite != next_.end())
                next_.erase(opposite);
            else
                next_.emplace(from, to);
        }
    }
    Contours take() {
        Contours contours;
        while (!next_.empty()) {
            std::vector<glm::dvec2>& contour = contours.emplace_back();
            for (auto edge = next_.begin(); edge != next_.end();) {
                contour.push_back(place_.at(edge->first));
                const std::uint32_t to = edge->second;
                next_.erase(edge);
                edge = next_.find(to);
            }
        }
        return contours;
    }

  private:
    using Edges = std::multimap<std::uint32_t, std::uint32_t>;
    Edges::iterator find(std::uint32_t from, std::uint32_t to) {
        const auto [first, last] = next_.equal_range(from);
        const auto found = std::find_if(first, last, [&](const auto& edge) { return edge.second == to; });
        return found == last ? next_.end() : found;
    }
    Edges next_;
    std::map<std::uint32_t, glm::dvec2> place_;
};

void check(FT_Error error, const char* what) {
    if (error) throw std::runtime_error(std::string(what) + " failed");
}

/// What the spans of a shape are added to.
struct Target {
    glm::vec3* picture;
    int side_px;
    glm::vec3 color_of_one;  ///< colour / 255
};

void addSpans(int y, int count, const FT_Span* spans, void* user) {
    const Target& target = *static_cast<const Target*>(user);
    glm::vec3* row = target.picture + static_cast<std::ptrdiff_t>(y) * target.side_px;
    for (int i = 0; i < count; ++i) {
        const glm::vec3 added = static_cast<float>(spans[i].coverage) * target.color_of_one;
        for (int x = spans[i].x; x < spans[i].x + spans[i].len; ++x) row[x] += added;
    }
}

}  // namespace

std::vector<FlatShape> flatShapes(const ScreenScene& screen, std::span<const glm::dvec3> colors,
                                  std::size_t run) {
    std::vector<FlatShape> shapes;
    for (std::size_t first = 0; first < screen.triangles.size(); first += run) {
        Boundary boundary;
        const std::size_t end = std::min(first + run, screen.triangles.size());
        for (std::size_t i = first; i < end; ++i) boundary.add(screen.triangles[i]);
        shapes.push_back({boundary.take(), colors[screen.triangles[first].owner]});
    }
    return shapes;
}

std::vector<FlatShape> onePerColor(std::span<const FlatShape> shapes) {
    std::vector<FlatShape> merged;
    for (const FlatShape& shape : shapes) {
        if (shape.color == glm::dvec3(0.0)) continue;
        auto same = std::ranges::find(merged, shape.color, &FlatShape::color);
        if (same == merged.end()) same = merged.insert(same, {{}, shape.color});
        same->contours_px.insert(same->contours_px.end(), shape.contours_px.begin(), shape.contours_px.end());
    }
    return merged;
}

struct FreeTypePeer::Outlines {
    struct One {
        FT_Outline outline{};
        glm::vec3 color_of_one{0.0f};
    };
    FT_Library library;
    std::vector<One> all;

    explicit Outlines(FT_Library owner) : library(owner) {}
    ~Outlines() {
        for (One& one : all) FT_Outline_Done(library, &one.outline);
    }
    Outlines(const Outlines&) = delete;
    Outlines& operator=(const Outlines&) = delete;

    void add(const FlatShape& shape) {
        std::size_t points = 0;
        for (const auto& contour : shape.contours_px) points += contour.size();
        One& one = all.emplace_back();
        one.color_of_one = glm::vec3(shape.color / 255.0);
        check(FT_Outline_New(library, static_cast<FT_UInt>(points),
                             static_cast<FT_Int>(shape.contours_px.size()), &one.outline),
              "FT_Outline_New");
        std::size_t point = 0, contour_index = 0;
        for (const auto& contour : shape.contours_px) {
            for (const glm::dvec2& p : contour) {
                one.outline.points[point] = {std::lround(p.x * 64), std::lround(p.y * 64)};
                one.outline.tags[point++] = FT_CURVE_TAG_ON;
            }
            one.outline.contours[contour_index++] = static_cast<short>(point - 1);
        }
    }
};

FreeTypePeer::FreeTypePeer(std::span<const FlatShape> shapes, int side_px)
    : side_px_(side_px), picture_(static_cast<std::size_t>(side_px) * side_px) {
    check(FT_Init_FreeType(&library_), "FT_Init_FreeType");
    outlines_ = std::make_unique<Outlines>(library_);
    for (const FlatShape& shape : shapes) outlines_->add(shape);
}

FreeTypePeer::~FreeTypePeer() {
    outlines_.reset();
    FT_Done_FreeType(library_);
}

void FreeTypePeer::draw() {
    std::ranges::fill(picture_, glm::vec3(0.0f));
    for (Outlines::One& one : outlines_->all) {
        Target target{picture_.data(), side_px_, one.color_of_one};
        FT_Raster_Params parameters{};
        parameters.flags = FT_RASTER_FLAG_AA | FT_RASTER_FLAG_DIRECT | FT_RASTER_FLAG_CLIP;
        parameters.gray_spans = addSpans;
        parameters.user = &target;
        parameters.clip_box = {0, 0, side_px_, side_px_};
        check(FT_Outline_Render(library_, &one.outline, &parameters), "FT_Outline_Render");
    }
}

}  // namespace edgewise::bench
