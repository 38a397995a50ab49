#version 460
// One invocation an entry: the colour and alpha of an owner of a pixel, a triangle or a stack of them, at its closest
// point or as the mean over shading points. pipeline/shade.h says what is computed; the formulas are the shared ones.
layout(local_size_x = 64) in;
#include "shared/real_bits.glsl"
#include "shared/double_double.glsl"
#include "shared/transcendental.glsl"
#include "shared/layouts.glsl"

layout(constant_id = 0) const uint kUses = 0u;
layout(constant_id = 1) const uint kBanks = 1u;
layout(constant_id = 2) const int kBudget = 0;  // turns of loops that one invocation may take

layout(std430, binding = kShadeFrameBinding) readonly buffer Frames { ShadeFrame frame; };
layout(std430, binding = kShadeOffsetsBinding) readonly buffer Offsets { uint offsets[]; };
layout(std430, binding = kShadeOwnersBinding) readonly buffer EntryOwners { uint entry_owner[]; };
layout(std430, binding = kShadeColorsBinding) writeonly buffer Colors { double entry_color[]; };
layout(std430, binding = kShadeStatusBinding) buffer Status { uint handed_back; };
layout(std430, binding = kOwnerRecordsBinding) readonly buffer Owners { OwnerRecord owner_record[]; };
layout(std430, binding = kTableBinding) readonly buffer Table { double table[]; };
layout(std430, binding = kSurfacesBinding) readonly buffer Surfaces { SurfaceRecord surfaces[]; };
layout(std430, binding = kMaterialsBinding) readonly buffer Materials { MaterialRecord materials[]; };
layout(std430, binding = kTrianglesBinding) readonly buffer Triangles { GpuTriangle triangles[]; };
layout(std430, binding = kPositionsBinding) readonly buffer Positions { double positions[]; };
layout(std430, binding = kAttributesBinding) readonly buffer Attributes { double attributes[]; };
layout(std430, binding = kPlaneNormalsBinding) readonly buffer PlaneNormals { double plane_normals[]; };
layout(std430, binding = kLightsBinding) readonly buffer Lights { LightRecord lights[]; };
layout(std430, binding = kMapsBinding) readonly buffer Maps { MapRecord maps[]; };
layout(std430, binding = kLevelsBinding) readonly buffer Levels { LevelRecord levels[]; };
layout(std430, binding = kStackFirstBinding) readonly buffer StackFirst { uint stack_first[]; };
layout(std430, binding = kStackLayersBinding) readonly buffer StackLayers { uint stack_layers[]; };
layout(std430, binding = kPointEndsBinding) readonly buffer PointEnds { uint point_end[]; };
layout(std430, binding = kPointsBinding) readonly buffer Points { double point_offset[]; };
layout(std430, binding = kBank0Binding) readonly buffer Bank0 { vec4 bank0[]; };
layout(std430, binding = kBank1Binding) readonly buffer Bank1 { vec4 bank1[]; };
layout(std430, binding = kBank2Binding) readonly buffer Bank2 { vec4 bank2[]; };
layout(std430, binding = kBank3Binding) readonly buffer Bank3 { vec4 bank3[]; };
layout(std430, binding = kEntryPixelsBinding) readonly buffer EntryPixels { uint entry_pixel[]; };
layout(push_constant) uniform Push { ShadePush push; };

const uint kFirstStack = 0x80000000u;
const uint kBackground = 0xffffffffu;

bool uses(uint what) { return (kUses & what) != 0u; }
bool isStack(uint owner) { return uses(kUsesStacks) && owner >= kFirstStack && owner != kBackground; }

#include "shared/vectors.glsl"
#include "shared/surface_point.glsl"
#include "shared/brdf.glsl"
#include "shared/lighting.glsl"
#include "shared/normal_map.glsl"
#include "shared/over.glsl"

dvec3 position3(uint at) { return dvec3(positions[at], positions[at + 1u], positions[at + 2u]); }
dvec2 attribute2(uint at) { return dvec2(attributes[at], attributes[at + 1u]); }
dvec3 attribute3(uint at) { return dvec3(attributes[at], attributes[at + 1u], attributes[at + 2u]); }
dvec4 attribute4(uint at) { return dvec4(attribute3(at), attributes[at + 3u]); }
dvec3 planeNormal(uint plane) {
    return dvec3(plane_normals[3u * plane], plane_normals[3u * plane + 1u], plane_normals[3u * plane + 2u]);
}
dvec2 pieceCorner(uint piece, uint k) { return dvec2(triangles[piece].p_px[2u * k], triangles[piece].p_px[2u * k + 1u]); }
dvec3 backgroundColor() { return dvec3(frame.background_r, frame.background_g, frame.background_b); }

