// Fan terms of radial kernels, inside the support's disk, and crossings with its circle. [E3]-[E9], [E12]

/// A part of the segment inside the disk: [t1, t2], `len` px long.
struct Piece {
    work t1, t2, len;
};

/// mean over one piece of phi1(r^2 / 2 sigma^2), by `rule`; positions in units of sqrt 2 sigma.
EDGEWISE_FN work phi1Mean(EDGEWISE_IN(RuleView) rule, work h, work t, work step) {
    int count = rule.count;
    work sum = splatWork(EDGEWISE_WORK(0.0));
    EDGEWISE_UNROLL for (int i = 0; i < count; ++i) {
        work at = t + step * EDGEWISE_AT(rule.node, i);
        sum = sum + EDGEWISE_AT(rule.weight, i) * phi1(h * h + at * at);
    }
    return sum;
}

/// The sum of phi1Mean() over a piece's equal parts, those of the lanes that are `mine`.
EDGEWISE_FN work phi1MeanOfParts(EDGEWISE_IN(RuleView) rule, work_mask mine, work parts, work h, work t, work step) {
    work sum = splatWork(EDGEWISE_WORK(0.0));
    for (work_number i = EDGEWISE_WORK(0.0); anyLane(EDGEWISE_BOTH(i < parts, mine)); i += EDGEWISE_WORK(1.0)) {
        work here = phi1Mean(rule, h, t + step * i, step);
        sum = sum + (i < parts ? here : splatWork(EDGEWISE_WORK(0.0)));
    }
    return sum / parts;
}

/// Mean of phi1 over the piece: equal parts of at most 3 sigma, each with the smallest rule that is proven for it.
/// Nodes are counted from the end nearer to the foot point: from the other they would lose their digits near the
/// sample, where phi1 is large. [E9]
EDGEWISE_FN work gaussianMean(EDGEWISE_KERNEL_IN work h, Piece piece) {
    work sigmas = piece.len / numberOf(kernel.sigma);
    work wanted = nearestInteger(sigmas * numberOf(EDGEWISE_REAL(1.0) / kLongestPieceSigmas) + EDGEWISE_WORK(0.5));
    work parts = wanted < EDGEWISE_WORK(1.0) ? splatWork(EDGEWISE_WORK(1.0)) : wanted;  // ceil, or one more
    work part = sigmas / parts;
    work start = absolute(piece.t1) <= absolute(piece.t2) ? piece.t1 : -piece.t2;  // phi1 is even in t
    work hs = h * numberOf(kernel.inverse_reach);
    work ts = start * numberOf(kernel.inverse_reach);
    work step = piece.len * numberOf(kernel.inverse_reach) / parts;
    work_mask first = part <= numberOf(kernel.piece_rules[0].limit_sigma);
    work_mask third = part > numberOf(kernel.piece_rules[1].limit_sigma);
    work_mask second = EDGEWISE_BOTH(part > numberOf(kernel.piece_rules[0].limit_sigma),
                                     part <= numberOf(kernel.piece_rules[1].limit_sigma));
    work mean = splatWork(EDGEWISE_WORK(0.0));
    if (anyLane(first)) mean = first ? phi1MeanOfParts(kernel.piece_rules[0].rule, first, parts, hs, ts, step) : mean;
    if (anyLane(second)) mean = second ? phi1MeanOfParts(kernel.piece_rules[1].rule, second, parts, hs, ts, step) : mean;
    if (anyLane(third)) mean = third ? phi1MeanOfParts(kernel.piece_rules[2].rule, third, parts, hs, ts, step) : mean;
    return mean;
}

/// g of an even polynomial, in powers of (r/R)^2: exact nodes. [E8]
EDGEWISE_FN work polyMean(EDGEWISE_KERNEL_IN work h, Piece piece) {
    int nodes = kernel.poly_rule.count;
    work hs = h / numberOf(kernel.radius);
    work ts = piece.t1 / numberOf(kernel.radius);
    work step = piece.len / numberOf(kernel.radius);
    work mean = splatWork(EDGEWISE_WORK(0.0));
    EDGEWISE_UNROLL for (int i = 0; i < nodes; ++i) {
        work at = ts + step * EDGEWISE_AT(kernel.poly_rule.node, i);
        work q = hs * hs + at * at;
        work g = splatWork(EDGEWISE_AT(kernel.poly, nodes - 1));
        EDGEWISE_UNROLL for (int k = nodes - 2; k >= 0; --k) g = g * q + EDGEWISE_AT(kernel.poly, k);
        mean = mean + EDGEWISE_AT(kernel.poly_rule.weight, i) * g;
    }
    return mean;
}

