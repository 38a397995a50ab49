#include "pipeline/scoped_path.h"

#include <unistd.h>

#include <cstdlib>
#include <string>

#include "pipeline/error.h"

namespace edgewise {

namespace fs = std::filesystem;

ScopedPath::~ScopedPath() {
    std::error_code error;
    fs::remove_all(path_, error);
}

ScopedPath temporaryFolder() {
    std::error_code error;
    std::string name = fs::temp_directory_path(error) / "edgewise-XXXXXX";
    if (error) throw FailureError("TMPDIR", "no folder for files on their way: " + error.message());
    if (!mkdtemp(name.data())) throw FailureError(name, "no folder for files on their way");
    return ScopedPath(name);
}

ScopedPath emptyFolder(const fs::path& path) {
    std::error_code error;
    fs::remove_all(path, error);
    fs::create_directories(path, error);
    return ScopedPath(path);
}

ScopedPath temporaryFile(const fs::path& folder) {
    std::string name = folder / ".edgewise-XXXXXX";
    const int descriptor = mkstemp(name.data());
    if (descriptor < 0) throw FailureError(folder.string(), "no file can be kept there for a moment");
    close(descriptor);
    return ScopedPath(name);
}

}  // namespace edgewise
