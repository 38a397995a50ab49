#include "pipeline/compare/pareto_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "pipeline/compare/error_slope.h"
#include "pipeline/html_text.h"
#include "pipeline/plot_colors.h"
#include "pipeline/plot_legend.h"

namespace edgewise::compare {
namespace {

constexpr double kHeight = 460, kLeft = 74, kTop = 16, kBottom = 52;
constexpr double kInnerWidth = 536, kInnerHeight = kHeight - kTop - kBottom;
constexpr double kLegendLeft = 22;         ///< of names, from the plot's inner right border
constexpr std::size_t kLeastLetters = 16;  ///< such names have room in every plot

struct Point {
    double seconds, error;
    std::string label;
};

using Families = std::map<std::string, std::vector<Point>>;

Families familiesOf(const Comparison& comparison) {
    Families families;
    for (const Row& row : comparison.rows) {
        if (!row.error || row.seconds.empty()) continue;
        families[familyOf(row)].push_back({spreadOf(row.seconds).median, row.error->rmse, row.method});
    }
    for (auto& [name, points] : families) std::ranges::sort(points, {}, &Point::seconds);
    return families;
}

/// Powers of ten around what is shown.
struct Axis {
    int low = 0, high = 1;
};
Axis axisOf(const std::vector<double>& values) {
    const auto [least, most] = std::ranges::minmax_element(values);
    if (values.empty()) return {-3, 0};
    const int low = static_cast<int>(std::floor(std::log10(*least)));
    return {low, std::max(low + 1, static_cast<int>(std::ceil(std::log10(*most))))};
}

class Plot {
  public:
    explicit Plot(const Families& families) {
        std::vector<double> seconds, errors;
        for (const auto& [name, points] : families)
            for (const Point& p : points) {
                seconds.push_back(std::max(p.seconds, 1e-9));
                if (p.error > 0.0) errors.push_back(p.error);
            }
        x_ = axisOf(seconds), y_ = axisOf(errors);
    }

    double px(double seconds) const {
        return kLeft + kInnerWidth * (std::log10(std::max(seconds, 1e-9)) - x_.low) / (x_.high - x_.low);
    }
    double py(double error) const {
        if (!(error > 0.0)) return kTop + kInnerHeight;
        const double part = (std::log10(error) - y_.low) / (y_.high - y_.low);
        return kTop + kInnerHeight * (1.0 - std::clamp(part, 0.0, 1.0));
    }

    std::string axes() const {
        std::string out;
        for (int e = y_.low; e <= y_.high; ++e) {
            const double y = py(std::pow(10.0, e));
            out += fmt::format("<path d='M{} {:.1f}h{}' stroke='#ddd'/>", kLeft, y, kInnerWidth);
            out += power(kLeft - 6, y + 4, e, "end");
        }
        for (int e = x_.low; e <= x_.high; ++e) {
            const double x = px(std::pow(10.0, e));
            out += fmt::format("<path d='M{:.1f} {}v{}' stroke='#ddd'/>", x, kTop, kInnerHeight);
            out += power(x, kTop + kInnerHeight + 18, e, "middle");
        }
        out += fmt::format("<rect x='{}' y='{}' width='{}' height='{}' fill='none' stroke='#777'/>", kLeft,
                           kTop, kInnerWidth, kInnerHeight);
        out += fmt::format("<text x='{}' y='{}' text-anchor='middle'>seconds, median</text>",
                           kLeft + kInnerWidth / 2, kHeight - 12);
        return out + fmt::format(
                         "<text transform='translate(16 {}) rotate(-90)' text-anchor='middle'>RMSE, linear "
                         "RGB</text>",
                         kTop + kInnerHeight / 2);
    }

    /// A sampler's error falls like N^-3/4 where an edge or two cross a pixel: through the first point of the
    /// sampler that has most of them.
    std::string slope(const Families& families) const {
        const std::vector<Point>* longest = nullptr;
        for (const auto& [name, points] : families)
            if (name.find('N') != std::string::npos && points[0].error > 0.0 &&
                (!longest || points.size() > longest->size()))
                longest = &points;
        if (!longest) return "";
        const double x0 = std::pow(10.0, x_.low), x1 = std::pow(10.0, x_.high);
        const auto at = [&](double x) {
            return longest->front().error * std::pow(x / longest->front().seconds, -0.75);
        };
        return fmt::format(
            "<g clip-path='url(#inside)'><path d='M{:.1f} {:.1f}L{:.1f} {:.1f}' stroke='#999' "
            "stroke-dasharray='6 4' "
            "fill='none'/></g><text x='{:.1f}' y='{:.1f}' fill='#777' font-size='11'>dashed: N^-3/4</text>",
            px(x0), unclamped(at(x0)), px(x1), unclamped(at(x1)), kLeft + kInnerWidth + 10,
            kTop + kInnerHeight);
    }

  private:
    double unclamped(double error) const {
        return kTop + kInnerHeight * (1.0 - (std::log10(error) - y_.low) / (y_.high - y_.low));
    }
    static std::string power(double x, double y, int e, const char* anchor) {
        return fmt::format(
            "<text x='{:.1f}' y='{:.1f}' text-anchor='{}'>10<tspan dy='-5' font-size='9'>{}{}</tspan></text>",
            x, y, anchor, e < 0 ? "&#8722;" : "", std::abs(e));
    }

    Axis x_, y_;
};

std::string seriesSvg(const Plot& plot, const std::string& name, const std::vector<Point>& points,
                      std::size_t index) {
    const char* color = kPlotColors[index % kPlotColors.size()];
    std::string path, dots;
    for (const Point& p : points) {
        const double x = plot.px(p.seconds), y = plot.py(p.error);
        path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x, y);
        dots += fmt::format(
            "<circle cx='{:.1f}' cy='{:.1f}' r='4' fill='{}' stroke='{}' stroke-width='1.5'><title>{}: "
            "{:.4g} s, RMSE "
            "{:.3g}</title></circle>",
            x, y, p.error > 0.0 ? color : "#fff", color, escapedHtml(p.label), p.seconds, p.error);
    }
    const double y = kTop + 14 + 18.0 * static_cast<double>(index), x = kLeft + kInnerWidth + kLegendLeft;
    return fmt::format("<path d='{}' fill='none' stroke='{}' stroke-width='1.3'/>{}", path, color, dots) +
           fmt::format("<circle cx='{}' cy='{}' r='4' fill='{}'/><text x='{}' y='{}'>{}</text>", x - 10,
                       y - 4, color, x, y, escapedHtml(name));
}

}  // namespace

std::string paretoSvg(const Comparison& comparison) {
    const Families families = familiesOf(comparison);
    const Plot plot(families);
    const double width = kLeft + kInnerWidth + kLegendLeft +
                         widthOfLongest(families, kLeastLetters, &Families::value_type::first);
    std::string out = fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}' "
        "font-family='sans-serif' font-size='12' fill='#333' role='img' aria-label='error against seconds'>"
        "<rect width='{0}' height='{1}' fill='#fff'/><clipPath id='inside'><rect x='{2}' y='{3}' width='{4}' "
        "height='{5}'/></clipPath>",
        width, kHeight, kLeft, kTop, kInnerWidth, kInnerHeight);
    out += plot.axes() + plot.slope(families);
    std::size_t index = 0;
    for (const auto& [name, points] : families) out += seriesSvg(plot, name, points, index++);
    return out + "</svg>\n";
}

}  // namespace edgewise::compare
