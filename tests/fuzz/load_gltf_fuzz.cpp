// No bytes make the loader crash, hang or throw anything but the two errors of the world.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "pipeline/error.h"
#include "pipeline/load_gltf.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("edgewise_fuzz_" + std::to_string(getpid()) + ".glb");
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    try {
        edgewise::loadGltf(path);
    } catch (const edgewise::InputError&) {
    } catch (const edgewise::FailureError&) {
    }
    return 0;
}
