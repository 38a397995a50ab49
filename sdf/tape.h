// An SDF as a list of instructions on numbered slots: what every evaluator runs, and what pruning shortens.
#pragma once

#include <array>
#include <cstdint>

#include <string_view>
#include <vector>

#include "sdf/codes.h"

namespace edgewise::sdf {

inline constexpr std::uint32_t kNoMaterial = 0xffffffffu;

/// Slots for positions and for values; a tree that needs more of either is refused when it is lowered.
inline constexpr int kMostSlots = 128;

struct Instruction {
    Code code = Code::keep;
    /// Shapes: value slot `to` from position slot `a`. Moves: position slot `to` from position slot `a`.
    /// Values: value slot `to` from itself, with position slot `b` where the code asks for one. Pairs: value
    /// slot `to` from itself and value slot `b`. keep: value slot `to` from value slot `b`.
    std::uint8_t to = 0, a = 0, b = 0;
    std::uint32_t numbers = 0;             ///< where its numbers begin in Tape::numbers
    std::uint32_t material = kNoMaterial;  ///< of shapes
    std::uint32_t node = 0;                ///< of the tree it was lowered from
    /// How fast the result changes with the world's position: |difference| <= lipschitz * distance. Moves: of
    /// the position.
    double lipschitz = 1.0;
};

/// An instruction of a shortened tape: the whole tape's by its index, or what is left of a pair there.
struct Pick {
    enum Kind : std::uint32_t { kAsItIs, kKeep, kComplement };
    std::uint32_t index : 30, kind : 2;
};

/// What evaluators take: a whole tape, or the instructions of it that were picked.
struct TapeView {
    const Instruction* instructions = nullptr;
    const double* numbers = nullptr;
    const Pick* picks = nullptr;  ///< none: all
    std::size_t count = 0;

    std::size_t size() const { return count; }
    /// For each in order: f(the whole tape's instruction, its code here).
    template <class F>
    [[gnu::always_inline]] inline void forEach(const F& f) const {
        for (std::size_t n = 0; n < count; ++n) {
            const Pick pick = picks ? picks[n] : Pick{static_cast<std::uint32_t>(n), Pick::kAsItIs};
            const Instruction& i = instructions[pick.index];
            f(i, codeOf(i, pick));
        }
    }
    [[gnu::always_inline]] static inline Code codeOf(const Instruction& i, Pick pick) {
        return pick.kind == Pick::kAsItIs ? i.code
               : pick.kind == Pick::kKeep ? Code::keep
                                          : Code::complementOf;
    }
};

/// The world's position is position slot 0; the result is value slot 0.
struct Tape {
    std::vector<Instruction> instructions;
    std::vector<double> numbers;
    int positions = 1, values = 1;  ///< slots in use
    double lipschitz = 1.0;         ///< of the whole

    std::size_t size() const { return instructions.size(); }
    operator TapeView() const { return {instructions.data(), numbers.data(), nullptr, size()}; }
};

/// What an instruction is, for those that print or analyse it.
struct CodeInfo {
    std::string_view name;  ///< of its function in the shared text
    CodeForm form;
    /// Its numbers in order: 'r' a real, 'v' three of a vector.
    std::string_view numbers;
    int numberCount() const;
};
const CodeInfo& codeInfo(Code code);

}  // namespace edgewise::sdf