// ---- Textures.

struct TextureLook {
    int wrap_s;
    int wrap_t;
    int mag;
    int min;
    int mip;
    int levels;
    uint first_level;
};
struct TextureLevel {
    int width;
    int height;
    uint first;
};

TextureLevel levelAt(TextureLook look, int i) {
    LevelRecord level = levels[look.first_level + uint(i)];
    return TextureLevel(level.width, level.height, level.first_texel);
}

dvec4 texelOf(TextureLevel level, int x, int y) {
    uint at = level.first + uint(y) * uint(level.width) + uint(x);
    if (kBanks == 1u) return dvec4(bank0[at]);
    uint bank = at >> kBankBits;
    uint slot = at & ((1u << kBankBits) - 1u);
    if (bank == 0u) return dvec4(bank0[slot]);
    if (bank == 1u) return dvec4(bank1[slot]);
    if (bank == 2u) return dvec4(bank2[slot]);
    return dvec4(bank3[slot]);
}

#include "shared/texture.glsl"

/// Three vertices and the streams of a triangle.
struct Corners {
    uint vertex0;
    uint vertex1;
    uint vertex2;
    SurfaceRecord surface;
};

dvec3 cornerPosition(Corners c, uint vertex) { return position3(c.surface.positions + 3u * vertex); }
uint uvStream(Corners c, uint uv) { return uv == 0u ? c.surface.uv0 : c.surface.uv1; }

precise dvec2 mappedDirection(MapRecord map, dvec2 uv) {
    return dvec2(map.u_from_u, map.v_from_u) * uv.x + dvec2(map.u_from_v, map.v_from_v) * uv.y;
}
precise dvec2 mappedPoint(MapRecord map, dvec2 uv) { return mappedDirection(map, uv) + dvec2(map.u_shift, map.v_shift); }

dvec2 uvMix(Corners c, uint stream, dvec3 w) {
    return mix3(attribute2(stream + 2u * c.vertex0), attribute2(stream + 2u * c.vertex1),
                attribute2(stream + 2u * c.vertex2), w);
}

dvec4 texelAt(MapRecord map, Corners c, SurfacePoint at) {
    uint stream = uvStream(c, map.uv);
    TextureLook look =
        TextureLook(map.wrap_s, map.wrap_t, map.mag, map.min, map.mip, map.levels, map.first_level);
    return sampleLevels(look, mappedPoint(map, uvMix(c, stream, at.barycentric)),
                        mappedDirection(map, uvMix(c, stream, at.d_dx)),
                        mappedDirection(map, uvMix(c, stream, at.d_dy)));
}

// ---- Normals.

precise dvec3 cornerNormal(OwnerRecord owner, Corners c, uint vertex) {
    dvec3 normal = attribute3(c.surface.normals + 3u * vertex);
    if (isZero(normal)) return planeNormal(owner.plane);
    return (owner.flags & kBackFacing) != 0u ? -normal : normal;
}

dvec3 vertexNormal(OwnerRecord owner, Corners c, dvec3 w) {
    dvec3 flat_ = planeNormal(owner.plane);
    if (!uses(kUsesVertexNormals) || c.surface.normals == kAbsent) return flat_;
    dvec3 normal = unitOrZero(mix3(cornerNormal(owner, c, c.vertex0), cornerNormal(owner, c, c.vertex1),
                                   cornerNormal(owner, c, c.vertex2), w));
    return isZero(normal) ? flat_ : normal;
}

precise dvec3 eyeDirection(dvec3 world) {
    return dvec3(frame.eye_from_world[0], frame.eye_from_world[1], frame.eye_from_world[2]) * world.x +
           dvec3(frame.eye_from_world[3], frame.eye_from_world[4], frame.eye_from_world[5]) * world.y +
           dvec3(frame.eye_from_world[6], frame.eye_from_world[7], frame.eye_from_world[8]) * world.z;
}

