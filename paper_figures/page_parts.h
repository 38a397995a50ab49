// What the pages of studies of SDF methods share.
#pragma once

#include <string>

namespace edgewise::figures {

inline constexpr const char* kPageStyle = R"css(
.pictures{display:grid;grid-template-columns:repeat(auto-fit,minmax(280px,1fr));gap:14px}
.pictures figure{margin:0}
.pictures img{width:100%;image-rendering:pixelated}
.pictures figcaption{font-size:13px}
p.under{font-size:13px;color:#444;margin:8px 0 0}
)css";

/// A sortable table in a card; `heads` and `rows` are HTML.
std::string table(const std::string& heads, const std::string& rows);
/// A cell that sorts by its value.
std::string number(double value, const char* format);

}  // namespace edgewise::figures
