#include "paper_figures/line_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/html_text.h"
#include "pipeline/plot_legend.h"

namespace edgewise::figures {
namespace {

constexpr double kHeight = 430, kLeft = 64, kTop = 14, kBottom = 50;
constexpr double kInnerWidth = 520, kInnerHeight = kHeight - kTop - kBottom;
constexpr double kLegendStep = 18;
constexpr double kMarkWidth = 28;             ///< of what stands before a name, and a gap
constexpr double kLegendLeft = 40;            ///< of names, from the plot's inner right border
constexpr std::size_t kLeastLetters = 17;     ///< such names have room in every plot
constexpr double kDot = 2.4, kLoneDot = 4.5;  ///< on a line; without one

double part(const PlotAxis& axis, double value) {
    if (axis.logarithmic) return std::log(value / axis.low) / std::log(axis.high / axis.low);
    return (value - axis.low) / (axis.high - axis.low);
}

constexpr double kDecadesOfAllLabels = 2.5;  ///< beyond, powers of ten alone
constexpr double kLeastInDigits = 9e-4;      ///< on logarithmic axes
constexpr double kMostDecadeLabels = 8.0;    ///< beyond, each so-manieth of them

std::vector<double> logarithmicTicks(const PlotAxis& axis) {
    const double decades = std::log10(axis.high / axis.low);
    const bool all = decades < kDecadesOfAllLabels;
    const int every = std::max(1, static_cast<int>(std::ceil(decades / kMostDecadeLabels)));
    std::vector<double> ticks;
    for (int e = static_cast<int>(std::floor(std::log10(axis.low))); std::pow(10.0, e) <= axis.high; ++e)
        for (const double digit : {1.0, 2.0, 5.0}) {
            const double value = digit * std::pow(10.0, e);
            if ((all || (digit == 1.0 && e % every == 0)) && value >= axis.low * (1 - 1e-9) &&
                value <= axis.high * (1 + 1e-9))
                ticks.push_back(value);
        }
    return ticks;
}

std::vector<double> ticksOf(const PlotAxis& axis) {
    if (axis.logarithmic) return logarithmicTicks(axis);
    const int count = static_cast<int>(std::floor((axis.high - axis.low) / axis.step + 1e-9));
    std::vector<double> ticks;
    for (int i = 0; i <= count; ++i) ticks.push_back(axis.low + i * axis.step);
    return ticks;
}

class Canvas {
  public:
    explicit Canvas(const LinePlot& plot) : plot_(plot) {}

    double px(double x) const { return kLeft + kInnerWidth * part(plot_.x, x); }
    double py(double y) const { return kTop + kInnerHeight * (1 - std::max(part(plot_.y, y), 0.0)); }

    std::string axes() const {
        std::string out;
        for (const double v : ticksOf(plot_.y))
            out += fmt::format(
                "<path d='M{} {:.1f}h{}' stroke='#ddd'/><text x='{}' y='{:.1f}' text-anchor='end'>{}</text>",
                kLeft, py(v), kInnerWidth, kLeft - 6, py(v) + 4, number(plot_.y, v));
        for (const double v : ticksOf(plot_.x))
            out += fmt::format(
                "<path d='M{:.1f} {}v{}' stroke='#ddd'/><text x='{:.1f}' y='{}' "
                "text-anchor='middle'>{}</text>",
                px(v), kTop, kInnerHeight, px(v), kTop + kInnerHeight + 17, number(plot_.x, v));
        for (const PlotMark& mark : plot_.marks)
            out += fmt::format(
                "<path d='M{0:.1f} {1}v{2}' stroke='#555' stroke-dasharray='2 3'/><text "
                "x='{3:.1f}' y='{4}' font-size='11'>{5}</text>",
                px(mark.x), kTop, kInnerHeight, px(mark.x) + 4, kTop + 13, escapedHtml(mark.label));
        return out + titles();
    }

