#include "paper_figures/pattern_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "paper_figures/page_parts.h"
#include "pipeline/compare/comparison_tables.h"
#include "pipeline/error.h"
#include "pipeline/html_table.h"
#include "pipeline/html_text.h"
#include "pipeline/load_scene.h"
#include "pipeline/resolve_camera.h"
#include "pipeline/scene_catalog.h"

namespace edgewise::figures {
namespace {

constexpr const char* kPaperFilter = "gaussian";
constexpr double kPaperRadius = 2.0;

/// Of the methods inside: they are stopped, and say nothing of their own.
struct Inner : Progress {
    explicit Inner(Progress& outer_) : outer(outer_) {}
    bool cancelled() override { return outer.cancelled(); }
    Progress& outer;
};

std::string fileNameOf(const std::string& text) {
    std::string name = text;
    std::ranges::replace_if(
        name, [](char c) { return std::string(":,+= ").find(c) != std::string::npos; }, '_');
    return name;
}

std::string fileNameOf(const PatternMethod& method) {
    return fileNameOf(method.method + (method.filter.empty() ? "" : "_" + method.filter));
}

bool contains(const PixelBox& outer, const PixelBox& inner) {
    return inner.x0 >= outer.x0 && inner.y0 >= outer.y0 && inner.x1 <= outer.x1 && inner.y1 <= outer.y1;
}

ImageBuffer partOf(const ImageBuffer& image, const PixelBox& box) {
    ImageBuffer part(box);
    for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x) {
            part.rgba[part.index(x, y)] = image.rgba[image.index(x, y)];
            part.edge[part.index(x, y)] = image.edge[image.index(x, y)];
        }
    return part;
}

class Maker {
  public:
    Maker(const PatternPlan& plan, Progress& progress)
        : plan_(plan), progress_(progress), scene_(loadScene(findScene(plan.scene))) {
        CameraOptions options;
        options.size = {plan.width, plan.height};
        camera_ = resolveCamera(scene_, options, film_);
        film_.crop = plan.crop;
    }

    PatternRow made(const PatternMethod& method) {
        const Prefilter filter = filterOf(method);
        PatternRow row{method, filter.radius, image(method.method, filter), {}, {}};
        if (method.method != "nsaa" || filter.name != kPaperFilter || filter.radius != kPaperRadius)
            row.of_paper =
                judge::compareImages(row.image, reference(makePrefilter(kPaperFilter, kPaperRadius, {})));
        if (method.method != "nsaa") row.of_own = judge::compareImages(row.image, reference(filter));
        return row;
    }

  private:
    static Prefilter filterOf(const PatternMethod& method) {
        return method.filter.empty() ? makePrefilter("box", {}, {})
                                     : makePrefilter(method.filter, method.radius, {});
    }

    ImageBuffer image(const std::string& method, const Prefilter& filter) {
        if (progress_.cancelled()) throw Interrupted();
        Inner inner(progress_);
        RenderOptions options;
        options.device = DeviceChoice::kCpu;
        return runMethod(parseMethod(method), {scene_, camera_, film_, filter, options, inner}).image;
    }

    const ImageBuffer& reference(const Prefilter& filter) {
        const std::string key = fmt::format("{} {}", filter.name, filter.radius);
        const auto found = references_.find(key);
        return found != references_.end() ? found->second
                                          : references_.emplace(key, image("nsaa", filter)).first->second;
    }

