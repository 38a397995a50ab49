// pruneTape() for eight balls at once.
#include <bit>

#include "sdf/prune.h"

namespace edgewise::sdf {
namespace {

CodeForm formOf(Code code) {
    return kCodeForms[static_cast<int>(code)];
}

/// Backwards through eight shorter tapes: a bit of what is needed is a ball's.
class Keeping {
  public:
    explicit Keeping(PickLists& shorter) : shorter_(shorter) {
        values_[0] = 0xff;
        for (int ball = 0; ball < kPointLanes; ++ball)
            next_[ball] = shorter.buffer[ball].data() + shorter.buffer[ball].size();
    }
    ~Keeping() {
        for (int ball = 0; ball < kPointLanes; ++ball)
            shorter_.begin[ball] = static_cast<std::size_t>(next_[ball] - shorter_.buffer[ball].data());
    }

    /// `winners`: past the pair's own.
    void take(const Instruction& i, Code code, Pick pick, const PairWinners*& winners) {
        const CodeForm form = formOf(code);
        if (form == CodeForm::kPair) --winners;
        Set& written = form == CodeForm::kMove ? positions_[i.to] : values_[i.to];
        const Set needed = written;
        if (needed == 0) return;
        if (form == CodeForm::kPair) return pair(i, pick, *winners, needed);
        if (form == CodeForm::kMove || form == CodeForm::kShape) written = 0, positions_[i.a] |= needed;
        if (form == CodeForm::kValueAt) positions_[i.b] |= needed;
        if (form == CodeForm::kKeep) written = 0, values_[i.b] |= needed;
        add(pick, needed);
    }

  private:
    using Set = std::uint8_t;

    void pair(const Instruction& i, Pick pick, const PairWinners& winners, Set needed) {
        const Set second = needed & winners.second;
        const Set both = static_cast<Set>(needed & ~(winners.first | winners.second));
        values_[i.b] |= second | both;
        values_[i.to] = static_cast<Set>(needed & ~second);
        add(pick, both);
        if (second == 0) return;
        const bool cuts = i.code == Code::subtract || i.code == Code::smoothSubtract;
        if (cuts) add({pick.index, Pick::kComplement}, second);
        add({pick.index, Pick::kKeep}, second);
    }
    void add(Pick pick, unsigned balls) {
        for (; balls != 0; balls &= balls - 1) *--next_[std::countr_zero(balls)] = pick;
    }

    PickLists& shorter_;
    std::array<Pick*, kPointLanes> next_{};
    std::array<Set, kMostSlots> positions_{}, values_{};
};

std::size_t pairsOf(const TapeView& tape) {
    std::size_t pairs = 0;
    tape.forEach([&](const Instruction&, Code code) { pairs += formOf(code) == CodeForm::kPair; });
    return pairs;
}

}  // namespace

void pruneEight(const TapeView& tape, int positions, int values, const LanePoints& centres, double radius,
                PickLists& shorter) {
    thread_local std::vector<PairWinners> winners;
    const std::size_t pairs = pairsOf(tape);
    if (winners.size() < pairs) winners.resize(pairs);
    const double longest_path = positions + values + 2.0;
    laneWinners(tape, {centres, radius, kDoubleRounding * kRoundingsAnInstruction * longest_path},
                winners.data());
    const std::size_t most = tape.size() + pairs;
    for (std::vector<Pick>& buffer : shorter.buffer)
        if (buffer.size() < most) buffer.resize(most);
    const PairWinners* next = winners.data() + pairs;
    Keeping keeping(shorter);
    for (std::size_t n = tape.size(); n-- > 0;) {
        const Pick pick = tape.picks ? tape.picks[n] : Pick{static_cast<std::uint32_t>(n), Pick::kAsItIs};
        const Instruction& i = tape.instructions[pick.index];
        keeping.take(i, TapeView::codeOf(i, pick), pick, next);
    }
}

}  // namespace edgewise::sdf
