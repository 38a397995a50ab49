#include "pipeline/vulkan/user_words.h"

#include <set>

namespace edgewise::vulkan {
namespace {

using Words = std::set<std::string_view>;

bool readsTexture(std::string_view word) {
    static const Words words{
        "shadow2D",        "texelFetch",       "texelFetchOffset",  "texture",         "texture1D",
        "texture2D",       "texture2DGradEXT", "texture2DLod",      "texture2DLodEXT", "texture2DProj",
        "texture3D",       "texture3DLod",     "textureCube",       "textureCubeLod",  "textureCubeLodEXT",
        "textureGather",   "textureGrad",      "textureGradOffset", "textureLod",      "textureLodOffset",
        "textureOffset",   "textureProj",      "textureProjGrad",   "textureProjLod",  "textureQueryLevels",
        "textureQueryLod", "textureSize"};
    return words.contains(word);
}

}  // namespace

bool isPlainType(std::string_view word) {
    static const Words words{"float",  "int",    "uint",   "bool",   "vec2",   "vec3",   "vec4",
                             "ivec2",  "ivec3",  "ivec4",  "uvec2",  "uvec3",  "uvec4",  "bvec2",
                             "bvec3",  "bvec4",  "mat2",   "mat3",   "mat4",   "mat2x2", "mat2x3",
                             "mat2x4", "mat3x2", "mat3x3", "mat3x4", "mat4x2", "mat4x3", "mat4x4"};
    return words.contains(word);
}

bool isOpaqueType(std::string_view word) {
    if (word == "atomic_uint") return true;
    if (word.starts_with('i') || word.starts_with('u')) {
        const std::string_view rest = word.substr(1);
        if (rest.starts_with("sampler") || rest.starts_with("image")) word = rest;
    }
    for (const std::string_view kind : {"sampler", "image", "texture", "subpassInput"}) {
        if (!word.starts_with(kind)) continue;
        const std::string_view shape = word.substr(kind.size());
        for (const std::string_view known : {"1D", "2D", "3D", "Cube", "Buffer", "ExternalOES"})
            if (shape.starts_with(known)) return true;
        if (kind == "subpassInput") return true;
    }
    return false;
}

bool isFreeNameInEs(std::string_view word) {
    static const Words words{
        "active",   "asm",        "buffer",    "cast",     "class",     "coherent",      "common",
        "enum",     "extern",     "external",  "filter",   "fixed",     "goto",          "half",
        "inline",   "input",      "interface", "long",     "namespace", "noinline",      "noperspective",
        "output",   "partition",  "patch",     "precise",  "public",    "readonly",      "resource",
        "restrict", "sample",     "sampler",   "shared",   "short",     "sizeof",        "static",
        "superp",   "subroutine", "template",  "this",     "typedef",   "samplerShadow", "union",
        "unsigned", "using",      "volatile",  "writeonly"};
    return words.contains(word);
}

bool isFunctionEsLacks(std::string_view word) {
    static const Words words{"acosh",
                             "asinh",
                             "atanh",
                             "bitCount",
                             "bitfieldExtract",
                             "cosh",
                             "bitfieldInsert",
                             "bitfieldReverse",
                             "determinant",
                             "findLSB",
                             "findMSB",
                             "floatBitsToInt",
                             "floatBitsToUint",
                             "fma",
                             "frexp",
                             "imulExtended",
                             "intBitsToFloat",
                             "inverse",
                             "isinf",
                             "isnan",
                             "ldexp",
                             "modf",
                             "outerProduct",
                             "packHalf2x16",
                             "packSnorm2x16",
                             "packUnorm2x16",
                             "packUnorm4x8",
                             "round",
                             "roundEven",
                             "sinh",
                             "tanh",
                             "transpose",
                             "trunc",
                             "uaddCarry",
                             "uintBitsToFloat",
                             "umulExtended",
                             "unpackHalf2x16",
                             "unpackSnorm2x16",
                             "unpackUnorm2x16",
                             "usubBorrow",
                             "packSnorm4x8",
                             "unpackSnorm4x8",
                             "unpackUnorm4x8",
                             "packDouble2x32",
                             "unpackDouble2x32"};
    return words.contains(word) || readsTexture(word);
}

std::string_view whyNotInMaps(std::string_view word, bool called) {
    static const Words channels{"iChannel0", "iChannel1", "iChannel2", "iChannel3"};
    static const Words fragment{"dFdx",       "dFdy",       "fwidth",     "dFdxFine",    "dFdyFine",
                                "fwidthFine", "dFdxCoarse", "dFdyCoarse", "fwidthCoarse"};
    static const Words shared{"atomicAdd",
                              "atomicAnd",
                              "atomicCompSwap",
                              "atomicExchange",
                              "atomicMax",
                              "atomicMin",
                              "atomicOr",
                              "atomicXor",
                              "barrier",
                              "groupMemoryBarrier",
                              "imageAtomicAdd",
                              "imageLoad",
                              "imageSize",
                              "imageStore",
                              "memoryBarrier",
                              "memoryBarrierBuffer",
                              "memoryBarrierImage",
                              "memoryBarrierShared"};
    if ((called && readsTexture(word)) || channels.contains(word) || isOpaqueType(word))
        return "a map has no textures or images; only functions that it does not call may use them";
    if ((called && fragment.contains(word)) || word == "discard" || word.starts_with("gl_"))
        return "a map is a function of its position alone: it has no fragments and no stages";
    if (called && shared.contains(word))
        return "a map is a function of its position alone: it shares no memory";
    return {};
}

}  // namespace edgewise::vulkan
