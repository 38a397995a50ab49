// What the pages of studies of SDF methods share.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace edgewise::figures {

inline constexpr const char* kPageStyle = R"css(
.pictures{display:grid;grid-template-columns:repeat(auto-fit,minmax(280px,1fr));gap:14px}
.pictures figure{margin:0}
.pictures img{width:100%;image-rendering:pixelated}
.pictures figcaption{font-size:13px}
th{white-space:normal}
p.under{font-size:13px;color:#444;margin:8px 0 0}
)css";

/// What every page of one figure says of it.
struct FigureWords {
    std::string name;     ///< as typed
    std::string title;    ///< a heading
    std::string caption;  ///< what is seen, and what the paper leaves open
    std::vector<std::pair<std::string, std::string>> parameters;  ///< name, value; the seed among them
    std::vector<std::string> commands;                            ///< that show parts of it again, each
    bool quick = false;
};

/// The page: words, `body` (HTML), the styles of pictures and plots, and tables that sort.
std::string figurePage(const FigureWords& words, const std::string& body);

}  // namespace edgewise::figures
