#version 460
// The owner of a sample.
layout(location = 0) flat in uint owner;
layout(location = 0) out uint id;

void main() { id = owner; }
