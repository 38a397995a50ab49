#include "pipeline/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>

#include "pipeline/error.h"

namespace edgewise {
namespace {

/// The temporary name of the write under way: one at a time, the program writes from one thread.
std::atomic<const char*> pending_name{nullptr};

[[noreturn]] void failToWrite(const std::filesystem::path& path, int error) {
    throw FailureError(path.string(), fmt::format("cannot be written: {}", std::strerror(error)));
}

/// A file that is gone unless it is kept.
class TemporaryFile {
  public:
    explicit TemporaryFile(const std::filesystem::path& target)
        : target_(target),
          name_(target.parent_path() / fmt::format(".{}.{}.tmp", target.filename().string(), getpid())) {
        pending_name = name_.c_str();
        descriptor_ = open(name_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
        if (descriptor_ < 0) failToWrite(target_, errno);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        if (descriptor_ >= 0) close(descriptor_);
        if (!kept_) unlink(name_.c_str());
        pending_name = nullptr;
    }

    int descriptor() const { return descriptor_; }

    void keep() {
        const int status = close(descriptor_);
        descriptor_ = -1;
        if (status != 0 || rename(name_.c_str(), target_.c_str()) != 0) failToWrite(target_, errno);
        kept_ = true;
    }

  private:
    std::filesystem::path target_, name_;
    int descriptor_ = -1;
    bool kept_ = false;
};

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
    TemporaryFile file(path);
    writeAll(file.descriptor(), bytes, path);
    file.keep();
}

void writeAtomically(const std::filesystem::path& path, std::string_view text) {
    writeAtomically(path, std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()));
}

void removePendingFile() noexcept {
    if (const char* name = pending_name) unlink(name);
}

}  // namespace edgewise
