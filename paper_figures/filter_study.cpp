// NSAA's Figure 6 compares three filters of radius 2 by eye. Here all filters are compared, by eye and
// number.
#include "paper_figures/filter_study.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "paper_figures/aliased_part.h"
#include "paper_figures/slanted_edge.h"
#include "pipeline/compare/error_map.h"
#include "pipeline/error.h"
#include "pipeline/load_scene.h"
#include "pipeline/resolve_camera.h"
#include "pipeline/scene_catalog.h"
#include "pipeline/write_image.h"

namespace edgewise::figures {
namespace {

constexpr double kPaperRadius = 2.0;

/// The last one stands in for the polynomials of the paper's conclusion, whose coefficients are not
/// published: (1 - r^2/R^2)^3 has nearly the second moment of the Gaussian with sigma = R/3, R^2/10 against
/// R^2/9.48.
constexpr std::array kPaperFilters{
    "box",     "disk",     "tent",        "cone",        "gaussian", "gaussian-separable",
    "bspline", "mitchell", "catmull-rom", "bc:0.5,0.25", "lanczos",  "poly:1,-3,3,-1"};
/// Whose default radius is another.
constexpr std::array kOwnRadius{"box", "disk", "tent", "cone", "lanczos"};

/// What the paper puts beside its filters.
constexpr const char* kBeside = "csaa:32";

/// Near the axis and near the diagonal, 1/256 and 1/180 px apart.
constexpr int kAxisEdge[]{256, 1}, kDiagonalEdge[]{128, 127};

struct PatternPlace {
    const char* name;
    int width, height;  ///< of the whole picture, px
    int x, y;           ///< the middle of the part that is shown
};
/// The zone plate's rim half-way between axis and diagonal, the finest cells of the log grid, the far end of
/// the tori.
constexpr PatternPlace kPlaces[]{{"zone-plate", 1024, 1024, 870, 280},
                                 {"log-grid", 1024, 1024, 912, 912},
                                 {"torus-sequence", 1024, 512, 700, 230}};

struct Effort {
    int per_px, part_px, margin_px;
    bool own_radii;
};
constexpr Effort kFull{4, 128, 32, true}, kQuick{2, 64, 16, false};

/// Of the methods inside: they are stopped, and say nothing of their own.
struct Inner : Progress {
    explicit Inner(Progress& outer_) : outer(outer_) {}
    bool cancelled() override { return outer.cancelled(); }
    Progress& outer;
};

std::vector<FilterRow> rowsFor(const Effort& effort) {
    std::vector<FilterRow> rows;
    for (const char* name : kPaperFilters) {
        rows.emplace_back();
        rows.back().filter = makePrefilter(name, kPaperRadius, {});
        rows.back().paper_radius = true;
    }
    for (const char* name : kOwnRadius) {
        if (!effort.own_radii) break;
        rows.emplace_back();
        rows.back().filter = makePrefilter(name, {}, {});
    }
    return rows;
}

AlongDirection alongDirection(const FilterProperties& properties, const int (&edge)[2], Progress& progress) {
    const SlantedEdge measured = measureEdge(properties.filter(), edge[0], edge[1], progress);
    AlongDirection along;
    along.angle = measured.angle;
    along.edge = edgeEnergy(properties, along.angle);
    along.overshoot = properties.overshoot(along.angle);
    along.width_px = properties.edgeWidth(along.angle);
    along.half_response = properties.halfResponse(along.angle);
    along.at_nyquist = properties.transform(kNyquist, along.angle);
    for (std::size_t k = 0; k < measured.value.size(); ++k)
        along.step_residual = std::max(
            along.step_residual,
            std::abs(measured.value[k] - properties.stepResponse(measured.distance[k], along.angle)));
    const double variation = properties.variation(along.angle);
    for (int i = 0; i <= kShownSteps; ++i) {
        const double f = kShownFrequency * i / kShownSteps;
        along.response.push_back(properties.transform(f, along.angle));
        along.measured.push_back(measuredResponse(measured, f));
        const double residual = std::abs(along.measured.back() - along.response.back());
        along.response_residual = std::max(along.response_residual, residual);
        along.residual_of_bound =
            std::max(along.residual_of_bound, residual / responseBound(measured, variation, f));
        along.step.push_back(properties.stepResponse(kShownReach * (2.0 * i / kShownSteps - 1), along.angle));
    }
    return along;
}

void analyse(FilterRow& row, Progress& progress) {
    const FilterProperties properties(row.filter);
    row.axis = alongDirection(properties, kAxisEdge, progress);
    row.diagonal = alongDirection(properties, kDiagonalEdge, progress);
    row.mean_edge = meanEdgeEnergy(properties);
    row.negative_area = properties.negativeArea();
    row.second_moment_px2 = properties.secondMoment();
    for (int i = 0; i <= 100; ++i) {
        const double f = kNyquist * i / 100;
        row.anisotropy = std::max(
            row.anisotropy, std::abs(properties.transform(f, 0.0) - properties.transform(f, 0.25 * M_PI)));
    }
}

PatternView viewOf(const PatternPlace& place, const Effort& effort) {
    PatternView view;
    view.name = place.name;
    view.margin_px = effort.margin_px;
    view.scene = loadScene(findScene(place.name));
    CameraOptions options;
    options.size = {place.width, place.height};
    view.camera = resolveCamera(view.scene, options, view.film);
    const int half = effort.part_px / 2 + effort.margin_px;
    view.film.crop = {place.x - half, place.y - half, place.x + half, place.y + half};
    return view;
}

std::vector<unsigned char> pngOf(const ImageBuffer& image) {
    WriteOptions options;
    options.width = image.box.width(), options.height = image.box.height();
    return encodeImage(image, ImageFormat::kPng, options);
}

std::string fileNameOf(std::string name) {
    std::ranges::replace_if(
        name,
        [](char c) {
            return !(c >= '0' && c <= '9') && !(c >= 'a' && c <= 'z') && !(c >= 'A' && c <= 'Z') &&
                   c != '.' && c != '-';
        },
        '_');
    return name;
}

/// The map of what aliases is that of the picture against the picture without it.
StudyPicture pictureOf(const std::string& pattern, const Prefilter& filter, const AliasedPart& part) {
    ImageBuffer without = part.picture;
    for (std::size_t i = 0; i < without.rgba.size(); ++i) without.rgba[i] -= part.aliased.rgba[i];
    const std::string stem = fileNameOf(fmt::format("{}_{}_R{:g}", pattern, filter.name, filter.radius));
    return {pattern,
            filter.name,
            stem + ".png",
            stem + "_aliased.png",
            pngOf(part.picture),
            compare::absoluteErrorMap(part.picture, without),
            part.rms};
}

StudyPicture pictureBeside(const PatternView& view, Progress& progress) {
    Film film = view.film;
    const int m = view.margin_px;
    film.crop = {film.crop.x0 + m, film.crop.y0 + m, film.crop.x1 - m, film.crop.y1 - m};
    RenderOptions options;
    options.device = DeviceChoice::kCpu;
    const Prefilter box = makePrefilter("box", {}, {});
    const MethodResult made =
        runMethod(parseMethod(kBeside), {view.scene, view.camera, film, box, options, progress});
    return {view.name, kBeside, fileNameOf(view.name + "_" + kBeside) + ".png", "", pngOf(made.image),
            {},        {}};
}

void throwIfCancelled(Progress& progress) {
    if (progress.cancelled()) throw Interrupted();
}

/// Filters side by side: a part of a picture alone keeps few threads busy.
void studyPattern(FilterStudy& out, const PatternView& view, Progress& progress) {
    Inner inner(progress);
    out.patterns.push_back(view.name);
    const std::size_t shifts = static_cast<std::size_t>(out.per_px) * out.per_px;
    progress.stage(view.name, out.rows.size() * shifts);
    std::vector<std::optional<StudyPicture>> pictures(out.rows.size());
    tbb::parallel_for(std::size_t(0), out.rows.size(), [&](std::size_t i) {
        FilterRow& row = out.rows[i];
        const auto advance = [&] {
            throwIfCancelled(progress);
            progress.advance(1);
        };
        const FinePicture fine = renderFinely(view, row.filter, out.per_px, inner, advance);
        const AliasedPart part = aliasedPart(fine, view.margin_px);
        row.patterns.push_back({part.rms, part.share});
        if (row.paper_radius) pictures[i] = pictureOf(view.name, row.filter, part);
    });
    for (std::optional<StudyPicture>& picture : pictures)
        if (picture) out.pictures.push_back(std::move(*picture));
    out.pictures.push_back(pictureBeside(view, inner));
}

FilterStudy study(const Effort& effort, Progress& progress) {
    FilterStudy out;
    out.per_px = effort.per_px, out.part_px = effort.part_px;
    out.rows = rowsFor(effort);
    Inner inner(progress);
    progress.stage("filters", out.rows.size());
    tbb::parallel_for(std::size_t(0), out.rows.size(), [&](std::size_t i) {
        throwIfCancelled(progress);
        analyse(out.rows[i], inner);
        progress.advance(1);
    });
    for (const PatternPlace& place : kPlaces) studyPattern(out, viewOf(place, effort), progress);
    return out;
}

std::string bytesOf(const std::vector<unsigned char>& bytes) {
    return {bytes.begin(), bytes.end()};
}

}  // namespace

std::string titleOf(const Prefilter& filter) {
    return fmt::format("{}, R {:g}", filter.name, filter.radius);
}

std::vector<FigureFile> makeFilterStudy(const FigureInput& input) {
    FilterStudy found = study(input.quick ? kQuick : kFull, input.progress);
    found.quick = input.quick;
    const auto plots = filterFigurePlots(found);
    std::vector<FigureFile> files{{"report.html", filterStudyHtml(found, plots)},
                                  {"results.json", filterStudyJson(found)},
                                  {"results.csv", filterStudyCsv(found)},
                                  {"response.csv", responseCsv(found)},
                                  {"step.csv", stepCsv(found)},
                                  {"table.tex", filterStudyLatex(found)}};
    appendPlotFiles(plots, files);
    for (const StudyPicture& picture : found.pictures) {
        files.push_back({picture.file, bytesOf(picture.png)});
        if (!picture.aliased_file.empty())
            files.push_back({picture.aliased_file, bytesOf(picture.aliased_png)});
    }
    return files;
}

}  // namespace edgewise::figures
