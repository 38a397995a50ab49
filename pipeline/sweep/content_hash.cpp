#include "pipeline/sweep/content_hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <memory>
#include <span>

#include "pipeline/gltf_document.h"
#include "pipeline/gltf_files.h"
#include "pipeline/read_file.h"

namespace edgewise::sweep {
namespace {

class Hasher {
  public:
    Hasher() : state_(XXH3_createState(), XXH3_freeState) { XXH3_128bits_reset(state_.get()); }

    /// The length goes first, so that no two lists of parts look alike.
    void add(std::span<const std::uint8_t> part) {
        const std::string length = fmt::format("{} ", part.size());
        XXH3_128bits_update(state_.get(), length.data(), length.size());
        XXH3_128bits_update(state_.get(), part.data(), part.size());
    }

    std::string digits() const { return digitsOf(XXH3_128bits_digest(state_.get())); }

    static std::string digitsOf(XXH128_hash_t hash) {
        return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
    }

  private:
    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
};

void addFilesOfGltf(Hasher& hasher, const std::filesystem::path& path) {
    const GltfDocument document = readGltfDocument(path);
    for (const char* section : {"buffers", "images"}) {
        if (!document.root.contains(section)) continue;
        for (const auto& element : document.root[section]) {
            if (!element.contains("uri")) continue;
            const std::string uri = element["uri"];
            if (isDataUri(uri)) continue;
            const std::filesystem::path file = jailedPath(document.folder, uri, document.source);
            std::error_code error;  // a picture may be missing: that is a scene, too
            const bool there = std::filesystem::is_regular_file(file, error);
            hasher.add(there ? readWholeFile(file, file.string()) : std::vector<std::uint8_t>{});
        }
    }
}

}  // namespace

std::string contentHash(std::string_view bytes) {
    return Hasher::digitsOf(XXH3_128bits(bytes.data(), bytes.size()));
}

std::string sceneHash(const std::filesystem::path& path) {
    Hasher hasher;
    hasher.add(readWholeFile(path, path.string()));
    if (path.extension() == ".gltf" || path.extension() == ".glb") addFilesOfGltf(hasher, path);
    return hasher.digits();
}

}  // namespace edgewise::sweep
