// A figure's folder: what is made, what is used again, and what failures leave.
#include "paper_figures/make_figure.h"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "paper_figures/claims_table.h"
#include "pipeline/error.h"
#include "pipeline/scoped_path.h"

namespace edgewise::figures {
namespace {

namespace fs = std::filesystem;

int calls = 0;

std::vector<FigureFile> makeGood(const FigureInput& input) {
    ++calls;
    input.claims.push_back({"Table 1", "a <ratio>", "1.30", "1.2\"5", "", "other, machine"});
    return {{"report.html", "<html>"}, {input.quick ? "small.csv" : "large.csv", "a,b\n"}};
}
std::vector<FigureFile> makeFailure(const FigureInput&) {
    throw FailureError("device", "is not there");
}
std::vector<FigureFile> makeSurprise(const FigureInput&) {
    throw std::out_of_range("vector");
}
std::vector<FigureFile> makeInterrupted(const FigureInput&) {
    throw Interrupted();
}

const Figure kGood{"good", "a paper", "what", makeGood};

std::string textOf(const fs::path& path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
}
void write(const fs::path& path, const std::string& text) {
    std::ofstream(path) << text;
}

class MakeFigure : public testing::Test {
  protected:
    MadeFigure make(const Figure& figure, const FigureSource& source) {
        return makeFigure(figure, source, folder_.path(), quiet_);
    }
    void SetUp() override { calls = 0; }
    const ScopedPath folder_ = temporaryFolder();
    Progress quiet_;
};

TEST_F(MakeFigure, IsUsedAgainWithItsClaims) {
    const MadeFigure first = make(kGood, {"p", true}), second = make(kGood, {"p", true});
    EXPECT_EQ(calls, 1);
    EXPECT_FALSE(first.reused);
    EXPECT_TRUE(second.reused);
    EXPECT_EQ(second.page, "good/report.html");
    EXPECT_EQ(second.seconds, first.seconds);
    ASSERT_EQ(second.claims.size(), 1u);
    EXPECT_EQ(second.claims[0].ours, "1.2\"5");
    EXPECT_EQ(second.claims[0].why, "other, machine");
}

TEST_F(MakeFigure, IsMadeAgainForAnotherSourceAndOldFilesGo) {
    make(kGood, {"p", true});
    EXPECT_TRUE(fs::exists(folder_.path() / "small.csv"));
    write(folder_.path() / "notes.txt", "mine");
    make(kGood, {"p", false});
    EXPECT_EQ(calls, 2);
    EXPECT_FALSE(fs::exists(folder_.path() / "small.csv"));
    EXPECT_TRUE(fs::exists(folder_.path() / "large.csv"));
    EXPECT_EQ(textOf(folder_.path() / "notes.txt"), "mine");  // nobody else's files
    make(kGood, {"another program", false});
    EXPECT_EQ(calls, 3);
}

TEST_F(MakeFigure, IsMadeAgainWhereAFileIsNotWhatItWas) {
    const FigureSource source{"p", true};
    make(kGood, source);
    write(folder_.path() / "small.csv", "a,c\n");
    make(kGood, source);
    EXPECT_EQ(calls, 2);
    EXPECT_EQ(textOf(folder_.path() / "small.csv"), "a,b\n");
    fs::remove(folder_.path() / "report.html");
    make(kGood, source);
    EXPECT_EQ(calls, 3);
    for (const char* broken : {"", "{", "[]", "{\"program\":1}", "null"}) {
        write(folder_.path() / kStampFile, broken);
        EXPECT_FALSE(make(kGood, source).reused) << broken;
    }
}

TEST_F(MakeFigure, StampsNameNoFilesElsewhere) {
    const ScopedPath other = temporaryFolder();
    write(other.path() / "precious", "x");
    const FigureStamp stamp =
        stampOf({"p", true}, 1.0, {{"../" + other.path().filename().string() + "/precious", "x"}}, {});
    write(folder_.path() / kStampFile, stampText(stamp));
    EXPECT_FALSE(readStamp(folder_.path()));
    make(kGood, {"p", true});
    EXPECT_TRUE(fs::exists(other.path() / "precious"));
}

TEST_F(MakeFigure, FailuresSaySoAndLeaveTheFolder) {
    make(kGood, {"p", true});
    const std::string before = textOf(folder_.path() / kStampFile);
    const MadeFigure failed = make({"bad", "a paper", "what", makeFailure}, {"p", false});
    EXPECT_EQ(failed.page, "");
    EXPECT_EQ(failed.why, "device: is not there");
    EXPECT_EQ(make({"worse", "a paper", "what", makeSurprise}, {"p", false}).why, "vector");
    EXPECT_THROW(make({"stopped", "a paper", "what", makeInterrupted}, {"p", false}), Interrupted);
    EXPECT_EQ(textOf(folder_.path() / kStampFile), before);
}

TEST(IndexPage, ShowsPagesFailuresAndClaims) {
    const Figure bad{"bad", "a paper", "what", makeFailure};
    MadeFigure made{&kGood, "good/report.html", ""};
    made.claims = {{"Table 1", "a <ratio>", "1.30", "1.2\"5", "ms", "other, machine"},
                   {"Table 2", "speed", "near-interactive", "7", "1/s", ""}};
    const std::vector<MadeFigure> all{made, {&bad, "", "device: <none>"}};
    const std::string html = indexHtml(all);
    for (const char* part : {"href='good/report.html'", "device: &lt;none&gt;", "a &lt;ratio&gt;", "1.30 ms",
                             "1.2&quot;5 ms", "other, machine", "near-interactive<", "7 1/s"})
        EXPECT_NE(html.find(part), std::string::npos) << part;
    EXPECT_EQ(indexCsv(all),
              "figure,of,place,claim,paper,ours,unit,why\n"
              "good,a paper,Table 1,a <ratio>,1.30,\"1.2\"\"5\",ms,\"other, machine\"\n"
              "good,a paper,Table 2,speed,near-interactive,7,1/s,\n");
}

}  // namespace
}  // namespace edgewise::figures
