// Lottes' scheme on thin things: frames, their mean, and the 11 rays of a pixel.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "paper_figures/drawing.h"
#include "paper_figures/figure_plot.h"
#include "paper_figures/line_plot.h"
#include "paper_figures/lottes_study.h"
#include "paper_figures/page_parts.h"
#include "paper_figures/picture_row.h"
#include "pipeline/plot_colors.h"
#include "pipeline/srgb.h"

namespace edgewise::figures {
namespace {

constexpr int kEnlarged = 4;

std::string hexOf(const glm::dvec4& linear) {
    const auto byte = [](double v) {
        return static_cast<int>(std::lround(255.0 * encodeSrgb(std::clamp(v, 0.0, 1.0))));
    };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(linear.r), byte(linear.g), byte(linear.b));
}

/// The pixel's own square and those of its neighbours, rays where they lie.
FigurePlot patternPlot(const LottesStudy& found) {
    constexpr double kPx = 100.0;
    Drawing drawing(760, 380, "The 11 rays of a pixel");
    const auto at = [&](glm::dvec2 p_px) {
        return glm::dvec2(30, 30) + kPx * (p_px - glm::dvec2(found.pixel) + glm::dvec2(2, 1));
    };
    double sum = 0.0;
    for (const LottesWeight& w : found.rays) sum += w.f * w.ray.coverage;
    for (const LottesWeight& w : found.rays)
        drawing.rectangle(
            at(w.pixel), glm::dvec2(kPx),
            fmt::format("fill='#f4f4f2' stroke='#aaa' stroke-width='{}'", w.pixel == found.pixel ? 3 : 1));
    for (const LottesWeight& w : found.rays) {
        const double share = sum > 0.0 ? w.f * w.ray.coverage / sum : 0.0;
        drawing.circle(at(w.ray.p_px), 3.0 + 50.0 * std::sqrt(share),
                       fmt::format("fill='{}' stroke='#222'", hexOf(w.ray.color)));
    }
    for (const LottesWeight& w : found.rays)
        drawing.text(at(w.pixel) + glm::dvec2(6, 94),
                     fmt::format("cov {:.2f}, {:.1f} %", w.ray.coverage,
                                 sum > 0.0 ? 100 * w.f * w.ray.coverage / sum : 0.0),
                     "font-size='11'");
    drawing.circle(at(glm::dvec2(found.pixel) + 0.5), 4, "fill='#d7263d' stroke='#fff'");
    drawing.rectangle(at(found.pixel), glm::dvec2(kPx), "fill='none' stroke='#d7263d' stroke-width='2.5'");
    drawing.text({560, 50}, fmt::format("pixel ({}, {}), frame 0", found.pixel.x, found.pixel.y),
                 "font-size='14'");
    drawing.text({560, 74}, "area of a circle: its ray's weight,");
    drawing.text({560, 90}, "F of the distance to the middle");
    drawing.text({560, 106}, "times coverage, over their sum");
    drawing.text({560, 122}, "colour: what the ray met");
    return {"pattern",
            "The fixed pattern, rows of 3, 5 and 3 pixels, with the rays of one frame: each lies somewhere "
            "in its own "
            "pixel, elsewhere in the next frame.",
            drawing.svg()};
}

FigurePlot framesPlot(const LottesStudy& found) {
    LinePlot plot{"Error and deviation by frames",
                  {0.9, 1.1 * found.effort.frames, 0.0, "frames", true},
                  {1e-3, 1.0, 0.0, "RMS, linear RGB", true},
                  {},
                  {}};
    PlotCurve error{"against the reference", kPlotColors[0], false, false, {}, {}},
        deviation{"of the mean, in time", kPlotColors[1], false, false, {}, {}},
        none{"a ray a pixel, no frames", kPlotColors[5], true, false, {}, {}};
    for (const LottesPoint& point : found.points) {
        error.line.emplace_back(point.frames, point.rmse);
        if (point.frames > 1) deviation.line.emplace_back(point.frames, point.deviation_of_mean);
    }
    error.dots = error.line, deviation.dots = deviation.line;
    none.line = {{1.0, found.none_rmse}, {double(found.effort.frames), found.none_rmse}};
    plot.curves = {error, deviation, none};
    return {"frames",
            "The mean settles, but not at the reference: what it tends to is the scheme's bias, for it "
            "dilates by its "
            "hit distance, normalises coverage away and blurs.",
            linePlotSvg(plot)};
}

ImageBuffer partOf(const ImageBuffer& image, const PixelBox& box) {
    ImageBuffer part(box);
    for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x) part.rgba[part.index(x, y)] = image.rgba[image.index(x, y)];
    return part;
}