/// Of the front, with the bitangent's sign; 0 where u and v do not span the triangle.
dvec4 tangentAt(MapRecord map, Corners c, dvec3 w, dvec3 normal) {
    if (c.surface.tangents != kAbsent) {
        dvec4 world = mix3(attribute4(c.surface.tangents + 4u * c.vertex0), attribute4(c.surface.tangents + 4u * c.vertex1),
                           attribute4(c.surface.tangents + 4u * c.vertex2), w);
        dvec3 tangent = orthogonalTo(normal, eyeDirection(dvec3(world)));
        double sign_ = attributes[c.surface.tangents + 4u * c.vertex0 + 3u] < 0.0 ? -1.0 : 1.0;
        if (!isZero(tangent)) return dvec4(tangent, sign_);
    }
    uint stream = uvStream(c, map.uv);
    dvec2 uv0 = mappedPoint(map, attribute2(stream + 2u * c.vertex0));
    dvec2 uv1 = mappedPoint(map, attribute2(stream + 2u * c.vertex1));
    dvec2 uv2 = mappedPoint(map, attribute2(stream + 2u * c.vertex2));
    dvec3 p0 = cornerPosition(c, c.vertex0), p1 = cornerPosition(c, c.vertex1), p2 = cornerPosition(c, c.vertex2);
    dvec3 tangent = orthogonalTo(normal, alongU(p0, p1, p2, uv0, uv1, uv2));
    if (isZero(tangent)) return dvec4(0.0);
    return dvec4(tangent, bitangentSign(normal, tangent, alongV(p0, p1, p2, uv0, uv1, uv2)));
}

precise dvec3 bumped(OwnerRecord owner, MaterialRecord material, MapRecord map, Corners c, dvec3 w, dvec3 seen, dvec3 texel) {
    double side = (owner.flags & kBackFacing) != 0u ? -1.0 : 1.0;
    dvec3 normal = side * seen;
    dvec4 tangent = tangentAt(map, c, w, normal);
    if (isZero(dvec3(tangent))) return seen;
    dvec3 turned = bumpedNormal(normal, dvec3(tangent), tangent.w, texel, material.normal_scale);
    return isZero(turned) ? seen : side * turned;
}

// ---- Materials.

/// What textures and vertices make of a material at a point.
struct Look {
    dvec4 base;
    double metallic;
    double roughness;
    double ambient;
    dvec3 emissive;
    dvec3 normal;
};

precise dvec4 times(dvec4 a, dvec4 b) { return a * b; }
precise dvec3 times(dvec3 a, dvec3 b) { return a * b; }
precise double times(double a, double b) { return a * b; }

Look withMap(Look look, OwnerRecord owner, MaterialRecord material, MapRecord map, Corners c, SurfacePoint at) {
    dvec4 texel = texelAt(map, c, at);
    if (map.role == kBaseMap) look.base = times(look.base, texel);
    if (!uses(kUsesLight)) return look;
    if (map.role == kMetallicRoughnessMap) {
        look.metallic = times(look.metallic, texel.b);
        look.roughness = times(look.roughness, texel.g);
    }
    if (map.role == kOcclusionMap) look.ambient = occluded(look.ambient, material.occlusion_strength, texel.r);
    if (map.role == kEmissiveMap) look.emissive = times(look.emissive, dvec3(texel));
    if (uses(kUsesNormalMaps) && map.role == kNormalMap)
        look.normal = bumped(owner, material, map, c, at.barycentric, look.normal, dvec3(texel));
    return look;
}

Look lookAt(OwnerRecord owner, MaterialRecord material, Corners c, SurfacePoint at) {
    Look look;
    look.base = dvec4(material.base_r, material.base_g, material.base_b, material.base_a);
    look.metallic = material.metallic;
    look.roughness = material.roughness;
    look.ambient = frame.ambient;
    look.emissive = dvec3(material.emissive_r, material.emissive_g, material.emissive_b);
    look.normal = dvec3(0.0, 0.0, 1.0);
    if (uses(kUsesLight) && material.unlit == 0u) look.normal = vertexNormal(owner, c, at.barycentric);
    if (uses(kUsesTextures))
        for (uint m = 0u; m < material.maps; ++m) {
            MapRecord map = maps[material.first_map + m];
            if (uvStream(c, map.uv) != kAbsent) look = withMap(look, owner, material, map, c, at);
        }
    if (uses(kUsesVertexColors) && c.surface.colors != kAbsent)
        look.base = times(look.base, mix3(attribute4(c.surface.colors + 4u * c.vertex0),
                                          attribute4(c.surface.colors + 4u * c.vertex1),
                                          attribute4(c.surface.colors + 4u * c.vertex2), at.barycentric));
    look.metallic = clamped(look.metallic, 0.0, 1.0);
    look.roughness = clamped(look.roughness, 0.0, 1.0);
    return look;
}

