#version 460
// The owner of a pixel's covered samples, as four bytes: devices need not multisample integers.
layout(location = 0) flat in uint owner;
layout(location = 0) out vec4 bytes;

void main() { bytes = unpackUnorm4x8(owner); }
