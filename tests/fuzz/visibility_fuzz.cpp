// libFuzzer's way in. Keep what it finds in seeds/: replay_test runs it ever after.
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/check_visibility.h"
#include "tests/fuzz/scene_from_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string wrong = edgewise::fuzz::checkVisibility(edgewise::fuzz::sceneFromBytes({data, size}));
    if (!wrong.empty()) {
        std::fprintf(stderr, "%s\n", wrong.c_str());
        std::abort();
    }
    return 0;
}