EyeLight lightOf(uint i) {
    LightRecord r = lights[i];
    return EyeLight(uses(kUsesPositionalLights) ? r.type : kDirectionalLight,
                    dvec3(r.position_x, r.position_y, r.position_z), dvec3(r.along_x, r.along_y, r.along_z),
                    dvec3(r.strength_r, r.strength_g, r.strength_b), r.range, r.cos_outer, r.scale);
}

precise dvec3 litColor(Look look, dvec3 p_eye) {
    dvec3 v = viewFrom(p_eye, frame.uniform_view != 0u), base = dvec3(look.base);
    dvec3 color = base * look.ambient + look.emissive;
    for (uint i = 0u; i < frame.lights; ++i) {
        Arrival light = arrivalAt(lightOf(i), p_eye);
        double cosine = inner(look.normal, light.towards);
        if (cosine > 0.0)
            color += reflectedShare(base, look.metallic, look.roughness, look.normal, v, light.towards, halfwayOf(v, light.towards)) *
                     (cosine * light.illuminance);
    }
    return color;
}

double opacityOf(MaterialRecord material, double alpha) {
    if (!uses(kUsesAlpha) || material.alpha_mode == kOpaqueMode) return 1.0;
    if (material.alpha_mode == kMaskMode) return alpha >= material.alpha_cutoff ? 1.0 : 0.0;
    return clamped(alpha, 0.0, 1.0);
}

// ---- Owners.

dvec2 closestOffset(OwnerRecord owner, dvec2 sample_px) {
    dvec2 best = dvec2(0.0);
    double best_px2 = EDGEWISE_FARTHEST_PX2;
    for (uint i = 0u; i < owner.pieces; ++i) {
        uint piece = owner.first + i;
        dvec2 a = pieceCorner(piece, 0u), b = pieceCorner(piece, 1u), c = pieceCorner(piece, 2u);
        if (!(sideOf(a, b, sample_px) < 0.0) && !(sideOf(b, c, sample_px) < 0.0) && !(sideOf(c, a, sample_px) < 0.0))
            return dvec2(0.0);
        for (uint k = 0u; k < 3u; ++k) {
            dvec2 from = pieceCorner(piece, k), to = pieceCorner(piece, k == 2u ? 0u : k + 1u);
            dvec2 offset = offsetToSegment(from, to, sample_px);
            double px2 = inner(offset, offset);
            if (px2 >= best_px2) continue;
            best = offset;
            best_px2 = px2;
        }
    }
    return best;
}

SurfacePoint pointOf(OwnerRecord owner, Corners c, dvec2 sample_px) {
    if (!uses(kUsesVarying) || (owner.flags & kConstantShade) != 0u)
        return SurfacePoint(dvec3(1.0, 0.0, 0.0), dvec3(0.0), dvec3(0.0), dvec3(0.0));
    dvec2 uv = imagePlanePoint(sample_px, closestOffset(owner, sample_px), dvec2(frame.offset_x, frame.offset_y),
                               dvec2(frame.whole_x, frame.whole_y), dvec2(frame.fraction_x, frame.fraction_y),
                               frame.scale_px);
    return surfacePointAt(cornerPosition(c, c.vertex0), cornerPosition(c, c.vertex1), cornerPosition(c, c.vertex2), uv,
                          frame.perspective != 0u, frame.scale_px);
}

/// Colour and alpha of a triangle; `turns` counts what its loops take.
dvec4 shadeTriangle(uint index, dvec2 sample_px, inout int turns) {
    OwnerRecord owner = owner_record[index];
    if (uses(kUsesTable) && (!uses(kUsesShading) || (owner.flags & kFromTable) != 0u))
        return dvec4(table[4u * owner.first], table[4u * owner.first + 1u], table[4u * owner.first + 2u],
                     table[4u * owner.first + 3u]);
    if (!uses(kUsesShading)) return dvec4(0.0);
    Corners c = Corners(owner.vertex0, owner.vertex1, owner.vertex2, surfaces[owner.surface]);
    MaterialRecord material = materials[c.surface.material];
    turns += int(5u * owner.pieces + material.maps + frame.lights + 4u);
    if (turns > kBudget) return dvec4(0.0);
    SurfacePoint at = pointOf(owner, c, sample_px);
    Look look = lookAt(owner, material, c, at);
    dvec3 color = dvec3(look.base);
    if (uses(kUsesLight) && material.unlit == 0u) color = litColor(look, at.p_eye);
    return dvec4(color, opacityOf(material, look.base.a));
}

