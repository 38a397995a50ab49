#include "pipeline/brdf.h"

#include "pipeline/shading_text.h"

namespace edgewise {

static_assert(kLeastRoughness == EDGEWISE_LEAST_ROUGHNESS);

glm::dvec3 brdf(const Reflectance& surface, const glm::dvec3& n, const glm::dvec3& v, const glm::dvec3& l) {
    return f64::reflectedShare(surface.base, surface.metallic, surface.roughness, n, v, l,
                               f64::halfwayOf(v, l));
}

}  // namespace edgewise
