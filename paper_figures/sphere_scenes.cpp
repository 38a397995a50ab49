// Enhanced sphere tracing, Figures 1, 10 and 11: scenes of those kinds, as they look.
#include <fmt/format.h>

#include "paper_figures/cone_view.h"
#include "paper_figures/page_parts.h"
#include "paper_figures/picture_row.h"
#include "pipeline/error.h"
#include "pipeline/methods/stopwatch.h"

namespace edgewise::figures {
namespace {

constexpr int kEnlarged = 4;

struct ScenePicture {
    const char *scene, *method, *name, *words;
};

class Maker {
  public:
    Maker(const FigureInput& input) : input_(input) {}

    PictureRow::Picture whole(const ScenePicture& picture) {
        return pictureOf(made(picture, {}), picture.name, picture.words);
    }
    PictureRow::Picture part(const ScenePicture& picture, const PixelBox& box) {
        return pictureOf(made(picture, box), picture.name, picture.words, kEnlarged);
    }
    int width() const { return input_.quick ? 160 : 1280; }
    int height() const { return input_.quick ? 90 : 720; }
    const std::vector<std::string>& commands() const { return commands_; }
    const std::string& csv() const { return csv_; }

  private:
    ImageBuffer made(const ScenePicture& picture, const std::optional<PixelBox>& box) {
        if (input_.progress.cancelled()) throw Interrupted();
        ConeView view(picture.scene, width(), height());
        if (box) view.film.crop = *box;
        commands_.push_back(fmt::format("edgewise render {} --size {}x{} --method {} -o {}.png",
                                        picture.scene, width(), height(), picture.method, picture.name));
        Stopwatch watch;
        MethodResult made = view.made(picture.method, input_.progress);
        csv_ += fmt::format("{},{},\"{}\",{},{},{:.6f}\n", picture.name, picture.scene, picture.method,
                            view.film.crop.width(), view.film.crop.height(), watch.lap());
        input_.progress.advance(1);
        return std::move(made.image);
    }

    const FigureInput& input_;
    std::vector<std::string> commands_;
    std::string csv_ = "picture,scene,method,width,height,seconds\n";
};

/// A part of the blob where its texture lies steep to the rays.
PixelBox closeUp(const Maker& maker) {
    const int w = maker.width() / 8, h = maker.height() / 5;
    return {maker.width() / 2 - w / 2, maker.height() / 2 - h / 2, maker.width() / 2 - w / 2 + w,
            maker.height() / 2 - h / 2 + h};
}

std::vector<PictureRow> picturesOf(Maker& maker, bool quick) {
    PictureRow first{"Scenes of Figure 1", "A jewel, a city, a room by paths.", {}, true};
    first.pictures = {maker.whole({"jewel", "sphere:relax=keinert", "jewel", "jewel, omega 1.2"}),
                      maker.whole({"city", "sphere:relax=keinert", "city", "city, omega 1.2"}),
                      maker.whole({"path-room", quick ? "path:4" : "path:8", "path_room",
                                   quick ? "path-room, 4 paths a pixel" : "path-room, 8 paths a pixel"})};
    const ScenePicture rough{"blob", "sphere:relax=none,prepass=off,threshold=1", "blob_rough", "as traced"};
    const ScenePicture even{"blob", "sphere:relax=none,prepass=off,threshold=1,discontinuity=3", "blob_even",
                            "after 3 steps of equation 3"};
    PictureRow tenth{"Discontinuity reduction (Figure 10)",
                     "A textured blob whose rays end within half a pixel, and the same after three steps.",
                     {},
                     true};
    tenth.pictures = {maker.whole(rough), maker.whole(even)};
    PictureRow close{"Its middle", fmt::format("{} times as large.", kEnlarged), {}};
    close.pictures = {maker.part({rough.scene, rough.method, "blob_rough_part", rough.words}, closeUp(maker)),
                      maker.part({even.scene, even.method, "blob_even_part", even.words}, closeUp(maker))};
    PictureRow eleventh{"The convex solid (Figure 11)",
                        "A glass dodecahedron in a ball, three balls and a plane in closed form.",
                        {},
                        true};
    eleventh.pictures = {maker.whole({"convex", "sphere", "convex", "convex, with the shortcut"})};
    return {first, tenth, close, eleventh};
}

}  // namespace

std::vector<FigureFile> makeSphereScenes(const FigureInput& input) {
    input.progress.stage("pictures", 8);
    Maker maker(input);
    const std::vector<PictureRow> rows = picturesOf(maker, input.quick);
    FigureWords words{
        "sphere-scenes",
        "Scenes of enhanced sphere tracing",
        "After Keinert et al. 2014, Figures 1, 10 and 11, on scenes of our own of the same kinds: the "
        "paper's are not published. Its times are in the figure sphere-tracing, which has Figures 7, 8 "
        "and 9 too.",
        {{"size", fmt::format("{}x{}", maker.width(), maker.height())},
         {"omega", "1.2"},
         {"device", "cpu"},
         {"seed", "0 (paths)"}},
        maker.commands(),
        input.quick};
    std::vector<FigureFile> files{{"report.html", figurePage(words, pictureRowsHtml(rows))},
                                  {"results.csv", maker.csv()}};
    appendPictureFiles(rows, files);
    return files;
}

}  // namespace edgewise::figures
