#include "paper_figures/cone_tracing_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "paper_figures/method_views.h"

namespace edgewise::figures {
namespace {

constexpr int kEnlarged = 8;
constexpr int kPartWidth = 40, kPartHeight = 28;

/// As a part of a file's name.
std::string fileName(std::string method) {
    for (char& c : method)
        if (c == ':' || c == ',' || c == '=' || c == '+') c = '_';
    return method;
}

/// Where a picture has most pixels of these kinds, the rarer kind counting more.
PixelBox busiestPart(const std::vector<EdgeKind>& kinds, const Film& film) {
    std::map<EdgeKind, double> weight;
    for (const EdgeKind kind : kinds) ++weight[kind];
    PixelBox best{0, 0, kPartWidth, kPartHeight};
    double most = -1.0;
    for (int y = 0; y + kPartHeight <= film.height; y += 4)
        for (int x = 0; x + kPartWidth <= film.width; x += 4) {
            std::map<EdgeKind, double> met;
            for (int j = y; j < y + kPartHeight; ++j)
                for (int i = x; i < x + kPartWidth; ++i)
                    ++met[kinds[static_cast<std::size_t>(j * film.width + i)]];
            double score = 0.0;
            for (const EdgeKind kind : kEdgeKinds)
                if (met[kind] > 0.0)
                    score += std::min(met[kind] / weight[kind], 0.1) + std::min(met[kind], 40.0) / 400.0;
            if (score > most) most = score, best = {x, y, x + kPartWidth, y + kPartHeight};
        }
    return best;
}

/// Figure 5: a surface against nothing.
PictureRow weights(const ConeTracingEffort& effort, Progress& progress) {
    PictureRow row{"Weights (Figure 5)",
                   "An outline against the background: uniform weights extrude it, visibility's smooth it; "
                   "with cones of five pixels it is clearer still. Pixels are 8 times as large.",
                   {}};
    ConeView view("primitives", effort.picture_size.x, effort.picture_size.y);
    const std::vector<EdgeKind> kinds = judge::edgeKindsOf(view.input(progress), 4);
    std::vector<EdgeKind> contours = kinds;
    for (EdgeKind& kind : contours)
        if (kind != EdgeKind::kContour) kind = EdgeKind::kNone;
    view.film.crop = busiestPart(contours, view.film);
    for (const auto& [method, words] : {std::pair("none", "(a) none"),
                                        {"ctss:weights=uniform", "(b) uniform, 1 pixel"},
                                        {"ctss", "(c) weighted, 1 pixel"},
                                        {"ctss:weights=uniform,coverage=5", "(d) uniform, 5 pixels"},
                                        {"ctss:coverage=5", "(e) weighted, 5 pixels"}})
        row.pictures.push_back(
            pictureOf(view.made(method, progress).image, "weights_" + fileName(method), words, kEnlarged));
    return row;
}

/// Figure 9.
PictureRow affected(const std::string& scene, const ConeTracingEffort& effort, Progress& progress) {
    PictureRow row{fmt::format("Affected pixels (Figure 9), {}", scene),
                   "White: of more than one colour. ctss also mends edges whose ray meets the near surface; "
                   "ctss-r only those beside it; ctss-x also creases, textures' and shadows' borders.",
                   {}};
    const ConeView view(scene, effort.picture_size.x, effort.picture_size.y);
    row.pictures.push_back(pictureOf(view.made("none", progress).image, "affected_" + scene, "the picture"));
    for (const char* method : {"ctss", "ctss-r", "ctss-x"}) {
        ImageBuffer image = view.made(method, progress).image;
        std::size_t count = 0;
        for (std::size_t i = 0; i < image.rgba.size(); ++i) {
            image.rgba[i] = glm::dvec4(glm::dvec3(image.edge[i]), 1.0);
            count += image.edge[i] == 1.0f;
        }
        row.pictures.push_back(pictureOf(
            image, "affected_" + scene + "_" + fileName(method),
            fmt::format("{}: {:.2f} % of all pixels", method,
                        100.0 * static_cast<double>(count) / static_cast<double>(image.rgba.size()))));
    }
    return row;
}

/// Figure 8: the part with most edges, 8 times as large.
PictureRow edges(const std::string& scene, const ConeTracingEffort& effort, Progress& progress) {
    PictureRow row{fmt::format("At edges, {}", scene), "Pixels are 8 times as large.", {}};
    ConeView view(scene, effort.picture_size.x, effort.picture_size.y);
    const std::vector<EdgeKind> kinds = judge::edgeKindsOf(view.input(progress), 4);
    const PixelBox whole = view.film.crop;
    view.film.crop = busiestPart(kinds, view.film);
    for (const std::string& method :
         {std::string("none"), std::string("ctss-r"), std::string("ctss"), std::string("ssaa:2"),
          std::string("ctss+ssaa:2"), std::string("ssaa:3"), std::string("ctss-x")})
        row.pictures.push_back(pictureOf(view.made(method, progress).image,
                                         "edges_" + scene + "_" + fileName(method), method, kEnlarged));
    row.pictures.push_back(pictureOf(view.made(fmt::format("ssaa:{}", effort.reference_side), progress).image,
                                     "edges_" + scene + "_reference", "reference", kEnlarged));
    row.pictures.push_back(
        pictureOf(partOf(judge::edgeKindPicture(kinds, whole), view.film.crop), "edges_" + scene + "_kinds",
                  "kinds of edges: red contours, blue internal, green textures, yellow shadows, violet "
                  "reflections",
                  kEnlarged));
    return row;
}

}  // namespace

std::vector<PictureRow> coneTracingPictures(const ConeTracingEffort& effort, Progress& progress) {
    std::vector<PictureRow> rows{weights(effort, progress)};
    for (const std::string& scene : effort.scenes)
        if (scene == "primitives" || scene == "atrium") rows.push_back(affected(scene, effort, progress));
    for (const std::string& scene : effort.scenes) rows.push_back(edges(scene, effort, progress));
    return rows;
}

}  // namespace edgewise::figures
