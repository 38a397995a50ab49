// `edgewise sweep` and `edgewise merge` as scripts rely on them: resuming, shards, joining, errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "tests/cli/run_program.h"

namespace edgewise::test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// For as long as it lives.
class Variable {
  public:
    Variable(const char* name, const std::string& value) : name_(name) { setenv(name, value.c_str(), 1); }
    ~Variable() { unsetenv(name_); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

  private:
    const char* name_;
};

/// Three triangles; 8 pixels and 8 wide.
constexpr const char* kStudy = R"(
scenes = ["scene.gltf"]
methods = ["none", "ssaa:2"]
filters = ["box", "tent"]
sizes = ["8x8", "9x8"]
runs = 1
device = "cpu"
)";

class Sweep : public ::testing::Test {
  protected:
    void SetUp() override {
        fs::copy_file(fs::path(EDGEWISE_TEST_DATA) / "degenerate/piercing.gltf", folder_ / "scene.gltf");
        writeFile(folder_ / "study.toml", kStudy);
    }
    ProgramRun sweep(const std::string& out, const Arguments& more = {}) const {
        Arguments arguments{"sweep", "study.toml", "-o", out};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runProgram(arguments, folder_.path());
    }
    /// File name -> content.
    std::map<std::string, std::string> jobsIn(const std::string& out) const {
        std::map<std::string, std::string> jobs;
        for (const auto& entry : fs::directory_iterator(folder_ / out / "jobs"))
            jobs[entry.path().filename()] = readFile(entry.path());
        return jobs;
    }
    json resultsIn(const std::string& out) const {
        return json::parse(readFile(folder_ / (out + "/results.json")));
    }
    /// Of one shard of a list that has not been shared out before.
    std::set<std::string> namesAfter(const std::string& out, const Arguments& more = {}) const {
        const ProgramRun run = sweep(out, more);
        EXPECT_EQ(run.status, 0) << run.err;
        std::set<std::string> names;
        for (const auto& [name, text] : jobsIn(out)) names.insert(name);
        return names;
    }
    /// Another machine's, with `change` made to its rows.
    template <class Change>
    void disguise(const std::string& from, const std::string& to, Change&& change) const {
        fs::copy(folder_ / from, folder_ / to, fs::copy_options::recursive);
        for (const auto& [name, text] : jobsIn(to)) {
            auto record = nlohmann::ordered_json::parse(text);
            for (auto& result : record.at("results")) {
                result.at("machine").at("host") = "elsewhere";
                for (auto& row : result.at("rows")) change(row);
            }
            writeFile(folder_ / (to + "/jobs/" + name), record.dump());
        }
    }

    TemporaryFolder folder_;
};

std::set<std::string> namesIn(const fs::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        names.insert(fs::relative(entry.path(), folder));
    return names;
}

/// `none` has a box of its own, so that it is in the box's jobs and not in the tent's.
TEST_F(Sweep, MakesAJobOfEveryCombinationAndTablesOfAll) {
    const ProgramRun run = sweep("out");
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(jobsIn("out").size(), 4u);
    const json results = resultsIn("out");
    std::multiset<std::string> rows;
    for (const json& row : results.at("rows")) {
        rows.insert(row.at("method").get<std::string>() + " " +
                    row.at("filter").at("name").get<std::string>());
        EXPECT_EQ(row.at("scene"), "scene.gltf");
        EXPECT_EQ(row.at("status"), "ok");
        EXPECT_EQ(row.at("seconds").at("runs"), 1);
        EXPECT_GE(row.at("error").at("rmse"), 0.0);
        EXPECT_TRUE(results.at("machines").contains(row.at("machine").get<std::string>()));
    }
    EXPECT_EQ(rows, (std::multiset<std::string>{"none box", "none box", "ssaa:2 box", "ssaa:2 box",
                                                "ssaa:2 tent", "ssaa:2 tent"}));
    EXPECT_EQ(lines(readFile(folder_ / "out/results.csv")).size(), 1u + 6u);
    for (const char* name : {"report.html", "table.tex"})
        EXPECT_NE(readFile(folder_ / ("out/" + std::string(name))).find("scene.gltf"), std::string::npos);
}

TEST_F(Sweep, AMethodWithItsOwnBoxMakesTheJobThatItNeeds) {
    writeFile(folder_ / "study.toml",
              "scenes = ['scene.gltf']\nmethods = ['none', 'nsaa']\nfilters = ['tent']\nsizes = ['8x8']\n"
              "runs = 1\ndevice = 'cpu'\n");
    ASSERT_EQ(sweep("out").status, 0);
    std::set<std::string> rows;
    const json results = resultsIn("out");
    for (const json& row : results.at("rows"))
        rows.insert(row.at("method").get<std::string>() + " " +
                    row.at("filter").at("name").get<std::string>());
    EXPECT_EQ(rows, (std::set<std::string>{"none box", "nsaa tent"}));
}