precise dvec3 plusShare(dvec3 color, double share, dvec3 more) { return color + share * more; }
precise double oneLess(double x) { return 1.0 - x; }

/// Layers over each other, front to back, over the background: composite.h.
dvec4 shadeLayers(uint owner, uint first, uint count, dvec2 sample_px, inout int turns) {
    dvec3 color = dvec3(0.0);
    double left = 1.0;
    for (uint k = 0u; k < count && turns <= kBudget; ++k) {
        ++turns;
        uint layer = isStack(owner) ? stack_layers[first + k] : owner;
        if (layer == kBackground) break;
        dvec4 shade = shadeTriangle(layer, sample_px, turns);
        bool last = k + 1u == count;
        color = plusShare(color, shareOf(left, shade.a, last), dvec3(shade));
        left = leftBehind(left, shade.a, last);
    }
    return dvec4(plusShare(color, left, backgroundColor()), oneLess(left));
}

bool allFromTable(uint owner, uint first, uint count) {
    for (uint k = 0u; k < count; ++k) {
        uint layer = isStack(owner) ? stack_layers[first + k] : owner;
        if (layer != kBackground && (owner_record[layer].flags & kFromTable) == 0u) return false;
    }
    return true;
}

/// The pixel whose entry this is: the last whose entries begin at or before it.
uint pixelOf(uint entry) {
    uint signed_by = entry_pixel[entry];
    if (signed_by != kAbsent) return signed_by;
    uint low = 0u, high = push.pixels;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (offsets[middle] <= entry) low = middle;
        else high = middle;
    }
    return low;
}

precise dvec2 sampleOf(uint pixel) {
    dvec2 corner = dvec2(push.x0 + int(pixel % push.width), push.y0 + int(pixel / push.width));
    return (corner + 0.5) + dvec2(frame.offset_x, frame.offset_y);
}

precise dvec2 plus(dvec2 a, dvec2 b) { return a + b; }
precise dvec4 plus(dvec4 a, dvec4 b) { return a + b; }
precise dvec4 meanOf(dvec4 sum, uint count) { return sum / double(count); }

dvec4 shadeEntry(uint entry, inout int turns) {
    uint owner = entry_owner[entry], first = 0u, count = 1u;
    if (isStack(owner)) {
        first = stack_first[owner - kFirstStack];
        count = stack_first[owner - kFirstStack + 1u] - first;
    }
    dvec2 sample_px = dvec2(0.0);
    if (uses(kUsesVarying)) sample_px = sampleOf(pixelOf(entry));
    if (!uses(kUsesPoints)) return shadeLayers(owner, first, count, sample_px, turns);
    uint begin = entry == 0u ? 0u : point_end[entry - 1u], points = point_end[entry] - begin;
    bool once = points == 0u || (uses(kUsesTable) && allFromTable(owner, first, count));
    dvec4 sum = dvec4(0.0);
    for (uint i = 0u; i < (once ? 1u : points) && turns <= kBudget; ++i) {
        ++turns;
        dvec2 offset = once ? dvec2(0.0) : dvec2(point_offset[2u * (begin + i)], point_offset[2u * (begin + i) + 1u]);
        sum = plus(sum, shadeLayers(owner, first, count, plus(sample_px, offset), turns));
    }
    return once ? sum : meanOf(sum, points);
}

void main() {
    uint entry = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * push.row;
    if (entry >= push.entries) return;
    int turns = 64 + int(uses(kUsesStacks) ? 2 * 256 : 0);  // pixelOf(), allFromTable()
    dvec4 shade = shadeEntry(entry, turns);
    if (turns > kBudget) {
        shade = dvec4(0.0, 0.0, 0.0, -1.0);
        atomicAdd(handed_back, 1u);
    }
    entry_color[4u * entry] = shade.r;
    entry_color[4u * entry + 1u] = shade.g;
    entry_color[4u * entry + 2u] = shade.b;
    entry_color[4u * entry + 3u] = shade.a;
}
