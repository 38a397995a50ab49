#include "pipeline/read_file.h"

#include <fmt/format.h>
#include <fstream>

#include "pipeline/error.h"

namespace edgewise {
namespace {

template <class Bytes>
Bytes readAs(const std::filesystem::path& path, const std::string& what) {
    needRegularFile(path, what);
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error) throw InputError(what, "cannot be read: " + error.message());
    if (size > kMaxFileBytes)
        throw FailureError(what, fmt::format("{} bytes, the limit is {}", size, kMaxFileBytes));
    Bytes bytes;
    bytes.resize(size);
    std::ifstream stream(path, std::ios::binary);
    if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
        throw InputError(what, "cannot be read");
    return bytes;
}

}  // namespace

void needRegularFile(const std::filesystem::path& path, const std::string& what) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) throw InputError(what, "no such file");
    if (!std::filesystem::is_regular_file(status)) throw InputError(what, "is not a regular file");
}

std::vector<std::uint8_t> readWholeFile(const std::filesystem::path& path, const std::string& what) {
    return readAs<std::vector<std::uint8_t>>(path, what);
}

std::string readText(const std::filesystem::path& path) {
    return readAs<std::string>(path, path.string());
}

}  // namespace edgewise
