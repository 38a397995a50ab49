// Enhanced sphere tracing, Figures 2 to 6: drawn from rays that are marched by the program's own text.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "paper_figures/field_slice.h"
#include "paper_figures/figure_plot.h"
#include "paper_figures/page_parts.h"

namespace edgewise::figures {
namespace {

using sdf::Relaxation;

constexpr const char* kClassic = "#1b6ca8";
constexpr const char* kRelaxed = "#d7263d";
constexpr const char* kFailed = "#d9a400";
constexpr double kOmega = 1.6;  ///< Figure 3's
constexpr int kMostSteps = 200;

struct DrawnMarch {
    std::string name;
    March march;
};

/// A ground that the ray runs along, as nearly a plane, a ball above, and one that it meets.
sdf::Tape wayField() {
    return ballsField({{{4.0, -30.62}, 30.0}, {{5.6, 1.75}, 0.9}, {{9.3, -0.2}, 1.0}});
}
const SliceRay kWay{{0.0, 0.0}, {1.0, 0.0}, 0.05, 20.0, 0.004, 1.0};

void drawRay(const SlicePanel& panel, const SliceRay& ray, double t, Drawing& drawing) {
    drawing.arrow(panel.at(ray.origin), panel.at(ray.at(t)), "#222");
    drawing.circle(panel.at(ray.origin), 3, "fill='#222'");
}

void drawStep(const SlicePanel& panel, const SliceRay& ray, const MarchStep& step, Drawing& drawing) {
    const char* color = step.failed ? kFailed : step.relaxed ? kRelaxed : kClassic;
    drawing.circle(panel.at(ray.at(step.t)), panel.scale * step.radius,
                   fmt::format("fill='{0}' fill-opacity='0.08' stroke='{0}' stroke-width='1.2'", color));
    drawing.circle(panel.at(ray.at(step.t)), 2.4, fmt::format("fill='{}'", color));
}

SlicePanel wayPanel(double y) {
    return {{10, y}, {740, 250}, {-0.35, -1.6}, 76};
}

void drawWay(double y, const std::string& words, const DrawnMarch& drawn, Drawing& drawing) {
    const SlicePanel panel = wayPanel(y);
    drawing.beginClip(panel.corner, panel.size);
    drawSolid(panel, wayField(), drawing);
    for (const MarchStep& step : drawn.march.steps) drawStep(panel, kWay, step, drawing);
    drawRay(panel, kWay, drawn.march.t, drawing);
    for (std::size_t i = 0; i + 1 < drawn.march.steps.size(); ++i)
        if (drawn.march.steps[i].failed) {
            const glm::dvec2 at = panel.at(kWay.at(drawn.march.steps[i + 1].t));
            drawing.arrow(at + glm::dvec2(0, 60), at + glm::dvec2(0, 4), "#222");
            drawing.text(at + glm::dvec2(-24, 74), "p_fallback");
        }
    drawing.endClip();
    drawing.rectangle(panel.corner, panel.size, "fill='none' stroke='#999'");
    drawing.text({14, y + 18}, fmt::format("{}: {} evaluations", words, drawn.march.steps.size()),
                 "font-size='14'");
}

FigurePlot wayPlot(const std::vector<DrawnMarch>& marches) {
    Drawing drawing(760, 530, "Sphere tracing without and with over-relaxation");
    drawWay(8, "classic", marches[0], drawing);
    drawWay(270, fmt::format("over-relaxed, omega {}", kOmega), marches[1], drawing);
    return {"figures-2-3",
            "Figures 2 and 3. Blue: steps of the sphere's radius. Red: relaxed steps. Yellow: a relaxed step "
            "whose "
            "sphere does not overlap the last one's; the arrow is where the ray goes on, unrelaxed.",
            drawing.svg()};
}

/// A ray that grazes a ball and has few steps.
constexpr int kGrazingSteps = 14;
sdf::Tape grazedField() {
    return ballsField({{{3.2, -1.06}, 1.0}, {{6.2, -6.35}, 5.0}});
}
const SliceRay kGrazing{{0.0, 0.0}, {1.0, 0.0}, 0.05, 20.0, 0.0021, 1.0};

FigurePlot candidatePlot(const March& march) {
    Drawing drawing(760, 250, "Which point of a ray that is out of steps is the hit");
    const SlicePanel panel{{10, 8}, {740, 230}, {-0.2, -1.25}, 96};
    drawing.beginClip(panel.corner, panel.size);
    drawSolid(panel, grazedField(), drawing);
    for (const MarchStep& step : march.steps) {
        const bool candidate = step.t == march.candidate_t, last = &step == &march.steps.back();
        const char* color = candidate ? kRelaxed : last ? kFailed : kClassic;
        drawing.circle(panel.at(kGrazing.at(step.t)), panel.scale * step.radius,
                       fmt::format("fill='{0}' fill-opacity='{1}' stroke='{0}' stroke-width='{2}'", color,
                                   candidate || last ? 0.35 : 0.06, candidate || last ? 2.0 : 1.0));
    }
    drawRay(panel, kGrazing, march.t, drawing);
    drawing.text(panel.at(kGrazing.at(march.candidate_t)) + glm::dvec2(-30, -20), "candidate",
                 fmt::format("fill='{}'", kRelaxed));
    drawing.text(panel.at(kGrazing.at(march.t)) + glm::dvec2(-30, -38), "last point", "fill='#8a6800'");
    drawing.endClip();
    drawing.rectangle(panel.corner, panel.size, "fill='none' stroke='#999'");
    return {
        "figure-4",
        fmt::format("Figure 4. After {} steps: yellow is the last point, in mid-air; red is the one whose "
                    "sphere is the smallest on the screen, {:.4f} at t = {:.2f}.",
                    march.steps.size(), valueOn(grazedField(), kGrazing.at(march.candidate_t)),
                    march.candidate_t),
        drawing.svg()};
}

/// A refracted ray's origin behind the hit.
struct EpsilonCase {
    const char* words;
    double stop_slope;  ///< of the threshold at which the first ray ends
    double epsilon;     ///< offset; negative: dynamic with this least value
};
constexpr double kLeast = 0.06;
constexpr EpsilonCase kEpsilons[]{{"one small epsilon", 0.1, 0.06},
                                  {"dynamic: 2 |f(p)|", 0.1, -kLeast},
                                  {"dynamic: 2 eps_min", 0.001, -kLeast}};

struct EpsilonResult {
    glm::dvec2 p, origin;
    double value_p, offset, value_origin;
};

const sdf::Tape& epsilonField() {
    static const sdf::Tape field = ballsField({{{3.4, -1.2}, 1.9}});
    return field;
}
const SliceRay kToGlass{{0.0, 1.3}, {0.8944271909999159, -0.4472135954999579}, 0.05, 20.0, 0.1, 1.0};

EpsilonResult epsilonOf(const EpsilonCase& one) {
    SliceRay ray = kToGlass;
    ray.pixel_slope = one.stop_slope;
    const March march = marchAlong(epsilonField(), ray, Relaxation::kNone, 1.0, kMostSteps);
    EpsilonResult out;
    out.p = ray.at(march.t), out.value_p = valueOn(epsilonField(), out.p);
    out.offset = one.epsilon > 0.0 ? one.epsilon : 2.0 * std::max(-one.epsilon, std::abs(out.value_p));
    out.origin = out.p - out.offset * normalOn(epsilonField(), out.p);
    out.value_origin = valueOn(epsilonField(), out.origin);
    return out;
}

FigurePlot epsilonPlot() {
    Drawing drawing(760, 282, "Where a refracted ray begins");
    for (int i = 0; i < 3; ++i) {
        const EpsilonResult found = epsilonOf(kEpsilons[i]);
        const SlicePanel panel{{10 + 250.0 * i, 30}, {240, 220}, {1.3, -0.35}, 170};
        drawing.text(panel.corner + glm::dvec2(0, -8), kEpsilons[i].words, "font-size='14'");
        drawing.beginClip(panel.corner, panel.size);
        drawSolid(panel, epsilonField(), drawing);
        drawing.line(panel.at(kToGlass.origin), panel.at(found.p), "stroke='#222' stroke-width='1.2'");
        drawing.circle(panel.at(found.p), panel.scale * std::abs(found.value_p),
                       fmt::format("fill='{0}' fill-opacity='0.3' stroke='{0}'", kFailed));
        drawing.circle(panel.at(found.p), 3, "fill='#222'");
        drawing.line(panel.at(found.p), panel.at(found.origin),
                     fmt::format("stroke='{}' stroke-width='2'", kRelaxed));
        drawing.circle(panel.at(found.origin), 4, fmt::format("fill='{}'", kRelaxed));
        drawing.endClip();
        drawing.rectangle(panel.corner, panel.size, "fill='none' stroke='#999'");
        drawing.text({panel.corner.x, 268},
                     fmt::format("f(p) {:+.3f}, f(origin) {:+.3f}: {}", found.value_p, found.value_origin,
                                 found.value_origin < 0.0 ? "within" : "still outside"),
                     "font-size='11'");
    }
    return {"figure-5",
            "Figure 5. Yellow: the sphere at the hit p. Red: the refracted ray's origin, moved along the "
            "normal. A "
            "small global offset leaves it outside, where it meets the same surface again.",
            drawing.svg()};
}

/// A square within a ball, turned.
sdf::Tape convexField() {
    sdf::Tree tree;
    tree.root =
        tree.add(sdf::Kind::kRotate, {0.0, 0.0, 1.0, 20.0}, {tree.add(sdf::Kind::kBox, {1.6, 1.6, 1.6})});
    return sdf::lower(tree);
}
constexpr double kBound = 1.1313708498984762;  ///< the square's half diagonal: what its slice needs

/// How far to the ball along a ray, from within or without: the nearest crossing ahead.
double toBall(const SliceRay& ray, bool from_within) {
    const double b = glm::dot(ray.origin, ray.direction),
                 c = glm::dot(ray.origin, ray.origin) - kBound * kBound;
    const double root = std::sqrt(b * b - c);
    return from_within ? -b + root : -b - root;
}

struct ConvexCase {
    const char* words;
    SliceRay drawn;    ///< the ray as asked
    SliceRay marched;  ///< as it is marched
    March march;
};

std::vector<ConvexCase> convexCases() {
    const glm::dvec2 along = glm::normalize(glm::dvec2(1.0, 0.25));
    const auto ray = [&](glm::dvec2 origin, double sign) {
        return SliceRay{origin, along, 1e-3, 2.5, 0.004, sign};
    };
    std::vector<ConvexCase> cases;
    cases.push_back({"between: march", ray({-0.98, -0.42}, 1.0), ray({-0.98, -0.42}, 1.0), {}});
    SliceRay outside = ray({-1.6, -0.45}, 1.0), entered = outside;
    entered.origin = outside.at(toBall(outside, false));
    cases.push_back({"outside: from the ball", outside, entered, {}});
    const SliceRay within = ray({-0.62, -0.3}, -1.0);
    SliceRay back = ray(within.at(toBall(within, true)), 1.0);
    back.direction = -along;
    cases.push_back({"within: back from the ball", within, back, {}});
    cases.push_back({"within: march through", within, within, {}});
    for (ConvexCase& one : cases)
        one.march = marchAlong(convexField(), one.marched, Relaxation::kNone, 1.0, kMostSteps);
    return cases;
}

FigurePlot convexPlot(const std::vector<ConvexCase>& cases) {
    Drawing drawing(760, 236, "Convex solids within a ball");
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const ConvexCase& one = cases[i];
        const SlicePanel panel{{10 + 187.0 * double(i), 28}, {180, 180}, {-1.75, -1.5}, 56};
        drawing.text(panel.corner + glm::dvec2(0, -8), one.words);
        drawing.beginClip(panel.corner, panel.size);
        drawSolid(panel, convexField(), drawing);
        drawing.circle(panel.at(glm::dvec2(0.0)), panel.scale * kBound,
                       "fill='none' stroke='#3a7d44' stroke-dasharray='4 3'");
        for (const MarchStep& step : one.march.steps) drawStep(panel, one.marched, step, drawing);
        drawRay(panel, one.marched, one.march.t, drawing);
        drawing.circle(panel.at(one.drawn.origin), 3.5, "fill='#fff' stroke='#222'");
        drawing.endClip();
        drawing.rectangle(panel.corner, panel.size, "fill='none' stroke='#999'");
        drawing.text({panel.corner.x, 224}, fmt::format("{} evaluations", one.march.steps.size()),
                     "font-size='11'");
    }
    return {
        "figure-6",
        "Figure 6. Hollow: the ray's origin. From within, the ray is started where it leaves the ball and is "
        "marched backwards, to the same point as if it had been marched through.",
        drawing.svg()};
}

std::string marchesCsv(const std::vector<DrawnMarch>& marches) {
    std::string out = "march,step,t,radius,relaxed,failed\n";
    for (const DrawnMarch& one : marches)
        for (std::size_t i = 0; i < one.march.steps.size(); ++i) {
            const MarchStep& s = one.march.steps[i];
            out += fmt::format("{},{},{},{},{},{}\n", one.name, i, s.t, s.radius, s.relaxed, s.failed);
        }
    return out;
}

}  // namespace

