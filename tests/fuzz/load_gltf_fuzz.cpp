// No bytes make the loader crash, hang, give a scene that is not finite, or throw anything but the two errors
// of the world. Mutations know JSON, so that most inputs get past the parser.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "tests/fuzz/gltf_from_bytes.h"
#include "tests/fuzz/mutate_json.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string wrong = edgewise::fuzz::checkLoad({data, size});
    if (!wrong.empty()) {
        std::fprintf(stderr, "%s\n", wrong.c_str());
        std::abort();
    }
    return 0;
}

/// Half of the mutations are libFuzzer's own on all bytes; a quarter change the JSON, a quarter the bytes
/// after it.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
    const auto* zero = static_cast<const std::uint8_t*>(std::memchr(data, 0, size));
    const std::size_t text = zero == nullptr ? size : static_cast<std::size_t>(zero - data);
    if (seed % 4 < 2 || size == 0 || data[0] != '{') return LLVMFuzzerMutate(data, size, max_size);
    if (seed % 4 == 2 && text + 1 < size)
        return text + 1 + LLVMFuzzerMutate(data + text + 1, size - text - 1, max_size - text - 1);
    const std::string changed =
        edgewise::fuzz::mutateJson(std::string(reinterpret_cast<const char*>(data), text), seed);
    const std::size_t rest = size - text;
    if (changed.empty() || changed.size() + rest > max_size) return LLVMFuzzerMutate(data, size, max_size);
    std::memmove(data + changed.size(), data + text, rest);
    std::memcpy(data, changed.data(), changed.size());
    return changed.size() + rest;
}
