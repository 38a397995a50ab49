// The methods for SDF scenes on scenes that ship: what each one's edges cost, and what is claimed of that.
#include "paper_figures/cone_tracing.h"

#include <fmt/format.h>

#include <cmath>

#include "paper_figures/cone_tracing_measure.h"

namespace edgewise::figures {
namespace {

ConeTracingEffort effortFor(bool quick) {
    ConeTracingEffort effort;
    effort.quick = quick;
    effort.scenes = {"primitives", "random-box", "random-shape", "sparse-shape",
                     "atrium",     "slabs",      "wires",        "thin"};
    if (!quick) return effort;
    effort.scenes = {"primitives", "wires"};
    effort.size = {96, 54}, effort.timed_size = {0, 0}, effort.runs = 1;
    effort.reference_side = 8;
    effort.picture_size = {96, 54};
    return effort;
}

using Scenes = std::vector<ConeScene>;
using Value = std::optional<double>;

/// Over scenes: a mean of what there is.
template <class Of>
Value meanOver(const Scenes& scenes, bool paper_alone, const Of& of) {
    double sum = 0.0;
    int count = 0;
    for (const ConeScene& scene : scenes) {
        if (paper_alone && !scene.ofPaper()) continue;
        if (const Value v = of(scene)) sum += *v, ++count;
    }
    return count == 0 ? std::nullopt : Value(sum / count);
}

Value meanRatio(const Scenes& scenes, const std::string& method, const std::string& to) {
    const Value logs = meanOver(scenes, true, [&](const ConeScene& scene) -> Value {
        const Value ratio = scene.ratioOf(method, to);
        return ratio ? Value(std::log(*ratio)) : std::nullopt;
    });
    return logs ? Value(std::exp(*logs)) : std::nullopt;
}

/// dB; kNone: over all edges.
Value gainOn(const ConeScene& scene, const std::string& better, const std::string& worse, EdgeKind kind) {
    const Psnr a = scene.psnrOf(better, kind), b = scene.psnrOf(worse, kind);
    return a && b ? Value(*a - *b) : std::nullopt;
}
Value meanGain(const Scenes& scenes, const std::string& better, const std::string& worse, EdgeKind kind,
               bool paper_alone = false) {
    return meanOver(scenes, paper_alone,
                    [&](const ConeScene& scene) { return gainOn(scene, better, worse, kind); });
}

std::string text(const Value& value, const char* format) {
    return value ? fmt::format(fmt::runtime(format), *value) : "not measured";
}
Value less(const Value& bar, const Value& value) {
    return bar && value ? Value(*bar - *value) : std::nullopt;
}

struct Asked {
    std::string claim, better, worse;
    EdgeKind kind;
    std::string paper;
};
ConeClaim gainClaim(const Scenes& scenes, const Asked& asked) {
    const Value gain = meanGain(scenes, asked.better, asked.worse, asked.kind);
    return {asked.claim, text(gain, "{:+.2f} dB"), asked.paper, ">= 0 dB", gain, "dB"};
}

struct Cost {
    std::string claim, method, to, paper;
    Value bar;
};
ConeClaim costClaim(const Scenes& scenes, const Cost& cost) {
    const Value ratio = meanRatio(scenes, cost.method, cost.to);
    return {cost.claim,
            text(ratio, "{:.3f}"),
            cost.paper,
            cost.bar ? fmt::format("<= {:.2f}", *cost.bar) : "",
            less(cost.bar, ratio),
            ""};
}

/// Of what ssaa:2 gains on contours of the paper's scenes, in dB.
ConeClaim shareClaim(const Scenes& scenes, const std::string& method, double bar) {
    const Value gain = meanGain(scenes, method, "none", EdgeKind::kContour, true),
                of = meanGain(scenes, "ssaa:2", "none", EdgeKind::kContour, true);
    const Value share = gain && of && *of > 0.0 ? Value(100.0 * *gain / *of) : std::nullopt;
    return {fmt::format("of ssaa:2's gain on contours of the paper's scenes, {} has", method),
            text(share, "{:.0f} %"),
            "comparable to 4x to 8x supersampling",
            fmt::format(">= {:.0f} %", 100.0 * bar),
            share ? Value(*share - 100.0 * bar) : std::nullopt,
            "%"};
}

/// The scene where ctss-x has least over the other, in dB over a kind.
ConeClaim leastClaim(const Scenes& scenes, const std::string& other, EdgeKind kind) {
    Value least;
    std::string where;
    for (const ConeScene& scene : scenes) {
        const Value gain = gainOn(scene, "ctss-x", other, kind);
        if (gain && (!least || *gain < *least)) least = gain, where = scene.name();
    }
    const std::string edges =
        kind == EdgeKind::kNone ? "all edges" : fmt::format("{} edges", judge::nameOf(kind));
    return {fmt::format("ctss-x over {}, {}, on the worst scene", other, edges),
            least ? fmt::format("{:+.2f} dB ({})", *least, where) : "not measured",
            "",
            ">= 0 dB",
            least,
            "dB"};
}

/// The scene whose time is furthest over what is allowed.
template <class Bar>
ConeClaim worstCost(const Scenes& scenes, const std::string& claim, const std::string& method,
                    const std::string& bar_text, bool paper_alone, const Bar& bar) {
    ConeClaim worst{claim, "not measured", "", bar_text, {}, ""};
    for (const ConeScene& scene : scenes) {
        const Value ratio = scene.ratioOf(method);
        if ((paper_alone && !scene.ofPaper()) || !ratio) continue;
        const double allowed = bar(scene);
        if (worst.margin && *worst.margin <= allowed - *ratio) continue;
        worst.margin = allowed - *ratio;
        worst.ours = fmt::format("{:.2f}, allowed {:.2f} ({})", *ratio, allowed, scene.name());
    }
    return worst;
}

std::vector<ConeClaim> costClaims(const Scenes& scenes) {
    return {costClaim(scenes,
                      {"cost of ctss, geometric mean of the paper's scenes", "ctss", "none", "1.30", 1.15}),
            worstCost(scenes, "cost of ctss, worst of the paper's scenes", "ctss", "<= 1.30", true,
                      [](const ConeScene&) { return 1.30; }),
            costClaim(scenes, {"cost of ctss-r", "ctss-r", "none", "1.16", 1.05}),
            costClaim(scenes, {"cost of ssaa:2", "ssaa:2", "none", "4.16", {}}),
            costClaim(scenes, {"cost of backtracing", "ctss", "ctss:backtrace=off", "negligible", {}}),
            costClaim(scenes, {"cost of ctss+ssaa:2 in ssaa:3", "ctss+ssaa:2", "ssaa:3",
                               "0.60 by Table 1, below 0.5 by section 4.2", 0.55})};
}

std::vector<ConeClaim> qualityClaims(const Scenes& scenes) {
    constexpr EdgeKind kContour = EdgeKind::kContour, kAll = EdgeKind::kNone;
    return {shareClaim(scenes, "ctss", 0.7),
            shareClaim(scenes, kPixelAreaCone, 0.7),
            gainClaim(scenes, {"weighted over uniform samples, contours", "ctss", "ctss:weights=uniform",
                               kContour, "smoother (Figure 5)"}),
            gainClaim(scenes, {"6x6 over 4x8 masks, contours", "ctss", "ctss:mask=4x8", kContour,
                               "closer to the cone's disk"}),
            gainClaim(scenes, {"backtracing on over off, all edges", "ctss", "ctss:backtrace=off", kAll,
                               "more reliable samples"}),
            gainClaim(scenes,
                      {"ctss+ssaa:2 over ssaa:3, contours", "ctss+ssaa:2", "ssaa:3", kContour, "comparable"}),
            gainClaim(scenes,
                      {"ctss+ssaa:2 over ssaa:3, all edges", "ctss+ssaa:2", "ssaa:3", kAll, "comparable"}),
            gainClaim(scenes, {"ctss-r:coverage=2 over ctss-r, contours", "ctss-r:coverage=2", "ctss-r",
                               kContour, "closer to ctss"})};
}

std::vector<ConeClaim> extensionClaims(const Scenes& scenes) {
    std::vector<ConeClaim> claims{
        leastClaim(scenes, "ssaa:2", EdgeKind::kNone),
        worstCost(scenes, "cost of ctss-x, worst scene; p: share of complex pixels", "ctss-x",
                  "<= 1.15 + 2 p, <= 1.7", false,
                  [](const ConeScene& scene) {
                      return std::min(1.15 + 2.0 * scene.shareOf("ctss-x", "pixels_complex"), 1.7);
                  }),
        leastClaim(scenes, "ssaa:3", EdgeKind::kNone),
        worstCost(scenes, "cost of ctss-x where it stands for ssaa:3, worst scene", "ctss-x", "<= 2.5", false,
                  [](const ConeScene&) { return 2.5; })};
    for (const EdgeKind kind : kEdgeKinds) claims.push_back(leastClaim(scenes, "ssaa:2", kind));
    return claims;
}

}  // namespace

std::vector<ConeClaim> claimsOf(const ConeTracing& found) {
    std::vector<ConeClaim> claims = costClaims(found.scenes);
    for (auto* of : {&qualityClaims, &extensionClaims})
        for (ConeClaim& claim : of(found.scenes)) claims.push_back(std::move(claim));
    return claims;
}

std::vector<FigureFile> makeConeTracing(const FigureInput& input) {
    const ConeTracing found = measureConeTracing(effortFor(input.quick), input.progress);
    for (const ConeClaim& claim : claimsOf(found))
        if (!claim.paper.empty())
            input.claims.push_back(
                {"sections 3 to 5", claim.claim, claim.paper, claim.ours, "",
                 "scenes of ours of the same kinds, on a CPU: the paper's are not published"});
    const std::vector<FigurePlot> plots = coneTracingPlots(found);
    std::vector<FigureFile> files{{"report.html", coneTracingHtml(found, plots)},
                                  {"results.json", coneTracingJson(found)},
                                  {"results.csv", coneTracingCsv(found)}};
    appendPlotFiles(plots, files);
    appendPictureFiles(found.pictures, files);
    return files;
}

}  // namespace edgewise::figures
