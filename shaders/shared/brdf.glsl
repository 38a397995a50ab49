// The metallic-roughness BRDF of glTF 2.0, Appendix B: pipeline/brdf.h has the equations.

#define EDGEWISE_PI EDGEWISE_REAL(3.14159265358979323846)
#define EDGEWISE_DIELECTRIC_F0 EDGEWISE_REAL(0.04)  // an index of refraction of 1.5
#define EDGEWISE_LEAST_ROUGHNESS EDGEWISE_REAL(0.0625)

EDGEWISE_EXACT_FN double smith(double cosine, double alpha2) {
    return cosine + sqrt(alpha2 + (1.0 - alpha2) * cosine * cosine);
}

/// D V, 1/sr. The denominator's root is (alpha N.H)^2 + |N x H|^2: nothing cancels in a sharp highlight.
EDGEWISE_EXACT_FN double microfacets(dvec3 n, dvec3 h, double nl, double nv, double roughness) {
    double nh = inner(n, h);
    double alpha = roughness * roughness;
    double alpha2 = alpha * alpha;
    if (!(nh > 0.0)) return 0.0;
    dvec3 across = outer(n, h);
    double root = alpha2 * nh * nh + inner(across, across);
    return alpha2 / (EDGEWISE_PI * root * root * smith(nl, alpha2) * smith(nv, alpha2));
}

/// Between a view and a light.
struct Halfway {
    dvec3 h;         // unit; 0 where the light comes from behind
    double fresnel;  // (1 - |V.H|)^5
};

EDGEWISE_EXACT_FN Halfway halfwayOf(dvec3 v, dvec3 l) {
    Halfway half_;
    dvec3 sum = v + l;
    double size = lengthOf(sum);
    half_.h = dvec3(0.0);
    half_.fresnel = 0.0;
    if (size == 0.0) return half_;
    half_.h = sum / size;
    double dark = larger(0.0, 1.0 - absolute(inner(v, half_.h)));
    half_.fresnel = (dark * dark) * (dark * dark) * dark;
    return half_;
}

/// The share of the light from l that leaves towards v, half_ being between them.
EDGEWISE_EXACT_FN dvec3 reflectedShare(dvec3 base, double metallic, double roughness, dvec3 n, dvec3 v, dvec3 l,
                                       Halfway half_) {
    if (isZero(half_.h)) return (1.0 - metallic) * base * (EDGEWISE_REAL(1.0) / EDGEWISE_PI);  // light from behind
    dvec3 h = half_.h;
    double fresnel = half_.fresnel;
    double specular = microfacets(n, h, inner(n, l), absolute(inner(n, v)), larger(roughness, EDGEWISE_LEAST_ROUGHNESS));
    double f = EDGEWISE_DIELECTRIC_F0 + (EDGEWISE_REAL(1.0) - EDGEWISE_DIELECTRIC_F0) * fresnel;
    dvec3 dielectric = base * ((1.0 - f) / EDGEWISE_PI) + dvec3(f * specular);
    dvec3 metal = specular * (base + (1.0 - base) * fresnel);
    return dielectric * (1.0 - metallic) + metal * metallic;
}
