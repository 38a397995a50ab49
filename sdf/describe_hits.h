// What is known of hits of the field beside their place, for many neighbours at once.
#pragma once

#include <span>

#include "sdf/surface_tracer.h"
#include "sdf/tape.h"

namespace edgewise::sdf {

/// Gives hits whose p_world and t are known what describeHit() gives: the bits that SceneTracer::fieldHit
/// gives to hits on the ray's side. `prune`: by tapes that are shortened for a ball around them, then for
/// halves of them. `materials`: how many there are.
void describeHits(const Tape& tape, std::span<SurfaceHit*> hits, std::size_t materials, bool prune);

}  // namespace edgewise::sdf
