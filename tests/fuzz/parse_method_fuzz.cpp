// No method's name makes the parser crash or throw anything but an InputError.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "pipeline/error.h"
#include "pipeline/methods/method.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        edgewise::parseMethod(std::string_view(reinterpret_cast<const char*>(data), size));
    } catch (const edgewise::InputError&) {
    }
    return 0;
}
