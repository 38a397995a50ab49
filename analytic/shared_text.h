// What the shared shader text needs to compile as C++: see shaders/shared/README.md.
#pragma once

#define EDGEWISE_FN [[gnu::always_inline]] inline
#define EDGEWISE_EXACT_FN [[gnu::always_inline]] inline
#define EDGEWISE_PRECISE
#define EDGEWISE_UNROLL
#define EDGEWISE_INIT {
#define EDGEWISE_END }
#define EDGEWISE_REAL(number) number
#define EDGEWISE_WORK(number) static_cast<work_number>(number)
#define EDGEWISE_IN(type) const type&
#define EDGEWISE_INOUT(type) type&
#define EDGEWISE_BOTH(a, b) ((a) & (b))
#define EDGEWISE_EITHER(a, b) ((a) | (b))

// A kernel's numbers: an array, and what is in it.
#define EDGEWISE_NUMBERS const double*
#define EDGEWISE_AT(numbers, i) static_cast<work_number>((numbers)[i])
#define EDGEWISE_KERNEL_IN const LaneKernel &kernel,
#define EDGEWISE_KERNEL kernel,
