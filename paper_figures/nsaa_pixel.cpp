#include "paper_figures/nsaa_pixel.h"

#include <fmt/format.h>

#include <algorithm>

#include "paper_figures/drawing.h"
#include "paper_figures/figure_plot.h"
#include "paper_figures/page_parts.h"
#include "pipeline/compare/comparison_tables.h"
#include "pipeline/html_table.h"
#include "pipeline/html_text.h"
#include "pipeline/methods/method.h"
#include "pipeline/methods/nsaa.h"
#include "pipeline/sample_pattern.h"

namespace edgewise::figures {
namespace {

constexpr int kDrawnSamples = 8;
constexpr double kPaperRadius = 2.0;
constexpr const char* kFirstColor = "#1b6ca8";
constexpr const char* kSecondColor = "#e0b98f";

struct PixelInput {
    Scene scene = flatScene(pixelTriangles(), kPixelFilm);
    ResolvedCamera camera = flatCamera(kPixelFilm);
    Film film{kPixelFilm,
              kPixelFilm,
              {kStudiedPixel.x, kStudiedPixel.y, kStudiedPixel.x + 1, kStudiedPixel.y + 1},
              {},
              {}};
    RenderOptions options;
    PixelInput() { options.device = DeviceChoice::kCpu; }
};

/// The first triangle is red, and nothing else is.
PixelShare sampled(const std::string& method, Progress& progress) {
    const PixelInput in;
    const Prefilter box = makePrefilter("box", {}, {});
    const MethodResult made =
        runMethod(parseMethod(method), {in.scene, in.camera, in.film, box, in.options, progress});
    return {method, box.name, box.radius, made.image.rgba.front().r};
}

PixelShare integrated(const std::string& filter, std::optional<double> radius, Progress& progress) {
    const PixelInput in;
    const Prefilter kernel = makePrefilter(filter, radius, {});
    const PixelReport report = pixelWeights({in.scene, in.camera, in.film, kernel, in.options, progress},
                                            kStudiedPixel.x, kStudiedPixel.y);
    const auto first = std::ranges::find(report.owners, 0u, &PixelOwner::index);
    return {"nsaa", filter, kernel.radius, first == report.owners.end() ? 0.0 : first->weight};
}

/// A window of the film as a square of the drawing.
struct Panel {
    glm::dvec2 corner;  ///< of the drawing
    double side;        ///< likewise
    glm::dvec2 from_px;
    double side_px;
    double scale() const { return side / side_px; }
    glm::dvec2 at(glm::dvec2 p_px) const { return corner + scale() * (p_px - from_px); }
};

void drawTriangles(const Panel& panel, const std::vector<FlatTriangle>& triangles, Drawing& drawing) {
    const char* colors[]{kFirstColor, kSecondColor};
    for (std::size_t i = 0; i < triangles.size(); ++i) {  // the far one first
        std::vector<glm::dvec2> corners;
        for (const glm::dvec2& p : triangles[i].p_px) corners.push_back(panel.at(p));
        drawing.polygon(
            corners, fmt::format("fill='{}' stroke='#222' stroke-width='1'", colors[i % std::size(colors)]));
    }
}

void drawGrid(const Panel& panel, Drawing& drawing) {
    for (int i = 0; i <= kPixelFilm; ++i) {
        drawing.line(panel.at({i, 0}), panel.at({i, kPixelFilm}), "stroke='#999' stroke-width='0.7'");
        drawing.line(panel.at({0, i}), panel.at({kPixelFilm, i}), "stroke='#999' stroke-width='0.7'");
    }
    drawing.rectangle(panel.at(glm::dvec2(kStudiedPixel)), glm::dvec2(panel.scale()),
                      "fill='none' stroke='#000' stroke-width='2.5'");
}

void drawSamples(const Panel& panel, const std::vector<FlatTriangle>& triangles, Drawing& drawing) {
    for (const glm::dvec2& offset : standardPattern(kDrawnSamples).at_px) {
        const glm::dvec2 p_px = glm::dvec2(kStudiedPixel) + offset;
        drawing.circle(panel.at(p_px), 7,
                       firstIsSeen(triangles, p_px) ? "fill='#d7263d' stroke='#fff' stroke-width='1.5'"
                                                    : "fill='#fff' stroke='#444' stroke-width='1.5'");
    }
}

/// White over all, thinner where the kernel is larger.
void drawKernel(const Panel& panel, const Prefilter& kernel, Drawing& drawing) {
    constexpr int kStops = 16;
    std::string stops;
    for (int i = 0; i <= kStops; ++i) {
        const double r = kernel.radius * i / kStops;
        stops +=
            fmt::format("<stop offset='{:.4f}' stop-color='#fff' stop-opacity='{:.4f}'/>", i / double(kStops),
                        0.92 * (1.0 - evaluate(kernel, std::min(r, kernel.radius * 0.9999), 0.0) /
                                          evaluate(kernel, 0.0, 0.0)));
    }
    drawing.raw("<radialGradient id='inside-kernel'>" + stops + "</radialGradient>\n");
    const glm::dvec2 middle = panel.at(glm::dvec2(kStudiedPixel) + 0.5);
    const double r = panel.scale() * kernel.radius;
    // what is outside of the support counts for nothing
    drawing.raw(
        fmt::format("<path fill='#fff' fill-opacity='0.92' fill-rule='evenodd' d='M{0:.2f} {1:.2f}h{2:.2f}"
                    "v{2:.2f}h-{2:.2f}zM{3:.2f} {4:.2f}a{5:.2f} {5:.2f} 0 1 0 {6:.2f} 0a{5:.2f} {5:.2f} 0 "
                    "1 0 -{6:.2f} 0z'/>\n",
                    panel.corner.x, panel.corner.y, panel.side, middle.x - r, middle.y, r, 2 * r));
    drawing.circle(middle, r, "fill='url(#inside-kernel)' stroke='#d7263d' stroke-width='1.5'");
    drawing.circle(middle, 3.5, "fill='#d7263d'");
}

std::string drawn(const std::vector<PixelShare>& shares) {
    const std::vector<FlatTriangle> triangles = pixelTriangles();
    const auto weightOf = [&](const std::string& method, const std::string& filter) {
        return std::ranges::find_if(
                   shares, [&](const PixelShare& s) { return s.method == method && s.filter == filter; })
            ->weight;
    };
    constexpr double kSide = 350;
    Drawing drawing(760, 430, "A pixel's samples, and the integral of a kernel over what is seen in it");
    const Panel left{{10, 40}, kSide, {2.625, 2.625}, 1.75}, right{{400, 40}, kSide, {1, 1}, 5};
    for (const Panel& panel : {left, right}) {
        drawing.beginClip(panel.corner, glm::dvec2(panel.side));
        drawTriangles(panel, triangles, drawing);
        const bool whole_support = panel.side_px > 2 * kPaperRadius;
        if (whole_support) drawKernel(panel, makePrefilter("gaussian", kPaperRadius, {}), drawing);
        drawGrid(panel, drawing);
        if (!whole_support) drawSamples(panel, triangles, drawing);
        drawing.endClip();
        drawing.rectangle(panel.corner, glm::dvec2(panel.side), "fill='none' stroke='#777'");
    }
    const std::string sampler = fmt::format("msaa:{}", kDrawnSamples);
    const double by_samples = weightOf(sampler, "box");
    drawing.text({10, 26}, fmt::format("{}: the ratio of samples that meet the blue triangle", sampler));
    drawing.text({400, 26}, "nsaa: the kernel's integral over what is seen of it");
    drawing.text({10, 412},
                 fmt::format("{:.0f} of {} = {:.4f}", kDrawnSamples * by_samples, kDrawnSamples, by_samples),
                 "font-size='15'");
    drawing.text({400, 412},
                 fmt::format("gaussian, R 2: {:.6f}; the pixel's box: {:.6f}", weightOf("nsaa", "gaussian"),
                             weightOf("nsaa", "box")),
                 "font-size='13'");
    return drawing.svg();
}

std::string sharesTable(const std::vector<PixelShare>& shares) {
    std::string rows;
    for (const PixelShare& s : shares)
        rows += fmt::format("<tr><td>{}</td><td>{}, R {:g}</td>", escapedHtml(s.method),
                            escapedHtml(s.filter), s.radius) +
                numberCell(s.weight, "{:.12f}") + "</tr>\n";
    return cardTable("<th>method</th><th>filter</th><th>weight of the blue triangle</th>", rows);
}

std::string sharesCsv(const std::vector<PixelShare>& shares) {
    std::string out = "method,filter,radius,weight\n";
    for (const PixelShare& s : shares)
        out += fmt::format("{},{},{},{}\n", compare::csvText(s.method), s.filter, s.radius, s.weight);
    return out;
}

}  // namespace

std::vector<FlatTriangle> pixelTriangles() {
    return {{{{{0.5, 3.0}, {6.5, 4.5}, {1.5, 7.0}}}, 2.0, {1.0, 0.0, 0.0}},
            {{{{2.75, 6.5}, {4.5, 2.0}, {7.0, 6.5}}}, 1.0, {0.0, 1.0, 0.0}}};
}

bool firstIsSeen(const std::vector<FlatTriangle>& triangles, glm::dvec2 p_px) {
    const auto holds = [&](const FlatTriangle& t) {
        int positive = 0;
        for (int i = 0; i < 3; ++i) {
            const glm::dvec2 a = t.p_px[i], b = t.p_px[(i + 1) % 3];
            positive += (b.x - a.x) * (p_px.y - a.y) - (b.y - a.y) * (p_px.x - a.x) > 0.0;
        }
        return positive == 0 || positive == 3;
    };
    return holds(triangles[0]) && !holds(triangles[1]);
}

std::vector<PixelShare> pixelShares(Progress& progress) {
    std::vector<PixelShare> shares;
    for (const char* method : {"none", "msaa:2", "msaa:4", "msaa:8", "msaa:16", "csaa:32", "ssaa:16"})
        shares.push_back(sampled(method, progress));
    for (const char* filter : {"box", "tent"}) shares.push_back(integrated(filter, {}, progress));
    for (const char* filter : {"disk", "cone", "gaussian"})
        shares.push_back(integrated(filter, kPaperRadius, progress));
    return shares;
}

std::vector<FigureFile> makeNsaaPixel(const FigureInput& input) {
    const std::vector<PixelShare> shares = pixelShares(input.progress);
    const std::vector<FigurePlot> plots{
        {"pixel",
         "Left: the standard's eight places of samples; red ones meet the blue triangle where nothing hides "
         "it. "
         "Right: the support of the kernel around the pixel's middle; what counts less is paler.",
         drawn(shares)}};
    FigureWords words{
        "nsaa-1",
        "Multisampling and the exact integral",
        "After NSAA's Figure 1. A blue triangle is partly hidden by a brown one. Sampling counts "
        "hits, so its answers are quotients of small numbers (csaa:32 divides by the samples that have a "
        "colour); the integral has one answer a kernel. Numbers "
        "are the program's own: methods render the pixel, nsaa's weights are those of `edgewise "
        "weights`.",
        {},
        {},
        input.quick};
    for (const FlatTriangle& t : pixelTriangles())
        words.parameters.emplace_back(
            t.color.r > 0.0 ? "blue triangle, px" : "brown triangle, px",
            fmt::format("({:g}, {:g}) ({:g}, {:g}) ({:g}, {:g})", t.p_px[0].x, t.p_px[0].y, t.p_px[1].x,
                        t.p_px[1].y, t.p_px[2].x, t.p_px[2].y));
    words.parameters.emplace_back("pixel", fmt::format("({}, {})", kStudiedPixel.x, kStudiedPixel.y));
    words.parameters.emplace_back("sigma", "R/3 (not published: ours)");
    words.parameters.emplace_back("seed", "none");
    std::vector<FigureFile> files{{"report.html", figurePage(words, plotsHtml(plots) + sharesTable(shares))},
                                  {"results.csv", sharesCsv(shares)}};
    appendPlotFiles(plots, files);
    return files;
}

}  // namespace edgewise::figures
