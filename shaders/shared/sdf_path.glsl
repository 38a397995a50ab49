// Directions that paths take at random: (u, v) in [0, 1)^2. C++ compiles this text as double (sdf/shading_text.h), GLSL as
// float. It needs sdf_sine.glsl and sdf_shading.glsl.

/// A direction given beside the axis z, beside n instead (the orthonormal basis of Duff et al. 2017).
EDGEWISE_FN vec3 aroundNormal(vec3 n, vec3 local) {
    real side = n.z < real(0.0) ? real(-1.0) : real(1.0);
    real a = real(-1.0) / (side + n.z);
    real b = n.x * n.y * a;
    vec3 x = vec3(real(1.0) + side * n.x * n.x * a, side * b, -side * n.x);
    vec3 y = vec3(b, side + n.y * n.y * a, -n.y);
    return x * local.x + y * local.y + n * local.z;
}
/// `versine` (1 - cos) from the axis z, turned by v.
EDGEWISE_FN vec3 besideAxis(real versine, real v) {
    real sine_ = sqrt(max(versine * (real(2.0) - versine), real(0.0)));
    real angle = real(2.0) * kPi * v;
    return vec3(sine_ * cosine(angle), sine_ * sine(angle), real(1.0) - versine);
}
/// With density cos / pi.
EDGEWISE_FN vec3 cosineDirection(vec3 n, real u, real v) {
    return aroundNormal(n, besideAxis(real(1.0) - sqrt(real(1.0) - u), v));
}
EDGEWISE_FN real cosineDensity(real cosine_) {
    return cosine_ * kInversePi;
}
/// 1 - cos of the half angle under which a sphere is seen from `distance_` > radius; nothing cancels where it is small.
EDGEWISE_FN real versineOfSphere(real radius, real distance_) {
    real ratio = radius / distance_;
    real sine2 = ratio * ratio;
    return sine2 / (real(1.0) + sqrt(max(real(1.0) - sine2, real(0.0))));
}
/// With the same density everywhere within the cone around the axis.
EDGEWISE_FN vec3 coneDirection(vec3 axis, real versine, real u, real v) {
    return aroundNormal(axis, besideAxis(u * versine, v));
}
EDGEWISE_FN real coneDensity(real versine) {
    return real(1.0) / (real(2.0) * kPi * versine);
}
/// Veach's power heuristic, of the first of two ways to come by a direction.
EDGEWISE_FN real sharedWeight(real density, real other) {
    real a = density * density;
    real b = other * other;
    return a / (a + b);
}
