// The metallic-roughness BRDF of glTF 2.0, Appendix B: pipeline/brdf.h has the equations.

#define EDGEWISE_PI EDGEWISE_REAL(3.14159265358979323846)
#define EDGEWISE_DIELECTRIC_F0 EDGEWISE_REAL(0.04)  // an index of refraction of 1.5
#define EDGEWISE_LEAST_ROUGHNESS EDGEWISE_REAL(0.0625)

EDGEWISE_EXACT_FN real smith(real cosine, real alpha2) {
    return cosine + sqrt(alpha2 + (1.0 - alpha2) * cosine * cosine);
}

/// D V, 1/sr. The denominator's root is (alpha N.H)^2 + |N x H|^2: nothing cancels in a sharp highlight.
EDGEWISE_EXACT_FN real microfacets(dvec3 n, dvec3 h, real nl, real nv, real roughness) {
    real nh = inner(n, h);
    real alpha = roughness * roughness;
    real alpha2 = alpha * alpha;
    dvec3 across = outer(n, h);
    real root = alpha2 * nh * nh + inner(across, across);
    real share = alpha2 / (EDGEWISE_PI * root * root * smith(nl, alpha2) * smith(nv, alpha2));
    return nh > 0.0 ? share : splat(0.0);
}

/// Between a view and a light.
struct Halfway {
    dvec3 h;       // unit; 0 where the light comes from behind
    real fresnel;  // (1 - |V.H|)^5
};

EDGEWISE_EXACT_FN Halfway halfwayOf(dvec3 v, dvec3 l) {
    Halfway half_;
    dvec3 sum = v + l;
    real size = lengthOf(sum);
    half_.h = either(size == 0.0, dvec3(0.0), sum / size);
    real dark = larger(splat(0.0), 1.0 - absolute(inner(v, half_.h)));
    half_.fresnel = size == 0.0 ? splat(0.0) : (dark * dark) * (dark * dark) * dark;
    return half_;
}

/// The share of the light from l that leaves towards v, half_ being between them.
EDGEWISE_EXACT_FN dvec3 reflectedShare(dvec3 base, real metallic, real roughness, dvec3 n, dvec3 v, dvec3 l,
                                       Halfway half_) {
    dvec3 h = half_.h;
    real fresnel = half_.fresnel;
    dvec3 from_behind = (1.0 - metallic) * base * splat(EDGEWISE_REAL(1.0) / EDGEWISE_PI);
    real specular =
        microfacets(n, h, inner(n, l), absolute(inner(n, v)), larger(roughness, splat(EDGEWISE_LEAST_ROUGHNESS)));
    real f = EDGEWISE_DIELECTRIC_F0 + (EDGEWISE_REAL(1.0) - EDGEWISE_DIELECTRIC_F0) * fresnel;
    dvec3 dielectric = base * ((1.0 - f) / EDGEWISE_PI) + dvec3(f * specular);
    dvec3 metal = specular * (base + (dvec3(1.0) - base) * fresnel);
    return either(isZero(h), from_behind, dielectric * (1.0 - metallic) + metal * metallic);
}
