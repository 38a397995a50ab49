#include "paper_figures/picture_row.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>

#include "pipeline/compare/base64.h"
#include "pipeline/html_text.h"
#include "pipeline/write_image.h"

namespace edgewise::figures {
namespace {

std::string embedded(const std::string& png) {
    return "data:image/png;base64," +
           compare::base64({reinterpret_cast<const unsigned char*>(png.data()), png.size()});
}

std::string imageHtml(const PictureRow::Picture& picture, bool linked) {
    const std::string alt = escapedHtml(picture.caption), file = escapedHtml(picture.file.name);
    if (!linked && picture.preview.empty())
        return fmt::format("<img alt='{}' src='{}'>", alt, embedded(picture.file.bytes));
    return fmt::format("<a href='{}'><img alt='{}' src='{}' style='display:block;image-rendering:auto'></a>",
                       file, alt, picture.preview.empty() ? file : embedded(picture.preview));
}

std::string rowHtml(const PictureRow& row) {
    std::string out = fmt::format("<h3>{}</h3><p class='under'>{}</p><div class='pictures'>",
                                  escapedHtml(row.title), escapedHtml(row.words));
    for (const PictureRow::Picture& picture : row.pictures)
        out += fmt::format("<figure class='card'>{}<figcaption>{}</figcaption></figure>\n",
                           imageHtml(picture, row.linked), escapedHtml(picture.caption));
    return out + "</div>";
}

ImageBuffer enlarged(const ImageBuffer& image, int times) {
    ImageBuffer large({0, 0, image.box.width() * times, image.box.height() * times});
    for (int y = 0; y < large.box.y1; ++y)
        for (int x = 0; x < large.box.x1; ++x)
            large.rgba[large.index(x, y)] =
                image.rgba[image.index(image.box.x0 + x / times, image.box.y0 + y / times)];
    return large;
}

}  // namespace

ImageBuffer shrunk(const ImageBuffer& image, int times) {
    const double sigma = 0.75 * times;
    const int reach = static_cast<int>(std::ceil(3.0 * sigma));
    ImageBuffer small({0, 0, image.box.width() / times, image.box.height() / times});
    for (int y = 0; y < small.box.y1; ++y)
        for (int x = 0; x < small.box.x1; ++x) {
            const glm::dvec2 middle = double(times) * glm::dvec2(x + 0.5, y + 0.5) - 0.5;
            glm::dvec4 sum(0.0);
            double weights = 0.0;
            for (int j = std::max(0, int(middle.y) - reach);
                 j < std::min(image.box.height(), int(middle.y) + reach); ++j)
                for (int i = std::max(0, int(middle.x) - reach);
                     i < std::min(image.box.width(), int(middle.x) + reach); ++i) {
                    const glm::dvec2 way = glm::dvec2(i, j) - middle;
                    const double weight = std::exp(-0.5 * (way.x * way.x + way.y * way.y) / (sigma * sigma));
                    sum += weight * image.rgba[image.index(image.box.x0 + i, image.box.y0 + j)];
                    weights += weight;
                }
            small.rgba[small.index(x, y)] = sum / weights;
        }
    return small;
}

PictureRow::Picture pictureOf(const ImageBuffer& image, const std::string& name, const std::string& caption,
                              int times) {
    const ImageBuffer large = enlarged(image, times);
    WriteOptions options;
    options.width = large.box.width(), options.height = large.box.height();
    const std::vector<unsigned char> png = encodeImage(large, ImageFormat::kPng, options);
    return {{name + ".png", {png.begin(), png.end()}}, caption};
}

std::string pictureRowsHtml(std::span<const PictureRow> rows) {
    std::string out;
    for (const PictureRow& row : rows) out += rowHtml(row);
    return out.empty() ? out : "<h2>Pictures</h2>" + out;
}

void appendPictureFiles(std::span<const PictureRow> rows, std::vector<FigureFile>& files) {
    for (const PictureRow& row : rows)
        for (const PictureRow::Picture& picture : row.pictures) files.push_back(picture.file);
}

}  // namespace edgewise::figures
