// A real of 113 bits for tables made once: + - * / alone, so that every machine makes the same tables.
#pragma once

namespace edgewise {

#if defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 QuadReal;
#else
using QuadReal = long double;
static_assert(__LDBL_MANT_DIG__ == 113, "tables need 113 bits");
#endif

inline QuadReal quadAbs(QuadReal x) {
    return x < 0 ? -x : x;
}
QuadReal quadPi();
QuadReal quadSinPi(QuadReal x);  ///< sin(pi x), relative error < 2^-100 away from its zeros
QuadReal quadExp(QuadReal x);    ///< e^x, |x| < 10000
QuadReal quadSqrt(QuadReal x);

}  // namespace edgewise
