#pragma once

namespace edgewise {
/// "0.1.0": goes into every output's metadata.
const char* version();
}  // namespace edgewise
