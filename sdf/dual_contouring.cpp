#include "sdf/polygonize.h"
namespace edgewise::sdf {
SurfaceMesh dualContouring(const MeshRequest& request, MeshCounts& counts) { return marchingCubes(request, counts); }
}
