// The papers' figures as a user makes them.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "pipeline/read_image.h"
#include "tests/cli/run_program.h"

namespace edgewise::test {
namespace {

TEST(FigureCommand, FilterStudyWritesItsFiles) {
    const TemporaryFolder folder;
    const ProgramRun done = runProgram({"figure", "filter-study", "--quick", "-o", "out"}, folder.path());
    EXPECT_EQ(done.status, 0) << done.err;
    EXPECT_EQ(done.err, "");
    EXPECT_EQ(lines(done.out), std::vector<std::string>{"out/index.html"});
    const auto own = folder.path() / "out" / "filter-study";
    for (const char* name : {"report.html", "results.json", "results.csv", "response.csv", "step.csv",
                             "table.tex", "response-axis.svg", "response-axis.pdf", "response-diagonal.svg",
                             "step.svg", "step.pdf", "trade-off.svg", "trade-off.pdf"})
        EXPECT_FALSE(readFile(own / name).empty()) << name;
    for (const char* pattern : {"zone-plate", "log-grid", "torus-sequence"})
        for (const char* name : {"_gaussian_R2.png", "_poly_1_-3_3_-1_R2_aliased.png", "_csaa_32.png"})
            EXPECT_EQ(readImage(own / (std::string(pattern) + name)).box.width(), 64) << pattern << name;
    // twelve filters of one radius, a line each and a header
    EXPECT_EQ(lines(readFile(own / "results.csv")).size(), 13u);
    EXPECT_NE(readFile(folder.path() / "out" / "index.html").find("filter-study/report.html"),
              std::string::npos);
    const std::string page = readFile(own / "report.html");
    for (const char* outside : {"http://", "https://", "src='/", "url(//"}) {
        const std::string namespace_free =
            page.substr(0, page.find("<svg")) + page.substr(page.rfind("</svg>"));
        EXPECT_EQ(namespace_free.find(outside), std::string::npos) << outside;  // works offline
    }
}

TEST(FigureCommand, PerformanceWritesItsFiles) {
    const TemporaryFolder folder;
    const ProgramRun done = runProgram({"figure", "performance", "--quick", "-o", "out"}, folder.path());
    EXPECT_EQ(done.status, 0) << done.err;
    EXPECT_EQ(done.err, "");
    const auto own = folder.path() / "out" / "performance";
    for (const char* name :
         {"report.html", "results.csv", "bars.csv", "growth.csv", "stages.csv", "table.tex",
          "pareto-random-2k.svg", "pareto-random-2k.pdf", "pareto-random-2k-Gaussian-R-2.pdf",
          "growth-triangles.svg", "growth-triangles-torus.pdf", "growth-resolution.pdf", "stages.pdf"})
        EXPECT_FALSE(readFile(own / name).empty()) << name;
    const auto json = nlohmann::json::parse(readFile(own / "results.json"));
    EXPECT_GT(json.at("bytes_per_second"), 0.0);
    ASSERT_EQ(json.at("scenes").size(), 2u);
    for (const auto& scene : json.at("scenes")) {
        const auto& nsaa = scene.at("rows").at(0);
        EXPECT_EQ(nsaa.at("method"), "nsaa");
        EXPECT_EQ(nsaa.at("error").at("max"), 0.0);  // it is the reference
        EXPECT_GT(nsaa.at("counts").at("terms"), 0);
        EXPECT_EQ(scene.at("ideals").size(), 6u);  // every stage
    }
    for (const auto& series : json.at("growth")) {
        EXPECT_EQ(series.at("points").size(), 3u);
        EXPECT_FALSE(series.at("fits").at("total").is_null());
    }
    // a line a method and scene, and a header
    EXPECT_EQ(lines(readFile(own / "results.csv")).size(), 1 + 2 * json.at("scenes").at(0).at("rows").size());
}

TEST(FigureCommand, ConeTracingWritesItsFiles) {
    const TemporaryFolder folder;
    const ProgramRun done = runProgram({"figure", "cone-tracing", "--quick", "-o", "out"}, folder.path());
    EXPECT_EQ(done.status, 0) << done.err;
    EXPECT_EQ(done.err, "");
    const auto own = folder.path() / "out" / "cone-tracing";
    EXPECT_NE(readFile(own / "report.html").find("6x6 over 4x8"), std::string::npos);
    EXPECT_EQ(readImage(own / "weights_ctss_coverage_5.png").box.width(), 8 * 40);
    EXPECT_EQ(readImage(own / "affected_primitives_ctss-x.png").box.width(), 96);
    const auto json = nlohmann::json::parse(readFile(own / "results.json"));
    ASSERT_EQ(json.at("scenes").size(), 2u);
    for (const auto& scene : json.at("scenes")) {
        std::uint64_t pixels = 0;
        for (const auto& [kind, count] : scene.at("pixels").items()) pixels += count.get<std::uint64_t>();
        EXPECT_EQ(pixels, 96u * 54u);
        std::map<std::string, double> psnr;
        for (const auto& row : scene.at("rows"))
            psnr[row.at("method")] = row.at("edge_kinds").at("contour").at("psnr");
        EXPECT_LT(psnr.at("none"), psnr.at("ctss"));
        EXPECT_LT(psnr.at("none"), psnr.at("ssaa:2"));
        EXPECT_LT(psnr.at("ctss:weights=uniform"), psnr.at("ctss"));
        EXPECT_LT(psnr.at("ssaa:3"), scene.at("reference_error").at("kinds").at("contour").at("psnr"));
    }
    for (const auto& claim : json.at("claims")) {
        if (!claim.at("margin").is_null()) {
            EXPECT_EQ(claim.at("met"), claim.at("margin").get<double>() >= 0.0) << claim;
        }
    }
    for (const char* name : {"means-edges.pdf", "means-contour.svg", "over-ssaa_2.svg", "wires-contour.svg"})
        EXPECT_FALSE(readFile(own / name).empty()) << name;
}

TEST(FigureCommand, ConeBeyondShowsEachKind) {
    const TemporaryFolder folder;
    const ProgramRun done = runProgram({"figure", "cone-beyond", "--quick", "-o", "out"}, folder.path());
    EXPECT_EQ(done.status, 0) << done.err;
    const auto own = folder.path() / "out" / "cone-beyond";
    const std::string page = readFile(own / "report.html");
    for (const char* words : {"error of ctss-x, ", "ctss-x over ctss", "texture", "shadow"})
        EXPECT_NE(page.find(words), std::string::npos) << words;
    EXPECT_FALSE(readFile(own / "primitives.pdf").empty());
    // a line a scene, method and kind with all edges, and a header
    EXPECT_EQ(lines(readFile(own / "results.csv")).size(), 1u + 2 * 4 * 6);
}

/// Fields of a CSV's rows, none of which has a comma in it.
std::vector<std::vector<std::string>> fieldsOf(const std::filesystem::path& csv) {
    std::vector<std::vector<std::string>> rows;
    for (const std::string& line : lines(readFile(csv))) {
        std::istringstream text(line);
        rows.emplace_back();
        for (std::string field; std::getline(text, field, ',');) rows.back().push_back(field);
    }
    return rows;
}

TEST(FigureCommand, OursAndConeTablesSayWhatTheyMeasured) {
    const TemporaryFolder folder;
    const ProgramRun done =
        runProgram({"figure", "error-time", "planner", "cone-scenes", "cone-table", "--quick", "-o", "out"},
                   folder.path());
    EXPECT_EQ(done.status, 0) << done.err;
    EXPECT_EQ(done.err, "");
    const auto out = folder.path() / "out";
    for (const char* name :
         {"error-time/means-sdf.pdf", "error-time/pareto-primitives.svg", "planner/savings-triangles.pdf",
          "planner/savings-sdf.svg", "cone-scenes/figure-1.pdf", "cone-scenes/figure-5.svg",
          "cone-scenes/settings.pdf", "cone-scenes/figure-10.pdf", "cone-table/ratios.pdf"})
        EXPECT_FALSE(readFile(out / name).empty()) << name;
    std::map<std::string, double> errors;  // in those of none
    for (const auto& row : fieldsOf(out / "error-time" / "means.csv"))
        if (row[0] != "on") errors[row[0] + " " + row[1]] = std::stod(row[4]);
    EXPECT_EQ(errors.at("triangles nsaa"), 0.0);
    EXPECT_LT(errors.at("triangles ssaa:4"), errors.at("triangles ssaa:2"));
    EXPECT_LT(errors.at("SDF scenes ctss-x"), errors.at("SDF scenes ctss"));
    std::map<std::string, std::string> used;
    for (const auto& row : fieldsOf(out / "planner" / "results.csv")) used[row[0] + " " + row[1]] = row[2];
    EXPECT_EQ(used.at("random-2k fetch"), "true");     // constant colours
    EXPECT_EQ(used.at("random-2k cancel"), "false");   // all of them different
    EXPECT_EQ(used.at("primitives convex"), "false");  // the scene has no bound
    EXPECT_EQ(used.at("primitives prune"), "true");
    std::map<std::string, double> rmse;
    for (const auto& row : fieldsOf(out / "cone-scenes" / "results.csv"))
        if (row[0] != "edges") rmse[row[0] + " " + row[2]] = std::stod(row[3]);
    // cones mend contours and nothing else; lines mend the rest
    EXPECT_LT(rmse.at("contour ctss"), 0.8 * rmse.at("contour none"));
    for (const std::string kind : {"internal", "texture", "shadow"}) {
        EXPECT_GT(rmse.at(kind + " ctss"), 0.8 * rmse.at(kind + " none")) << kind;
        EXPECT_LT(rmse.at(kind + " ctss-x"), 0.8 * rmse.at(kind + " none")) << kind;
    }
    EXPECT_EQ(fieldsOf(out / "cone-table" / "results.csv").size(), 1u + 2 * 2 * 4);
}

TEST(FigureCommand, ListsItsNames) {
    const ProgramRun run = runProgram({"figures"});
    EXPECT_EQ(run.status, 0);
    for (const char* name : {"filter-study: ", "performance: ", "cone-tracing: ", "nsaa-1: ", "nsaa-times: ",
                             "sphere-drawn: ", "lottes: "})
        EXPECT_NE(run.out.find(name), std::string::npos) << name;
}

TEST(FigureCommand, WrongOnesAreOneLineAndLeaveNothing) {
    const TemporaryFolder folder;
    writeFile(folder / "file", "x");
    for (const Arguments& wrong :
         {Arguments{"figure", "nope", "-o", "out"}, Arguments{"figure", "filter-study", "nope", "-o", "out"},
          Arguments{"figure", "filter-study"}, Arguments{"figure", "-o", "out"},
          Arguments{"figure", "filter-study", "--quick", "-o", "file/x"}}) {
        const ProgramRun run = runProgram(wrong, folder.path());
        EXPECT_EQ(run.status, 2) << run.err;
        EXPECT_EQ(lines(run.err).size(), 1u) << run.err;
        EXPECT_EQ(folder.names(), std::vector<std::string>{"file"});
    }
}

TEST(FigureCommand, CtrlCEndsWith130AndLeavesNothing) {
    const TemporaryFolder folder;
    const ProgramRun run = runProgram({"figure", "performance", "-o", "out"}, folder.path(), 1000);
    EXPECT_EQ(run.status, 130) << run.err;
    EXPECT_TRUE(folder.names().empty());
}

TEST(FigureCommand, AllOfThemQuickly) {
    const TemporaryFolder folder;
    const ProgramRun done = runProgram({"figure", "all", "--quick", "-o", "out"}, folder.path());
    EXPECT_EQ(done.status, 0) << done.err;
    EXPECT_EQ(done.err, "");
    const auto out = folder.path() / "out";
    for (const char* name :
         {"nsaa-1/pixel.pdf", "nsaa-2/pipeline.pdf", "nsaa-2/segments.png", "nsaa-3/conservative.pdf",
          "nsaa-4/errors.pdf", "nsaa-4/zone-plate_rim_msaa_16.png", "nsaa-5/errors.svg",
          "nsaa-5/log-grid_fine_csaa_32.png", "nsaa-6/log-grid_nsaa_cone.png",
          "nsaa-7/torus-sequence_far_nsaa_gaussian.png", "nsaa-times/shares.pdf", "nsaa-times/results.csv"})
        EXPECT_FALSE(readFile(out / name).empty()) << name;
    EXPECT_EQ(readImage(out / "nsaa-4" / "zone-plate_rim_msaa_16.png").box.width(), 4 * 64);
    // Errors fall as samples become more, and nsaa is its own reference.
    std::map<std::string, double> rmse;
    for (const std::string& row : lines(readFile(out / "nsaa-4" / "results.csv"))) {
        std::vector<std::string> fields;
        std::istringstream text(row);
        for (std::string field; std::getline(text, field, ',');) fields.push_back(field);
        if (fields.size() > 7 && fields[0] == "zone-plate") rmse[fields[1]] = std::stod(fields[7]);
    }
    for (const auto& [more, fewer] : {std::pair("msaa:2", "none"), std::pair("msaa:4", "msaa:2"),
                                      std::pair("msaa:8", "msaa:4"), std::pair("msaa:16", "msaa:8")})
        EXPECT_LT(rmse.at(more), rmse.at(fewer)) << more;
    EXPECT_EQ(rmse.at("nsaa"), 0.0);
    const std::string claims = readFile(out / "claims.csv");
    for (const char* claim : {"share of exact visibility", "> 90", "< 5", "in the 100 MB range"})
        EXPECT_NE(claims.find(claim), std::string::npos) << claim;
    const std::string index = readFile(out / "index.html");
    EXPECT_NE(index.find("Paper says, we measure"), std::string::npos);
    for (const std::string& figure : lines(runProgram({"figures"}).out)) {
        const std::string page = figure.substr(0, figure.find(':')) + "/report.html";
        EXPECT_NE(index.find("href='" + page + "'"), std::string::npos) << page;
        EXPECT_FALSE(readFile(out / page).empty()) << page;
    }
    for (const char* name :
         {"sphere-drawn/figure-4.pdf", "sphere-drawn/results.csv", "sphere-scenes/jewel.png",
          "sphere-scenes/results.csv", "lottes/pattern.pdf", "lottes/frame_0.png"})
        EXPECT_FALSE(readFile(out / name).empty()) << name;
    // over-relaxation takes fewer steps, and one of them is taken back, as Figure 3 shows
    int classic = 0, relaxed = 0, failed = 0;
    for (const std::string& row : lines(readFile(out / "sphere-drawn" / "results.csv"))) {
        classic += row.starts_with("classic,"), relaxed += row.starts_with("relaxed,");
        failed += row.starts_with("relaxed,") && row.ends_with(",true");
    }
    EXPECT_LT(relaxed, classic);
    EXPECT_EQ(failed, 1);
}

TEST(FigureCommand, ASecondRunMakesWhatChanged) {
    const TemporaryFolder folder;
    const auto stamp = [&](const char* name) {
        return readFile(folder.path() / "out" / name / "stamp.json");
    };
    ASSERT_EQ(runProgram({"figure", "nsaa-1", "nsaa-3", "--quick", "-o", "out"}, folder.path()).status, 0);
    const std::string first = stamp("nsaa-1"), third = stamp("nsaa-3");
    writeFile(folder.path() / "out" / "nsaa-3" / "results.csv", "spoilt");
    ASSERT_EQ(runProgram({"figure", "nsaa-1", "nsaa-3", "--quick", "-o", "out"}, folder.path()).status, 0);
    EXPECT_EQ(stamp("nsaa-1"), first);  // the time that it took, too
    EXPECT_NE(stamp("nsaa-3"), third);
    EXPECT_NE(readFile(folder.path() / "out" / "nsaa-3" / "results.csv"), "spoilt");
    // what lies there already is on the page too
    ASSERT_EQ(runProgram({"figure", "nsaa-1", "-o", "out"}, folder.path()).status, 0);
    EXPECT_NE(stamp("nsaa-1"), first);
    const std::string page = readFile(folder.path() / "out" / "index.html");
    EXPECT_NE(page.find("nsaa-3/report.html"), std::string::npos);
    EXPECT_NE(page.find("samples gathered in vain"), std::string::npos);
}

TEST(FigureCommand, OneThatIsInterruptedHasAnIndexOfWhatIsMade) {
    const TemporaryFolder folder;
    // performance takes minutes, nsaa-1 a moment
    const ProgramRun run = runProgram({"figure", "nsaa-1", "performance", "-o", "out"}, folder.path(), 5000);
    EXPECT_EQ(run.status, 130);
    const std::string page = readFile(folder.path() / "out" / "index.html");
    EXPECT_NE(page.find("1 of "), std::string::npos);
    EXPECT_NE(page.find("href='nsaa-1/report.html'"), std::string::npos);
    EXPECT_EQ(page.find("href='performance/report.html'"), std::string::npos);
}

TEST(FigureCommand, OneThatFailsSaysSoAndOthersGoOn) {
    const TemporaryFolder folder;
    // nsaa-2 has stages dumped there
    const ProgramRun run = runOther(
        "env",
        {"TMPDIR=nowhere", EDGEWISE_PROGRAM, "figure", "nsaa-1", "nsaa-2", "nsaa-3", "--quick", "-o", "out"},
        folder.path());
    EXPECT_EQ(run.status, 1);
    ASSERT_EQ(lines(run.err).size(), 1u) << run.err;
    EXPECT_TRUE(run.err.starts_with("edgewise: error: nsaa-2: ")) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out" / "nsaa-2"));
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / "nsaa-3" / "report.html"));
    EXPECT_NE(readFile(folder.path() / "out" / "index.html").find("TMPDIR"), std::string::npos);
}

