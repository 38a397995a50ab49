// GLSL only: 64-bit words of line_key.glsl.
uint64_t mixFactor() { return packUint2x32(uvec2(0x7f4a7c15u, 0x9e3779b9u)); }
uint64_t bitsOf(double x) { return packUint2x32(unpackDouble2x32(x)); }