/// The Gaussian's disk beyond inner_radius, where g is 1/(2 pi r^2): angles, and the piece that is left inside. The
/// parts' lengths add up to those of a short piece, which may be far better known than its ends: on the circle both
/// forms of g agree, so that a cut may err along the line, but no length may be lost: the ends are known to roundings
/// of the radius, however short the chord is. Of a piece longer than the radius the ends of the inside part are known
/// better than its length. [E9]
EDGEWISE_FN work takeOuterAngles(EDGEWISE_KERNEL_IN work h, EDGEWISE_INOUT(Piece) piece) {
    work none = splatWork(EDGEWISE_WORK(0.0));
    work c = halfChord(h, splatWork(numberOf(kernel.inner_radius)));
    work_mask whole = EDGEWISE_EITHER(piece.t2 <= -c, c <= EDGEWISE_WORK(0.0));
    work before = smaller(larger(-c - piece.t1, none), piece.len);
    before = whole ? piece.len : before;
    work after = smaller(larger(piece.t2 - c, none), piece.len - before);
    after = piece.t1 >= c ? piece.len - before : after;
    work before_end = whole ? piece.t2 : -c;
    work after_start = larger(piece.t1, c);
    work angle = before > EDGEWISE_WORK(0.0) ? subtendedAngle(h, piece.t1, before_end, before) : none;
    angle = angle + (after > EDGEWISE_WORK(0.0) ? subtendedAngle(h, after_start, piece.t2, after) : none);
    work_mask is_long = EDGEWISE_BOTH(piece.len > numberOf(kernel.inner_radius), before + after > EDGEWISE_WORK(0.0));
    piece.t1 = larger(piece.t1, -c);
    piece.t2 = smaller(piece.t2, c);
    piece.len = is_long ? larger(piece.t2 - piece.t1, none) : (piece.len - before) - after;
    return angle * EDGEWISE_WORK(0.15915494309189535);
}

EDGEWISE_FN work fanTerm(EDGEWISE_KERNEL_IN work h, Piece whole) {
    Piece piece = whole;
    work outer = splatWork(EDGEWISE_WORK(0.0));
    if (kernel.inner_radius < kernel.radius) outer = takeOuterAngles(EDGEWISE_KERNEL h, piece);
    work area = h * piece.len;
    if (kernel.form == kDiskTerm) return area * numberOf(kernel.scale);
    if (kernel.form == kConeTerm)
        return area * coneMean(h, piece.t1, piece.t2, piece.len, splatWork(numberOf(kernel.radius))) *
               numberOf(kernel.scale);
    if (kernel.form == kGaussianTerm)
        return outer + area * gaussianMean(EDGEWISE_KERNEL h, piece) * numberOf(kernel.scale);
    return area * polyMean(EDGEWISE_KERNEL h, piece) * numberOf(kernel.scale);
}

#ifdef EDGEWISE_FP32
const double kTurnsDoubt = EDGEWISE_REAL(8.881784197001252e-16);

/// Increases with the angle of (x, y) like turns do, from -1/2 to 1/2: by a quarter a quadrant, at a rate of 0.79 to
/// 1.57 times theirs. Float angles are too coarse to sort by.
EDGEWISE_FN real diamondTurns(real x, real y) {
    real quarter = EDGEWISE_REAL(0.25) * y / nonZero(absolute(x) + absolute(y));
    real half_turn = y < EDGEWISE_REAL(0.0) ? splat(EDGEWISE_REAL(-0.5)) : splat(EDGEWISE_REAL(0.5));
    return x < EDGEWISE_REAL(0.0) ? half_turn - quarter : quarter;
}
#else
const double kTurnsDoubt = EDGEWISE_REAL(4.440892098500626e-16);
#endif

