// tinygltf's code, compiled as our own under a name of its own: Debian's libdraco exports another version of
// the same symbols, and whichever the linker finds first would win for both. No file access, no image decoder
// in it.
#include <fstream>  // tiny_gltf.h forgets it without its file access
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
