#include "pipeline/compare/scratch_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>

#include "pipeline/error.h"

namespace edgewise::compare {

ScratchFile::ScratchFile(const std::filesystem::path& folder, std::size_t index) {
    std::string name = folder / fmt::format(".picture-{}-XXXXXX", index);
    const int descriptor = mkstemp(name.data());
    if (descriptor < 0) throw FailureError(folder.string(), "no picture can be kept there for a moment");
    close(descriptor);
    path_ = name;
}

ScratchFile::~ScratchFile() {
    std::error_code error;
    std::filesystem::remove(path_, error);
}

}  // namespace edgewise::compare
