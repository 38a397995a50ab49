// NSAA, Figure 7: tori one behind the other, textured and lit.
#include <fmt/format.h>

#include "paper_figures/page_parts.h"
#include "paper_figures/pattern_pictures.h"

namespace edgewise::figures {
namespace {

PatternPlan plan(bool quick) {
    PatternPlan out{"torus-sequence",
                    1024,
                    512,
                    quick ? PixelBox{880, 24, 1008, 120} : PixelBox{0, 0, 1024, 512},
                    {{"far", "The far end", {904, 40, 984, 104}},
                     {"near", "The nearest one and the next", {270, 240, 350, 304}}},
                    {{"none", "", {}, "none: a sample a pixel"},
                     {"nsaa", "gaussian", 2.0, "nsaa, gaussian R 2"},
                     {"ssaa:8", "gaussian", 2.0, "ssaa:8, gaussian R 2"},
                     {"ssaa:16", "gaussian", 2.0, "ssaa:16, gaussian R 2"}},
                    4};
    if (quick) out.methods.pop_back();
    return out;
}

}  // namespace

std::vector<FigureFile> makeNsaaTori(const FigureInput& input) {
    const PatternPictures found = makePatternPictures(plan(input.quick), input.progress);
    const char* finest = input.quick ? "ssaa:8" : "ssaa:16";
    const judge::ErrorMetrics& apart = *found.row(finest, "gaussian").of_own;
    input.claims.push_back({"Figure 7",
                            fmt::format("nsaa's occlusions against those of a depth test, {}", finest),
                            "correct", fmt::format("RMSE {:.2e}, largest {:.2e}", apart.rmse, apart.max), "",
                            "what is left is the samples' error: it falls as they become more"});
    FigureWords words{
        "nsaa-7",
        "A sequence of tori",
        "After NSAA's Figure 7: seven checkered tori recede, turn, hide each other and themselves; "
        "no depth buffer is used. The paper shades by Phong's model; here the file's metallic-roughness "
        "material is lit by the documented default rig, and textured. Visibility is exact, shading is "
        "one point a pixel and triangle, the nearest one, which may be a hidden one.",
        {{"size", "1024x512"},
         {"filter", "gaussian, R 2, sigma R/3 (not published: ours)"},
         {"device", "cpu"},
         {"seed", "none"}},
        {},
        input.quick};
    for (const PatternMethod& method : found.plan.methods)
        words.commands.push_back(commandOf(found.plan, method));
    std::vector<FigureFile> files{
        {"report.html",
         figurePage(words, pictureRowsHtml(found.pictures) + "<h2>Errors</h2>" + patternTable(found))},
        {"results.csv", patternCsv(found)}};
    appendPictureFiles(found.pictures, files);
    return files;
}

}  // namespace edgewise::figures
