#include "sdf/prune.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>

#include "sdf/machine.h"

namespace edgewise::sdf {
namespace {

enum class Winner : unsigned char { kEither, kFirst, kSecond };

/// Both sides of a pair, the second as the pair takes it, at the centre and as far as they reach in the ball.
struct Side {
    double value, reach;
    double low() const { return value - reach; }
    double high() const { return value + reach; }
};

/// Whether the sides are apart by more than `band`, and which is below.
Winner lower(const Side& a, const Side& b, double band) {
    if (b.low() - a.high() > band) return Winner::kFirst;
    return a.low() - b.high() > band ? Winner::kSecond : Winner::kEither;
}
Winner higher(const Side& a, const Side& b, double band) {
    if (a.low() - b.high() > band) return Winner::kFirst;
    return b.low() - a.high() > band ? Winner::kSecond : Winner::kEither;
}

class Pruning {
  public:
    Pruning(const Tape& tape, const glm::dvec3& centre, double radius, double rounding)
        : tape_(tape), centre_(centre), radius_(radius), winners_(tape.size(), Winner::kEither) {
        const double longest_path = tape.positions + tape.values + 2.0;
        rounding_ = rounding * kRoundingsAnInstruction * longest_path;
        size_ = std::abs(centre.x) + std::abs(centre.y) + std::abs(centre.z) + radius;
    }

    Tape run() {
        decide();
        return kept();
    }

  private:
    /// Runs the whole tape at the centre.
    void decide() {
        thread_local Slots<double> slots;
        slots.position[0] = {centre_.x, centre_.y, centre_.z};
        for (std::size_t n = 0; n < tape_.size(); ++n) {
            const Instruction& i = tape_.instructions[n];
            const double* numbers = tape_.numbers.data() + i.numbers;
            const CodeForm form = codeInfo(i.code).form;
            if (form == CodeForm::kPair) winners_[n] = winnerOf(i, numbers, slots);
            step(i, numbers, slots);
            if (form != CodeForm::kMove) slope_[i.to] = form == CodeForm::kKeep ? slope_[i.b] : i.lipschitz;
        }
    }

    Side side(double value, double slope) const {
        return {value, slope * radius_ + rounding_ * (size_ * std::max(slope, 1.0) + std::abs(value))};
    }

    Winner winnerOf(const Instruction& i, const double* numbers, const Slots<double>& slots) const {
        const Side a = side(slots.value[i.to], slope_[i.to]), b = side(slots.value[i.b], slope_[i.b]);
        const Side minus_b{-b.value, b.reach};
        switch (i.code) {
            case Code::unite:
                return lower(a, b, 0.0);
            case Code::smoothUnite:
                return lower(a, b, numbers[0]);
            case Code::intersect:
                return higher(a, b, 0.0);
            case Code::smoothIntersect:
                return higher(a, b, numbers[0]);
            case Code::subtract:
                return higher(a, minus_b, 0.0);
            default:
                return higher(a, minus_b, numbers[0]);
        }
    }

    /// From the result backwards: what something that is kept reads is kept.
    Tape kept() {
        values_[0] = true;
        for (std::size_t n = tape_.size(); n-- > 0;) keepIfRead(tape_.instructions[n], winners_[n]);
        std::reverse(backwards_.begin(), backwards_.end());
        Tape result;
        result.positions = tape_.positions, result.values = tape_.values, result.lipschitz = tape_.lipschitz;
        result.instructions = std::move(backwards_);
        for (Instruction& i : result.instructions) {
            const auto from = tape_.numbers.begin() + i.numbers;
            i.numbers = static_cast<std::uint32_t>(result.numbers.size());
            result.numbers.insert(result.numbers.end(), from, from + codeInfo(i.code).numberCount());
        }
        return result;
    }

    void keepIfRead(const Instruction& i, Winner winner) {
        const CodeForm form = codeInfo(i.code).form;
        auto& slots = form == CodeForm::kMove ? positions_ : values_;
        if (!slots[i.to]) return;
        switch (form) {
            case CodeForm::kMove:
            case CodeForm::kShape:
                slots[i.to] = false;
                positions_[i.a] = true;
                break;
            case CodeForm::kValueAt:
                positions_[i.b] = true;
                break;
            case CodeForm::kValue:
                break;
            case CodeForm::kKeep:
                values_[i.to] = false;
                values_[i.b] = true;
                break;
            case CodeForm::kPair:
                return keepPair(i, winner);
        }
        backwards_.push_back(i);
    }

    void keepPair(const Instruction& i, Winner winner) {
        if (winner == Winner::kFirst) return;
        values_[i.b] = true;
        if (winner == Winner::kEither) return backwards_.push_back(i);
        values_[i.to] = false;
        Instruction taken = i;
        const bool negated = i.code == Code::subtract || i.code == Code::smoothSubtract;
        if (negated) {
            taken.code = Code::complementOf;
            backwards_.push_back(taken);
        }
        taken.code = Code::keep;
        backwards_.push_back(taken);
    }

    const Tape& tape_;
    const glm::dvec3 centre_;
    const double radius_;
    double rounding_ = 0.0, size_ = 0.0;
    std::vector<Winner> winners_;
    std::array<double, kMostSlots> slope_{};
    std::bitset<kMostSlots> positions_, values_;
    std::vector<Instruction> backwards_;
};

}  // namespace

Tape pruneTape(const Tape& tape, const glm::dvec3& centre_world, double radius, double rounding) {
    return Pruning(tape, centre_world, radius, rounding).run();
}

}  // namespace edgewise::sdf
