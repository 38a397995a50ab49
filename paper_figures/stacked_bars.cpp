#include "paper_figures/stacked_bars.h"

#include <fmt/format.h>

#include <numeric>

#include "pipeline/html_text.h"
#include "pipeline/plot_colors.h"

namespace edgewise::figures {
namespace {

constexpr double kWidth = 790, kLeft = 200, kRight = 90, kTop = 40, kBottom = 40;
constexpr double kInnerWidth = kWidth - kLeft - kRight;
constexpr double kBarStep = 28, kBarHeight = 20;
constexpr double kLegendStep = 96;
constexpr double kLeastWritten = 0.07;  ///< a share below this has no room for its number

const char* colorOfPart(std::size_t part) {
    return kPlotColors[part % kPlotColors.size()];
}

std::string barSvg(const StackedBars& plot, const StackedBar& bar, double y) {
    std::string out = fmt::format("<text x='{}' y='{}' text-anchor='end'>{}</text>", kLeft - 8, y + 14,
                                  escapedHtml(bar.name));
    const double sum = std::accumulate(bar.parts.begin(), bar.parts.end(), 0.0);
    double x = kLeft;
    for (std::size_t i = 0; i < bar.parts.size() && sum > 0.0; ++i) {
        const double share = bar.parts[i] / sum, width = share * kInnerWidth;
        out += fmt::format(
            "<rect x='{:.2f}' y='{}' width='{:.2f}' height='{}' fill='{}'><title>{}: {:.1f} "
            "%</title></rect>",
            x, y, width, kBarHeight, colorOfPart(i), escapedHtml(plot.parts[i]), 100 * share);
        if (share >= kLeastWritten)
            out += fmt::format(
                "<text x='{:.1f}' y='{}' text-anchor='middle' fill='#fff' font-size='11'>{:.0f}</text>",
                x + width / 2, y + 14, 100 * share);
        x += width;
    }
    return out + fmt::format("<text x='{}' y='{}'>{}</text>\n", kLeft + kInnerWidth + 8, y + 14,
                             escapedHtml(bar.note));
}

}  // namespace

std::string stackedBarsSvg(const StackedBars& plot) {
    const double bottom = kTop + kBarStep * static_cast<double>(plot.bars.size());
    std::string out = fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}' "
        "font-family='sans-serif' font-size='12' fill='#333' role='img' aria-label='{2}'><rect width='{0}' "
        "height='{1}' fill='#fff'/>\n",
        kWidth, bottom + kBottom, escapedHtml(plot.label));
    for (std::size_t i = 0; i < plot.parts.size(); ++i) {
        const double x = kLeft + kLegendStep * static_cast<double>(i);
        out += fmt::format(
            "<rect x='{0}' y='12' width='12' height='12' fill='{1}'/><text x='{2}' y='22'>{3}</text>", x,
            colorOfPart(i), x + 17, escapedHtml(plot.parts[i]));
    }
    for (std::size_t i = 0; i < plot.bars.size(); ++i)
        out += barSvg(plot, plot.bars[i], kTop + kBarStep * static_cast<double>(i));
    for (int percent = 0; percent <= 100; percent += 20)
        out += fmt::format("<text x='{:.1f}' y='{}' text-anchor='middle'>{} %</text>",
                           kLeft + kInnerWidth * percent / 100.0, bottom + 14, percent);
    return out + "</svg>\n";
}

}  // namespace edgewise::figures
