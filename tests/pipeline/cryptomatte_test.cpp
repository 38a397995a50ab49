// Cryptomatte: the hash against its author's check value, ids against the values that the format's authors
// publish, ranks of pixels made by hand.
#include "pipeline/cryptomatte.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/pipeline/test_scene.h"

namespace edgewise {
namespace {

float idOf(const std::string& name) {
    return std::bit_cast<float>(cryptomatteIdBits(murmurHash3(name)));
}

// Appleby's own check of an implementation: the hashes of 0 .. i - 1 with seed 256 - i, hashed.
TEST(MurmurHash3, HasItsAuthorsVerificationValue) {
    std::string key, hashes;
    for (std::uint32_t i = 0; i < 256; ++i) {
        const std::uint32_t hash = murmurHash3(key, 256 - i);
        for (int byte = 0; byte < 4; ++byte) hashes += static_cast<char>((hash >> (8 * byte)) & 0xffu);
        key += static_cast<char>(i);
    }
    EXPECT_EQ(murmurHash3(hashes), 0xb0f57ee3u);
}

TEST(Cryptomatte, IdsAreThePublishedOnes) {
    EXPECT_EQ(idOf("hello"), 6.0705627102400005616e-17f);
    EXPECT_EQ(idOf("cube"), -4.08461912519e+15f);
    EXPECT_EQ(idOf("sphere"), 2.79018604383e+15f);
    EXPECT_EQ(idOf("plane"), 3.66557617593e-11f);
    EXPECT_EQ(idOf("\xd1\x80\xd0\xb0\xd0\xb2\xd0\xbd\xd0\xb8\xd0\xbd\xd0\xb0"), -1.3192631212399999468e-25f);
    EXPECT_EQ(idOf("m\xc3\xa4"
                   "dchen"),
              6.2361298211599995797e+25f);
}

// The exponents that no number may have are 0 and 255; the other bits stay.
TEST(Cryptomatte, NoIdIsASubnormalAnInfinityOrNotANumber) {
    for (const std::uint32_t mantissa : {0u, 1u, 0x7fffffu})
        for (const std::uint32_t sign : {0u, 1u})
            for (std::uint32_t exponent = 0; exponent < 256; ++exponent) {
                const std::uint32_t hash = sign << 31 | exponent << 23 | mantissa;
                const std::uint32_t id = cryptomatteIdBits(hash);
                const std::uint32_t expected = exponent == 0 ? 1 : (exponent == 255 ? 254 : exponent);
                EXPECT_TRUE(std::isnormal(std::bit_cast<float>(id)));
                EXPECT_EQ(id, sign << 31 | expected << 23 | mantissa);
            }
}

/// A triangle a node, with a material each; where they lie does not matter.
Scene sceneOfNodes(const std::vector<std::string>& names) {
    std::vector<Geometry> geometry(
        names.size(),
        test::makeGeometry({test::Corners{glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)}}));
    Scene scene = test::makeScene(geometry);
    scene.node_names = names;
    scene.materials.resize(names.size(), scene.materials[0]);
    for (std::uint32_t i = 0; i < names.size(); ++i) scene.geometry[i].material = i;
    return scene;
}

TEST(Cryptomatte, NamesAreUniqueAndNeverEmpty) {
    const Scene scene = sceneOfNodes({"wheel", "", "wheel", "wheel_2", "node_1", "wheel"});
    const CryptomatteLayer objects = CryptomatteLayer::ofObjects(scene);
    std::vector<std::string> names;
    for (const auto& [name, id] : objects.manifest()) {
        names.push_back(name);
        EXPECT_EQ(id, cryptomatteIdBits(murmurHash3(name)));
    }
    EXPECT_EQ(names,
              (std::vector<std::string>{"node_1", "node_1_", "wheel", "wheel_2", "wheel_2_", "wheel_5"}));
    EXPECT_EQ(CryptomatteLayer::ofMaterials(scene).manifest().size(), 6u);
    EXPECT_TRUE(CryptomatteLayer::ofMaterials(scene).manifest().contains("material_3"));
}

TEST(Cryptomatte, ChannelsAndMetadataFollowTheFormat) {
    AovImage image;
    CryptomatteLayer::ofObjects(sceneOfNodes({"cube", "\xff"})).describe(image);
    ASSERT_EQ(image.channels.size(), 12u);
    EXPECT_EQ(image.channels[0].name, "CryptoObject00.red");
    EXPECT_EQ(image.channels[11].name, "CryptoObject02.alpha");
    ASSERT_EQ(image.metadata.size(), 4u);
    const std::string key = image.metadata.begin()->first.substr(0, 19);
    EXPECT_EQ(key, "cryptomatte/3ae39a5");  // as other renderers' files have it for a layer of this name
    EXPECT_EQ(image.metadata.at(key + "/name"), "CryptoObject");
    EXPECT_EQ(image.metadata.at(key + "/hash"), "MurmurHash3_32");
    EXPECT_EQ(image.metadata.at(key + "/conversion"), "uint32_to_float32");
    const auto manifest = nlohmann::json::parse(image.metadata.at(key + "/manifest"));
    EXPECT_EQ(std::bit_cast<float>(static_cast<std::uint32_t>(
                  std::stoul(manifest.at("cube").get<std::string>(), nullptr, 16))),
              idOf("cube"));
}

FixedWeight part(double weight) {
    return static_cast<FixedWeight>(std::ldexp(weight, kWeightBits));
}

struct Ranked {
    bool complete;
    std::vector<float> values;
};

Ranked rank(const Scene& scene, const std::vector<OwnerWeight>& owners) {
    std::uint32_t words[2 * kCryptomatteRanks];
    Ranked ranked{CryptomatteLayer::ofObjects(scene).rank(scene, owners, words), {}};
    for (const std::uint32_t word : words) ranked.values.push_back(std::bit_cast<float>(word));
    return ranked;
}

TEST(Cryptomatte, TheLargestCoverageComesFirstAndTheBackgroundHasNone) {
    const Scene scene = sceneOfNodes({"a", "b", "c"});
    const Ranked ranked =
        rank(scene, {{0, part(0.125)}, {1, part(0.5)}, {2, part(0.25)}, {kBackground, part(0.125)}});
    EXPECT_TRUE(ranked.complete);
    EXPECT_EQ(ranked.values,
              (std::vector<float>{idOf("b"), 0.5f, idOf("c"), 0.25f, idOf("a"), 0.125f, 0, 0, 0, 0, 0, 0}));
}

// Rounded apart, 2^-30 would vanish beside 0.5; summed exactly first, the parts of one node are just 0.5.
TEST(Cryptomatte, PartsOfAnObjectAreSummedBeforeTheyAreRounded) {
    Scene scene = sceneOfNodes({"a", "b", "b"});
    scene.geometry[2].node = 1;
    const Ranked ranked = rank(scene, {{0, part(0.5)}, {1, part(0.5) + part(0x1p-30)}, {2, -part(0x1p-30)}});
    EXPECT_EQ(ranked.values[1], 0.5f);
    EXPECT_EQ(ranked.values[3], 0.5f);
    const Ranked gone = rank(scene, {{0, part(1)}, {1, part(0.25)}, {2, -part(0.25)}});
    EXPECT_EQ(gone.values[2], 0.0f);  // nothing is left of b
}

TEST(Cryptomatte, NegativeCoveragesStayAndRankBySize) {
    const Ranked ranked = rank(sceneOfNodes({"a", "b"}), {{0, part(-0.25)}, {1, part(0.125)}});
    EXPECT_EQ(ranked.values[0], idOf("a"));
    EXPECT_EQ(ranked.values[1], -0.25f);
    EXPECT_EQ(ranked.values[3], 0.125f);
}

TEST(Cryptomatte, BeyondTheRanksTheSmallestAreLeftOutAndItSaysSo) {
    const Scene scene = sceneOfNodes({"a", "b", "c", "d", "e", "f", "g"});
    std::vector<OwnerWeight> owners;
    for (Owner i = 0; i < 7; ++i) owners.push_back({i, part(0.0625 * (1 + (i * 3) % 7))});
    const Ranked ranked = rank(scene, owners);
    EXPECT_FALSE(ranked.complete);
    for (int i = 0; i < kCryptomatteRanks; ++i)
        EXPECT_EQ(ranked.values[static_cast<std::size_t>(2 * i + 1)], static_cast<float>(0.0625 * (7 - i)));
    owners.pop_back();
    EXPECT_TRUE(rank(scene, owners).complete);
}

}  // namespace
}  // namespace edgewise
