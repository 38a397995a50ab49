#version 460
// Three vertices a piece of the screen, pulled from the scene's tables: on the viewport in pixels, w = 1, the depth
// affine on the screen and mapped into (0, 1). All of it is double up to the one rounding of the result.
#include "shared/layouts.glsl"
layout(std430, binding = kRasterTriangles) readonly buffer Triangles { GpuTriangle triangles[]; };
layout(std430, binding = kRasterClipped) readonly buffer Clipped { GpuTriangle clipped[]; };
layout(std430, binding = kRasterPlanes) readonly buffer Planes { double planes[]; };
layout(std430, binding = kRasterPieces) readonly buffer Pieces { uint pieces[]; };
layout(push_constant) uniform Push { RasterPush push; };
layout(location = 0) flat out uint owner;

const double kLeastDepth = 1e-37lf;  // the target is cleared to 0, and the greater depth passes

double depthAt(uint plane, dvec2 p) {
    dvec2 from_anchor = p - dvec2(push.anchor_x, push.anchor_y);
    return planes[3u * plane] * from_anchor.x + (planes[3u * plane + 1u] * from_anchor.y + planes[3u * plane + 2u]);
}

void main() {
    uint piece = pieces[gl_VertexIndex / 3], corner = 2u * uint(gl_VertexIndex % 3);
    bool cut = (piece & kClippedPiece) != 0u;
    piece &= ~kClippedPiece;
    dvec2 p = cut ? dvec2(clipped[piece].p_px[corner], clipped[piece].p_px[corner + 1u])
                  : dvec2(triangles[piece].p_px[corner], triangles[piece].p_px[corner + 1u]);
    uint plane = cut ? clipped[piece].plane : triangles[piece].plane;
    owner = cut ? clipped[piece].owner : triangles[piece].owner;
    dvec2 at = (p - dvec2(push.x0_px, push.y0_px)) * push.scale + dvec2(push.shift_x, push.shift_y);
    double depth = depthAt(plane, p) * push.depth_scale + push.depth_offset;
    gl_Position = vec4(vec2(2.0 * at / dvec2(push.width, push.height) - 1.0),
                       float(clamp(depth, kLeastDepth, 1.0lf)), 1.0);
}
