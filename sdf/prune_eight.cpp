// pruneTape() for eight balls at once.
#include "sdf/prune.h"

namespace edgewise::sdf {
namespace {

/// Backwards through eight shorter tapes: a bit of what is needed is a ball's.
class Keeping {
  public:
    explicit Keeping(PickLists& shorter) : buffer_(shorter.buffer.data()), next_(shorter.begin) {
        values_[0] = 0xff;
        for (int ball = 0; ball < kPointLanes; ++ball) next_[ball] = (ball + 1) * shorter.room;
    }

    void take(const Verdict& v, Pick pick) {
        Set& written = v.form == CodeForm::kMove ? positions_[v.to] : values_[v.to];
        const Set needed = written;
        if (needed == 0) return;
        switch (v.form) {
            case CodeForm::kPair:
                return pair(v, pick, needed);
            case CodeForm::kMove:
            case CodeForm::kShape:
                written = 0;
                positions_[v.from] |= needed;
                break;
            case CodeForm::kValueAt:
                positions_[v.from] |= needed;
                break;
            case CodeForm::kKeep:
                written = 0;
                values_[v.from] |= needed;
                break;
            case CodeForm::kValue:
                break;
        }
        add(pick, needed);
    }

  private:
    using Set = std::uint8_t;

    void pair(const Verdict& v, Pick pick, Set needed) {
        const Set second = needed & v.second;
        const Set both = static_cast<Set>(needed & ~(v.first | v.second));
        values_[v.from] |= second | both;
        values_[v.to] = static_cast<Set>(needed & ~second);
        if (both != 0) add(pick, both);
        if (second == 0) return;
        if (v.negates) add({pick.index, Pick::kComplement}, second);
        add({pick.index, Pick::kKeep}, second);
    }
    /// Written to all lists, and kept in some: no branch has to be foretold.
    void add(Pick pick, unsigned balls) {
        for (unsigned ball = 0; ball < kPointLanes; ++ball) {
            buffer_[next_[ball] - 1] = pick;
            next_[ball] -= balls >> ball & 1;
        }
    }

    Pick* buffer_;
    std::array<std::size_t, kPointLanes>& next_;
    std::array<Set, kMostSlots> positions_{}, values_{};
};

}  // namespace

void pruneEight(const TapeView& tape, int positions, int values, const LanePoints& centres, double radius,
                PickLists& shorter) {
    thread_local std::vector<Verdict> verdicts;
    if (verdicts.size() < tape.size()) verdicts.resize(tape.size());
    const double longest_path = positions + values + 2.0;
    laneVerdicts(tape, {centres, radius, kDoubleRounding * kRoundingsAnInstruction * longest_path},
                 verdicts.data());
    shorter.room = 2 * tape.size() + 1;  // a pair may leave two; one is written before a list's begin
    if (shorter.buffer.size() < kPointLanes * shorter.room) shorter.buffer.resize(kPointLanes * shorter.room);
    Keeping keeping(shorter);
    for (std::size_t n = tape.size(); n-- > 0;)
        keeping.take(verdicts[n],
                     tape.picks ? tape.picks[n] : Pick{static_cast<std::uint32_t>(n), Pick::kAsItIs});
}

}  // namespace edgewise::sdf
