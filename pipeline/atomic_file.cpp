#include "pipeline/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "pipeline/error.h"

namespace edgewise {
namespace {

/// The temporary names of writes under way; the program writes from one thread.
std::array<std::atomic<const char*>, kMaxPendingFiles> pending_names{};

std::size_t freeSlot(const std::filesystem::path& path) {
    const auto free = std::ranges::find_if(pending_names, [](const auto& name) { return name == nullptr; });
    if (free == pending_names.end())
        throw FailureError(path.string(), fmt::format("more than {} files at once", kMaxPendingFiles));
    return static_cast<std::size_t>(free - pending_names.begin());
}

[[noreturn]] void failToWrite(const std::filesystem::path& path, int error) {
    throw FailureError(path.string(), fmt::format("cannot be written: {}", std::strerror(error)));
}

void writeAll(int descriptor, std::span<const unsigned char> bytes, const std::filesystem::path& path) {
    while (!bytes.empty()) {
        const ssize_t written = write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) failToWrite(path, errno);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

void writeToDevice(const std::filesystem::path& path, std::span<const unsigned char> bytes) {
    const int descriptor = open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) failToWrite(path, errno);
    try {
        writeAll(descriptor, bytes, path);
    } catch (...) {
        close(descriptor);
        throw;
    }
    if (close(descriptor) != 0) failToWrite(path, errno);
}

}  // namespace

PendingFile::PendingFile(const std::filesystem::path& target)
    : target_(target),
      slot_(freeSlot(target)),
      name_(target.parent_path() /
            fmt::format(".{}.{}.{}.tmp", target.filename().string(), getpid(), slot_)) {
    checkOutputPath(target);
    pending_names[slot_] = name_.c_str();
    stream_ = std::fopen(name_.c_str(), "w+be");
    if (stream_ != nullptr) return;
    const int error = errno;
    pending_names[slot_] = nullptr;
    failToWrite(target_, error);
}

PendingFile::~PendingFile() {
    if (stream_ != nullptr) std::fclose(stream_);
    if (!kept_) unlink(name_.c_str());
    pending_names[slot_] = nullptr;
}

void PendingFile::keep() {
    errno = 0;
    const bool failed = std::ferror(stream_) != 0;
    if (std::fclose(std::exchange(stream_, nullptr)) != 0 || failed)
        failToWrite(target_, errno ? errno : EIO);
    if (std::rename(name_.c_str(), target_.c_str()) != 0) failToWrite(target_, errno);
    kept_ = true;
}

void checkOutputPath(const std::filesystem::path& path) {
    std::error_code ignored;
    if (path.filename().empty() || std::filesystem::is_directory(path, ignored))
        throw InputError(path.empty() ? "output" : path.string(), "is not a file name");
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    if (!std::filesystem::is_directory(folder, ignored))
        throw InputError(path.string(), fmt::format("there is no folder {}", folder.string()));
}

void writeAtomically(const std::filesystem::path& path, std::span<const unsigned char> bytes) {
    checkOutputPath(path);
    std::error_code ignored;
    if (std::filesystem::is_other(path, ignored)) return writeToDevice(path, bytes);
    PendingFile file(path);
    if (std::fwrite(bytes.data(), 1, bytes.size(), file.stream()) != bytes.size()) failToWrite(path, errno);
    file.keep();
}

void writeAtomically(const std::filesystem::path& path, std::string_view text) {
    writeAtomically(path, std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()));
}

void removePendingFile() noexcept {
    for (const auto& pending : pending_names)
        if (const char* name = pending) unlink(name);
}

}  // namespace edgewise