TEST_F(Sweep, ResumesWithWhatIsMissingAlone) {
    ASSERT_EQ(sweep("out", {"--shard", "1/2"}).status, 0);
    auto before = jobsIn("out");
    ASSERT_EQ(before.size(), 2u);
    // a file cut in the middle counts as missing
    const std::string broken = before.begin()->first;
    writeFile(folder_ / ("out/jobs/" + broken), before.begin()->second.substr(0, 100));
    before.erase(before.begin());
    const ProgramRun run = sweep("out", {"--resume"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("3 jobs made, 1 kept"), std::string::npos) << run.out;
    const auto after = jobsIn("out");
    EXPECT_EQ(after.size(), 4u);
    for (const auto& [name, text] : before) EXPECT_EQ(after.at(name), text);
    EXPECT_TRUE(json::accept(after.at(broken)));
    const ProgramRun again = sweep("out", {"--resume"});
    EXPECT_NE(again.out.find("0 jobs made, 4 kept"), std::string::npos) << again.out;
    EXPECT_EQ(jobsIn("out"), after);
}

TEST_F(Sweep, AnInterruptLeavesNothingHalfWritten) {
    ASSERT_EQ(sweep("out", {"--shard", "2/2"}).status, 0);
    const auto before = jobsIn("out");
    std::string study = kStudy;
    study.replace(study.find("runs = 1"), 8, "runs = 10000");
    writeFile(folder_ / "study.toml", study);
    const ProgramRun run = runProgram({"sweep", "study.toml", "-o", "out", "--resume"}, folder_.path(), 700);
    EXPECT_EQ(run.status, 130) << run.err;
    EXPECT_EQ(jobsIn("out"), before) << "none of 10000 runs can have ended";
    EXPECT_EQ(namesIn(folder_ / "out").size(), 1 + before.size() + 4) << "jobs, tables and page, no more";
}

TEST_F(Sweep, AJobIsAnotherOneWhenItsSceneOrAParameterChanges) {
    const auto first = namesAfter("out", {"--shard", "1/4"});
    writeFile(folder_ / "scene.gltf", readFile(folder_ / "scene.gltf") + "\n");
    const auto scene = namesAfter("scene", {"--shard", "1/4"});
    writeFile(folder_ / "study.toml", std::string(kStudy) + "seed = 1\n");
    const auto seed = namesAfter("seed", {"--shard", "1/4"});
    std::set<std::string> all(first);
    all.insert(scene.begin(), scene.end()), all.insert(seed.begin(), seed.end());
    EXPECT_EQ(all.size(), 3u);
    EXPECT_EQ(namesAfter("again", {"--shard", "1/4"}), seed) << "and the same one when nothing does";
}

TEST_F(Sweep, ShardsAreDisjointAndComplete) {
    std::set<std::string> joined;
    for (const char* shard : {"1/3", "2/3", "3/3"}) {
        const auto part = namesAfter(std::string("part") + shard[0], {"--shard", shard});
        EXPECT_GE(part.size(), 1u);
        EXPECT_LE(part.size(), 2u);
        for (const std::string& name : part) EXPECT_TRUE(joined.insert(name).second) << "in two shards";
    }
    // several may share a folder, and together they are the whole
    for (const char* shard : {"3/3", "1/3"}) namesAfter("shared", {"--shard", shard});
    EXPECT_EQ(namesAfter("shared", {"--resume"}), joined);
    EXPECT_EQ(resultsIn("shared").at("rows").size(), 6u);
}

TEST_F(Sweep, ShardsComeFromTheEnvironment) {
    const auto second = namesAfter("flag", {"--shard", "2/4"});
    const Variable rank("OMPI_COMM_WORLD_RANK", "1"), ranks("OMPI_COMM_WORLD_SIZE", "4");
    EXPECT_EQ(namesAfter("mpi"), second);
    const Variable task("SLURM_ARRAY_TASK_ID", "7"), least("SLURM_ARRAY_TASK_MIN", "7"),
        count("SLURM_ARRAY_TASK_COUNT", "4");
    EXPECT_NE(namesAfter("slurm"), second) << "Slurm's array stands before a rank";
    EXPECT_EQ(namesAfter("flag_wins", {"--shard", "2/4"}), second);
}

TEST_F(Sweep, WrongShardsAreErrors) {
    const auto wrong = [&](const Arguments& more, const std::string& what) {
        const ProgramRun run = sweep("out", more);
        EXPECT_EQ(run.status, 2);
        ASSERT_EQ(lines(run.err).size(), 1u) << run.err;
        EXPECT_EQ(run.err.rfind("edgewise: error: " + what + ": ", 0), 0u) << run.err;
        EXPECT_FALSE(fs::exists(folder_ / "out"));
    };
    for (const char* shard : {"0/2", "3/2", "1", "1/0", "a/b", "-1/2", "1/2/3", ""})
        wrong({"--shard", shard}, "--shard");
    {
        const Variable rank("OMPI_COMM_WORLD_RANK", "2"), ranks("OMPI_COMM_WORLD_SIZE", "2");
        wrong({}, "OMPI_COMM_WORLD_RANK");
    }
    const Variable task("SLURM_ARRAY_TASK_ID", "4"), least("SLURM_ARRAY_TASK_MIN", "0");
    wrong({}, "SLURM_ARRAY_TASK_COUNT");
    const Variable count("SLURM_ARRAY_TASK_COUNT", "2");
    wrong({}, "SLURM_ARRAY_TASK_ID");  // an array with gaps
}

TEST_F(Sweep, ListsAllThatIsWrongBeforeAnythingRuns) {
    writeFile(
        folder_ / "study.toml",
        "scenes = ['nowhere.glb', 'scene.gltf']\nmethods = ['nsaa', 'warp', 'msaa:5', 'nsaa']\n"
        "filters = ['box', 'bax', {name = 'box', sigma = 1}]\nradii = [-1]\nsizes = ['8x', '8x8', '8x8']\n"
        "cameras = ['nobody']\nruns = 0\ncolour = 'red'\nbudget = 'much'\nshading = 'flat'\n");
    const ProgramRun run = sweep("out");
    EXPECT_EQ(run.status, 2);
    const std::vector<std::string> found = lines(run.err);
    for (const char* expected :
         {"1: scenes: nowhere.glb", "2: methods: method 'warp'", "2: methods: method 'msaa:5'",
          "2: methods: 'nsaa' is there already", "3: filters: filter 'bax'", "3: filters: filter 'box'",
          "4: radii: -1: ", "5: sizes: 8x: ", "5: sizes: '8x8' is there", "6: cameras: nobody: scene.gltf",
          "7: runs: ", "8: colour: ", "9: budget: ", "10: shading: "})
        EXPECT_EQ(std::ranges::count_if(found,
                                        [&](const std::string& line) {
                                            return line.starts_with("edgewise: error: study.toml:" +
                                                                    std::string(expected));
                                        }),
                  1)
            << expected << "\n"
            << run.err;
    EXPECT_EQ(found.size(), 14u) << run.err;
    EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(Sweep, TheShippedStudyIsOne) {
    const std::string study = (fs::path(EDGEWISE_TEST_DATA) / "studies/filters.toml").string();
    // fewer jobs than shards: this one has nothing to do but to read the study and its scenes
    const ProgramRun run = runProgram({"sweep", study, "-o", "out", "--shard", "1000/1000"}, folder_.path());
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("0 jobs made, 0 kept, 0 failed, of 12"), std::string::npos) << run.out;
}

TEST_F(Sweep, AFilterThatNoMethodTakesIsAnError) {
    writeFile(folder_ / "study.toml", "scenes = ['scene.gltf']\nmethods = ['none']\nradii = [1]\n");
    const ProgramRun run = sweep("out");
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find("study.toml:3: radii: "), std::string::npos) << run.err;
}

