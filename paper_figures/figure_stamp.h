// What a figure's folder was made of, kept beside its files: whether they can be used again.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "paper_figures/figure.h"

namespace edgewise::figures {

/// All that a figure's files depend on but the machine.
struct FigureSource {
    std::string program;  ///< the content of the program and of the scenes that ship with it
    bool quick = false;
    bool operator==(const FigureSource&) const = default;
};

struct FigureStamp {
    FigureSource source;
    double seconds = 0.0;  ///< that the figure took
    std::string page;      ///< the file that shows it
    std::vector<FigureClaim> claims;
    std::map<std::string, std::string> contents;  ///< file -> hash of its bytes
};

inline constexpr const char* kStampFile = "stamp.json";

/// Of this process. Throws FailureError where the program's own file cannot be read.
FigureSource thisProgram(bool quick);

FigureStamp stampOf(const FigureSource& source, double seconds, const std::vector<FigureFile>& files,
                    std::vector<FigureClaim> claims);
std::string stampText(const FigureStamp& stamp);

/// The stamp of a figure's folder; none where there is none, or what lies there is not what the stamp
/// describes.
std::optional<FigureStamp> readStamp(const std::filesystem::path& folder);

}  // namespace edgewise::figures