std::vector<PictureRow> rowsOf(const LottesStudy& found) {
    struct Named {
        const ImageBuffer* image;
        std::string name, words;
    };
    std::vector<Named> all;
    for (std::size_t i = 0; i < found.frames.size(); ++i)
        all.push_back({&found.frames[i], fmt::format("frame_{}", i), fmt::format("frame {}", i)});
    all.push_back({&found.mean, "mean", fmt::format("mean of {} frames", found.effort.frames)});
    all.push_back(
        {&found.mean_without_coverage, "mean_without_coverage", "the same, all rays count in full"});
    all.push_back({&found.none, "none", "a ray through each middle"});
    all.push_back({&found.reference, "reference",
                   fmt::format("reference: {0} x {0} rays a pixel", found.effort.reference_side)});
    PictureRow whole{"Frame by frame, and averaged", "", {}, true}, part{"A part", "", {}};
    const int w = found.effort.width / 4, h = found.effort.height / 4;
    const int x0 = std::clamp(found.pixel.x - w / 2, 0, found.effort.width - w),
              y0 = std::clamp(found.pixel.y - h / 2, 0, found.effort.height - h);
    part.words = fmt::format("{} times as large.", kEnlarged);
    for (const Named& one : all) {
        whole.pictures.push_back(pictureOf(*one.image, one.name, one.words));
        part.pictures.push_back(pictureOf(partOf(*one.image, {x0, y0, x0 + w, y0 + h}), one.name + "_part",
                                          one.words, kEnlarged));
    }
    return {whole, part};
}

std::string pointsCsv(const LottesStudy& found) {
    std::string out = "frames,deviation_of_mean,rmse\n";
    for (const LottesPoint& p : found.points)
        out += fmt::format("{},{},{}\n", p.frames, p.deviation_of_mean, p.rmse);
    return out;
}

void addClaims(const LottesStudy& found, std::vector<FigureClaim>& claims) {
    claims.push_back(
        {"Reconstruction", "rays that make a pixel", "11", fmt::format("{}", found.rays.size()), "", ""});
    claims.push_back({"Coverage", "error on surfaces shows up as temporal grain", "visually pleasing",
                      fmt::format("{:.4f} RMS from frame to frame, of which {} is added grain",
                                  found.deviation, found.effort.grain),
                      "", "the page gives no number"});
    claims.push_back(
        {"Reconstruction", "the mean against a box filter's picture", "very analog film feeling",
         fmt::format("RMSE {:.4f}; a ray a pixel: {:.4f}", found.points.back().rmse, found.none_rmse), "",
         "the page claims a look, not a filter: the scheme dilates, normalises coverage away and blurs"});
}

}  // namespace

std::vector<FigureFile> makeLottes(const FigureInput& input) {
    LottesEffort effort;
    if (input.quick) effort.width = 96, effort.height = 54, effort.frames = 8, effort.reference_side = 6;
    const LottesStudy found = studyLottes(effort, input.progress);
    addClaims(found, input.claims);
    const std::vector<FigurePlot> plots{patternPlot(found), framesPlot(found)};
    const std::vector<PictureRow> rows = rowsOf(found);
    FigureWords words{
        "lottes",
        "Lottes' scheme on thin things",
        "After Lottes 2016: a ray a pixel that moves from frame to frame, stopped near a surface; a "
        "coverage; 11 rays weighted by F times coverage; grain. F's scale and the knob of the hit's "
        "distance are not published: ours are below.",
        {{"scene", effort.scene},
         {"size", fmt::format("{}x{}", effort.width, effort.height)},
         {"frames", fmt::format("{}", effort.frames)},
         {"hit distance", fmt::format("{} pixel diameters", found.settings.distance)},
         {"F", fmt::format("2^(-{} r^2)", found.settings.scale)},
         {"grain", fmt::format("{} RMS", effort.grain)},
         {"seed", "0"}},
        {fmt::format("edgewise render {} --size {}x{} --method lottes --frames {} --seed 0 -o mean.png",
                     effort.scene, effort.width, effort.height, effort.frames)},
        input.quick};
    std::vector<FigureFile> files{
        {"report.html", figurePage(words, plotsHtml(plots) + pictureRowsHtml(rows))},
        {"results.csv", pointsCsv(found)}};
    appendPlotFiles(plots, files);
    appendPictureFiles(rows, files);
    return files;
}

}  // namespace edgewise::figures
