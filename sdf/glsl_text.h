// GLSL from a tape: straight-line code that holds only what the tape uses.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sdf/tape.h"
#include "sdf/tape_batches.h"

namespace edgewise::sdf {

/// Many children of one fold that differ in their numbers and materials alone: a loop over rows of a table.
struct GlslBatch {
    Code fold = Code::unite;
    double blend = 0.0;              ///< the smooth folds' number
    std::uint32_t rows = 0;          ///< children: all but the fold's first
    std::uint32_t first = 0;         ///< of row 0 in GlslField::table
    std::uint32_t stride = 0;        ///< of rows there
    std::uint32_t instructions = 0;  ///< a row
    double lipschitz = 1.0;          ///< of every row's value
    bool prunable = false;           ///< the fold forgets what is far from its value
};

struct GlslField {
    /// Functions. What they need is declared before them:
    ///     uvec4 ew_table[]     `table`, where there are batches
    ///     uint ew_items[]      lists of rows
    ///     uvec2 ew_range[]     by batch: which part of ew_items to fold
    ///     uint ew_turns        grows by the turns of loops
    /// and they define
    ///     float fieldAt(vec3 p)
    ///     uint winnerAt(vec3 p, out vec3 p_local)   the material of the shape that gives the value, as
    ///                                               winnerAt of sdf/evaluate.h; kNoMaterial: it has none
    std::string text;
    /// The same as a pass that makes lists for a ball: for each prunable batch that `ew_range` lists, the
    /// rows that count there are given to ew_keep(batch, row), and ew_forget(batch) says that those so far do
    /// not.
    ///     float listsFor(vec3 p, float radius)      the value at p
    std::string prune_text;
    /// By fours: a row's numbers as bits of floats, then its materials, then zeros.
    std::vector<std::array<std::uint32_t, 4>> table;
    std::vector<GlslBatch> batches;
    std::vector<std::string> functions;  ///< of the shared text that tapes call, sorted
    std::uint32_t rows() const;          ///< of all batches: turns of an evaluation's loops
};

GlslField glslText(const Tape& tape, const BatchRule& rule = {});

/// A float's literal that reads back exactly.
std::string glslNumber(double number);

}  // namespace edgewise::sdf
