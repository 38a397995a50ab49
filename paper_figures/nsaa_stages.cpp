// NSAA, Figure 2: the pipeline, with what its stages hand over.
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>

#include "paper_figures/drawing.h"
#include "paper_figures/figure_plot.h"
#include "paper_figures/page_parts.h"
#include "paper_figures/picture_row.h"
#include "pipeline/load_scene.h"
#include "pipeline/methods/method.h"
#include "pipeline/project.h"
#include "pipeline/read_file.h"
#include "pipeline/resolve_camera.h"
#include "pipeline/scene_catalog.h"
#include "pipeline/scoped_path.h"

namespace edgewise::figures {
namespace {

constexpr const char* kScene = "torus-sequence";
/// The rim of the nearest torus's hole, so large that triangles can be told apart.
constexpr int kFilmWidth = 4096, kFilmHeight = 2048;
constexpr PixelBox kCrop{270, 1150, 526, 1278};
constexpr const char* kGather = "#3a7d44";
constexpr const char* kWeigh = "#b3261e";
constexpr const char* kBlend = "#1b6ca8";

/// A column of a CSV file with a header, as numbers; what is none is -1.
std::vector<double> column(const std::string& csv, int index) {
    std::vector<double> values;
    std::istringstream rows(csv);
    std::string row;
    std::getline(rows, row);
    while (std::getline(rows, row)) {
        std::size_t begin = 0;
        for (int i = 0; i < index; ++i) begin = row.find(',', begin) + 1;
        try {
            values.push_back(std::stod(row.substr(begin)));
        } catch (const std::invalid_argument&) {
            values.push_back(-1.0);
        }
    }
    return values;
}

/// A linear buffer's entries, row by row, as many as there are pixels.
template <class Color>
std::string bufferPng(const std::string& name, std::size_t entries, const Color& color) {
    ImageBuffer image(kCrop);
    for (std::size_t i = 0; i < image.rgba.size(); ++i)
        image.rgba[i] = glm::dvec4(i < entries ? color(i) : glm::dvec3(0.0), 1.0);
    return pictureOf(image, name, "").file.bytes;
}

glm::dvec3 colorOfId(double id) {
    if (id < 0.0) return glm::dvec3(0.02);
    const std::uint64_t h = (static_cast<std::uint64_t>(id) + 1) * 0x9e3779b97f4a7c15ull;
    return glm::dvec3((h >> 56) & 0xff, (h >> 48) & 0xff, (h >> 40) & 0xff) / 255.0;
}

/// Edges of all triangles that face the eye, hidden or not.
std::string edgesPng(const ScreenScene& screen) {
    ImageBuffer image(kCrop);
    for (glm::dvec4& p : image.rgba) p = glm::dvec4(0.0, 0.0, 0.0, 1.0);
    for (const ScreenTriangle& t : screen.triangles)
        for (int i = 0; i < 3; ++i) {
            const glm::dvec2 a = t.p_px[i], d = t.p_px[(i + 1) % 3] - a;
            const int steps = 2 + static_cast<int>(2 * glm::length(d));
            for (int k = 0; k <= steps; ++k) {
                const glm::ivec2 p(glm::floor(a + d * (double(k) / steps)));
                if (image.box.contains(p.x, p.y))
                    image.rgba[image.index(p.x, p.y)] += glm::dvec4(glm::dvec3(0.35), 0.0);
            }
        }
    return pictureOf(image, "triangles", "").file.bytes;
}

struct StagePanel {
    int column, row;
    const char* color;
    std::string stage, caption, name, png;
};

struct Pipeline {
    std::vector<StagePanel> panels;
    std::size_t triangles = 0, screen = 0, ids = 0, segments = 0, pairs = 0;
};

Pipeline pipelineOf(Progress& progress) {
    const Scene scene = loadScene(findScene(kScene));
    Film film;
    CameraOptions options;
    options.size = {kFilmWidth, kFilmHeight};
    const ResolvedCamera camera = resolveCamera(scene, options, film);
    film.crop = kCrop;
    const ScopedPath folder = temporaryFolder();
    RenderOptions making;
    making.device = DeviceChoice::kCpu, making.dump_dir = folder.path();
    const Prefilter filter = makePrefilter("gaussian", {}, {});
    const MethodResult made = runMethod(parseMethod("nsaa"), {scene, camera, film, filter, making, progress});
    const auto file = [&](const char* name) { return readText(folder.path() / name); };

    Pipeline out;
    const ScreenScene screen = project(scene, camera, film);
    const std::string gather = file("gather.csv"), weights = file("weights.csv");
    const std::vector<double> counts = column(gather, 2), offsets = column(gather, 3);
    const std::vector<double> xs = column(gather, 0), ys = column(gather, 1);
    const std::vector<double> owners = column(weights, 2), shares = column(weights, 3);
    out.triangles = scene.triangle_count, out.screen = screen.triangles.size();
    out.segments = column(file("segments.csv"), 0).size(), out.pairs = owners.size();
    for (const double count : counts) out.ids += static_cast<std::size_t>(count);

    ImageBuffer offset_picture(kCrop);
    for (std::size_t i = 0; i < offsets.size(); ++i)
        for (int y = int(ys[i]); y < int(ys[i]) + 16; ++y)
            for (int x = int(xs[i]); x < int(xs[i]) + 16; ++x)
                if (offset_picture.box.contains(x, y))
                    offset_picture.rgba[offset_picture.index(x, y)] =
                        glm::dvec4(glm::dvec3(offsets[i] / double(out.ids)), 1.0);
    const std::string image = pictureOf(made.image, "image", "").file.bytes;
    out.panels = {
        {0, 0, "#555", "scene", fmt::format("{} of {} triangles face the eye", out.screen, out.triangles),
         "triangles", edgesPng(screen)},
        {1, 0, kGather, "1. histogram", "lengths of the lists of cells of 16 px", "histogram",
         file("gather.png")},
        {2, 0, kGather, "scan", "list offsets: darker is earlier", "offsets",
         pictureOf(offset_picture, "offsets", "").file.bytes},
        {3, 0, kGather, "2. fill", fmt::format("ids: a colour an owner, {} entries", out.pairs), "ids",
         bufferPng("ids", owners.size(), [&](std::size_t i) { return colorOfId(owners[i]); })},
        {1, 1, kWeigh, "analytic visibility",
         fmt::format("{} visible segments over the owners", out.segments), "segments", file("segments.png")},
        {2, 1, kWeigh, "prefilter", "owners a pixel", "owners", file("weights.png")},
        {3, 1, kWeigh, "weight buffer", "weights: white is 1", "weights",
         bufferPng("weights", shares.size(),
                   [&](std::size_t i) { return glm::dvec3(std::max(shares[i], 0.0)); })},
        {2, 2, kBlend, "shade, blend", "sum of weight times colour", "image", image}};
    return out;
}

constexpr double kPanelWidth = 216, kPanelHeight = 108, kStepX = 244, kStepY = 186;

glm::dvec2 cornerOf(const StagePanel& panel) {
    return {14 + kStepX * panel.column, 46 + kStepY * panel.row};
}

std::string drawn(const Pipeline& pipeline) {
    Drawing drawing(14 + 4 * kStepX, 46 + 3 * kStepY - 30, "The stages of nsaa and what they hand over");
    for (int row = 0; row < 3; ++row) {
        const char* names[]{"Primitive gathering (3.1)", "Weight computation (3.2)", "Final blending (3.3)"};
        const char* colors[]{kGather, kWeigh, kBlend};
        drawing.rectangle({kStepX + 4, 6 + kStepY * row}, {3 * kStepX - 4, kStepY - 8},
                          fmt::format("fill='{0}' fill-opacity='0.07' stroke='{0}' rx='6'", colors[row]));
        drawing.text({kStepX + 14, 22 + kStepY * row}, names[row],
                     fmt::format("font-weight='bold' fill='{}'", colors[row]));
    }
    for (const StagePanel& panel : pipeline.panels) {
        const glm::dvec2 corner = cornerOf(panel), size(kPanelWidth, kPanelHeight);
        drawing.text(corner + glm::dvec2(0, -7), panel.stage,
                     fmt::format("font-weight='bold' fill='{}'", panel.color));
        drawing.picture(corner, size, panel.png);
        drawing.rectangle(corner, size,
                          fmt::format("fill='none' stroke='{}' stroke-width='1.5'", panel.color));
        drawing.text(corner + glm::dvec2(0, kPanelHeight + 14), panel.caption, "font-size='11'");
    }
    const auto right = [&](int column, int row, const char* color) {
        const glm::dvec2 at(14 + kStepX * column + kPanelWidth + 4, 46 + kStepY * row + 0.5 * kPanelHeight);
        drawing.arrow(at, at + glm::dvec2(kStepX - kPanelWidth - 8, 0), color);
    };
    for (int column = 0; column < 3; ++column) right(column, 0, kGather);
    right(1, 1, kWeigh), right(2, 1, kWeigh);
    // The scene goes into visibility too, and the ids into the weights.
    drawing.line({14 + 0.5 * kPanelWidth, 46 + kPanelHeight + 22},
                 {14 + 0.5 * kPanelWidth, 46 + kStepY + 0.5 * kPanelHeight},
                 fmt::format("stroke='{}' stroke-width='1.5'", kWeigh));
    drawing.arrow({14 + 0.5 * kPanelWidth, 46 + kStepY + 0.5 * kPanelHeight},
                  {14 + kStepX - 4, 46 + kStepY + 0.5 * kPanelHeight}, kWeigh);
    const double ids_x = 14 + 3 * kStepX + 0.8 * kPanelWidth;
    drawing.arrow({ids_x, 46 + kPanelHeight + 18}, {ids_x, 46 + kStepY - 6}, "#777");
    const glm::dvec2 under(14 + 3 * kStepX + 0.5 * kPanelWidth, 46 + 2 * kStepY + 0.5 * kPanelHeight);
    drawing.line({under.x, 46 + kStepY + kPanelHeight + 22}, under,
                 fmt::format("stroke='{}' stroke-width='1.5'", kBlend));
    drawing.arrow(under, {14 + 2 * kStepX + kPanelWidth + 4, under.y}, kBlend);
    return drawing.svg();
}

}  // namespace

std::vector<FigureFile> makeNsaaStages(const FigureInput& input) {
    const Pipeline pipeline = pipelineOf(input.progress);
    const std::vector<FigurePlot> plots{{"pipeline",
                                         "Green: gathering. Red: weights. Blue: blending. Pictures are the "
                                         "buffers themselves; linear buffers are "
                                         "laid out row by row, their first 32,768 entries.",
                                         drawn(pipeline)}};
    FigureWords words{
        "nsaa-2",
        "The pipeline and its buffers",
        "After NSAA's Figure 2, with what the stages hand over for one real picture (`--dump-stages`). The "
        "paper "
        "gathers a list a sample, and visibility, made once a frame, does not use it. Here the lists are of "
        "cells of visibility, 16 px wide, and visibility is swept in them; weights are gathered from the "
        "visible "
        "segments, so the ids of the weighed buffer are those of visible owners alone. The paper's "
        "visibility "
        "gives each primitive its own closed boundary; here a segment lies between two owners.",
        {{"scene", kScene},
         {"size", fmt::format("{}x{}, of which pixels {} to {} across and {} to {} down", kFilmWidth,
                              kFilmHeight, kCrop.x0, kCrop.x1, kCrop.y0, kCrop.y1)},
         {"filter", "gaussian, R 2, sigma R/3"},
         {"device", "cpu"},
         {"seed", "none"}},
        {fmt::format(
            "edgewise render {} --size {}x{} --crop {},{},{},{} --device cpu --dump-stages stages -o "
            "image.png",
            kScene, kFilmWidth, kFilmHeight, kCrop.x0, kCrop.y0, kCrop.x1, kCrop.y1)},
        input.quick};
    const std::string csv = fmt::format(
        "buffer,entries\ntriangles,{}\nscreen_triangles,{}\ncell_ids,{}\nvisible_segments,{}\nweights,{}\n",
        pipeline.triangles, pipeline.screen, pipeline.ids, pipeline.segments, pipeline.pairs);
    std::vector<FigureFile> files{{"report.html", figurePage(words, plotsHtml(plots))}, {"results.csv", csv}};
    appendPlotFiles(plots, files);
    for (const StagePanel& panel : pipeline.panels) files.push_back({panel.name + ".png", panel.png});
    return files;
}

}  // namespace edgewise::figures
