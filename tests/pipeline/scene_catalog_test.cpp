#include "pipeline/scene_catalog.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "data/generate/recipes.h"
#include "pipeline/error.h"
#include "pipeline/scene_folders.h"

namespace edgewise {
namespace {

namespace fs = std::filesystem;

std::string bytesOf(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

std::size_t filesBelow(const fs::path& folder) {
    std::size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        count += entry.is_regular_file() ? 1 : 0;
    return count;
}

/// A folder of its own a test, removed with it; nothing outside it is looked at.
class SceneCatalog : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "edgewise-test-XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        folder_ = name;
        options_ = {.data_folders = {{folder_ / "data"}},
                    .cache_folder = folder_ / "cache",
                    .share_folders = {{folder_ / "share"}}};
    }
    void TearDown() override { fs::remove_all(folder_); }

    void write(const fs::path& relative, const std::string& bytes = "x") {
        ASSERT_TRUE(writeWhole(folder_ / relative, bytes));
    }
    std::string refusal(const std::string& scene) {
        try {
            findScene(scene, options_);
        } catch (const InputError& error) {
            return error.what();
        }
        return "found";
    }

    fs::path folder_;
    CatalogOptions options_;
};

TEST_F(SceneCatalog, AnExistingFileIsItself) {
    write("mine.glb");
    EXPECT_EQ(findScene((folder_ / "mine.glb").string(), options_), folder_ / "mine.glb");
}

TEST_F(SceneCatalog, AShippedFileIsFoundInTheFirstFolderThatHasIt) {
    options_.data_folders = {folder_ / "empty", folder_ / "data", folder_ / "later"};
    write("data/zone-plate.glb");
    write("later/zone-plate.glb");
    EXPECT_EQ(findScene("zone-plate", options_), folder_ / "data/zone-plate.glb");
}

TEST_F(SceneCatalog, MakesWhatDoesNotShipOnceAndLeavesNothingElse) {
    const fs::path made = findScene("random-200k", options_);
    EXPECT_EQ(made.parent_path().parent_path(), folder_ / "cache");
    EXPECT_NE(made.string().find("scenes-" + scenes::generatorVersion()), std::string::npos);
    EXPECT_EQ(filesBelow(folder_ / "cache"), 1u);
    const auto first = fs::last_write_time(made);
    EXPECT_EQ(findScene("random-200k", options_), made);
    EXPECT_EQ(fs::last_write_time(made), first);
}

TEST_F(SceneCatalog, ACacheThatCannotBeWrittenIsAFailureAndLeavesNothing) {
    write("cache");  // a file where the folder should be
    try {
        findScene("random-2k", options_);
        FAIL() << "made in a file";
    } catch (const FailureError& error) {
        EXPECT_NE(std::string(error.what()).find("EDGEWISE_CACHE"), std::string::npos) << error.what();
    }
    EXPECT_EQ(filesBelow(folder_), 1u);
}

TEST_F(SceneCatalog, FindsTheEngineInItsUsualPlaceOrBelow) {
    EXPECT_EQ(
        refusal("engine"),
        "engine: no such file or scene; 2CylinderEngine.glb comes with Debian's package assimp-testmodels");
    write("share/assimp/models/glTF2/z/2CylinderEngine.glb");
    EXPECT_EQ(findScene("engine", options_), folder_ / "share/assimp/models/glTF2/z/2CylinderEngine.glb");
    const fs::path usual = "share/assimp/models/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb";
    write(usual);
    EXPECT_EQ(findScene("engine", options_), folder_ / usual);
}

TEST_F(SceneCatalog, RefusesWhatItDoesNotKnowWithAHint) {
    EXPECT_EQ(refusal("torus-20"),
              "torus-20: no such file or scene; did you mean torus-20k? `edgewise scenes` lists the names");
    EXPECT_EQ(refusal("nowhere/model.glb"),
              "nowhere/model.glb: no such file or scene; `edgewise scenes` lists the names");
    EXPECT_EQ(refusal("menger-3"), "menger-3: its file is in no data folder; set EDGEWISE_DATA");
    EXPECT_EQ(refusal("menger-2"),
              "menger-2: no such file or scene; did you mean menger-3? `edgewise scenes` lists the names");
    EXPECT_EQ(refusal(folder_.string()), folder_.string() + ": a folder, not a scene file");
    EXPECT_EQ(refusal(""), "SCENE: no such file or scene; `edgewise scenes` lists the names");
    EXPECT_EQ(refusal(std::string(100000, 'x')).substr(100000),
              ": no such file or scene; `edgewise scenes` lists the names");
}

TEST_F(SceneCatalog, ListsEveryNameAndMakesNothing) {
    write("data/log-grid.glb");
    std::string names;
    for (const SceneInfo& scene : sceneNames(options_)) {
        names += scene.name + " ";
        EXPECT_FALSE(scene.what.empty());
        if (scene.name == "log-grid")
            EXPECT_EQ(scene.where, (folder_ / "data/log-grid.glb").string());
        else if (scene.name == "engine")
            EXPECT_EQ(scene.where.substr(0, 9), "not found");
        else
            EXPECT_TRUE(scene.where == "made on demand" || scene.where == "not found: in no data folder")
                << scene.where;
    }
    EXPECT_EQ(
        names,
        "zone-plate log-grid torus-sequence torus-20k torus-200k torus-1m random-2k random-20k "
        "random-200k engine primitives random-box random-shape sparse-shape atrium jewel city path-room "
        "convex thin blob gyroid menger-3 sphere-minus-box spheres-50 spheres-1000 wires slabs ");
    EXPECT_FALSE(fs::exists(folder_ / "cache"));
}

TEST_F(SceneCatalog, TheEnvironmentSaysWhereToLook) {
    setenv("EDGEWISE_DATA", "/a", 1);
    setenv("EDGEWISE_CACHE", "/b", 1);
    setenv("XDG_DATA_HOME", "/c", 1);
    setenv("XDG_DATA_DIRS", "/d::/e", 1);
    EXPECT_EQ(defaultDataFolders().front(), "/a");
    EXPECT_EQ(defaultCacheFolders(), std::vector<fs::path>{"/b"});
    EXPECT_EQ(defaultShareFolders(),
              (std::vector<fs::path>{"/c", "/d", "/e", "/usr/local/share", "/usr/share"}));
    unsetenv("EDGEWISE_CACHE");
    setenv("XDG_CACHE_HOME", "/f", 1);
    EXPECT_EQ(defaultCacheFolders().front(), "/f/edgewise");
    for (const char* name : {"EDGEWISE_DATA", "XDG_CACHE_HOME", "XDG_DATA_HOME", "XDG_DATA_DIRS"})
        unsetenv(name);
}

TEST_F(SceneCatalog, EveryShippedFileIsWhatTheGeneratorMakes) {
    const fs::path data = defaultDataFolders().back();
    std::size_t compared = 2;  // with the manifest and the schema, which sdf_tests compare
    for (const auto* recipes :
         {&scenes::namedRecipes(), &scenes::sdfRecipes(), &scenes::degenerateRecipes()}) {
        for (const auto& recipe : *recipes) {
            if (!recipe.ships) continue;
            ++compared;
            if (!recipe.bytes) {
                EXPECT_TRUE(fs::is_regular_file(data / recipe.file)) << recipe.file;
                continue;
            }
            EXPECT_TRUE(bytesOf(data / recipe.file) == recipe.bytes())
                << recipe.file << ": run make_scenes data";
        }
    }
    EXPECT_EQ(bytesOf(data / "MANIFEST.md"), scenes::manifest());
    EXPECT_EQ(compared + filesBelow(data / "generate") + filesBelow(data / "studies"), filesBelow(data))
        << "a scene of data/ has no recipe";
}

}  // namespace
}  // namespace edgewise
