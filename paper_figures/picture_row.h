// Pictures of a figure's page.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "paper_figures/figure.h"
#include "pipeline/image_buffer.h"

namespace edgewise::figures {

/// Pictures that are to be seen side by side.
struct PictureRow {
    std::string title, words;
    struct Picture {
        FigureFile file;  ///< PNG
        std::string caption;
        std::string preview = {};  ///< PNG that the page shows in the file's place, with a link to it
    };
    std::vector<Picture> pictures;
    bool linked = false;  ///< large ones: the page refers to their files and shows them smoothly
};

/// `times` smaller, by a Gaussian of 3/4 of a new pixel, linear: what the new pixels cannot hold is gone to a
/// few hundredths.
ImageBuffer shrunk(const ImageBuffer& image, int times);

/// The picture as NAME.png, each of its pixels `times` as large.
PictureRow::Picture pictureOf(const ImageBuffer& image, const std::string& name, const std::string& caption,
                              int times = 1);

/// A heading, words and <figure>s for each row; nothing for none. kPageStyle is theirs.
std::string pictureRowsHtml(std::span<const PictureRow> rows);

void appendPictureFiles(std::span<const PictureRow> rows, std::vector<FigureFile>& files);

}  // namespace edgewise::figures
