#include "sdf/slab_tapes.h"

#include <chrono>

#include "sdf/prune.h"

namespace edgewise::sdf {
namespace {

/// Lengths of slabs in widths of their beams.
constexpr double kLengthInWidths = 1.0;
/// A tape shorter than this is not worth shortening, nor is one for fewer points.
constexpr std::size_t kShortTape = 16, kFewPoints = 4;

}  // namespace

Slabs::Slabs(const Beam& top, double t_min, double t_max) : ratios_(top.sine > 0.0) {
    if (ratios_) {
        first_ = std::max(t_min, 1e-6 * t_max);
        length_ = std::log1p(kLengthInWidths * 2.0 * top.sine / std::max(top.cosine, 0.1));
    } else {
        first_ = t_min;
        length_ = std::max(kLengthInWidths * 2.0 * top.half_width, 1e-6 * (t_max - t_min));
    }
}

int Slabs::indexOf(double t, int level) const {
    const double along = ratios_ ? std::log(std::max(t / first_, 1.0)) : std::max(t - first_, 0.0);
    return static_cast<int>(std::min(std::ldexp(along / length_, level), 1e9));
}

double Slabs::begin(int index, int level) const {
    const double along = std::ldexp(index * length_, -level);
    if (ratios_) return index == 0 ? 0.0 : first_ * std::exp(along);
    return first_ + along;
}

PruneCounts& PruneCounts::operator+=(const PruneCounts& other) {
    tapes += other.tapes, instructions += other.instructions, kept += other.kept;
    seconds += other.seconds;
    return *this;
}

SlabTapes::SlabTapes(const Tape& whole, const Slabs& slabs, const Beam& beam, bool prune)
    : whole_(whole), slabs_(slabs), beam_(beam), prune_(prune) {}

SlabTapes::SlabTapes(SlabTapes& parent, const Beam& beam)
    : whole_(parent.whole_),
      slabs_(parent.slabs_),
      parent_(&parent),
      beam_(beam),
      level_(parent.level_ + 1),
      prune_(parent.prune_) {}

const Tape& SlabTapes::of(int index, std::size_t points, PruneCounts& counts) {
    if (!prune_) return whole_;
    if (const auto known = tapes_.find(index); known != tapes_.end()) return *known->second;
    const Tape& outer = parent_ ? parent_->of(index >> 1, points * 4, counts) : whole_;
    if (outer.size() < kShortTape || points < kFewPoints) return outer;
    return make(index, outer, counts);
}

const Tape& SlabTapes::make(int index, const Tape& from, PruneCounts& counts) {
    const auto start = std::chrono::steady_clock::now();
    const Ball ball = beam_.around(slabs_.begin(index, level_), slabs_.begin(index + 1, level_));
    auto& tape = tapes_[index];
    tape = std::make_unique<const Tape>(pruneTape(from, ball.centre_world, ball.radius));
    ++counts.tapes;
    counts.instructions += from.size(), counts.kept += tape->size();
    counts.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return *tape;
}

}  // namespace edgewise::sdf
