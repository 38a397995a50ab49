#include "analytic/pixel_weights.h"
