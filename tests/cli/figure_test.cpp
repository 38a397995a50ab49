// The papers' figures as a user makes them.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

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
        for (const auto& run : scene.at("runs")) psnr[run.at("method")] = run.at("psnr").at("contour");
        EXPECT_LT(psnr.at("none"), psnr.at("ctss"));
        EXPECT_LT(psnr.at("none"), psnr.at("ssaa:2"));
        EXPECT_LT(psnr.at("ctss:weights=uniform"), psnr.at("ctss"));
        EXPECT_LT(psnr.at("ssaa:3"), scene.at("reference_psnr").at("contour"));
    }
}

TEST(FigureCommand, ListsItsNames) {
    const ProgramRun run = runProgram({"figures"});
    EXPECT_EQ(run.status, 0);
    for (const char* name : {"filter-study: ", "performance: ", "cone-tracing: "})
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
    const ProgramRun run = runProgram({"figure", "all", "-o", "out"}, folder.path(), 1000);
    EXPECT_EQ(run.status, 130) << run.err;
    EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace edgewise::test
