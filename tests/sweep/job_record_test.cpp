// Records come back as they were, join in any order, and keep machines apart.
#include <gtest/gtest.h>

#include "pipeline/error.h"
#include "pipeline/sweep/job_record.h"
#include "pipeline/sweep/sweep_results.h"
#include "tests/sweep/scratch.h"

namespace edgewise::sweep::test {
namespace {

compare::Row rowWith(double seconds, double rmse) {
    compare::Row row;
    row.method = "ssaa:2", row.parameters = {{"number", 2}};
    row.filter = "box", row.radius = 0.5, row.size = {8, 6}, row.device = "cpu";
    row.seconds = {seconds, 1.0 / 3.0}, row.setup_seconds = {0.0, 0.0};
    row.stages = {{"sample", {seconds, 0.25}}};
    judge::ErrorMetrics& error = row.error.emplace();
    error.rmse = rmse, error.max = 2 * rmse, error.psnr = 20.0, error.ssim = 0.5, error.flip = 0.1;
    return row;
}

JobRecord recordOf(const std::string& host, double seconds = 0.1, double rmse = 0.01,
                   const std::string& scene = "a.glb") {
    return {{{"version", "1"}, {"scene", scene}, {"camera", ""}, {"reference", "nsaa"}},
            {{{host, "processor", 4, 1024.0}, {rowWith(seconds, rmse)}}}};
}

TEST(JobRecord, ComesBackAsItWas) {
    const JobRecord record = recordOf("one");
    const std::string text = recordText(record);
    EXPECT_EQ(recordText(recordFromText(text, "here")), text);
    EXPECT_EQ(recordFromText(text, "here").hash(), record.hash());
}

TEST(JobRecord, RefusesWhatItHasNotWritten) {
    const std::string text = recordText(recordOf("one"));
    EXPECT_THROW(recordFromText("", "here"), InputError);
    EXPECT_THROW(recordFromText("[1]", "here"), InputError);
    EXPECT_THROW(recordFromText(text.substr(0, text.size() / 2), "here"), InputError);
    EXPECT_THROW(recordFromText(R"({"format": "edgewise sweep job 1", "job": {}, "results": []})", "here"),
                 InputError);
}

TEST(JobRecord, LiesUnderItsHashAndUnderNoOther) {
    const Scratch folder;
    const JobRecord one = recordOf("one"), other = recordOf("one", 0.1, 0.01, "b.glb");
    ASSERT_NE(one.hash(), other.hash());
    writeRecord(folder.path(), one);
    ASSERT_EQ(recordFiles(folder.path()), std::vector{recordPath(folder.path(), one.hash())});
    EXPECT_EQ(recordText(readRecord(recordPath(folder.path(), one.hash()))), recordText(one));
    std::filesystem::rename(recordPath(folder.path(), one.hash()), recordPath(folder.path(), other.hash()));
    EXPECT_THROW(readRecord(recordPath(folder.path(), other.hash())), InputError);
}

TEST(JobRecord, JoinsInAnyOrder) {
    const std::vector<JobRecord> parts{recordOf("one"), recordOf("two", 0.2), recordOf("one", 0.3)};
    const std::string text = recordText(joined(joined(parts[0], parts[1]), parts[2]));
    EXPECT_EQ(recordText(joined(joined(parts[2], parts[0]), parts[1])), text);
    EXPECT_EQ(recordText(joined(parts[1], joined(parts[2], parts[0]))), text);
    const JobRecord all = recordFromText(text, "here");
    EXPECT_EQ(all.results.size(), 3u) << "two machines, and two runs of one";
    EXPECT_EQ(recordText(joined(all, parts[1])), text) << "what is equal is one";
}

TEST(MachineName, IsOfHostProcessorAndCores) {
    const compare::Machine machine{"host", "processor", 4, 1000.0};
    EXPECT_EQ(machineName(machine), machineName({"host", "processor", 4, 999.0}));
    EXPECT_NE(machineName(machine), machineName({"tsoh", "processor", 4, 1000.0}));
    EXPECT_NE(machineName(machine), machineName({"host", "rocessorp", 4, 1000.0}));
    EXPECT_NE(machineName(machine), machineName({"host", "processor", 5, 1000.0}));
}

TEST(SweepResults, SaysWhereMachinesDisagree) {
    const JobRecord same = joined(recordOf("one"), recordOf("two", 7.0));
    EXPECT_TRUE(resultsOf({same}).disagreements.empty()) << "times may differ";
    const JobRecord different = joined(recordOf("one"), recordOf("two", 0.1, 0.02));
    const auto found = resultsOf({different}).disagreements;
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NE(found[0].find("'ssaa:2'"), std::string::npos) << found[0];
}

TEST(SweepResults, HasTheSameBytesInAnyOrder) {
    const JobRecord a = recordOf("one"), b = recordOf("one", 0.1, 0.01, "b.glb");
    const SweepResults one = resultsOf({a, b}), other = resultsOf({b, a});
    EXPECT_EQ(resultsJson(one), resultsJson(other));
    EXPECT_EQ(resultsCsv(one), resultsCsv(other));
    EXPECT_EQ(resultsLatex(one), resultsLatex(other));
}

}  // namespace
}  // namespace edgewise::sweep::test
