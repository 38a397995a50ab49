#include "paper_figures/figure_stamp.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "pipeline/error.h"
#include "pipeline/json_text.h"
#include "pipeline/read_file.h"
#include "pipeline/scene_folders.h"
#include "pipeline/sweep/content_hash.h"
#include "pipeline/version.h"

namespace edgewise::figures {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::optional<std::string> bytesOf(const fs::path& path) {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) return std::nullopt;
    return readText(path);
}

/// Names and contents of the files of the first folder of scenes that is there.
std::string scenesContent() {
    for (const fs::path& folder : defaultDataFolders()) {
        std::vector<fs::path> paths;
        std::error_code error;
        for (fs::directory_iterator entry(folder, error); !error && entry != fs::directory_iterator();
             entry.increment(error))
            if (entry->is_regular_file()) paths.push_back(entry->path());
        if (paths.empty()) continue;
        std::ranges::sort(paths);
        std::string all;
        for (const fs::path& path : paths)
            all += path.filename().string() + " " + sweep::contentHash(bytesOf(path).value_or("")) + "\n";
        return all;
    }
    return "";
}

Json claimJson(const FigureClaim& claim) {
    return {{"place", claim.place}, {"claim", claim.claim}, {"paper", claim.paper},
            {"ours", claim.ours},   {"unit", claim.unit},   {"why", claim.why}};
}

FigureClaim claimOf(const Json& json) {
    return {json.at("place"), json.at("claim"), json.at("paper"),
            json.at("ours"),  json.at("unit"),  json.at("why")};
}

FigureStamp parsed(const std::string& text) {
    const Json json = Json::parse(text);
    FigureStamp stamp{
        {json.at("program"), json.at("quick")}, json.at("seconds"), json.at("page"), {}, json.at("files")};
    for (const Json& claim : json.at("claims")) stamp.claims.push_back(claimOf(claim));
    return stamp;
}

bool describes(const FigureStamp& stamp, const fs::path& folder) {
    return stamp.contents.contains(stamp.page) && std::ranges::all_of(stamp.contents, [&](const auto& file) {
               const auto bytes = bytesOf(folder / file.first);
               return fs::path(file.first).filename() == file.first && bytes &&
                      sweep::contentHash(*bytes) == file.second;
           });
}

}  // namespace

FigureSource thisProgram(bool quick) {
    const auto program = bytesOf("/proc/self/exe");
    if (!program) throw FailureError("/proc/self/exe", "cannot be read");
    return {sweep::contentHash(version() + sweep::contentHash(*program) + scenesContent()), quick};
}

FigureStamp stampOf(const FigureSource& source, double seconds, const std::vector<FigureFile>& files,
                    std::vector<FigureClaim> claims) {
    FigureStamp stamp{source, seconds, files.front().name, std::move(claims), {}};
    for (const FigureFile& file : files) stamp.contents[file.name] = sweep::contentHash(file.bytes);
    return stamp;
}

std::string stampText(const FigureStamp& stamp) {
    Json claims = Json::array();
    for (const FigureClaim& claim : stamp.claims) claims.push_back(claimJson(claim));
    return jsonText(Json{{"program", stamp.source.program},
                         {"quick", stamp.source.quick},
                         {"seconds", stamp.seconds},
                         {"page", stamp.page},
                         {"files", stamp.contents},
                         {"claims", claims}},
                    2) +
           "\n";
}

std::optional<FigureStamp> readStamp(const fs::path& folder) {
    const auto text = bytesOf(folder / kStampFile);
    if (!text) return std::nullopt;
    try {
        FigureStamp stamp = parsed(*text);
        return describes(stamp, folder) ? std::optional(std::move(stamp)) : std::nullopt;
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;  // somebody else's file, or half of one
    }
}

}  // namespace edgewise::figures
