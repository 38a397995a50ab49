// Chubarau et al. 2023 on scenes that ship, and ctss-x: what each method's edges cost.
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
    effort.width = effort.timed_width = 96, effort.height = effort.timed_height = 54, effort.runs = 1;
    effort.reference_side = 8, effort.finer_side = 12, effort.facts_side = 4;
    effort.picture_width = 96, effort.picture_height = 54;
    return effort;
}

/// Over scenes: a mean of what there is.
template <class Value>
std::optional<double> meanOver(const ConeTracing& found, bool paper_alone, const Value& value) {
    double sum = 0.0;
    int count = 0;
    for (const ConeScene& scene : found.scenes) {
        if (paper_alone && !scene.of_paper) continue;
        if (const std::optional<double> v = value(scene)) sum += *v, ++count;
    }
    return count == 0 ? std::nullopt : std::optional(sum / count);
}

std::optional<double> meanRatio(const ConeTracing& found, const std::string& method, const std::string& to) {
    const auto logs = meanOver(found, true, [&](const ConeScene& scene) -> std::optional<double> {
        return std::log(scene.run(method).seconds / scene.run(to).seconds);
    });
    return logs ? std::optional(std::exp(*logs)) : std::nullopt;
}

/// dB over contours, or over all edges with kNone.
Psnr psnrOf(const ConeScene& scene, const std::string& method, EdgeKind kind) {
    const EdgePsnr& psnr = scene.run(method).psnr;
    return kind == EdgeKind::kNone ? psnr.all : psnr.of(kind);
}
std::optional<double> meanGain(const ConeTracing& found, const std::string& better, const std::string& worse,
                               EdgeKind kind, bool paper_alone = false) {
    return meanOver(found, paper_alone, [&](const ConeScene& scene) -> std::optional<double> {
        const Psnr a = psnrOf(scene, better, kind), b = psnrOf(scene, worse, kind);
        return a && b ? std::optional(*a - *b) : std::nullopt;
    });
}

std::string text(const std::optional<double>& value, const char* format) {
    return value ? fmt::format(fmt::runtime(format), *value) : "none";
}

ConeClaim gainClaim(const ConeTracing& found, const std::string& claim, const std::string& better,
                    const std::string& worse, EdgeKind kind, const std::string& paper) {
    const std::optional<double> gain = meanGain(found, better, worse, kind);
    return {claim, text(gain, "{:+.2f} dB"), paper, "> 0 dB",
            gain ? std::optional(*gain > 0.0) : std::nullopt};
}
ConeClaim costClaim(const ConeTracing& found, const std::string& claim, const std::string& method,
                    const std::string& to, const std::string& paper, std::optional<double> bar) {
    const std::optional<double> ratio = meanRatio(found, method, to);
    return {claim, text(ratio, "{:.3f}"), paper, bar ? fmt::format("<= {:.2f}", *bar) : "",
            ratio && bar ? std::optional(*ratio <= *bar) : std::nullopt};
}

/// Of what ssaa:2 gains on contours of the paper's scenes.
std::optional<double> shareOfGain(const ConeTracing& found, const std::string& method) {
    const auto gain = meanGain(found, method, "none", EdgeKind::kContour, true),
               of = meanGain(found, "ssaa:2", "none", EdgeKind::kContour, true);
    return gain && of && *of > 0.0 ? std::optional(*gain / *of) : std::nullopt;
}

/// The scene where ctss-x has least over the other, in dB over all edges.
ConeClaim leastClaim(const ConeTracing& found, const std::string& other) {
    std::optional<double> least;
    std::string where;
    for (const ConeScene& scene : found.scenes) {
        const Psnr a = psnrOf(scene, "ctss-x", EdgeKind::kNone), b = psnrOf(scene, other, EdgeKind::kNone);
        if (a && b && (!least || *a - *b < *least)) least = *a - *b, where = scene.name;
    }
    return {fmt::format("ctss-x over {}, all edges, on the worst scene", other),
            least ? fmt::format("{:+.2f} dB ({})", *least, where) : "none", "", ">= 0 dB",
            least ? std::optional(*least >= 0.0) : std::nullopt};
}

