#include "paper_figures/temporary_folder.h"

#include <cstdlib>
#include <string>

#include "pipeline/error.h"

namespace edgewise::figures {

TemporaryFolder::TemporaryFolder() {
    std::error_code error;
    std::string name = std::filesystem::temp_directory_path(error) / "edgewise-figure-XXXXXX";
    if (error) throw FailureError("TMPDIR", "no folder for files on their way: " + error.message());
    if (!mkdtemp(name.data())) throw FailureError(name, "no folder for files on their way");
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
}

}  // namespace edgewise::figures
