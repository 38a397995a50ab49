// NSAA, Figure 3: the conservative area, thickening by the incircle, and the box that clips it.
#include <fmt/format.h>

#include <algorithm>

#include "paper_figures/conservative_area.h"
#include "paper_figures/drawing.h"
#include "paper_figures/figure_plot.h"
#include "paper_figures/page_parts.h"
#include "pipeline/html_table.h"
#include "pipeline/load_scene.h"
#include "pipeline/project.h"
#include "pipeline/resolve_camera.h"
#include "pipeline/scene_catalog.h"

namespace edgewise::figures {
namespace {

constexpr double kReach = 2.0;  ///< h: the kernel's radius, px
constexpr Corners kWide{{{4.5, 11.0}, {13.5, 9.5}, {8.0, 3.5}}},
    kAcute{{{6.0, 12.5}, {15.0, 6.5}, {7.0, 10.0}}};
constexpr double kPx = 15.0;  ///< of the drawing a pixel
constexpr double kPanel = 315, kStep = 330, kTop = 34;

/// A window of 21 x 21 px.
glm::dvec2 at(int panel, glm::dvec2 p_px) {
    return glm::dvec2(10 + kStep * panel, kTop) + kPx * (p_px + glm::dvec2(1.5, 2.5));
}

std::vector<glm::dvec2> cornersOf(int panel, const Corners& triangle) {
    std::vector<glm::dvec2> out;
    for (const glm::dvec2& p : triangle) out.push_back(at(panel, p));
    return out;
}

/// P_cons as its rows.
void drawReach(int panel, const Corners& triangle, const char* color, Drawing& drawing) {
    std::vector<glm::dvec2> left, right;
    for (double y = -3.0; y < 19.0; y += 1.0 / 64)
        if (const auto row = withinReach(triangle, kReach, y))
            left.push_back(at(panel, {row->low, y})), right.push_back(at(panel, {row->high, y}));
    left.insert(left.end(), right.rbegin(), right.rend());
    drawing.polygon(left, fmt::format("fill='{0}' fill-opacity='0.22' stroke='{0}'", color));
}

void drawProjected(int panel, const Corners& triangle, Drawing& drawing) {
    drawing.polygon(cornersOf(panel, triangle), "fill='#1b6ca8' fill-opacity='0.75' stroke='#123'");
}

/// (a): kernels that just touch the triangle.
void drawArea(Drawing& drawing) {
    drawReach(0, kWide, "#1b6ca8", drawing);
    drawProjected(0, kWide, drawing);
    for (int i = 0; i < 3; ++i) {
        const glm::dvec2 a = kWide[i], b = kWide[(i + 1) % 3], d = b - a;
        const glm::dvec2 outwards = glm::dvec2(d.y, -d.x) / std::hypot(d.x, d.y);
        const glm::dvec2 sign = incircleOf(kWide).centre - a;
        const double turn = outwards.x * sign.x + outwards.y * sign.y > 0.0 ? -1.0 : 1.0;
        const glm::dvec2 middle = 0.5 * (a + b) + turn * kReach * outwards;
        drawing.circle(at(0, middle), kPx * kReach, "fill='none' stroke='#b3261e' stroke-dasharray='4 3'");
        drawing.circle(at(0, middle), 3, "fill='#b3261e'");
    }
    drawing.text(at(0, {7.6, 8.9}), "P_proj", "fill='#fff' font-weight='bold'");
    drawing.text(at(0, {15.9, 8.4}), "P_cons", "fill='#1b6ca8' font-weight='bold'");
}

/// (b): r, h and the scaled triangle.
void drawThickening(Drawing& drawing) {
    const Corners large = thickened(kWide, kReach);
    drawing.polygon(cornersOf(1, large), "fill='#3a7d44' fill-opacity='0.15' stroke='#3a7d44'");
    drawReach(1, kWide, "#1b6ca8", drawing);
    drawProjected(1, kWide, drawing);
    const Incircle circle = incircleOf(kWide);
    drawing.circle(at(1, circle.centre), kPx * circle.radius, "fill='none' stroke='#fff' stroke-width='1.5'");
    drawing.circle(at(1, circle.centre), kPx * (circle.radius + kReach),
                   "fill='none' stroke='#b3261e' stroke-dasharray='4 3'");
    const glm::dvec2 down(0.0, 1.0);
    drawing.line(at(1, circle.centre), at(1, circle.centre + circle.radius * down),
                 "stroke='#fff' stroke-width='1.5'");
    drawing.line(at(1, circle.centre + circle.radius * down),
                 at(1, circle.centre + (circle.radius + kReach) * down),
                 "stroke='#b3261e' stroke-width='1.5'");
    drawing.text(at(1, circle.centre + 0.6 * circle.radius * down) + glm::dvec2(4, 0), "r", "fill='#fff'");
    drawing.text(at(1, circle.centre + (circle.radius + 0.6 * kReach) * down) + glm::dvec2(4, 0), "h",
                 "fill='#b3261e'");
    for (int i = 0; i < 3; ++i) drawing.arrow(at(1, kWide[i]), at(1, large[i]), "#3a7d44");
}

/// (c): every sample of an acute triangle's thickened one.
void drawBox(Drawing& drawing) {
    const Corners large = thickened(kAcute, kReach);
    drawing.polygon(cornersOf(2, large), "fill='none' stroke='#3a7d44'");
    drawReach(2, kAcute, "#1b6ca8", drawing);
    drawProjected(2, kAcute, drawing);
    const glm::dvec2 low = glm::min(glm::min(kAcute[0], kAcute[1]), kAcute[2]) - kReach,
                     high = glm::max(glm::max(kAcute[0], kAcute[1]), kAcute[2]) + kReach;
    drawing.rectangle(at(2, low), kPx * (high - low), "fill='none' stroke='#222' stroke-width='1.5'");
    for (int j = -3; j < 20; ++j) {
        const auto row = rowOf(large, j + 0.5), needed = withinReach(kAcute, kReach, j + 0.5);
        for (int i = -3; row && i < 24; ++i) {
            const glm::dvec2 p(i + 0.5, j + 0.5);
            if (p.x < row->low || p.x > row->high) continue;
            const bool boxed = p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y;
            const bool used = needed && p.x >= needed->low && p.x <= needed->high;
            drawing.circle(at(2, p), 2.4,
                           fmt::format("fill='{}'", used    ? "#1b6ca8"
                                                    : boxed ? "#ef9a94"
                                                            : "#8c1510"));
        }
    }
}

std::string drawn() {
    Drawing drawing(20 + 3 * kStep - 15, kTop + kPanel + 34, "Conservative area, thickening, clipping box");
    const char* titles[]{"(a) kernels that touch the triangle", "(b) scaled about the incircle by (r + h)/r",
                         "(c) clipped to a box"};
    using Draw = void (*)(Drawing&);
    const Draw panels[]{drawArea, drawThickening, drawBox};
    for (int i = 0; i < 3; ++i) {
        const glm::dvec2 corner(10 + kStep * i, kTop);
        drawing.text(corner + glm::dvec2(0, -10), titles[i], "font-size='14'");
        drawing.beginClip(corner, glm::dvec2(kPanel));
        panels[i](drawing);
        drawing.endClip();
        drawing.rectangle(corner, glm::dvec2(kPanel), "fill='none' stroke='#999'");
    }
    const double y = kTop + kPanel + 18;
    drawing.text({10 + 2 * kStep, y}, "dark: discarded; pale: kept in vain; blue: needed", "font-size='11'");
    return drawing.svg();
}

struct GatherRow {
    std::string name;
    GatherCounts counts;
};

/// All triangles of a scene that are seen from the front, hidden or not.
GatherRow gatherOf(const std::string& name, int width, int height) {
    const Scene scene = loadScene(findScene(name));
    Film film;
    CameraOptions options;
    options.size = {width, height};
    const ResolvedCamera camera = resolveCamera(scene, options, film);
    GatherRow row{fmt::format("{}, {}x{}", name, width, height), {}};
    for (const ScreenTriangle& t : project(scene, camera, film).triangles)
        row.counts += gatherCounts(t.p_px, kReach, film.crop);
    return row;
}

std::vector<GatherRow> rowsFor(bool quick, Progress& progress) {
    const PixelBox window{-2, -3, 19, 18};
    std::vector<GatherRow> rows{{"the wide triangle", gatherCounts(kWide, kReach, window)},
                                {"the acute triangle", gatherCounts(kAcute, kReach, window)}};
    struct Named {
        const char* name;
        int width, height;
    };
    constexpr Named kAll[]{{"torus-20k", 1024, 1024},
                           {"zone-plate", 1024, 1024},
                           {"log-grid", 1024, 1024},
                           {"torus-sequence", 1024, 512}};
    progress.stage("gather", std::size(kAll));
    for (const Named& scene : kAll) {
        const int shrink = quick ? 4 : 1;
        rows.push_back(gatherOf(scene.name, scene.width / shrink, scene.height / shrink));
        progress.advance(1);
    }
    return rows;
}

double percent(std::uint64_t part, std::uint64_t of) {
    return of == 0 ? 0.0 : 100.0 * double(part) / double(of);
}

std::string rowsTable(const std::vector<GatherRow>& rows) {
    std::string out;
    for (const GatherRow& r : rows) {
        const GatherCounts& c = r.counts;
        out += fmt::format("<tr><td>{}</td><td></td>", r.name) + numberCell(double(c.covered), "{:.0f}") +
               numberCell(double(c.needed), "{:.0f}") + numberCell(double(c.thickened), "{:.0f}") +
               numberCell(double(c.clipped), "{:.0f}") +
               numberCell(percent(c.thickened - c.needed, c.needed), "{:.1f}") +
               numberCell(percent(c.clipped - c.needed, c.needed), "{:.1f}") + "</tr>\n";
    }
    return cardTable(
        "<th>triangles</th><th></th><th>samples covered</th><th>needed</th><th>thickened</th><th>clipped "
        "to the box</th><th>in vain, % of needed</th><th>in vain with the box, %</th>",
        out);
}

std::string rowsCsv(const std::vector<GatherRow>& rows) {
    std::string out = "triangles,covered,needed,thickened,clipped\n";
    for (const GatherRow& r : rows)
        out += fmt::format("\"{}\",{},{},{},{}\n", r.name, r.counts.covered, r.counts.needed,
                           r.counts.thickened, r.counts.clipped);
    return out;
}

void addClaims(const std::vector<GatherRow>& rows, std::vector<FigureClaim>& claims) {
    for (std::size_t i = 2; i < rows.size(); ++i) {
        const GatherCounts& c = rows[i].counts;
        claims.push_back(
            {"Figure 3 (c)", "samples gathered in vain after the box, " + rows[i].name,
             "small compared to the triangles",
             fmt::format("{:.0f} % of those needed, {:.0f} % without the box",
                         percent(c.clipped - c.needed, c.needed), percent(c.thickened - c.needed, c.needed)),
             "", "the paper gives no number"});
    }
}

}  // namespace

std::vector<FigureFile> makeNsaaGather(const FigureInput& input) {
    const std::vector<GatherRow> rows = rowsFor(input.quick, input.progress);
    addClaims(rows, input.claims);
    const std::vector<FigurePlot> plots{
        {"conservative",
         "Blue: the triangle; pale blue: P_cons, all middles of kernels that meet it; green: the triangle "
         "that is "
         "rasterized for it. In (c) each dot is a sample for which it is rasterized.",
         drawn()}};
    FigureWords words{
        "nsaa-3",
        "Conservative rasterization",
        "After NSAA's Figure 3. A triangle is gathered for every sample whose kernel meets it. The "
        "table counts samples for all triangles that face the eye, over whole pictures. edgewise "
        "rasterizes in this way on Vulkan (shaders/gather.geom), over cells of 16 px, and asks each "
        "cell exactly afterwards.",
        {{"h", fmt::format("{:g} px", kReach)}, {"seed", "none"}},
        {},
        input.quick};
    std::vector<FigureFile> files{{"report.html", figurePage(words, plotsHtml(plots) + rowsTable(rows))},
                                  {"results.csv", rowsCsv(rows)}};
    appendPlotFiles(plots, files);
    return files;
}

}  // namespace edgewise::figures
