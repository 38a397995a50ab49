#include "sdf/tape_batches.h"

#include <algorithm>

namespace edgewise::sdf {
namespace {

CodeForm formOf(const Instruction& i) {
    return codeInfo(i.code).form;
}

bool writesValue(const Instruction& i, int slot) {
    return formOf(i) != CodeForm::kMove && i.to == slot;
}

/// A pair's second child begins after the last instruction that gave the first side its value. Nothing, where
/// the child is no block of its own (a pruned tape).
std::size_t blockBegin(const Tape& tape, std::size_t pair) {
    std::size_t at = pair;
    while (at > 0 && !writesValue(tape.instructions[at - 1], tape.instructions[pair].to)) --at;
    return at;
}

bool sameNumbers(const Tape& tape, const Instruction& a, const Instruction& b) {
    const auto* numbers = tape.numbers.data();
    return std::equal(numbers + a.numbers, numbers + a.numbers + codeInfo(a.code).numberCount(),
                      numbers + b.numbers);
}

bool alike(const Tape& tape, std::size_t a, std::size_t b, std::size_t length) {
    for (std::size_t k = 0; k < length; ++k) {
        const Instruction &x = tape.instructions[a + k], &y = tape.instructions[b + k];
        if (x.code != y.code || x.to != y.to || x.a != y.a || x.b != y.b) return false;
    }
    return sameNumbers(tape, tape.instructions[a + length - 1], tape.instructions[b + length - 1]);
}

}  // namespace

std::vector<TapeBatch> findBatches(const Tape& tape, const BatchRule& rule) {
    std::vector<TapeBatch> found;
    for (std::size_t i = 0; i < tape.size(); ++i) {
        if (formOf(tape.instructions[i]) != CodeForm::kPair) continue;
        const std::size_t begin = blockBegin(tape, i), length = i + 1 - begin;
        const auto before =
            std::find_if(found.rbegin(), found.rend(), [&](const TapeBatch& b) { return b.end() == begin; });
        if (before != found.rend() && before->length == length && alike(tape, before->first, begin, length)) {
            ++before->rows;
        } else if (length > 1) {
            found.push_back({begin, length, 1});
        }
    }
    std::erase_if(found, [&](const TapeBatch& b) {
        return b.rows < rule.least_rows || b.rows * b.length < rule.least_instructions;
    });
    std::ranges::sort(found, [](const TapeBatch& a, const TapeBatch& b) {
        return a.first != b.first ? a.first < b.first : a.end() > b.end();
    });
    std::vector<TapeBatch> outer;
    for (const TapeBatch& b : found) {
        while (!outer.empty() && b.first <= outer.back().first && b.end() >= outer.back().end())
            outer.pop_back();
        if (outer.empty() || b.first >= outer.back().end()) outer.push_back(b);
    }
    return outer;
}

}  // namespace edgewise::sdf