TEST_F(Sweep, PathsAreRelativeToTheStudy) {
    fs::create_directory(folder_ / "elsewhere");
    const ProgramRun run =
        runProgram({"sweep", "../study.toml", "-o", "out", "--shard", "1/4"}, folder_ / "elsewhere");
    EXPECT_EQ(run.status, 0) << run.err;
    fs::create_directory(folder_ / "studies");
    writeFile(folder_ / "studies/study.toml", kStudy);
    const ProgramRun missing = runProgram({"sweep", "studies/study.toml", "-o", "out"}, folder_.path());
    EXPECT_EQ(missing.status, 2);
    EXPECT_NE(missing.err.find("relative to it"), std::string::npos) << missing.err;
}

TEST_F(Sweep, MergingGivesTheSameBytesInAnyOrder) {
    for (const char* shard : {"1/3", "2/3", "3/3"})
        ASSERT_EQ(sweep(std::string("part") + shard[0], {"--shard", shard}).status, 0);
    ASSERT_EQ(sweep("none", {"--shard", "9/9"}).status, 0) << "more shards than jobs";
    const auto merge = [&](const Arguments& folders, const std::string& out) {
        Arguments arguments{"merge", "-o", out};
        arguments.insert(arguments.end(), folders.begin(), folders.end());
        const ProgramRun run = runProgram(arguments, folder_.path());
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_EQ(run.err, "");
    };
    merge({"part1", "part2", "part3"}, "abc");
    merge({"part3", "none", "part1", "part2"}, "cab");
    merge({"part1", "part2", "part1"}, "aba");
    merge({"part3", "aba", "part2"}, "nested");
    EXPECT_EQ(jobsIn("abc").size(), 4u);
    const auto names = namesIn(folder_ / "abc");
    for (const char* other : {"cab", "nested"}) {
        EXPECT_EQ(namesIn(folder_ / other), names);
        for (const std::string& name : names) {
            if (!fs::is_regular_file(folder_ / "abc" / name)) continue;
            EXPECT_EQ(readFile(folder_ / "abc" / name), readFile(folder_ / other / name)) << name;
        }
    }
    // and of the bytes that a sweep without shards would have, were its times the same
    ASSERT_EQ(sweep("abc", {"--resume"}).status, 0);
    EXPECT_EQ(readFile(folder_ / "abc/results.json"), readFile(folder_ / "cab/results.json"));
}

