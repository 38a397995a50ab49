// Coverage and reconstruction of "Sphere Tracing AA" (Lottes 2016). C++ compiles this text as double (sdf/shading_text.h),
// GLSL as float. It needs exponential(x).

/// Where the line through two distances along a ray is 0; the first place where they do not fall.
EDGEWISE_FN real secantRoot(real t1, real f1, real t2, real f2) {
    real fall = f1 - f2;
    return fall > real(0.0) ? t1 + (t2 - t1) * (f1 / fall) : t1;
}
/// Full on the surface, none at `reach` from it.
EDGEWISE_FN real coverageOf(real distance_, real reach) {
    return clamp(real(1.0) - abs(distance_) / reach, real(0.0), real(1.0));
}
/// F of a ray that is sqrt(square_px) pixels from the pixel's centre: 2^(-scale r^2).
EDGEWISE_FN real gaussianWeight(real square_px, real scale) {
    return exponential(real(-0.69314718055994530942) * scale * square_px);
}
/// 1 up to where the Gaussian of that scale has fallen to a half, then smoothly to 0 at one and a half times as far.
EDGEWISE_FN real diskWeight(real square_px, real scale) {
    real beyond = clamp(real(2.0) * (sqrt(scale * square_px) - real(1.0)), real(0.0), real(1.0));
    return real(1.0) - beyond * beyond * (real(3.0) - real(2.0) * beyond);
}
