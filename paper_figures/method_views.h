// One SDF scene by several methods, and its parts enlarged side by side.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "paper_figures/cone_view.h"
#include "paper_figures/drawing.h"
#include "pipeline/judge/kind_errors.h"

namespace edgewise::figures {

/// A scene by methods, with what its pixels show.
struct MethodViews {
    struct Made {
        ImageBuffer image;
        double seconds = 0.0;  ///< without set-up
    };
    ConeView view;
    std::string name;
    std::vector<judge::EdgeKind> kinds;
    std::map<std::string, Made> made;

    /// With "reference", of reference_side^2 samples a pixel; kinds of edges by a lattice of facts_side^2.
    MethodViews(const std::string& scene, int width, int height, int reference_side, int facts_side,
                Progress& progress);
    void make(const std::string& method, Progress& progress);
    const ImageBuffer& of(const std::string& method) const { return made.at(method).image; }
    judge::KindErrors errorsOf(const std::string& method) const;
    std::size_t pixelsOf(judge::EdgeKind kind) const;
};

ImageBuffer partOf(const ImageBuffer& image, const PixelBox& box);
/// |a - b|, so many times as bright.
ImageBuffer difference(const ImageBuffer& a, const ImageBuffer& b, double gain);

/// A picture with a frame and words below it.
struct Panel {
    glm::dvec2 corner, size;
    void draw(const ImageBuffer& image, const std::string& words, const std::string& frame,
              Drawing& drawing) const;
};

/// Parts beside and below each other.
struct PanelGrid {
    double left = 0.0, top = 0.0, width = 168, height = 168.0 * 28 / 40;  ///< of a panel
    static constexpr double kGap = 10, kWords = 22;
    Panel at(int column, int row) const {
        return {{left + column * (width + kGap), top + row * (height + kWords)}, {width, height}};
    }
};

/// The whole picture, with a frame around each part.
void drawWhole(const MethodViews& views, const std::string& method, const Panel& panel,
               const std::vector<std::pair<PixelBox, const char*>>& parts, Drawing& drawing);

}  // namespace edgewise::figures
