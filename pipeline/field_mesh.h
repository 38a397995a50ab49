// An SDF scene as triangles for one film: what triangle methods make their picture of.
#pragma once

#include "pipeline/mesh_store.h"
#include "pipeline/methods/method.h"

namespace edgewise {

/// The scene's mesh, its distance from the surface within spec.mesh's `error_px` of a pixel everywhere that
/// the film sees, and as far around it as filters reach; what is not seen is coarse, and stays unseen.
/// Half-spaces that are united with the rest are discs that end where rays do; closed forms are parts of the
/// tree. Depends on the whole film, not on its crop.
struct FieldMesh {
    Scene scene;
    MeshReport report;
};

/// Throws InputError naming the method for a scene with other unbounded parts, and for an eye within a
/// half-space; else as polygonize() does.
/// `store`: of the input's scene, camera and film.
FieldMesh meshForFilm(const MethodSpec& spec, const MethodInput& input, const MeshStore* store = nullptr);

/// As the method's note says it.
std::string wordsOf(const MeshReport& report);

}  // namespace edgewise
