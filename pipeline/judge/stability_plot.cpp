#include "pipeline/judge/stability_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/html_text.h"

namespace edgewise::judge {
namespace {

constexpr double kWidth = 380, kHeight = 250, kLeft = 60, kRight = 12, kTop = 10, kBottom = 44;
constexpr double kInnerWidth = kWidth - kLeft - kRight, kInnerHeight = kHeight - kTop - kBottom;

/// About six labels, however many decades.
int labelStep(const PlotAxis& axis) {
    return std::max(1, (axis.high - axis.low + 5) / 6);
}

class Canvas {
  public:
    explicit Canvas(const PlotFrame& frame) : frame_(frame) {}

    double px(double x) const { return kLeft + kInnerWidth * part(frame_.x, x); }
    double py(double error) const {
        if (!(error > 0.0)) return kTop + kInnerHeight;
        return kTop + kInnerHeight * (1.0 - std::clamp(part(frame_.y, error), 0.0, 1.0));
    }

    std::string axes() const {
        std::string out;
        for (int e = frame_.y.low; e <= frame_.y.high; ++e) {
            const double y = py(std::pow(10.0, e));
            const bool labelled = (e - frame_.y.low) % labelStep(frame_.y) == 0;
            out += fmt::format("<path d='M{} {:.1f}h{}' class='{}'/>", kLeft, y, kInnerWidth,
                               labelled ? "grid" : "fine");
            if (labelled) out += power(kLeft - 5, y + 3.5, e, "end");
        }
        for (int e = frame_.x.low; e <= frame_.x.high; ++e) {
            const double x = px(std::pow(10.0, e));
            const bool labelled = (e - frame_.x.low) % labelStep(frame_.x) == 0;
            out += fmt::format("<path d='M{:.1f} {}v{}' class='{}'/>", x, kTop, kInnerHeight,
                               labelled ? "grid" : "fine");
            if (labelled) out += power(x, kTop + kInnerHeight + 15, e, "middle");
        }
        return out + titles();
    }

  private:
    static double part(const PlotAxis& axis, double value) {
        return (std::log10(value) - axis.low) / (axis.high - axis.low);
    }

    /// 10 to the e, the exponent raised.
    static std::string power(double x, double y, int e, const char* anchor) {
        if (e == 0) return fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}'>1</text>", x, y, anchor);
        return fmt::format(
            "<text x='{:.1f}' y='{:.1f}' text-anchor='{}'>10<tspan dy='-4' font-size='8'>{}{}</tspan></text>",
            x, y, anchor, e < 0 ? "&#8722;" : "", std::abs(e));
    }

    std::string titles() const {
        const double middle = kTop + kInnerHeight / 2;
        return fmt::format(
            "<rect x='{}' y='{}' width='{}' height='{}' class='frame'/>"
            "<text x='{}' y='{}' text-anchor='middle' class='title'>{}</text>"
            "<text transform='translate(11 {}) rotate(-90)' text-anchor='middle' class='title'>{}</text>\n",
            kLeft, kTop, kInnerWidth, kInnerHeight, kLeft + kInnerWidth / 2, kHeight - 8,
            escapedHtml(frame_.x_title), middle, escapedHtml(frame_.y_title));
    }

    const PlotFrame& frame_;
};

std::string drawn(const Canvas& canvas, const PlotSeries& series) {
    std::string line, bound, dots;
    for (const PlotPoint& p : series.points) {
        const char* command = line.empty() ? "M" : "L";
        const double x = canvas.px(p.x), y = canvas.py(p.error);
        line += fmt::format("{}{:.1f} {:.1f}", command, x, y);
        bound += fmt::format("{}{:.1f} {:.1f}", command, x, canvas.py(p.bound));
        dots += fmt::format(
            "<circle cx='{:.1f}' cy='{:.1f}' r='2.6'{}><title>{} at {:.3g}: {:.3g}, promised "
            "{:.3g}</title></circle>",
            x, y, p.error > 0.0 ? "" : " class='zero'", escapedHtml(series.name), p.x, p.error, p.bound);
    }
    return fmt::format(
        "<g fill='{0}' stroke='{0}'><path d='{1}' class='bound'/><path d='{2}' class='line'/>{3}</g>\n",
        series.color, bound, line, dots);
}

template <class Value>
PlotAxis decadesOf(const std::vector<PlotSeries>& series, const Value& values) {
    double low = INFINITY, high = 0.0;
    for (const PlotSeries& one : series)
        for (const PlotPoint& p : one.points)
            for (const double v : values(p))
                if (v > 0.0 && v < INFINITY) low = std::min(low, v), high = std::max(high, v);
    if (high == 0.0) return {-1, 0};
    // What lies on a decade within a rounding of the logarithm ends the axis there.
    const int from = static_cast<int>(std::floor(std::log10(low) + 1e-9));
    return {from, std::max(from + 1, static_cast<int>(std::ceil(std::log10(high) - 1e-9)))};
}

}  // namespace

PlotAxis xAxisOf(const std::vector<PlotSeries>& series) {
    return decadesOf(series, [](const PlotPoint& p) { return std::array{p.x}; });
}

PlotAxis errorAxisOf(const std::vector<PlotSeries>& series) {
    return decadesOf(series, [](const PlotPoint& p) { return std::array{p.error, p.bound}; });
}

std::string plotSvg(const PlotFrame& frame, const std::vector<PlotSeries>& series) {
    const Canvas canvas(frame);
    std::string out = fmt::format("<svg viewBox='0 0 {} {}' role='img' aria-label='{}'>\n", kWidth, kHeight,
                                  escapedHtml(frame.label));
    out += canvas.axes();
    for (const PlotSeries& one : series) out += drawn(canvas, one);
    return out + "</svg>\n";
}

}  // namespace edgewise::judge