    const PatternPlan& plan_;
    Progress& progress_;
    Scene scene_;
    Film film_;
    ResolvedCamera camera_;
    std::map<std::string, ImageBuffer> references_;
};

constexpr int kShrunk = 4, kLarge = 512;  ///< px: what is wider is shown smaller

PictureRow wholes(const PatternPlan& plan, const std::vector<PatternRow>& rows) {
    const bool large = plan.crop.width() >= kLarge;
    PictureRow out{
        fmt::format("{}, {}x{}", plan.scene, plan.crop.width(), plan.crop.height()),
        large ? fmt::format(
                    "Shown {} times smaller, by a Gaussian in linear light that turns fine rings and cells "
                    "into "
                    "grey: rings that are left in them are what aliased. Follow a picture to its own pixels.",
                    kShrunk)
              : "A part of the picture.",
        {},
        true};
    for (const PatternRow& row : rows) {
        out.pictures.push_back(
            pictureOf(row.image, plan.scene + "_" + fileNameOf(row.method), row.method.caption));
        if (large) out.pictures.back().preview = pictureOf(shrunk(row.image, kShrunk), "", "").file.bytes;
    }
    return out;
}

PictureRow enlarged(const PatternPlan& plan, const PatternPart& part, const std::vector<PatternRow>& rows) {
    PictureRow out{part.words,
                   fmt::format("Pixels {} to {} across and {} to {} down, {} times as large.", part.box.x0,
                               part.box.x1, part.box.y0, part.box.y1, plan.enlarged),
                   {}};
    for (const PatternRow& row : rows)
        out.pictures.push_back(pictureOf(partOf(row.image, part.box),
                                         plan.scene + "_" + part.name + "_" + fileNameOf(row.method),
                                         row.method.caption, plan.enlarged));
    return out;
}

std::string errorCells(const std::optional<judge::ErrorMetrics>& error) {
    if (!error) return sortedCell(0.0, "0") + emptyCell() + emptyCell();
    return numberCell(error->rmse, "{:.5f}") + numberCell(error->psnr, "{:.2f}") +
           numberCell(error->flip, "{:.4f}");
}

}  // namespace

const PatternRow& PatternPictures::row(const std::string& method, const std::string& filter) const {
    return *std::ranges::find_if(
        rows, [&](const PatternRow& r) { return r.method.method == method && r.method.filter == filter; });
}

PatternPictures makePatternPictures(const PatternPlan& plan, Progress& progress) {
    PatternPictures found{plan, {}, {}};
    progress.stage(plan.scene, plan.methods.size());
    Maker maker(plan, progress);
    for (const PatternMethod& method : plan.methods) {
        found.rows.push_back(maker.made(method));
        progress.advance(1);
    }
    found.pictures.push_back(wholes(plan, found.rows));
    for (const PatternPart& part : plan.parts)
        if (contains(plan.crop, part.box)) found.pictures.push_back(enlarged(plan, part, found.rows));
    return found;
}

std::string patternTable(const PatternPictures& found) {
    std::string rows;
    for (const PatternRow& row : found.rows)
        rows += fmt::format("<tr><td>{}</td><td>{}, R {:g}</td>", escapedHtml(row.method.method),
                            row.method.filter.empty() ? "box" : escapedHtml(row.method.filter), row.radius) +
                errorCells(row.of_paper) + errorCells(row.of_own) + "</tr>\n";
    return cardTable(
        "<th>method</th><th>filter</th><th>RMSE against nsaa, Gaussian R 2</th><th>PSNR, "
        "dB</th><th>FLIP</th><th>RMSE against nsaa, own filter</th><th>PSNR, dB</th><th>FLIP</th>",
        rows);
}

std::string patternCsv(const PatternPictures& found) {
    std::string out =
        "scene,method,filter,radius,rmse_gaussian,psnr_gaussian,flip_gaussian,rmse_own,psnr_own,flip_own\n";
    const auto fields = [](const std::optional<judge::ErrorMetrics>& error) {
        if (!error) return std::string(",0,,");
        return fmt::format(",{},{},{}", error->rmse, error->psnr ? fmt::format("{}", *error->psnr) : "",
                           error->flip);
    };
    for (const PatternRow& row : found.rows)
        out +=
            fmt::format("{},{},{},{}", found.plan.scene, compare::csvText(row.method.method),
                        compare::csvText(row.method.filter.empty() ? "box" : row.method.filter), row.radius) +
            fields(row.of_paper) + fields(row.of_own) + "\n";
    return out;
}

std::string commandOf(const PatternPlan& plan, const PatternMethod& method) {
    return fmt::format("edgewise render {} --size {}x{} --device cpu --method {}{}{} -o image.png",
                       plan.scene, plan.width, plan.height, method.method,
                       method.filter.empty() ? "" : " --filter " + method.filter,
                       method.radius ? fmt::format(" --radius {:g}", *method.radius) : "");
}

}  // namespace edgewise::figures
