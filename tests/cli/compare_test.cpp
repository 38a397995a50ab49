// `edgewise compare` as scripts rely on it: the files, the rows' fields, budgets, resuming, errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "pipeline/version.h"
#include "tests/cli/read_picture.h"
#include "tests/cli/run_program.h"

namespace edgewise::test {
namespace {

using nlohmann::json;

ProgramRun compareIn(const TemporaryFolder& folder, Arguments more, const std::string& size = "48x32") {
    Arguments arguments{"compare", "torus-20k", "-o", "out", "--size", size, "--device", "cpu"};
    if (std::ranges::find(more, "--runs") == more.end()) arguments.insert(arguments.end(), {"--runs", "2"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runProgram(arguments, folder.path());
}

json resultsOf(const TemporaryFolder& folder) {
    return json::parse(readFile(folder / "out/results.json"));
}

json rowOf(const json& results, const std::string& method) {
    const auto& rows = results.at("rows");
    return *std::ranges::find(rows, method,
                              [](const json& row) { return row.at("method").get<std::string>(); });
}

TEST(Compare, GivesARowAMethodAndAllFiles) {
    const TemporaryFolder folder;
    const ProgramRun run = compareIn(
        folder, {"--method", "nsaa", "--method", "ssaa:2", "--method", "ssaa:4", "--method", "msaa:4"});
    ASSERT_EQ(run.status, 0) << run.err;
    for (const char* name : {"results.json", "results.csv", "table.tex", "report.html", "pareto.svg",
                             "pareto.pdf", "nsaa.exr", "ssaa_2.png", "msaa_4.exr"})
        EXPECT_TRUE(std::filesystem::exists(folder / ("out/" + std::string(name)))) << name;
    const json results = resultsOf(folder);
    EXPECT_EQ(results.at("scene"), "torus-20k");
    EXPECT_EQ(results.at("reference"), "nsaa,device=cpu");
    EXPECT_EQ(results.at("version"), version());
    ASSERT_EQ(results.at("rows").size(), 4u);
    for (const json& row : results.at("rows")) {
        EXPECT_EQ(row.at("status"), "ok");
        EXPECT_EQ(row.at("device"), "cpu");
        EXPECT_EQ(row.at("size"), json({48, 32}));
        EXPECT_EQ(row.at("seconds").at("runs"), 2);
        EXPECT_LE(row.at("seconds").at("min"), row.at("seconds").at("median"));
        EXPECT_LE(row.at("seconds").at("median"), row.at("seconds").at("max"));
        EXPECT_GT(row.at("peak_mib"), 10.0);
        EXPECT_FALSE(row.at("stages").empty());
    }
    const json exact = rowOf(results, "nsaa").at("error");
    EXPECT_EQ(exact.at("rmse"), 0.0) << "the reference itself";
    EXPECT_TRUE(exact.at("psnr").is_null());
    const json two = rowOf(results, "ssaa:2").at("error"), four = rowOf(results, "ssaa:4").at("error");
    EXPECT_GT(two.at("rmse"), four.at("rmse"));
    EXPECT_GT(four.at("rmse"), 0.0);
    EXPECT_GT(two.at("edge_rmse"), two.at("rmse")) << "errors lie on edges";
}

/// A method with a box of its own is judged against the reference with that box.
TEST(Compare, AnInterruptReachesItsWorkersAndIsNoFailureOfTheirs) {
    const TemporaryFolder folder;
    for (const int after_ms : {1000, 2500}) {  // in the reference, and among the runs
        const ProgramRun run = runProgram({"compare", "torus-20k", "-o", "out", "--size", "48x32", "--method",
                                           "none", "--runs", "10000", "--quiet"},
                                          folder.path(), after_ms);
        EXPECT_EQ(run.status, 130) << run.err;
        EXPECT_EQ(run.err.find("status"), std::string::npos) << run.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "out/results.json"));
    }
}

TEST(Compare, JudgesARowByItsOwnFilter) {
    const TemporaryFolder folder;
    const ProgramRun run = compareIn(
        folder, {"--filter", "gaussian", "--sigma", "0.8", "--method", "msaa:16", "--method", "ssaa:4"});
    ASSERT_EQ(run.status, 0) << run.err;
    const json results = resultsOf(folder);
    const json sampled = rowOf(results, "msaa:16"), filtered = rowOf(results, "ssaa:4");
    EXPECT_EQ(sampled.at("filter"), json({{"name", "box"}, {"radius", 0.5}, {"sigma", nullptr}}));
    EXPECT_EQ(filtered.at("filter"), json({{"name", "gaussian"}, {"radius", 2.0}, {"sigma", 0.8}}));
    // against the wide Gaussian its error would be that of the blur
    EXPECT_LT(sampled.at("error").at("rmse"), 0.03);
}

TEST(Compare, ABudgetEndsAMethodAndItsRowSaysSo) {
    const TemporaryFolder folder;
    const ProgramRun run =
        compareIn(folder, {"--budget", "0.02", "--method", "ssaa:32", "--method", "none"}, "512x512");
    ASSERT_EQ(run.status, 0) << run.err;
    const json row = rowOf(resultsOf(folder), "ssaa:32");
    EXPECT_EQ(row.at("status"), "timeout");
    EXPECT_TRUE(row.at("seconds").is_null());
    EXPECT_TRUE(row.at("error").is_null());
    EXPECT_NE(run.err.find("budget"), std::string::npos) << run.err;
}

TEST(Compare, ResumeKeepsTheRowsOfTheSameCommand) {
    const TemporaryFolder folder;
    ASSERT_EQ(compareIn(folder, {"--method", "none", "--method", "ssaa:2"}).status, 0);
    const json before = resultsOf(folder);
    ASSERT_EQ(compareIn(folder, {"--resume", "--method", "none", "--method", "ssaa:2", "--method", "ssaa:3"})
                  .status,
              0);
    const json after = resultsOf(folder);
    ASSERT_EQ(after.at("rows").size(), 3u);
    for (const char* method : {"none", "ssaa:2"}) EXPECT_EQ(rowOf(before, method), rowOf(after, method));
    // another size is another command
    ASSERT_EQ(compareIn(folder, {"--resume", "--method", "none"}, "40x32").status, 0);
    EXPECT_EQ(rowOf(resultsOf(folder), "none").at("size"), json({40, 32}));
}

TEST(Compare, ExposureIsForPngAlone) {
    const TemporaryFolder folder;
    const auto compareAt = [&](Arguments more) {
        more.insert(more.end(), {"--method", "ssaa:2", "--runs", "1", "--resume"});
        const ProgramRun run = compareIn(folder, more);
        EXPECT_EQ(run.status, 0) << run.err;
        return rowOf(resultsOf(folder), "ssaa:2").at("error");
    };
    const auto pixels = [&](const char* name) {
        return readPicture(folder / (std::string("out/") + name)).values;
    };
    const json error = compareAt({});
    const auto exr = pixels("ssaa_2.exr"), png = pixels("ssaa_2.png");
    EXPECT_EQ(compareAt({"--exposure", "-1"}), error);
    EXPECT_EQ(pixels("ssaa_2.exr"), exr);
    EXPECT_NE(pixels("ssaa_2.png"), png) << "kept by --resume?";
}

TEST(Compare, ParametersAreResolved) {
    const TemporaryFolder folder;
    ASSERT_EQ(compareIn(folder, {"--runs", "1", "--method", "ssaa:2", "--method", "smaa:edges=color"}).status,
              0);
    const json results = resultsOf(folder);
    EXPECT_EQ(rowOf(results, "ssaa:2").at("parameters"), json({{"number", 2}}));
    EXPECT_EQ(rowOf(results, "smaa:edges=color").at("parameters"),
              json({{"preset", "high"}, {"edges", "color"}, {"blend", "linear"}}));
}

/// Names of files are bytes, and JSON's text is UTF-8.
TEST(Compare, NamesNeedNotBeUtf8) {
    const TemporaryFolder folder;
    const std::string scene = "r\xe9seau.glb", out = "r\xe9sultat";
    std::filesystem::copy_file(std::filesystem::path(EDGEWISE_TEST_DATA) / "torus-20k.glb", folder / scene);
    const ProgramRun run = runProgram({"compare", scene, "-o", out, "--size", "24x16", "--device", "cpu",
                                       "--runs", "1", "--method", "none"},
                                      folder.path());
    ASSERT_EQ(run.status, 0) << run.err;
    const json results = json::parse(readFile(folder / (out + "/results.json")));
    EXPECT_EQ(results.at("scene"), "r\ufffdseau.glb");
    EXPECT_EQ(rowOf(results, "none").at("status"), "ok");
    EXPECT_TRUE(std::filesystem::exists(folder / (out + "/report.html")));
}

TEST(Compare, WrongInputIsOneLineBeforeAnythingRuns) {
    for (const Arguments& wrong : {Arguments{"--method", "nsaa", "--method", "msaa:5"},
                                   {"--method", "nsaa", "--method", "nsaa"},
                                   {"--method", "nsaa", "--budget", "0"},
                                   {"--method", "nsaa", "--reference", "truth"},
                                   {"--method", "nsaa", "--runs", "none"}}) {
        const TemporaryFolder folder;
        const ProgramRun run = compareIn(folder, wrong);
        EXPECT_EQ(run.status, 2) << run.err;
        EXPECT_EQ(lines(run.err).size(), 1u) << run.err;
        EXPECT_TRUE(folder.names().empty()) << "something was left behind";
    }
}

/// In two dimensions the error of a net falls with N^-3/4 where an edge or two cross a pixel.
TEST(Compare, TellsHowFastASamplersErrorFalls) {
    const TemporaryFolder folder;
    Arguments methods{"--runs", "1", "--filter", "box"};
    for (const char* method : {"ssaa:2", "ssaa:4", "ssaa:8", "ssaa:16"})
        methods.insert(methods.end(), {"--method", method});
    ASSERT_EQ(compareIn(folder, methods).status, 0);
    const json slopes = resultsOf(folder).at("slopes");
    ASSERT_EQ(slopes.size(), 1u);
    EXPECT_EQ(slopes[0].at("family"), "ssaa:N");
    EXPECT_NEAR(slopes[0].at("samples")[0], 4.0, 1e-9);
    EXPECT_NEAR(slopes[0].at("samples")[1], 256.0, 1e-9);
    EXPECT_LT(slopes[0].at("slope"), -0.5) << "no slower than independent samples";
    EXPECT_GT(slopes[0].at("slope"), -1.0) << "no faster than an integrand without edges";
    EXPECT_TRUE(slopes[0].at("few_edges_slope").is_number());
}

/// 64 to 1024 samples on 64x64 pixels; the whole range on larger pictures gives -0.744 to -0.754.
TEST(Compare, ScrambledNetsFallLikeTheory) {
    const TemporaryFolder folder;
    if (runProgram({"methods"}, folder.path()).out.find("\nrt:") == std::string::npos)
        GTEST_SKIP() << "built without rt";
    Arguments arguments{"compare",  "random-2k", "-o",     "out", "--size",   "96x96",
                        "--device", "cpu",       "--runs", "1",   "--filter", "box"};
    for (const char* method : {"rt:64", "rt:128", "rt:256", "rt:512", "rt:1024"})
        arguments.insert(arguments.end(), {"--method", method});
    const ProgramRun run = runProgram(arguments, folder.path());
    ASSERT_EQ(run.status, 0) << run.err;
    const json results = resultsOf(folder);
    EXPECT_NEAR(results.at("slopes")[0].at("few_edges_slope"), -0.75, 0.05);
    const json row = rowOf(results, "rt:1024");
    EXPECT_GT(row.at("few_edges").at("pixels"), 1000);
    // 95 % is 1.96 deviations; 4 deviations happen once in 16,000 seeds.
    const double half_width = row.at("bias_half_width");
    EXPECT_LT(std::fabs(row.at("error").at("bias").get<double>()), half_width / 1.96 * 4.0);
    EXPECT_LT(half_width, 1e-4);
}

TEST(Compare, AMissingSceneIsNamed) {
    const TemporaryFolder folder;
    const ProgramRun run =
        runProgram({"compare", "nowhere.glb", "-o", "out", "--method", "nsaa"}, folder.path());
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find("nowhere.glb"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace edgewise::test
