// A scene's hash follows its content: the file, and the files that it refers to.
#include <gtest/gtest.h>

#include <set>

#include "pipeline/error.h"
#include "pipeline/sweep/content_hash.h"
#include "tests/sweep/scratch.h"

namespace edgewise::sweep::test {
namespace {

// XXH3's 128 bits of no bytes, seed 0, as its specification prints them.
TEST(ContentHash, IsXxh3) {
    EXPECT_EQ(contentHash(""), "99aa06d3014798d86001c324468d497f");
    EXPECT_NE(contentHash("a"), contentHash("b"));
}

TEST(SceneHash, ChangesWithEveryFileOfTheScene) {
    const Scratch folder;
    const std::string gltf =
        R"({"asset":{"version":"2.0"},"buffers":[{"uri":"a%20b.bin","byteLength":3}],"images":[{"uri":"c.png"}]})";
    const std::string scene = folder.write("scene.gltf", gltf);
    std::set<std::string> seen;
    const auto fresh = [&] { return seen.insert(sceneHash(scene)).second; };
    EXPECT_TRUE(fresh());
    EXPECT_FALSE(fresh()) << "nothing has changed";
    folder.write("a b.bin", "abc");
    EXPECT_TRUE(fresh()) << "a buffer is there";
    folder.write("a b.bin", "abd");
    EXPECT_TRUE(fresh()) << "a buffer has changed";
    folder.write("c.png", "picture");
    EXPECT_TRUE(fresh()) << "a picture is there";
    folder.write("scene.gltf", gltf + " ");
    EXPECT_TRUE(fresh()) << "the file itself has changed";
    folder.write("other.bin", "abc");
    EXPECT_FALSE(fresh()) << "that is none of the scene's files";
    EXPECT_THROW(sceneHash(folder / "nowhere.gltf"), InputError);
}

}  // namespace
}  // namespace edgewise::sweep::test
