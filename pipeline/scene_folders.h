// The folders in which scenes are looked for and kept, from the environment.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace edgewise {

std::vector<std::filesystem::path> defaultDataFolders();
/// In order of preference; with $EDGEWISE_CACHE set, that one alone.
std::vector<std::filesystem::path> defaultCacheFolders();
std::vector<std::filesystem::path> defaultShareFolders();

/// The file of that name below `folder`: at `usual` if it is there, else the first in path order; folders
/// that cannot be read are passed over.
std::optional<std::filesystem::path> findBelow(const std::filesystem::path& folder,
                                               const std::filesystem::path& usual);

/// Writes a file that appears whole or not at all, whoever else writes it at the same time; false if it
/// cannot be.
bool writeWhole(const std::filesystem::path& path, const std::string& bytes);

}  // namespace edgewise
