// No bytes make the reader of a .map.glsl's header crash, hang, give numbers that are not finite, or throw
// anything but a SceneError.
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/sdf_from_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string wrong = edgewise::fuzz::checkMap({data, size});
    if (!wrong.empty()) {
        std::fprintf(stderr, "%s\n", wrong.c_str());
        std::abort();
    }
    return 0;
}