/// All pictures of a page are there, and the browser has nothing to say.
TEST(FigureCommand, PagesAreWholeInABrowser) {
    const TemporaryFolder folder;
    if (runOther("chromium", {"--version"}, folder.path()).status != 0)
        GTEST_SKIP() << "chromium is not installed";
    ASSERT_EQ(
        runProgram({"figure", "nsaa-1", "nsaa-2", "nsaa-4", "--quick", "-o", "out"}, folder.path()).status,
        0);
    constexpr const char* kProbe = R"js(<script>addEventListener("load", () => {
  const pictures = [...document.images], note = document.createElement("pre");
  note.textContent = "PROBE" + pictures.filter((p) => !p.naturalWidth).length + " of " + pictures.length + "PROBE";
  document.body.append(note);
});</script>)js";
    for (const auto& [page, pictures] : {std::pair("index", 0), std::pair("nsaa-1/report", 0),
                                         std::pair("nsaa-2/report", 0), std::pair("nsaa-4/report", 18)}) {
        const auto file = folder.path() / "out" / (page + std::string(".html"));
        const auto probed = folder.path() / "out" / (page + std::string("-probed.html"));
        writeFile(probed, readFile(file) + kProbe);
        const ProgramRun browser =
            runOther("chromium",
                     {"--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                      "--user-data-dir=" + (folder / "profile").string(), "--enable-logging=stderr",
                      "--virtual-time-budget=20000", "--dump-dom", "file://" + probed.string()},
                     folder.path());
        ASSERT_EQ(browser.status, 0) << browser.err;
        EXPECT_EQ(browser.err.find("CONSOLE"), std::string::npos) << browser.err;
        EXPECT_NE(browser.out.find("PROBE0 of " + std::to_string(pictures) + "PROBE</pre>"),
                  std::string::npos)
            << page;
    }
}

}  // namespace
}  // namespace edgewise::test
