#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "paper_figures/filter_study.h"
#include "pipeline/compare/base64.h"
#include "pipeline/compare/error_map.h"
#include "pipeline/compare/report_page.h"
#include "pipeline/html_table.h"
#include "pipeline/html_text.h"
#include "pipeline/version.h"

namespace edgewise::figures {
namespace {

constexpr const char* kStyle = R"css(
.shown{position:sticky;top:0;background:#f6f6f4ee;padding:8px 0;z-index:1;display:flex;flex-wrap:wrap;gap:2px 14px}
.shown label{white-space:nowrap;font-size:13px}
.shown i{display:inline-block;width:16px;height:4px;border-radius:2px;vertical-align:middle;margin:0 4px 0 2px}
.pictures{display:flex;flex-wrap:wrap;gap:14px}
.pictures figure{flex:none}
.pictures figcaption b{color:#222}
.pictures img{display:block;image-rendering:pixelated;background:#888}
.pictures img+img{margin-top:3px}
main{max-width:1800px}table{font-size:12px}th,td{padding:4px 5px}th{white-space:normal;min-width:40px;line-height:1.2}
td:nth-child(2),th:nth-child(2){text-align:right}
)css";

/// Ticks hide series in all plots at once; pictures take a whole number of screen pixels a pixel.
constexpr const char* kScript = R"js(
for (const tick of document.querySelectorAll(".shown input")) tick.addEventListener("change", () => {
  const name = tick.dataset.filter;
  for (const group of document.querySelectorAll("[data-series]"))
    if (group.dataset.series === name || group.dataset.series.startsWith(name + ", R "))
      group.style.display = tick.checked ? "" : "none";
});
const zoom = document.getElementById("zoom");
const resize = () => {
  for (const picture of document.querySelectorAll(".pictures img"))
    picture.style.width = picture.style.height =
      picture.naturalWidth * Number(zoom.value) / window.devicePixelRatio + "px";
};
zoom.addEventListener("change", resize);
window.addEventListener("load", resize);
)js";

struct Column {
    std::string title, tip;
    std::function<double(const FilterRow&)> value;
    const char* format;
};

constexpr double kPercent = 100.0, kMilli = 1000.0;
constexpr double kLeastShownResponse = 1e-6;

constexpr std::ptrdiff_t kPatternColumn = 4;  ///< after what a formula says of aliasing

std::vector<Column> columnsOf(const FilterStudy& study) {
    std::vector<Column> columns{
        {"edge error, 10&#8315;&#179; px", "blur and aliasing of an edge together",
         [](const FilterRow& r) { return kMilli * (r.mean_edge.blur + r.mean_edge.aliasing); }, "{:.2f}"},
        {"blur, 10&#8315;&#179; px", "what the pass band of an edge loses, all orientations",
         [](const FilterRow& r) { return kMilli * r.mean_edge.blur; }, "{:.2f}"},
        {"aliasing, 10&#8315;&#179; px", "what of an edge folds, all orientations",
         [](const FilterRow& r) { return kMilli * r.mean_edge.aliasing; }, "{:.3g}"},
        {"aliasing, % of no filter", "the same over an unfiltered edge's",
         [](const FilterRow& r) { return kPercent * r.mean_edge.share; }, "{:.3g}"},
        {"width, px", "10-90 % of the step response, axis",
         [](const FilterRow& r) { return r.axis.width_px; }, "{:.3f}"},
        {"diagonal", "10-90 % of the step response, diagonal",
         [](const FilterRow& r) { return r.diagonal.width_px; }, "{:.3f}"},
        {"MTF50, cycles/px", "where the response is 1/2, axis",
         [](const FilterRow& r) { return r.axis.half_response; }, "{:.3f}"},
        {"diagonal", "where the response is 1/2, diagonal",
         [](const FilterRow& r) { return r.diagonal.half_response; }, "{:.3f}"},
        {"at Nyquist, dB", "the response at 1/2 cycle/px, axis; at least -120",
         [](const FilterRow& r) {
             return 20 * std::log10(std::max(kLeastShownResponse, std::abs(r.axis.at_nyquist)));
         },
         "{:.1f}"},
        {"variance, px&#178;", "second moment along an axis",
         [](const FilterRow& r) { return r.second_moment_px2; }, "{:.4f}"},
        {"overshoot, %", "of the step, axis; the undershoot is the same",
         [](const FilterRow& r) { return kPercent * r.axis.overshoot; }, "{:.2f}"},
        {"negative area, %", "of the kernel's integral",
         [](const FilterRow& r) { return kPercent * r.negative_area; }, "{:.2f}"},
        {"anisotropy", "largest difference between axis and diagonal up to Nyquist",
         [](const FilterRow& r) { return r.anisotropy; }, "{:.4f}"},
        {"step residual", "nsaa's weights against the formula, largest",
         [](const FilterRow& r) { return std::max(r.axis.step_residual, r.diagonal.step_residual); },
         "{:.1e}"},
        {"response residual", "measured response against the transform, largest",
         [](const FilterRow& r) { return std::max(r.axis.response_residual, r.diagonal.response_residual); },
         "{:.1e}"},
        {"of its bound", "the same over what a finely sampled edge may err",
         [](const FilterRow& r) { return std::max(r.axis.residual_of_bound, r.diagonal.residual_of_bound); },
         "{:.2g}"}};
    for (std::size_t i = 0; i < study.patterns.size(); ++i)
        columns.insert(columns.begin() + kPatternColumn + static_cast<std::ptrdiff_t>(i),
                       {study.patterns[i] + ", aliased %", "what aliases, of the variance of the picture",
                        [i](const FilterRow& r) { return kPercent * r.patterns[i].share; }, "{:.3g}"});
    return columns;
}

std::string table(const FilterStudy& study) {
    const std::vector<Column> columns = columnsOf(study);
    std::string out = "<table><thead><tr><th>filter</th><th>R, px</th>";
    for (const Column& column : columns)
        out += fmt::format("<th title='{}'{}>{}</th>", escapedHtml(column.tip),
                           &column == &columns.front() ? " aria-sort='ascending'" : "", column.title);
    out += "</tr></thead><tbody>\n";
    std::vector<const FilterRow*> rows;
    for (const FilterRow& row : study.rows) rows.push_back(&row);
    std::ranges::sort(rows, {}, [&](const FilterRow* row) { return columns.front().value(*row); });
    for (const FilterRow* row : rows) {
        out += fmt::format("<tr><td>{}</td>{}", escapedHtml(row->filter.name),
                           numberCell(row->filter.radius, "{:g}"));
        for (const Column& column : columns) out += numberCell(column.value(*row), column.format);
        out += "</tr>\n";
    }
    return out + "</tbody></table>\n";
}

std::string image(const std::vector<unsigned char>& png, const std::string& alt, int side) {
    return fmt::format("<img alt='{0}' title='{0}' width='{1}' height='{1}' src='data:image/png;base64,{2}'>",
                       escapedHtml(alt), 2 * side, compare::base64(png));
}

std::string picturesHtml(const FilterStudy& study) {
    std::string out;
    for (const std::string& pattern : study.patterns) {
        out += fmt::format("<h2>{}, R 2</h2><div class='card pictures'>\n", escapedHtml(pattern));
        for (const StudyPicture& p : study.pictures) {
            if (p.pattern != pattern) continue;
            out += "<figure>" + image(p.png, p.pattern + ", " + p.name, study.part_px);
            if (!p.aliased_png.empty())
                out += image(p.aliased_png, p.pattern + ", " + p.name + ": what aliases", study.part_px);
            out += fmt::format("<figcaption><b>{}</b>{}</figcaption></figure>\n", escapedHtml(p.name),
                               p.rms ? fmt::format("<br>aliased: RMS {:.2e}", *p.rms) : "");
        }
        out += "</div>\n";
    }
    return out;
}

/// The best and the worst in words: what the table says first.
std::string findings(const FilterStudy& study) {
    const auto least = [&](auto&& value) {
        const auto best = std::ranges::min_element(study.rows, {}, value);
        return std::pair(titleOf(best->filter), value(*best));
    };
    const auto [sharp, sharp_error] =
        least([](const FilterRow& r) { return r.mean_edge.blur + r.mean_edge.aliasing; });
    const auto [clean, clean_share] = least([](const FilterRow& r) { return r.mean_edge.share; });
    double step = 0.0, response = 0.0, of_bound = 0.0;
    for (const FilterRow& row : study.rows)
        for (const AlongDirection* along : {&row.axis, &row.diagonal}) {
            step = std::max(step, along->step_residual);
            response = std::max(response, along->response_residual);
            of_bound = std::max(of_bound, along->residual_of_bound);
        }
    return fmt::format(
        "<p>Nearest to an ideal low-pass on edges: <b>{}</b>, {:.2f}&middot;10&#8315;&#179; px. Least "
        "aliasing: "
        "<b>{}</b>, {:.2g} % of an unfiltered edge's. The pictures' own weights meet the formulas: step "
        "responses "
        "within {:.1e}, frequency responses within {:.1e}, at most {:.2f} of what the measurement may "
        "err.</p>\n",
        escapedHtml(sharp), kMilli * sharp_error, escapedHtml(clean), kPercent * clean_share, step, response,
        of_bound);
}

std::string ticks(const FilterStudy& study) {
    std::string out = "<div class='shown'>";
    for (const FilterRow& row : study.rows)
        if (row.paper_radius)
            out += fmt::format(
                "<label><input type='checkbox' checked data-filter='{0}'><i "
                "style='background:{1}'></i>{0}</label>",
                escapedHtml(row.filter.name), colorOf(study, row.filter));
    return out + "</div>\n";
}

std::string definitions(const FilterStudy& study) {
    return fmt::format(
        "<dl><dt>filters</dt><dd>all of the contract at R 2 as in the paper's Figure 6, where it names a "
        "constant "
        "(disk), a tent (cone) and a Gaussian; its sigma is not published, R/3 is ours. "
        "bc:0.5,0.25 and poly:1,-3,3,-1, (1 &minus; r&sup2;/R&sup2;)&sup3;, are members that we chose; the "
        "polynomial stands in for those of the paper's conclusion. Rows of another R are the contract's "
        "default "
        "radii{}</dd>"
        "<dt>frequency response</dt><dd>the kernel's Fourier transform by Gauss-Legendre quadrature; Nyquist "
        "is "
        "1/2 cycle/px along an axis, 0.707 along the diagonal</dd>"
        "<dt>measured</dt><dd>nsaa renders a half plane whose edge is slanted by 1:256 (axis) and 127:128 "
        "(diagonal); its pixels are a step response every 1/256 and 1/180 px, differentiated and transformed "
        "as in "
        "ISO 12233. The bound is that of the aliases of these samples</dd>"
        "<dt>blur, aliasing</dt><dd>an ideal edge of contrast 1, spectrum 1/(2&pi;f)&sup2;, a px of its "
        "length: "
        "(1/2&pi;&sup2;) &int; (1 &minus; W&#770;)&sup2;/f&sup2; below Nyquist and (1/2&pi;&sup2;) &int; "
        "W&#770;&sup2;/f&sup2; above it, up to {:g} cycles/px, mean over all orientations; their sum, the "
        "edge "
        "error, is the squared distance from the edge through an ideal low-pass</dd>"
        "<dt>width, overshoot</dt><dd>of the step response: 10 to 90 %, and beyond 1</dd>"
        "<dt>anisotropy</dt><dd>the largest difference between the responses along axis and diagonal up to "
        "Nyquist; 0 for radial kernels</dd>"
        "<dt>aliased</dt><dd>the scene filtered with that filter at {} samples a pixel and axis (the film "
        "moved by "
        "fractions of a pixel), its luminance without all frequencies that pixels hold: RMS, and percent of "
        "the "
        "picture's variance, on the parts of {} px that are shown. What lies beyond {} cycles/px folds into "
        "it</dd></dl>",
        study.quick ? ", which --quick leaves out" : "", kEdgeBand, study.per_px, study.part_px,
        study.per_px / 2.0);
}

}  // namespace

std::string filterStudyHtml(const FilterStudy& study, const std::vector<FigurePlot>& plots) {
    return fmt::format(
               "<!doctype html><html lang='en'><head><meta charset='utf-8'><meta name='viewport' "
               "content='width=device-width'><title>Filter study</title><link rel='icon' href='data:,'>"
               "<style>{}{}{}</style></head><body><main><h1>Filter study</h1><p>NSAA's Figure 6, continued: "
               "every "
               "filter, exactly evaluated, on the paper's patterns. edgewise {}, <code>edgewise figure "
               "filter-study{} -o DIR</code>; nothing random, no seed</p>\n",
               compare::kReportStyle, kPlotStyle, kStyle, escapedHtml(version()),
               study.quick ? " --quick" : "") +
           findings(study) + "<h2>Ranking</h2><div class='card scroll'>" + table(study) +
           "</div>\n<h2>Responses</h2>" + ticks(study) + plotsHtml(plots) +
           fmt::format(
               "<div class='bar' style='margin-top:28px'><label>screen pixels a pixel <select id='zoom'>"
               "<option>1</option><option selected>2</option><option>3</option><option>4</option><option>"
               "8</option></select></label><span class='scale'>below each picture what aliases in it: "
               "1e-5 <i style='background:{}'></i> 1, log</span></div>\n",
               compare::absoluteGradient()) +
           picturesHtml(study) + "<h2>Definitions</h2><div class='card'>" + definitions(study) +
           "</div></main>\n<script>" + compare::kSortScript + kScript + "</script></body></html>\n";
}

}  // namespace edgewise::figures
