// A study's text: values with their lines, and every problem at once.
#include <gtest/gtest.h>

#include <fstream>

#include "pipeline/error.h"
#include "pipeline/sweep/study_file.h"
#include "tests/sweep/scratch.h"

namespace edgewise::sweep::test {
namespace {

class StudyFileTest : public ::testing::Test {
  protected:
    StudyFile read(const std::string& text) {
        folder_.write("study.toml", text);
        return readStudyFile(path_, problems_);
    }
    bool found(const std::string& message) const {
        for (const std::string& each : problems_.messages())
            if (each.find(message) != std::string::npos) return true;
        return false;
    }

    Scratch folder_;
    std::string path_ = folder_ / "study.toml";
    StudyProblems problems_{"study.toml"};
};

TEST_F(StudyFileTest, GivesEveryValueItsLine) {
    const StudyFile study = read(
        "scenes = [\n  'a.glb',\n  'b.glb',\n]\nmethods = ['nsaa']\nradii = [2, 0.1]\nruns = 3\n"
        "background = [0, 0.5, 1]\nfilters = ['box', {name = 'gaussian', sigma = 0.5}]\n"
        "cameras = [1, 'front', {eye = [0, 0, 5], fovy = 30}]\n");
    EXPECT_TRUE(problems_.empty());
    ASSERT_EQ(study.list("scenes").size(), 2u);
    EXPECT_EQ(study.list("scenes")[1].text, "b.glb");
    EXPECT_EQ(study.list("scenes")[1].line, 3);
    EXPECT_EQ(study.list("radii")[0].text, "2");
    EXPECT_EQ(study.list("radii")[1].text, "0.1") << "the shortest text that reads back";
    EXPECT_EQ(study.option("runs"), "3");
    EXPECT_EQ(study.option("background"), "0,0.5,1");
    EXPECT_EQ(study.option("budget"), std::nullopt);
    ASSERT_EQ(study.filters.size(), 2u);
    EXPECT_EQ(study.filters[1].sigma->text, "0.5");
    EXPECT_FALSE(study.filters[1].radius);
    ASSERT_EQ(study.cameras.size(), 3u);
    EXPECT_EQ(study.cameras[0].camera, "1");
    EXPECT_EQ(study.cameras[2].label, "eye 0,0,5 fovy 30");
    EXPECT_EQ(study.cameras[2].line, 10);
}

TEST_F(StudyFileTest, NamesEveryProblemAtItsLine) {
    read("scenes = []\nruns = 2.5\nfilters = [3]\ncolour = 1\nsizes = 'all'\ncameras = [{eye = 1}]\n");
    for (const char* message :
         {"study.toml:1: methods: is missing", "study.toml:1: scenes: is an empty list",
          "study.toml:2: runs: must be a whole number", "study.toml:3: filters: must be",
          "study.toml:4: colour: is no key", "study.toml:5: sizes: is not a list",
          "study.toml:6: cameras.eye: must be three numbers"})
        EXPECT_TRUE(found(message)) << message;
    EXPECT_EQ(problems_.messages().size(), 7u);
}

TEST_F(StudyFileTest, WhatIsNoTomlIsOneErrorWithItsLine) {
    try {
        read("scenes = ['a']\nmethods = [\n'nsaa'\nruns = 1\n");
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("study.toml:4: "), std::string::npos) << error.what();
    }
    EXPECT_THROW(read("runs = 1\nruns = 2\n"), InputError) << "a key twice";
    EXPECT_THROW(readStudyFile(folder_ / "nowhere.toml", problems_), InputError);
    EXPECT_THROW(readStudyFile(folder_.path(), problems_), InputError) << "a folder";
}

}  // namespace
}  // namespace edgewise::sweep::test
