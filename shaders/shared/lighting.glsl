// Light as it arrives at a point, by KHR_lights_punctual: pipeline/lighting.h has the equations. Eye space.

const int kDirectionalLight = 0;
const int kPointLight = 1;
const int kSpotLight = 2;

struct EyeLight {
    int type;
    dvec3 position;
    dvec3 along;     // unit, the way the light travels
    dvec3 strength;  // colour times lux or candela
    double range;    // infinity: none
    double cos_outer;
    double scale;
};

/// One light as it arrives at a point.
struct Arrival {
    dvec3 towards;      // unit, from the point to the light
    dvec3 illuminance;  // lux on a surface that faces it
};

EDGEWISE_EXACT_FN double rangeWindow(double distance_, double range) {
    double ratio = distance_ / range;
    double square = ratio * ratio;
    return larger(0.0, 1.0 - square * square);
}

EDGEWISE_EXACT_FN double spotShare(EyeLight light, dvec3 towards) {
    double rim = (-inner(towards, light.along) - light.cos_outer) * light.scale;
    double cone = clamped(rim, 0.0, 1.0);
    return cone * cone;
}

EDGEWISE_EXACT_FN Arrival arrivalAt(EyeLight light, dvec3 p_eye) {
    Arrival out_;
    out_.towards = -light.along;
    out_.illuminance = light.strength;
    if (light.type == kDirectionalLight) return out_;
    dvec3 way = light.position - p_eye;
    double square = inner(way, way);
    double distance_ = sqrt(square);
    out_.towards = dvec3(0.0, 0.0, 1.0);
    out_.illuminance = dvec3(0.0);
    if (square == 0.0) return out_;
    out_.towards = way / distance_;
    double share = rangeWindow(distance_, light.range) / square;
    if (light.type == kSpotLight) share *= spotShare(light, out_.towards);
    out_.illuminance = light.strength * share;
    return out_;
}

/// White's share of the rig's ambient light where the occlusion map has `red`.
EDGEWISE_EXACT_FN double occluded(double ambient, double strength, double red) {
    return ambient * (1.0 + strength * (red - 1.0));
}
