// What the shared shader text needs to compile as C++: see shaders/shared/README.md.
#pragma once

#define EDGEWISE_FN [[gnu::always_inline]] inline
#define EDGEWISE_EXACT_FN [[gnu::always_inline]] inline
#define EDGEWISE_PRECISE
#define EDGEWISE_INIT {
#define EDGEWISE_END }
#define EDGEWISE_REAL(number) number
