// report.html as a reader has it: opened from disk in headless Chromium, where that is installed.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/run_program.h"

namespace edgewise::test {
namespace {

using nlohmann::json;

/// Uses the page and leaves what it saw in an element of its own.
constexpr const char* kProbe = R"js(<script>
addEventListener("load", () => setTimeout(() => {
  const canvas = document.querySelector(".view canvas");
  const pixels = () => {
    let hash = 0;
    for (const character of canvas.toDataURL()) hash = (hash * 31 + character.charCodeAt(0)) | 0;
    return hash;
  };
  const look = () => ({name: document.querySelector(".view b").textContent, pixels: pixels(),
                       zoom: document.getElementById("zoom").textContent});
  const click = (id) => document.getElementById(id).click();
  const choose = (id, value) => {
    document.getElementById(id).value = value;
    document.getElementById(id).dispatchEvent(new Event("change"));
  };
  const methods = () => [...document.querySelectorAll("tbody tr")].map((row) => row.cells[0].textContent);
  const seen = {two: look()};
  click("side"); seen.one = look();
  click("flip"); seen.flipped = look();
  click("flip"); seen.back = look();
  click("pixels"); seen.close = look();
  click("whole"); seen.whole = look();
  choose("kind", "signed"); choose("left", "1");
  seen.methods = methods();
  const rmse = [...document.querySelectorAll("th")].find((header) => header.textContent === "RMSE");
  rmse.click(); seen.rising = methods();
  rmse.click(); seen.falling = methods();
  setTimeout(() => {
    seen.error = look();
    const note = document.createElement("pre");
    note.textContent = "PROBE" + JSON.stringify(seen) + "PROBE";
    document.body.append(note);
  }, 500);
}, 500));
</script></html>)js";

TEST(ReportInBrowser, FlipsZoomsAndSorts) {
    const TemporaryFolder folder;
    if (runOther("chromium", {"--version"}, folder.path()).status != 0)
        GTEST_SKIP() << "chromium is not installed";
    const ProgramRun made =
        runProgram({"compare", "torus-20k", "-o", ".", "--size", "64x64", "--device", "cpu", "--runs", "1",
                    "--method", "ssaa:2", "--method", "none", "--method", "nsaa"},
                   folder.path());
    ASSERT_EQ(made.status, 0) << made.err;
    std::string page = readFile(folder / "report.html");
    const std::size_t end = page.rfind("</html>");
    ASSERT_NE(end, std::string::npos);
    writeFile(folder / "probed.html", page.substr(0, end) + kProbe);

    const ProgramRun browser =
        runOther("chromium",
                 {"--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                  "--user-data-dir=" + (folder / "profile").string(), "--enable-logging=stderr",
                  "--window-size=1400,2000", "--virtual-time-budget=20000", "--dump-dom",
                  "file://" + (folder / "probed.html").string()},
                 folder.path());
    ASSERT_EQ(browser.status, 0) << browser.err;
    EXPECT_EQ(browser.err.find("CONSOLE"), std::string::npos) << browser.err;
    const std::size_t from = browser.out.rfind("<pre>PROBE") + 10, to = browser.out.rfind("PROBE</pre>");
    ASSERT_LT(from, to) << "the page's script did not end";
    const json seen = json::parse(browser.out.substr(from, to - from));

    EXPECT_EQ(seen.at("two").at("name"), "reference: nsaa,device=cpu");
    EXPECT_NE(seen.at("one").at("zoom"), seen.at("two").at("zoom")) << "one picture has the room of two";
    EXPECT_EQ(seen.at("flipped").at("name"), "none");
    EXPECT_NE(seen.at("flipped").at("pixels"), seen.at("one").at("pixels"));
    EXPECT_EQ(seen.at("back"), seen.at("one"));
    EXPECT_EQ(seen.at("close").at("zoom"), "800 %");
    EXPECT_EQ(seen.at("whole"), seen.at("one"));
    EXPECT_EQ(seen.at("error").at("name"), "ssaa:2, signed error");
    EXPECT_NE(seen.at("error").at("pixels"), seen.at("one").at("pixels"));
    EXPECT_EQ(seen.at("methods"), json({"ssaa:2", "none", "nsaa"}));
    EXPECT_EQ(seen.at("rising"), json({"nsaa", "ssaa:2", "none"}));
    EXPECT_EQ(seen.at("falling"), json({"none", "ssaa:2", "nsaa"}));
}

}  // namespace
}  // namespace edgewise::test
