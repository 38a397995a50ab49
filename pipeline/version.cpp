#include "pipeline/version.h"

namespace edgewise {
const char* version() {
    return EDGEWISE_VERSION;
}
}  // namespace edgewise
