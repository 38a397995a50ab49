// Border shares: what a hand can compute, and crossings that rounding exchanged.
#include "analytic/border.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

namespace edgewise {
namespace {

constexpr Owner A = 1, B = 2, C = 3, D = 4;

BorderCrossing at(double turns, Owner before, Owner after, double doubt = 0x1p-51) {
    return {turns, static_cast<std::int64_t>(std::ldexp(turns, 60)), doubt, 0.0, before, after};
}

struct Shared {
    std::map<Owner, double> share;
    std::int64_t sum = 0;
    int conflicts = 0;
};

Shared shared(std::vector<BorderCrossing> crossings, bool circle, Owner base) {
    std::vector<BorderShare> shares;
    Shared out;
    out.conflicts = shareBorder(crossings, circle, base, shares);
    for (const BorderShare& s : shares) {
        out.share[s.owner] += std::ldexp(static_cast<double>(s.share), -60);
        out.sum += s.share;
    }
    return out;
}

TEST(Border, StretchesOfACircle) {
    const Shared s = shared({at(0.25, B, A), at(-0.25, A, B)}, true, C);
    EXPECT_EQ(s.conflicts, 0);
    EXPECT_DOUBLE_EQ(s.share.at(A), 0.5);
    EXPECT_DOUBLE_EQ(s.share.at(B), 0.5);
    EXPECT_EQ(s.share.count(C), 0u);
}

TEST(Border, StretchesOfASide) {
    const Shared s = shared({at(0.25, A, B), at(0.75, B, C)}, false, D);
    EXPECT_EQ(s.conflicts, 0);
    EXPECT_DOUBLE_EQ(s.share.at(A), 0.25);
    EXPECT_DOUBLE_EQ(s.share.at(B), 0.5);
    EXPECT_DOUBLE_EQ(s.share.at(C), 0.25);
}

/// The line between B and C has come to lie beyond the one between C and A: C has what it lost on the other
/// side of them, and that is what its terms lack.
TEST(Border, ExchangedCrossingsKeepTheirPositions) {
    const double d = 0x1p-20;
    for (const bool circle : {true, false}) {
        const Shared s = shared({at(0.125, A, B), at(0.25 + d, B, C), at(0.25, C, A)}, circle, D);
        EXPECT_EQ(s.conflicts, 0);
        EXPECT_EQ(s.sum, std::int64_t{1} << 60);
        EXPECT_DOUBLE_EQ(s.share.at(A), 0.875);
        EXPECT_DOUBLE_EQ(s.share.at(B), 0.125 + d);
        EXPECT_DOUBLE_EQ(s.share.at(C), -d);
    }
}

/// Behind an edge that touches the circle a corner of C reaches through it: the circle is A's all the same.
TEST(Border, CornersBehindATangentLeaveTheCircleToItsOwner) {
    const double d = 0x1p-40, doubt = 0x1p-24;
    const Shared s =
        shared({at(-0.25, C, B, doubt), at(-0.25 + d, B, C, doubt), at(0.0, A, D), at(0.25, D, A)}, true, D);
    EXPECT_EQ(s.conflicts, 0);
    EXPECT_DOUBLE_EQ(s.share.at(A), 0.75);
    EXPECT_DOUBLE_EQ(s.share.at(D), 0.25);
    EXPECT_NEAR(s.share.at(B), 0.0, 2 * d);
    EXPECT_NEAR(s.share.at(C), 0.0, 2 * d);
}

/// A vertex on the border with many edges, the steepest of which rounding has moved furthest: the one that
/// comes first is not the one that leads in.
/// Two sides of a sliver enter the circle at a vertex on it, nearly along it: which comes first is rounding's
/// choice, and wrongly chosen it would give A the whole border.
TEST(Border, ExchangedSidesOfASliverLeaveTheCircleToTheBase) {
    const double doubt = 0x1p-38, apart = 0x1p-43;
    for (const bool exchanged : {true, false}) {
        const double first = exchanged ? -0.25 + apart : -0.25, second = exchanged ? -0.25 : -0.25 + apart;
        const Shared s = shared({at(first, B, A, doubt), at(second, A, B, doubt)}, true, B);
        EXPECT_EQ(s.conflicts, 0);
        EXPECT_EQ(s.sum, std::int64_t{1} << 60);
        EXPECT_NEAR(s.share.at(A), 0, doubt);
        EXPECT_NEAR(s.share.at(B), 1, doubt);
    }
}

TEST(Border, AVertexOnTheBorderIsEnteredByItsOwnFirstLabel) {
    const double v = 0.375, far = 0x1p-44;
    const std::vector<BorderCrossing> fan{at(v - far, B, C, 4 * far), at(v, C, D, 0x1p-50),
                                          at(v + 0x1p-50, A, B, 8 * far), at(v + far, D, 9, 8 * far)};
    const Shared side = shared(fan, false, D);
    EXPECT_EQ(side.conflicts, 0);
    EXPECT_EQ(side.sum, std::int64_t{1} << 60);
    EXPECT_NEAR(side.share.at(A), v, 2 * far);
    EXPECT_NEAR(side.share.at(9), 1 - v, 2 * far);
    auto closed = fan;
    closed.push_back(at(-0.25, 9, A));
    const Shared circle = shared(closed, true, D);
    EXPECT_EQ(circle.conflicts, 0);
    EXPECT_EQ(circle.sum, std::int64_t{1} << 60);
    EXPECT_NEAR(circle.share.at(A), v + 0.25, 2 * far);
}

TEST(Border, AnOpenMapIsAConflictAndStillSumsToOne) {
    const Shared s = shared({at(0.0, A, B), at(0.25, C, A)}, true, A);
    EXPECT_EQ(s.conflicts, 1);
    EXPECT_EQ(s.sum, std::int64_t{1} << 60);
}

TEST(Border, TheOrderOfTheListChangesNothing) {
    constexpr int kLists = 300;
    constexpr unsigned kSeed = 7;
    std::mt19937 rng(kSeed);
    int exchanged = 0;
    for (int k = 0; k < kLists; ++k) {
        std::vector<BorderCrossing> list;
        const int count = 2 + static_cast<int>(rng() % 12);
        for (int i = 0; i < count; ++i) {
            const double moved = std::ldexp(static_cast<double>(rng() % 5), -50);
            list.push_back(at(-0.4 + 0.05 * (i / 3) + moved, Owner(i), Owner((i + 1) % count)));
            exchanged += i > 0 && list[i].order < list[i - 1].order;
        }
        const Shared one = shared(list, true, A);
        std::shuffle(list.begin(), list.end(), rng);
        const Shared other = shared(list, true, A);
        EXPECT_EQ(one.conflicts, 0) << "list " << k << " of seed " << kSeed;
        EXPECT_EQ(one.sum, std::int64_t{1} << 60);
        EXPECT_EQ(one.share, other.share);
    }
    EXPECT_GT(exchanged, 100);
}

/// A crossing that changes nothing sends the list the long way, through clusters: the shares are the same.
TEST(Border, CrossingsFarApartTakeTheShortWayToTheSameShares) {
    const unsigned seed = 271828;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> step(0.01, 0.09);
    std::uniform_int_distribution<int> owner(0, 5);
    for (int round = 0; round < 1000; ++round) {
        std::vector<BorderCrossing> chain;
        const Owner first = static_cast<Owner>(owner(random));
        Owner label = first;
        double turns = -0.5;
        for (int i = 0; i < 7; ++i) {
            Owner next = static_cast<Owner>(owner(random));
            if (i == 6) next = first;
            if (next == label) next = label + 10;
            chain.push_back(at(turns += step(random), label, next));
            label = next;
        }
        chain.back().after = first;
        if (chain.back().before == first) chain.pop_back(), chain.back().after = first;
        if (chain.back().before == first) continue;
        std::vector<BorderCrossing> longer = chain;
        const double between =
            0.5 * (std::ldexp(double(chain[0].position), -60) + std::ldexp(double(chain[1].position), -60));
        longer.push_back(at(between, chain[0].after, chain[0].after));
        const Shared one = shared(chain, true, D), other = shared(longer, true, D);
        ASSERT_EQ(one.conflicts, 0) << "seed " << seed << " round " << round;
        ASSERT_EQ(other.conflicts, 0) << "seed " << seed << " round " << round;
        ASSERT_EQ(one.sum, other.sum);
        ASSERT_EQ(one.share.size(), other.share.size());
        for (const auto& [who, share] : one.share)
            ASSERT_NEAR(share, other.share.at(who), 8 * 0x1p-53) << "seed " << seed << " round " << round;
    }
}

}  // namespace
}  // namespace edgewise