TEST_F(Sweep, MergingKeepsMachinesApart) {
    ASSERT_EQ(sweep("here", {"--shard", "1/2"}).status, 0);
    disguise("here", "there", [](auto& row) { row.at("seconds").at(0) = 1000.0; });
    const ProgramRun run = runProgram({"merge", "here", "there", "-o", "both"}, folder_.path());
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "") << "the errors are the same";
    const json results = resultsIn("both");
    ASSERT_EQ(results.at("machines").size(), 2u);
    std::map<std::string, std::size_t> rows;
    for (const json& row : results.at("rows")) {
        const std::string machine = row.at("machine");
        ++rows[machine];
        EXPECT_EQ(row.at("seconds").at("runs"), 1) << "nothing is pooled";
        EXPECT_EQ(row.at("seconds").at("median") == 1000.0,
                  results.at("machines").at(machine).at("host") == "elsewhere");
    }
    for (const auto& [machine, count] : rows) EXPECT_EQ(count, 4u) << machine;
    // neither is run again
    EXPECT_NE(sweep("both", {"--shard", "1/2", "--resume"}).out.find("0 jobs made, 2 kept"),
              std::string::npos);
    // only this machine's rows are made anew
    ASSERT_EQ(sweep("both", {"--shard", "1/2"}).status, 0);
    std::size_t elsewhere = 0;
    const json after = resultsIn("both");
    for (const json& row : after.at("rows")) elsewhere += row.at("seconds").at("median") == 1000.0;
    EXPECT_EQ(elsewhere, 4u);
    EXPECT_EQ(after.at("rows").size(), 8u);
}

TEST_F(Sweep, MergingWarnsOfErrorsThatDependOnTheMachine) {
    ASSERT_EQ(sweep("here", {"--shard", "1/4"}).status, 0);
    disguise("here", "there", [](auto& row) {
        if (row.at("method").template get<std::string>() == "none") row.at("error").at("rmse") = 0.5;
    });
    const ProgramRun run = runProgram({"merge", "here", "there", "-o", "both"}, folder_.path());
    EXPECT_EQ(run.status, 0);
    ASSERT_EQ(lines(run.err).size(), 1u) << run.err;
    EXPECT_NE(run.err.find("warning"), std::string::npos);
    EXPECT_NE(run.err.find("'none'"), std::string::npos) << run.err;
    EXPECT_EQ(resultsIn("both").at("disagreements").size(), 1u);
}

TEST_F(Sweep, MergingNamesEveryBadFolder) {
    ASSERT_EQ(sweep("good", {"--shard", "1/4"}).status, 0);
    fs::create_directories(folder_ / "empty");
    fs::copy(folder_ / "good", folder_ / "bad", fs::copy_options::recursive);
    writeFile(folder_ / ("bad/jobs/" + jobsIn("bad").begin()->first), "{}");
    const ProgramRun run =
        runProgram({"merge", "good", "empty", "nowhere", "bad", "-o", "out"}, folder_.path());
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(lines(run.err).size(), 3u) << run.err;
    for (const char* what : {"error: empty: ", "error: nowhere: ", "error: bad/jobs/"})
        EXPECT_NE(run.err.find(what), std::string::npos) << run.err;
    EXPECT_FALSE(fs::exists(folder_ / "out"));
    // what lies in -o must be among the folders
    fs::copy(folder_ / "good", folder_ / "other", fs::copy_options::recursive);
    EXPECT_EQ(runProgram({"merge", "good", "-o", "other"}, folder_.path()).status, 2);
    EXPECT_EQ(runProgram({"merge", "good", "other", "-o", "other"}, folder_.path()).status, 0);
}

}  // namespace
}  // namespace edgewise::test
