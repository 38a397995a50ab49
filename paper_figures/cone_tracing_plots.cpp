#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "paper_figures/cone_tracing.h"
#include "paper_figures/line_plot.h"
#include "paper_figures/value_grid.h"
#include "pipeline/compare/error_slope.h"
#include "pipeline/plot_colors.h"

namespace edgewise::figures {
namespace {

/// kNone: all edges.
constexpr EdgeKind kShown[]{EdgeKind::kNone,    EdgeKind::kContour, EdgeKind::kInternal,
                            EdgeKind::kTexture, EdgeKind::kShadow,  EdgeKind::kReflection};

std::string edgesOf(EdgeKind kind) {
    return kind == EdgeKind::kNone ? "all edges" : fmt::format("{} edges", judge::nameOf(kind));
}
std::string fileOf(EdgeKind kind) {
    return kind == EdgeKind::kNone ? "edges" : judge::nameOf(kind);
}

/// A method with what it takes and how far it is off.
struct Point {
    std::string method, family;
    glm::dvec2 at;
};

/// Powers of two, or of ten, around what is shown.
PlotAxis axisAround(std::vector<double> values, double base, const std::string& title) {
    const auto [low, high] = std::ranges::minmax_element(values);
    const auto power = [&](double v, double (*to)(double)) {
        return std::pow(base, to(std::log(v) / std::log(base)));
    };
    const auto down = [](double v) { return std::floor(v - 0.05); };
    const auto up = [](double v) { return std::ceil(v + 0.05); };
    return {power(*low, down), power(*high, up), 0.0, title, true};
}

/// Methods of one family are joined; colours go by the order of families in all plots.
std::string plotOf(const std::vector<Point>& points, const std::string& label, PlotAxis x, PlotAxis y,
                   const std::optional<double>& reference) {
    LinePlot plot{.label = label, .x = std::move(x), .y = std::move(y), .marks = {}, .curves = {}};
    std::vector<std::string> families;
    std::map<std::string, std::vector<glm::dvec2>> of;
    for (const Point& p : points) {
        if (!of.contains(p.family)) families.push_back(p.family);
        of[p.family].push_back(p.at);
    }
    for (const std::string& family : families) {
        std::vector<glm::dvec2>& dots = of[family];
        std::ranges::sort(dots, {}, &glm::dvec2::x);
        const std::size_t i = plot.curves.size();
        plot.curves.push_back({family, kPlotColors[i % kPlotColors.size()], false, i >= kPlotColors.size(),
                               dots.size() > 1 ? dots : std::vector<glm::dvec2>(), dots});
    }
    if (reference)
        plot.curves.push_back({"the reference",
                               "#999",
                               true,
                               false,
                               {{plot.x.low, *reference}, {plot.x.high, *reference}},
                               {}});
    return linePlotSvg(plot);
}

/// `none` is ssaa:1 there.
std::string seriesOf(const compare::Row& row) {
    return row.method == "none" ? "ssaa:N" : compare::familyOf(row);
}

std::vector<Point> pointsOf(const ConeScene& scene, EdgeKind kind) {
    std::vector<Point> points;
    for (const compare::Row& row : scene.judged.rows) {
        const double rmse = scene.errorOf(row.method, kind).rmse();
        if (row.seconds.empty() || rmse == 0.0) continue;
        points.push_back({row.method, seriesOf(row), {1e3 * compare::spreadOf(row.seconds).median, rmse}});
    }
    return points;
}

std::vector<double> partOf(const std::vector<Point>& points, double glm::dvec2::*part) {
    std::vector<double> values;
    for (const Point& p : points) values.push_back(p.at.*part);
    return values;
}

std::optional<FigurePlot> scenePlot(const ConeScene& scene, EdgeKind kind) {
    const std::vector<Point> points = pointsOf(scene, kind);
    if (points.empty()) return std::nullopt;
    std::optional<double> own;
    if (const auto& error = scene.judged.reference_error) {
        const judge::KindError e = kind == EdgeKind::kNone ? error->kinds.edges() : error->kinds.of(kind);
        if (e.squares > 0.0) own = e.rmse();
    }
    std::vector<double> errors = partOf(points, &glm::dvec2::y);
    if (own) errors.push_back(*own);
    const std::string title = fmt::format("{}, {}", scene.name(), edgesOf(kind));
    return FigurePlot{fmt::format("{}-{}", scene.name(), fileOf(kind)), title,
                      plotOf(points, title, axisAround(partOf(points, &glm::dvec2::x), 2.0, "time, ms"),
                             axisAround(errors, 10.0, fmt::format("RMSE on {}", edgesOf(kind))), own)};
}

struct Sums {
    std::string family;
    double time = 0.0, error = 0.0;
    int scenes = 0;
};

/// Geometric means over the scenes that have the kind, in none's.
std::vector<Point> meansOf(const std::vector<ConeScene>& scenes, EdgeKind kind) {
    std::vector<std::pair<std::string, Sums>> sums;
    for (const ConeScene& scene : scenes) {
        const std::vector<Point> points = pointsOf(scene, kind);
        const auto none = std::ranges::find(points, "none", &Point::method);
        if (none == points.end()) continue;
        for (const Point& p : points) {
            auto own = std::ranges::find(sums, p.method, &std::pair<std::string, Sums>::first);
            if (own == sums.end()) own = sums.insert(own, {p.method, {p.family}});
            own->second.time += std::log(p.at.x / none->at.x);
            own->second.error += std::log(p.at.y / none->at.y), ++own->second.scenes;
        }
    }
    std::vector<Point> means;
    for (const auto& [method, s] : sums)
        means.push_back({method, s.family, {std::exp(s.time / s.scenes), std::exp(s.error / s.scenes)}});
    return means;
}

std::optional<FigurePlot> meansPlot(const ConeTracing& found, EdgeKind kind) {
    const std::vector<Point> points = meansOf(found.scenes, kind);
    if (points.empty()) return std::nullopt;
    const std::string title = fmt::format("All scenes, {}", edgesOf(kind));
    return FigurePlot{
        fmt::format("means-{}", fileOf(kind)), title + ": geometric means of time and RMSE in those of none.",
        plotOf(points, title, axisAround(partOf(points, &glm::dvec2::x), 2.0, "time, in none's"),
               axisAround(partOf(points, &glm::dvec2::y), 2.0, "RMSE, in none's"), {})};
}

/// dB of ctss-x over another method.
FigurePlot gainsPlot(const ConeTracing& found, const std::string& other) {
    constexpr double kDarkest = 20.0;  // dB
    ValueGrid grid{"ctss-x over " + other, {}, {}, {}};
    for (const EdgeKind kind : kShown) grid.columns.push_back(edgesOf(kind));
    for (const ConeScene& scene : found.scenes) {
        grid.rows.push_back(scene.name());
        for (const EdgeKind kind : kShown) {
            const Psnr own = scene.psnrOf("ctss-x", kind), of = scene.psnrOf(other, kind);
            if (!own || !of) {
                grid.cells.emplace_back();
                continue;
            }
            const double gain = *own - *of;
            grid.cells.push_back(
                {fmt::format("{:+.1f}", gain), std::min(1.0, std::abs(gain) / kDarkest), gain < 0.0});
        }
    }
    std::string name = other;
    std::ranges::replace(name, ':', '_');
    return {"over-" + name, fmt::format("dB of PSNR that ctss-x has over {}; red: less than it.", other),
            valueGridSvg(grid)};
}

}  // namespace

std::vector<FigurePlot> coneTracingPlots(const ConeTracing& found) {
    std::vector<FigurePlot> plots;
    if (found.scenes.empty()) return plots;
    for (const char* other : {"ssaa:2", "ssaa:3", "ctss"}) plots.push_back(gainsPlot(found, other));
    for (const EdgeKind kind : kShown)
        if (auto plot = meansPlot(found, kind)) plots.push_back(std::move(*plot));
    for (const ConeScene& scene : found.scenes)
        for (const EdgeKind kind : kShown)
            if (auto plot = scenePlot(scene, kind)) plots.push_back(std::move(*plot));
    return plots;
}

}  // namespace edgewise::figures
