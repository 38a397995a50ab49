// Scenes that are hard on purpose. All unlit, each triangle of a colour of its own, linear values in [0, 1].
#pragma once

#include "data/generate/gltf_file.h"

namespace edgewise::scenes {

/// Rows of boxes against one long edge, and a slanted edge whose inner vertices lie off it by rounding.
GltfFile makeTJunctions();
/// A tilted quad twice, cut along either diagonal, and a triangle in the same plane, all in one node.
GltfFile makeCoplanarDuplicates();
/// Three nodes with overlapping boxes at one depth, parallel to the screen: the lower index is seen.
GltfFile makeEqualDepth();
/// Triangles 18 px long and 1 to 1e-5 px wide, level, slightly turned and diagonal, before a backdrop.
GltfFile makeSlivers();
/// A thousand triangles around one vertex on the centre of pixel (16, 16).
GltfFile makeFan1000();
/// Points, lines and edge-on triangles, by position and by index, before visible ones.
GltfFile makeZeroArea();
/// Edges on pixel borders and through samples, vertices on samples, strips of 1/16 px.
GltfFile makePixelEdges();
/// A star of wires from 2 px down to 0.012 px, crossed by level wires of 0.4 px.
GltfFile makeThinWires();

/// Three triangles that pierce each other.
GltfFile makePiercing();
/// Sixteen quads through one common line.
GltfFile makePiercingBook();
/// Three triangles, each over the next.
GltfFile makeCyclicOverlap();
/// Triangles cut by the near plane and the far plane, behind the eye, and with vertices on all of these.
GltfFile makeNearPlane();
/// Overlapping decals before their coplanar base in index order, in two primitives of one node, in
/// perspective.
GltfFile makeDecals();
/// 512 triangles facing outwards.
GltfFile makeClosedSphere();
/// Two closed spheres that pierce each other, in a node each.
GltfFile makeTwoSpheres();

}  // namespace edgewise::scenes
