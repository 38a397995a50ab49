#include "pipeline/methods/edge_classes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/methods/nsaa_cpu.h"

namespace edgewise {
namespace {

/// The lines seen so far in a pixel's support, up to as many as matter.
struct PixelEdges {
    static constexpr int kMany = 3;
    std::array<std::uint32_t, kMany - 1> lines{};
    int count = 0;
    bool along_axis = false;

    void add(std::uint32_t line, bool axis) {
        along_axis |= axis;
        const auto end = lines.begin() + std::min(count, kMany - 1);
        if (count >= kMany || std::find(lines.begin(), end, line) != end) return;
        if (count < kMany - 1) lines[count] = line;
        ++count;
    }
    EdgeClass asClass() const {
        if (count == 0) return EdgeClass::kNoEdge;
        return count < kMany && !along_axis ? EdgeClass::kFew : EdgeClass::kOthers;
    }
};

struct Interval {
    double begin, end;
};

/// The samples i + 0.5 + offset strictly closer than `radius` to the interval, from `first` to before `last`.
std::pair<int, int> samplesNear(Interval interval, double offset, double radius, int first, int last) {
    const int begin = static_cast<int>(std::floor(interval.begin - radius - offset - 0.5)) + 1;
    const int end = static_cast<int>(std::ceil(interval.end + radius - offset - 0.5));
    return {std::clamp(begin, first, last), std::clamp(end, first, last)};
}

class EdgeCounter {
  public:
    EdgeCounter(const NsaaFrame& frame, const PixelBox& band)
        : band_(band),
          offset_(frame.offset()),
          radius_(frame.in.filter.radius),
          pixels_(static_cast<std::size_t>(band.width()) * band.height()) {}

    void add(const VisibleSegment& s, bool along_axis) {
        const glm::dvec2 a = s.a.grid + s.a.rest, b = s.b.grid + s.b.rest;
        const auto [top, bottom] = std::minmax(a.y, b.y);
        const auto [y0, y1] = samplesNear({top, bottom}, offset_.y, radius_, band_.y0, band_.y1);
        for (int y = y0; y < y1; ++y) {
            const double sample = y + 0.5 + offset_.y;
            const Interval x = alongRow(a, b, {sample - radius_, sample + radius_});
            const auto [x0, x1] = samplesNear(x, offset_.x, radius_, band_.x0, band_.x1);
            PixelEdges* row = &pixels_[static_cast<std::size_t>(y - band_.y0) * band_.width()];
            for (int i = x0; i < x1; ++i) row[i - band_.x0].add(s.line, along_axis);
        }
    }

    const std::vector<PixelEdges>& pixels() const { return pixels_; }

  private:
    /// The x that the segment has between two rows.
    static Interval alongRow(const glm::dvec2& a, const glm::dvec2& b, Interval rows) {
        const auto at = [&](double y) { return a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)); };
        const double top = std::max(rows.begin, std::min(a.y, b.y));
        const double bottom = std::min(rows.end, std::max(a.y, b.y));
        const auto [begin, end] = a.y == b.y ? std::minmax({a.x, b.x}) : std::minmax({at(top), at(bottom)});
        return {begin, end};
    }

    PixelBox band_;
    glm::dvec2 offset_;
    double radius_;
    std::vector<PixelEdges> pixels_;
};

}  // namespace

std::vector<EdgeClass> edgeClasses(const MethodInput& input) {
    CpuStages stages;
    NsaaFrame frame(input);
    std::vector<EdgeClass> classes;
    frame.forEachBand(stages, [&](const VisibleMap& map, const PixelBox& band) {
        const MapOwners owners(frame.plan.classes, map);
        EdgeCounter counter(frame, band);
        for (const VisibleSegment& s : map.segments) {
            if (owners.classes.of(s.left) == owners.classes.of(s.right)) continue;
            const CarrierLine& line = map.lines[s.line];
            counter.add(s, line.nx_hi == 0.0 || line.ny_hi == 0.0);
        }
        for (const PixelEdges& pixel : counter.pixels()) classes.push_back(pixel.asClass());
    });
    return classes;
}

}  // namespace edgewise