std::vector<FigureFile> makeSphereDrawn(const FigureInput& input) {
    std::vector<DrawnMarch> marches{
        {"classic", marchAlong(wayField(), kWay, Relaxation::kNone, 1.0, kMostSteps)},
        {"relaxed", marchAlong(wayField(), kWay, Relaxation::kKeinert, kOmega, kMostSteps)},
        {"grazing", marchAlong(grazedField(), kGrazing, Relaxation::kNone, 1.0, kGrazingSteps)}};
    const std::vector<ConvexCase> convex = convexCases();
    input.claims.push_back(
        {"Figure 3", "iterations of the drawn ray, classic and over-relaxed by 1.6", "fewer",
         fmt::format("{} and {}", marches[0].march.steps.size(), marches[1].march.steps.size()), "",
         "a ray of our own along a ground: the paper's is not published"});
    input.claims.push_back(
        {"Figure 6", "iterations from within: marched through, and back from the ball", "far fewer",
         fmt::format("{} and {}", convex[3].march.steps.size(), convex[2].march.steps.size()), "",
         "a slice of our own"});
    std::vector<FigurePlot> plots{wayPlot(marches), candidatePlot(marches[2].march), epsilonPlot(),
                                  convexPlot(convex)};
    for (const ConvexCase& one : convex) marches.push_back({one.words, one.march});
    FigureWords words{
        "sphere-drawn",
        "Sphere tracing, drawn",
        "After Keinert et al. 2014, Figures 2 to 6. Circles are the spheres of rays that the program's "
        "own text marches through fields in a plane.",
        {{"omega", fmt::format("{}, Figure 3's", kOmega)},
         {"steps of Figure 4", fmt::format("{}", kGrazingSteps)},
         {"eps_min of Figure 5", fmt::format("{}", kLeast)},
         {"seed", "none"}},
        {},
        input.quick};
    std::vector<FigureFile> files{{"report.html", figurePage(words, plotsHtml(plots))},
                                  {"results.csv", marchesCsv(marches)}};
    appendPlotFiles(plots, files);
    return files;
}

}  // namespace edgewise::figures