/// The scene whose time is furthest over what is allowed.
template <class Bar>
ConeClaim worstCost(const ConeTracing& found, const std::string& claim, const std::string& method,
                    const std::string& bar_text, bool paper_alone, const Bar& bar) {
    double worst = -HUGE_VAL;
    std::string where;
    for (const ConeScene& scene : found.scenes) {
        if (paper_alone && !scene.of_paper) continue;
        const double over = scene.ratioOf(method) - bar(scene);
        if (over > worst)
            worst = over,
            where = fmt::format("{:.2f}, allowed {:.2f} ({})", scene.ratioOf(method), bar(scene), scene.name);
    }
    return {claim, where, "", bar_text, worst <= 0.0};
}

}  // namespace

const ConeRun& ConeScene::run(const std::string& method) const {
    for (const ConeRun& run : runs)
        if (run.method == method) return run;
    return runs.front();
}

std::vector<ConeClaim> claimsOf(const ConeTracing& found) {
    const auto share = [&](const std::string& claim, const std::string& method, double bar) {
        const auto got = shareOfGain(found, method);
        return ConeClaim{claim, got ? fmt::format("{:.0f} %", 100.0 * *got) : "none",
                         "comparable to 4x to 8x supersampling", fmt::format(">= {:.0f} %", 100.0 * bar),
                         got ? std::optional(*got >= bar) : std::nullopt};
    };
    const auto gained = [&](const char* claim, const char* better, const char* worse, EdgeKind kind,
                            const char* paper) {
        return gainClaim(found, claim, better, worse, kind, paper);
    };
    constexpr EdgeKind kContour = EdgeKind::kContour, kAll = EdgeKind::kNone;
    return {
        costClaim(found, "cost of ctss, geometric mean of the paper's scenes", "ctss", "none", "1.30", 1.15),
        worstCost(found, "cost of ctss, worst of the paper's scenes", "ctss", "<= 1.30", true,
                  [](const ConeScene&) { return 1.30; }),
        costClaim(found, "cost of ctss-r", "ctss-r", "none", "1.16", 1.05),
        costClaim(found, "cost of ssaa:2", "ssaa:2", "none", "4.16", std::nullopt),
        share("of ssaa:2's gain on contours of the paper's scenes, ctss has", "ctss", 0.7),
        gained("weighted over uniform samples, contours", "ctss", "ctss:weights=uniform", kContour,
               "smoother (Figure 5)"),
        gained("6x6 over 4x8 masks, contours", "ctss", "ctss:mask=4x8", kContour,
               "closer to the cone's disk"),
        gained("backtracing on over off, all edges", "ctss", "ctss:backtrace=off", kAll,
               "more reliable samples"),
        costClaim(found, "cost of backtracing", "ctss", "ctss:backtrace=off", "negligible", std::nullopt),
        gained("ctss+ssaa:2 over ssaa:3, all edges", "ctss+ssaa:2", "ssaa:3", kAll, "comparable"),
        costClaim(found, "cost of ctss+ssaa:2 in ssaa:3", "ctss+ssaa:2", "ssaa:3",
                  "0.60 by Table 1, below 0.5 by section 4.2", 0.55),
        gained("ctss-r:coverage=2 over ctss-r, contours", "ctss-r:coverage=2", "ctss-r", kContour,
               "closer to ctss"),
        leastClaim(found, "ssaa:2"),
        worstCost(found, "cost of ctss-x, worst scene", "ctss-x", "<= 1.15 + 2 p, p complex pixels; <= 1.7",
                  false,
                  [](const ConeScene& scene) {
                      return std::min(1.15 + 2.0 * scene.run("ctss-x").shareOf("pixels_complex"), 1.7);
                  }),
        leastClaim(found, "ssaa:3"),
        worstCost(found, "cost of ctss-x where it stands for ssaa:3, worst scene", "ctss-x", "<= 2.5", false,
                  [](const ConeScene&) { return 2.5; })};
}

std::vector<FigureFile> makeConeTracing(const FigureInput& input) {
    const ConeTracing found = measureConeTracing(effortFor(input.quick), input.progress);
    for (const ConeClaim& claim : claimsOf(found))
        if (!claim.paper.empty())
            input.claims.push_back(
                {"sections 3 to 5", claim.claim, claim.paper, claim.ours, "",
                 "scenes of ours of the same kinds, on a CPU: the paper's are not published"});
    std::vector<FigureFile> files{{"report.html", coneTracingHtml(found)},
                                  {"results.json", coneTracingJson(found)}};
    appendPictureFiles(found.pictures, files);
    return files;
}

}  // namespace edgewise::figures
