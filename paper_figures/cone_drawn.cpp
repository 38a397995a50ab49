// Cone-traced supersampling, Figures 2, 3, 4, 6 and 7: drawn from a cone that the program's own text traces.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "paper_figures/cone_slice.h"
#include "paper_figures/figure_plot.h"
#include "paper_figures/line_plot.h"
#include "paper_figures/page_parts.h"
#include "pipeline/plot_colors.h"
#include "pipeline/plot_legend.h"

namespace edgewise::figures {
namespace {

constexpr const char* kCone = "#d98200";
constexpr const char* kGroup = "#b3261e";
constexpr const char* kNormal = "#2e8b3d";
constexpr const char* kSolid = "#7da7cf";
constexpr const char* kSphere = "#7d4e9e";

/// What the cone meets: a ball beside the ray, a small one that the ray meets, and one that fills the cone.
sdf::Tape conedField() {
    return ballsField({{{3.1, 0.95}, 0.7}, {{5.6, -0.12}, 0.3}, {{10.0, 0.5}, 1.9}});
}
const SliceRay kAlong{{0.0, 0.0}, {1.0, 0.0}, 0.4, 20.0, 0.07, 1.0};

/// The share of a disk that a half-plane covers whose border lies `distance` radii from its middle.
double diskShare(double distance) {
    const double d = std::clamp(distance, -1.0, 1.0);
    return (std::acos(d) - d * std::sqrt(1.0 - d * d)) / M_PI;
}

/// Likewise by the mask's bits, the mean over directions.
double maskShare(double distance, bool four_by_eight) {
    constexpr int kDirections = 360;
    double bits = 0.0;
    for (int i = 0; i < kDirections; ++i) {
        const double angle = 2.0 * M_PI * (i + 0.5) / kDirections;
        bits +=
            std::popcount(sdf::cones::planeMask(std::cos(angle), std::sin(angle), distance, four_by_eight));
    }
    return bits / (32.0 * kDirections);
}

/// Figure 2.
FigurePlot occlusionPlot() {
    constexpr double kStep = 148.0, kRadius = 52.0;
    Drawing drawing(760, 190, "Occlusion of a cone by the distance over its radius");
    for (int i = 0; i < 5; ++i) {
        const double distance = 1.0 - 0.5 * i, omega = 0.5 * (1.0 - distance);
        const glm::dvec2 middle(84.0 + kStep * i, 80.0);
        const std::string clip = fmt::format("inside-{}", i);
        drawing.raw(
            fmt::format("<clipPath id='{}'><rect x='{:.1f}' y='10' width='130' height='140'/></clipPath>"
                        "<g clip-path='url(#{})'>",
                        clip, middle.x - 65, clip));
        drawing.rectangle({middle.x + kRadius * distance, 10}, {200, 140}, fmt::format("fill='{}'", kSolid));
        drawing.circle(middle, kRadius, fmt::format("fill='{0}' fill-opacity='0.25' stroke='{0}'", kCone));
        drawing.raw("</g>");
        drawing.circle(middle, 2.5, "fill='#222'");
        drawing.text({middle.x, 172}, fmt::format("d/R {:g}, omega {:g}", distance, omega),
                     "text-anchor='middle'");
    }
    return {"figure-2",
            "Figure 2. The cone's section over a plane: the distance over the cone's radius tells how much "
            "of it is "
            "occluded.",
            drawing.svg()};
}

FigurePlot sharePlot() {
    LinePlot plot{
        "Occlusion, area and bits", {-1.0, 1.0, 0.5, "d/R"}, {0.0, 1.0, 0.25, "share of the cone"}, {}, {}};
    PlotCurve omega{"omega, (1 - d/R)/2", kPlotColors[0], true, false, {}, {}},
        area{"area of the disk", kPlotColors[5], false, false, {}, {}},
        six{"bits of 6x6", kPlotColors[1], false, false, {}, {}},
        eight{"bits of 4x8", kPlotColors[2], false, false, {}, {}};
    for (int i = -100; i <= 100; ++i) {
        const double d = i / 100.0;
        omega.line.emplace_back(d, 0.5 * (1.0 - d)), area.line.emplace_back(d, diskShare(d));
        six.line.emplace_back(d, maskShare(d, false)), eight.line.emplace_back(d, maskShare(d, true));
    }
    plot.curves = {omega, area, six, eight};
    return {"shares",
            "How good that is: the area that a half-plane really covers, and the mean of the masks' bits "
            "over all its "
            "directions.",
            linePlotSvg(plot)};
}

void drawCone(const SlicePanel& panel, const ConeMarch& march, double t, Drawing& drawing) {
    for (const double side : {-1.0, 1.0})
        drawing.line(panel.at(kAlong.origin),
                     panel.at(kAlong.at(t) + glm::dvec2(0.0, side * march.slope * t)),
                     fmt::format("stroke='{}' stroke-dasharray='5 3'", kCone));
    drawing.arrow(panel.at(kAlong.origin), panel.at(kAlong.at(t)), "#222");
}

/// Figure 3.
FigurePlot groupsPlot(const ConeMarch& march) {
    Drawing drawing(760, 322, "Hit groups along a cone");
    const SlicePanel panel{{10, 8}, {740, 300}, {-0.3, -1.8}, 82};
    const sdf::Tape field = conedField();
    drawing.beginClip(panel.corner, panel.size);
    drawSolid(panel, field, drawing);
    for (const ConeMarchStep& step : march.steps)
        drawing.circle(
            panel.at(kAlong.at(step.t)), panel.scale * step.radius,
            fmt::format("fill='none' stroke='{}' stroke-width='{}'", kCone, step.open ? 1.2 : 0.5));
    drawCone(panel, march, march.steps.back().t + 0.4, drawing);
    for (std::size_t i = 0; i < march.groups.size(); ++i) {
        const ConeMarchGroup& one = march.groups[i];
        drawing.line(panel.at(kAlong.at(one.group.entry)), panel.at(kAlong.at(one.exit)),
                     fmt::format("stroke='{}' stroke-width='4'", kGroup));
        const glm::dvec2 sample = kAlong.at(one.group.t);
        drawing.arrow(panel.at(sample), panel.at(sample + 0.55 * normalOn(field, sample)), kNormal);
        drawing.circle(panel.at(sample), 5,
                       fmt::format("fill='#fff' stroke='{}' stroke-width='2.5'", kGroup));
        const std::string name = fmt::format("g{}{}, omega {:.2f}", i + 1, one.group.hard ? ", hard" : "",
                                             std::min(1.0, 0.5 * (1.0 - one.group.least)));
        glm::dvec2 at = panel.at(kAlong.at(one.group.entry)) + glm::dvec2(-4, 60);
        at.x = std::min(at.x, panel.corner.x + panel.size.x - nameWidth(name.size()));
        drawing.text(at, name, "font-size='11'");
    }
    drawing.endClip();
    drawing.rectangle(panel.corner, panel.size, "fill='none' stroke='#999'");
    return {"figure-3",
            "Figure 3. Orange: the cone and its section at each step. Red: groups along the ray; rings: "
            "where each is "
            "shaded; green: normals there. The second group has a hard hit, and tracing goes on until the "
            "cone is "
            "full.",
            drawing.svg()};
}

/// A mask over the cone's base, of a plane that lies so many radii from the middle.
void drawMask(glm::dvec2 middle, double radius, bool four_by_eight, double distance, Drawing& drawing) {
    const glm::dvec2 n = glm::normalize(glm::dvec2(-0.8, 0.45));
    const std::uint32_t mask = sdf::cones::planeMask(n.x, n.y, distance, four_by_eight);
    const glm::dvec2 along(-n.y, n.x), border = middle - radius * distance * n;
    const glm::dvec2 corners[]{border + 300.0 * along, border - 300.0 * along,
                               border - 300.0 * along - 300.0 * n, border + 300.0 * along - 300.0 * n};
    drawing.beginClip(middle - radius, glm::dvec2(2.0 * radius));
    drawing.polygon(corners, fmt::format("fill='{}'", kSolid));
    drawing.endClip();
    drawing.rectangle(middle - radius, glm::dvec2(2.0 * radius), "fill='none' stroke='#777'");
    drawing.circle(middle, radius, fmt::format("fill='none' stroke='{}' stroke-width='1.5'", kCone));
    const int columns = four_by_eight ? 8 : 6, rows = four_by_eight ? 4 : 6;
    int bit = 0;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            if (!four_by_eight && (row == 0 || row == 5) && (column == 0 || column == 5)) continue;
            const glm::dvec2 p(2.0 * (column + 0.5) / columns - 1.0, 2.0 * (row + 0.5) / rows - 1.0);
            const bool set = (mask >> bit) & 1u;
            drawing.circle(middle + radius * p, 9, set ? "fill='#222'" : "fill='#fff' stroke='#222'");
            drawing.text(middle + radius * p + glm::dvec2(0, 3.5), fmt::format("{}", bit),
                         fmt::format("text-anchor='middle' font-size='9' fill='{}'", set ? "#fff" : "#222"));
            ++bit;
        }
    drawing.text(middle + glm::dvec2(0, radius + 20),
                 fmt::format("{}: {} bits, area {:.2f}", four_by_eight ? "4x8" : "6x6 without corners",
                             std::popcount(mask), 32 * diskShare(distance)),
                 "text-anchor='middle' font-size='11'");
}

/// Figures 4 and 6.
FigurePlot masksPlot() {
    constexpr double kDistance = 0.3;
    Drawing drawing(760, 290, "A plane within the cone, and masks of its base");
    // the side view: the cone as a cylinder, the surface as a plane
    const glm::dvec2 low(20, 70), high(210, 200);
    drawing.beginClip({10, 20}, {220, 230});
    const glm::dvec2 surface[]{{150, 0}, {75, 260}, {300, 260}, {300, 0}};
    drawing.polygon(surface, fmt::format("fill='{}'", kSolid));
    drawing.rectangle(low, high - low, fmt::format("fill='{0}' fill-opacity='0.2' stroke='{0}'", kCone));
    drawing.arrow({14, 135}, {222, 135}, "#222");
    drawing.arrow({111, 135}, {62, 121}, kNormal);
    drawing.endClip();
    drawing.text({40, 222}, "a segment of the cone, side view", "font-size='11'");
    drawMask({365, 135}, 110, false, kDistance, drawing);
    drawMask({625, 135}, 110, true, kDistance, drawing);
    return {"figures-4-6",
            "Figures 4 and 6. Left: within the cone the surface is taken for a plane. Middle and right: on "
            "the cone's "
            "base it is a half-plane; the numbered points of two masks, black where covered, as the program "
            "sets them; area: of the disk, in 32nds.",
            drawing.svg()};
}

/// Figure 7: the step that finds the first group.
FigurePlot backtracePlot(const ConeMarch& march) {
    Drawing drawing(760, 330, "Where a cone really meets the surface");
    const sdf::Tape field = conedField();
    const auto first = std::ranges::find_if(march.steps, &ConeMarchStep::open);
    const double entry = march.groups.front().group.entry;
    const SlicePanel panel{{10, 8}, {740, 310}, {0.6, -0.9}, 190};
    drawing.beginClip(panel.corner, panel.size);
    drawSolid(panel, field, drawing);
    for (const auto& [step, name] : {std::pair(first - 1, "t_(i-1)"), std::pair(first, "t_i")}) {
        const glm::dvec2 at = panel.at(kAlong.at(step->t));
        drawing.circle(at, panel.scale * std::abs(step->value),
                       fmt::format("fill='none' stroke='{}' stroke-width='1.5'", kSphere));
        drawing.circle(at, panel.scale * step->radius,
                       fmt::format("fill='{0}' fill-opacity='0.3' stroke='{0}'", kCone));
        drawing.circle(at, 3, "fill='#222'");
        drawing.text(at + glm::dvec2(-12, 18), name);
    }
    drawCone(panel, march, first->t + 1.0, drawing);
    const glm::dvec2 at = panel.at(kAlong.at(entry));
    drawing.circle(at, panel.scale * march.slope * entry,
                   fmt::format("fill='{0}' fill-opacity='0.25' stroke='{0}' stroke-width='2'", kGroup));
    drawing.circle(at, 4, fmt::format("fill='{}'", kGroup));
    drawing.text(at + glm::dvec2(-8, -10), "t_s");
    drawing.endClip();
    drawing.rectangle(panel.corner, panel.size, "fill='none' stroke='#999'");
    return {
        "figure-7",
        fmt::format(
            "Figure 7. Purple: what the field says is free; orange: the cone's section. The group is found "
            "at t = {:.3f}; equation 10 moves its entry back to {:.3f}, red.",
            first->t, entry),
        drawing.svg()};
}

std::string stepsCsv(const ConeMarch& march) {
    std::string out = "what,t,value_or_entry,radius_or_least,open_or_hard\n";
    for (const ConeMarchStep& s : march.steps)
        out += fmt::format("step,{},{},{},{}\n", s.t, s.value, s.radius, s.open);
    for (const ConeMarchGroup& g : march.groups)
        out += fmt::format("group,{},{},{},{}\n", g.group.t, g.group.entry, g.group.least, g.group.hard);
    return out;
}

void addClaims(std::vector<FigureClaim>& claims) {
    double omega = 0.0, six = 0.0, eight = 0.0;
    for (int i = -1000; i <= 1000; ++i) {
        const double d = i / 1000.0, area = diskShare(d);
        omega = std::max(omega, std::abs(0.5 * (1.0 - d) - area));
        six = std::max(six, std::abs(maskShare(d, false) - area));
        eight = std::max(eight, std::abs(maskShare(d, true) - area));
    }
    claims.push_back({"Figure 2", "occlusion by d/R against the area that a plane covers of the cone",
                      "directly correlated", fmt::format("off by at most {:.4f} of the cone", omega), "",
                      "the paper takes the ratio for the occlusion; the area is a circle's segment"});
    claims.push_back(
        {"Figure 6", "masks against the area, mean over directions: 6x6 and 4x8", "6x6 is closer to the cone",
         fmt::format("off by at most {:.4f} and {:.4f}", six, eight), "", "closed form, no scene"});
}

}  // namespace

std::vector<FigureFile> makeConeDrawn(const FigureInput& input) {
    const ConeMarch march = marchCone(conedField(), kAlong, {});
    addClaims(input.claims);
    const std::vector<FigurePlot> plots{occlusionPlot(), sharePlot(), groupsPlot(march), masksPlot(),
                                        backtracePlot(march)};
    FigureWords words{
        "cone-drawn",
        "Cone tracing, drawn",
        "After Chubarau et al. 2023, Figures 2, 3, 4, 6 and 7, from a cone that the program's own text "
        "traces through a field in a plane, with Algorithm 1's steps. Pictures and times are in the "
        "figure cone-tracing.",
        {{"half a pixel at t = 1", fmt::format("{}", kAlong.pixel_slope)},
         {"cone's slope", fmt::format("{:.4f}: sqrt(2) times that", march.slope)},
         {"alpha", fmt::format("{}", sdf::ConeSettings{}.alpha)},
         {"seed", "none"}},
        {},
        input.quick};
    std::vector<FigureFile> files{{"report.html", figurePage(words, plotsHtml(plots))},
                                  {"results.csv", stepsCsv(march)}};
    appendPlotFiles(plots, files);
    return files;
}

}  // namespace edgewise::figures