/// Where the line at t meets the circle.
EDGEWISE_FN BorderPoint circleCrossing(EDGEWISE_KERNEL_IN Line line, real t, real in_a, real in_b, mask crossed, mask is_exit) {
    BorderPoint point = noCrossing();
    point.crossed = crossed;
    if (!anyLane(crossed)) return point;
    real x = line.h * line.d_y + t * line.d_x;
    real y = t * line.d_y - line.h * line.d_x;
    point.position = atan2Real(workOf(y), workOf(x)) * EDGEWISE_WORK(0.15915494309189535);
#ifdef EDGEWISE_FP32
    point.order = diamondTurns(x, y);
#else
    point.order = point.position;
#endif
    real steep = line.h / nonZero(absolute(t));  // t = -0 is an entry still
    point.spread = spreadFrom(line, t, is_exit ? steep : -steep, in_a, in_b);
    // h errs by 4u R, so the half chord c by 4u R^2/c, or sqrt(8u) R when the line is that near to a tangent
    real amplified = smaller(kernel.radius / larger(absolute(t), splat(EDGEWISE_REAL(9.332636185032189e-302))),
                             splat(EDGEWISE_REAL(134217728.0)));
    point.doubt = (EDGEWISE_REAL(1.0) + amplified) * kTurnsDoubt;
    return point;
}

/// The segment against the support's disk: which ends are inside (0 or 1), where it enters and leaves, what is inside.
struct DiskCut {
    real in_a, in_b, through, entry, exit;
    mask touched;
    real t1, t2, len;
};

EDGEWISE_FN DiskCut cutByDisk(EDGEWISE_KERNEL_IN Line line) {
    real one = splat(EDGEWISE_REAL(1.0));
    real none = splat(EDGEWISE_REAL(0.0));
    double R2 = kernel.radius * kernel.radius;
    real c = halfChord(line.h, splat(kernel.radius));
    DiskCut cut;
    cut.in_a = line.a_x * line.a_x + line.a_y * line.a_y <= R2 ? one : none;
    cut.in_b = line.b_x * line.b_x + line.b_y * line.b_y <= R2 ? one : none;
    real chord = (line.t_a < EDGEWISE_REAL(0.0) ? one : none) * (line.t_b > EDGEWISE_REAL(0.0) ? one : none) *
                 (c > EDGEWISE_REAL(0.0) ? one : none);
    cut.through = chord * (EDGEWISE_REAL(1.0) - cut.in_a) * (EDGEWISE_REAL(1.0) - cut.in_b);
    cut.touched = cut.in_a + cut.in_b + cut.through > EDGEWISE_REAL(0.5);
    // A short piece may count as leaving where its line enters, and an end may lie past the rounded chord: the
    // crossing is on the segment all the same. [E4]
    cut.entry = larger(smaller(-c, line.t_b), line.t_a);
    cut.exit = smaller(larger(c, line.t_a), line.t_b);
    cut.t1 = cut.in_a > EDGEWISE_REAL(0.5) ? line.t_a : cut.entry;
    cut.t2 = cut.in_b > EDGEWISE_REAL(0.5) ? line.t_b : cut.exit;
    cut.len = cut.in_a + cut.in_b > EDGEWISE_REAL(1.5) ? line.len : larger(cut.t2 - cut.t1, none);
    cut.len = cut.touched ? cut.len : none;
    return cut;
}

EDGEWISE_FN mask entersDisk(EDGEWISE_IN(DiskCut) cut) {
    return (EDGEWISE_REAL(1.0) - cut.in_a) * (cut.in_b + cut.through) > EDGEWISE_REAL(0.5);
}
EDGEWISE_FN mask leavesDisk(EDGEWISE_IN(DiskCut) cut) {
    return (EDGEWISE_REAL(1.0) - cut.in_b) * (cut.in_a + cut.through) > EDGEWISE_REAL(0.5);
}

EDGEWISE_FN EdgeTerm fanTerms(EDGEWISE_KERNEL_IN Line line) {
    DiskCut cut = cutByDisk(EDGEWISE_KERNEL line);
    EdgeTerm term;
    term.touched = cut.touched;
    term.value = splatWork(EDGEWISE_WORK(0.0));
    term.entry = noCrossing();
    term.exit = noCrossing();
    if (!anyLane(cut.touched)) return term;
    Piece piece;
    piece.t1 = workOf(cut.t1);
    piece.t2 = workOf(cut.t2);
    piece.len = workOf(cut.len);
    term.value = flushTiny(fanTerm(EDGEWISE_KERNEL workOf(line.h), piece));
    mask never = cut.in_a < EDGEWISE_REAL(0.0);
    mask always = cut.in_a >= EDGEWISE_REAL(0.0);
    term.entry = circleCrossing(EDGEWISE_KERNEL line, cut.entry, cut.in_a, cut.in_b, entersDisk(cut), never);
    term.exit = circleCrossing(EDGEWISE_KERNEL line, cut.exit, cut.in_a, cut.in_b, leavesDisk(cut), always);
    return term;
}
