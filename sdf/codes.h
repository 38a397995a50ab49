// The instructions of a tape, one list for all that runs or prints them. A code is named after its function
// in shaders/shared/sdf_shapes.glsl or sdf_operators.glsl; what numbers it takes, that function's signature
// says.
#pragma once

// SHAPE   value <- f(position, numbers)
// MOVE    position <- f(position, numbers)
// VALUE   value <- f(value, numbers)
// VALUE_AT value <- f(value, position, numbers)
// PAIR    value <- f(value, value, numbers)
// clang-format off
#define EDGEWISE_SDF_CODES(SHAPE, MOVE, VALUE, VALUE_AT, PAIR)                                              \
    SHAPE(sphereAt) SHAPE(boxAt) SHAPE(boxFrameAt) SHAPE(torusAt) SHAPE(capsuleAt) SHAPE(cylinderAt)        \
    SHAPE(coneAt) SHAPE(planeAt) SHAPE(ellipsoidAt) SHAPE(octahedronAt) SHAPE(dodecahedronAt)               \
    SHAPE(icosahedronAt) SHAPE(hexPrismAt) SHAPE(gyroidAt) SHAPE(tunnelsAt)                                 \
    MOVE(translateBy) MOVE(rotateBy) MOVE(stretchBy) MOVE(foldAxes) MOVE(repeatBy) MOVE(elongateBy)         \
    MOVE(twistBy)                                                                                           \
    VALUE(complementOf) VALUE(offsetBy) VALUE(shellOf) VALUE(scaleValue)                                    \
    VALUE_AT(displaceBy) VALUE_AT(withinRadius) VALUE_AT(withinWalls)                                       \
    PAIR(unite) PAIR(intersect) PAIR(subtract) PAIR(smoothUnite) PAIR(smoothIntersect) PAIR(smoothSubtract)
// clang-format on

namespace edgewise::sdf {

enum class Code : unsigned char {
#define EDGEWISE_NAME(name) name,
    EDGEWISE_SDF_CODES(EDGEWISE_NAME, EDGEWISE_NAME, EDGEWISE_NAME, EDGEWISE_NAME, EDGEWISE_NAME)
#undef EDGEWISE_NAME
        keep  ///< value <- value: what is left of a pair whose first side lost
};

enum class CodeForm : unsigned char { kShape, kMove, kValue, kValueAt, kPair, kKeep };

inline constexpr CodeForm kCodeForms[]{
#define EDGEWISE_SHAPE(name) CodeForm::kShape,
#define EDGEWISE_MOVE(name) CodeForm::kMove,
#define EDGEWISE_VALUE(name) CodeForm::kValue,
#define EDGEWISE_VALUE_AT(name) CodeForm::kValueAt,
#define EDGEWISE_PAIR(name) CodeForm::kPair,
    EDGEWISE_SDF_CODES(EDGEWISE_SHAPE, EDGEWISE_MOVE, EDGEWISE_VALUE, EDGEWISE_VALUE_AT, EDGEWISE_PAIR)
#undef EDGEWISE_SHAPE
#undef EDGEWISE_MOVE
#undef EDGEWISE_VALUE
#undef EDGEWISE_VALUE_AT
#undef EDGEWISE_PAIR
        CodeForm::kKeep};

}  // namespace edgewise::sdf
