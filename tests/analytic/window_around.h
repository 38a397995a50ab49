// The window of a random scene that tests of visible maps look at.
#pragma once

#include "analytic/visibility.h"

namespace edgewise::test {

inline Window windowAround(glm::ivec2 centre, int reach_px) {
    return {centre.x - reach_px, centre.y - reach_px, centre.x + reach_px, centre.y + reach_px};
}

}  // namespace edgewise::test
