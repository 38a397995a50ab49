#include "pipeline/cryptomatte.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "pipeline/json_text.h"
#include "pipeline/project.h"

namespace edgewise {
namespace {

std::uint32_t scrambled(std::uint32_t block) {
    return std::rotl(block * 0xcc9e2d51u, 15) * 0x1b873593u;
}

/// Up to four bytes, the first the lowest.
std::uint32_t littleEndian(std::string_view bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
        value |= std::uint32_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
    return value;
}

/// By index: the file's name, or KIND_INDEX; later namesakes get their index behind it until nothing else is
/// called so.
std::vector<std::string> uniqueNames(const std::vector<std::string>& names, const char* kind) {
    std::set<std::string> taken;
    std::vector<std::string> unique(names.size());
    for (std::size_t i = 0; i < names.size(); ++i)
        if (!names[i].empty() && taken.insert(names[i]).second) unique[i] = names[i];
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (!unique[i].empty()) continue;
        unique[i] = fmt::format("{}_{}", names[i].empty() ? kind : names[i], i);
        while (!taken.insert(unique[i]).second) unique[i] += "_";
    }
    return unique;
}

std::uint32_t idOf(const std::string& name) {
    return cryptomatteIdBits(murmurHash3(name));
}

struct IdWeight {
    std::uint32_t id;
    FixedWeight weight;
};

/// Sorted by id, each once.
void sumEqualIds(std::vector<IdWeight>& weights) {
    std::ranges::sort(weights, {}, &IdWeight::id);
    std::size_t kept = 0;
    for (const IdWeight& w : weights) {
        if (kept > 0 && weights[kept - 1].id == w.id)
            weights[kept - 1].weight += w.weight;
        else
            weights[kept++] = w;
    }
    weights.resize(kept);
    std::erase_if(weights, [](const IdWeight& w) { return w.weight == 0; });
}

}  // namespace

std::uint32_t murmurHash3(std::string_view bytes, std::uint32_t seed) {
    std::uint32_t hash = seed;
    std::size_t at = 0;
    for (; at + 4 <= bytes.size(); at += 4)
        hash = std::rotl(hash ^ scrambled(littleEndian(bytes.substr(at, 4))), 13) * 5u + 0xe6546b64u;
    hash ^= scrambled(littleEndian(bytes.substr(at)));
    hash ^= static_cast<std::uint32_t>(bytes.size());
    hash = (hash ^ (hash >> 16)) * 0x85ebca6bu;
    hash = (hash ^ (hash >> 13)) * 0xc2b2ae35u;
    return hash ^ (hash >> 16);
}

std::uint32_t cryptomatteIdBits(std::uint32_t hash) {
    constexpr std::uint32_t kExponent = 0xffu << 23;
    const std::uint32_t exponent = hash & kExponent;
    return exponent == 0 || exponent == kExponent ? hash ^ (1u << 23) : hash;
}

CryptomatteLayer CryptomatteLayer::ofObjects(const Scene& scene) {
    std::vector<std::string> names = scene.node_names;
    for (const Geometry& geometry : scene.geometry)
        names.resize(std::max<std::size_t>(names.size(), geometry.node + 1));
    names = uniqueNames(names, "node");
    CryptomatteLayer layer;
    layer.name_ = "CryptoObject";
    for (const Geometry& geometry : scene.geometry) {
        layer.id_of_geometry_.push_back(idOf(names[geometry.node]));
        layer.manifest_[names[geometry.node]] = layer.id_of_geometry_.back();
    }
    return layer;
}

CryptomatteLayer CryptomatteLayer::ofMaterials(const Scene& scene) {
    std::vector<std::string> names;
    for (const Material& material : scene.materials) names.push_back(material.name);
    names = uniqueNames(names, "material");
    CryptomatteLayer layer;
    layer.name_ = "CryptoMaterial";
    for (const Geometry& geometry : scene.geometry) {
        layer.id_of_geometry_.push_back(idOf(names[geometry.material]));
        layer.manifest_[names[geometry.material]] = layer.id_of_geometry_.back();
    }
    return layer;
}

void CryptomatteLayer::describe(AovImage& image) const {
    for (int i = 0; i < kCryptomatteLayers; ++i)
        for (const char* channel : {"red", "green", "blue", "alpha"})
            image.channels.push_back({fmt::format("{}{:02}.{}", name_, i, channel)});
    nlohmann::json manifest = nlohmann::json::object();
    for (const auto& [name, id] : manifest_) manifest[name] = fmt::format("{:08x}", id);
    const std::string key = "cryptomatte/" + fmt::format("{:08x}", murmurHash3(name_)).substr(0, 7);
    image.metadata[key + "/name"] = name_;
    image.metadata[key + "/hash"] = "MurmurHash3_32";
    image.metadata[key + "/conversion"] = "uint32_to_float32";
    // A file may hold names that are no UTF-8.
    image.metadata[key + "/manifest"] = jsonText(manifest);
}

bool CryptomatteLayer::rank(const Scene& scene, std::span<const OwnerWeight> owners,
                            std::uint32_t* channels) const {
    thread_local std::vector<IdWeight> weights;
    weights.clear();
    for (const OwnerWeight& entry : owners)
        if (entry.owner != kBackground)
            weights.push_back({id_of_geometry_[findTriangle(scene, entry.owner).geometry], entry.weight});
    sumEqualIds(weights);
    std::ranges::stable_sort(weights, std::greater{}, [](const IdWeight& w) { return std::abs(w.weight); });
    for (std::size_t i = 0; i < kCryptomatteRanks; ++i) {
        const IdWeight w = i < weights.size() ? weights[i] : IdWeight{0, 0};
        channels[2 * i] = w.id;
        channels[2 * i + 1] = floatBits(std::ldexp(static_cast<double>(w.weight), -kWeightBits));
    }
    return weights.size() <= kCryptomatteRanks;
}

}  // namespace edgewise
