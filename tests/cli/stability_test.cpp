// The stability study as a user runs it.
#include <gtest/gtest.h>

#include "tests/cli/run_program.h"

namespace edgewise::test {
namespace {

bool hasStability() {
    return runProgram({"--help"}).out.find("\n  stability") != std::string::npos;
}

TEST(StabilityCommand, WritesFourFilesOrNone) {
    if (!hasStability()) GTEST_SKIP() << "built without the oracle";
    const TemporaryFolder folder;
    const ProgramRun done = runProgram(
        {"stability", "-o", "out", "--case", "touching", "--filter", "box", "--scenes", "1"}, folder.path());
    EXPECT_EQ(done.status, 0) << done.err;
    EXPECT_EQ(done.err, "");
    for (const char* name : {"results.json", "results.csv", "table.tex", "stability.html"})
        EXPECT_FALSE(readFile(folder.path() / "out" / name).empty()) << name;
}

TEST(StabilityCommand, CtrlCEndsWith130AndLeavesNothing) {
    if (!hasStability()) GTEST_SKIP() << "built without the oracle";
    const TemporaryFolder folder;
    const ProgramRun run = runProgram({"stability", "-o", "out", "--scenes", "1000"}, folder.path(), 1000);
    EXPECT_EQ(run.status, 130) << run.err;
    EXPECT_TRUE(folder.names().empty());
}

TEST(StabilityCommand, WrongOnesAreOneLineAndLeaveNothing) {
    if (!hasStability()) GTEST_SKIP() << "built without the oracle";
    const TemporaryFolder folder;
    writeFile(folder / "file", "x");
    for (const Arguments& wrong :
         {Arguments{"stability", "-o", "out", "--case", "nope"},
          Arguments{"stability", "-o", "out", "--filter", "soft"},
          Arguments{"stability", "-o", "out", "--scenes", "0"}, Arguments{"stability", "-o", "file/x"}}) {
        const ProgramRun run = runProgram(wrong, folder.path());
        EXPECT_EQ(run.status, 2) << run.err;
        EXPECT_EQ(lines(run.err).size(), 1u) << run.err;
        EXPECT_EQ(folder.names(), std::vector<std::string>{"file"});
    }
}

}  // namespace
}  // namespace edgewise::test