    std::string curve(const PlotCurve& one, std::size_t index) const {
        std::string path, dots;
        for (const glm::dvec2& p : one.line)
            path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? "M" : "L", px(p.x), py(p.y));
        for (const glm::dvec2& p : one.dots)
            if (part(plot_.x, p.x) >= 0 && part(plot_.x, p.x) <= 1 && part(plot_.y, p.y) >= 0 &&
                part(plot_.y, p.y) <= 1)
                dots += fmt::format(
                    "<circle cx='{:.1f}' cy='{:.1f}' r='{}'{}><title>{}: {:.4g}, {:.5g}</title></circle>",
                    px(p.x), py(p.y), one.line.empty() ? kLoneDot : kDot, style(one), escapedHtml(one.name),
                    p.x, p.y);
        const double x = kLeft + kInnerWidth + kLegendLeft - kMarkWidth,
                     y = kTop + 10 + kLegendStep * static_cast<double>(index);
        const char* dash = one.dashed ? " stroke-dasharray='5 3'" : "";
        std::string out =
            fmt::format("<g data-series='{0}' stroke='{1}' fill='{1}'>", escapedHtml(one.name), one.color);
        if (!path.empty())
            out += fmt::format("<path d='{}' fill='none' stroke-width='1.5' clip-path='url(#inside)'{}/>",
                               path, dash);
        out += fmt::format("<g>{}</g>", dots);
        out += one.line.empty()
                   ? fmt::format("<circle cx='{}' cy='{}' r='{}'{}/>", x + 11, y - 4, kLoneDot, style(one))
                   : fmt::format("<path d='M{} {}h22' stroke-width='2'{}/>", x, y - 4, dash);
        return out + fmt::format("<text x='{}' y='{}' stroke='none' fill='#333'>{}</text></g>\n",
                                 x + kMarkWidth, y, escapedHtml(one.name));
    }

  private:
    static const char* style(const PlotCurve& one) {
        return one.hollow ? " fill='#fff' stroke-width='2'" : " stroke='none'";
    }

    /// With a true minus sign, and no -0; large ones as 20k and 1M.
    static std::string number(const PlotAxis& axis, double value) {
        if (axis.logarithmic && value < kLeastInDigits) return fmt::format("{:.0e}", value);
        if (std::abs(value) < 1e-12) return "0";
        if (value >= 1e6) return fmt::format("{:g}M", value / 1e6);
        if (value >= 1e4) return fmt::format("{:g}k", value / 1e3);
        return fmt::format("{}{:g}", value < 0 ? "&#8722;" : "", std::round(std::abs(value) * 1e9) / 1e9);
    }

    std::string titles() const {
        return fmt::format(
            "<rect x='{}' y='{}' width='{}' height='{}' fill='none' stroke='#777'/><text x='{}' y='{}' "
            "text-anchor='middle'>{}</text><text transform='translate(15 {}) rotate(-90)' "
            "text-anchor='middle'>{}</text>\n",
            kLeft, kTop, kInnerWidth, kInnerHeight, kLeft + kInnerWidth / 2, kHeight - 10,
            escapedHtml(plot_.x.title), kTop + kInnerHeight / 2, escapedHtml(plot_.y.title));
    }

    const LinePlot& plot_;
};

}  // namespace

std::string linePlotSvg(const LinePlot& plot) {
    const double width =
        kLeft + kInnerWidth + kLegendLeft + widthOfLongest(plot.curves, kLeastLetters, &PlotCurve::name);
    const Canvas canvas(plot);
    std::string out = fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}' "
        "font-family='sans-serif' font-size='12' fill='#333' role='img' aria-label='{2}'><rect width='{0}' "
        "height='{1}' fill='#fff'/><clipPath id='inside'><rect x='{3}' y='{4}' width='{5}' "
        "height='{6}'/></clipPath>\n",
        width, kHeight, escapedHtml(plot.label), kLeft, kTop, kInnerWidth, kInnerHeight);
    out += canvas.axes();
    for (std::size_t i = 0; i < plot.curves.size(); ++i) out += canvas.curve(plot.curves[i], i);
    return out + "</svg>\n";
}

}  // namespace edgewise::figures
